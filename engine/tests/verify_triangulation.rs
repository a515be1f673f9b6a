//! Triangulations of fragments: every corner used, no triangle flat or turned over, all sides met exactly once.

mod fragments;

use std::collections::HashMap;

use brisance_engine::geometry::{Polygon, Triangulator};
use fragments::{Draw, mapped, mosaic, shard, star, with_holes};
use glam::DVec2;
use proptest::prelude::*;

type Triangles = Vec<[u32; 3]>;

/// The sign of the area of a triangle, exactly: `robust` is what decides it, and agrees with integers below.
fn turns_left(a: DVec2, b: DVec2, c: DVec2) -> bool {
    let coord = |p: DVec2| robust::Coord { x: p.x, y: p.y };
    robust::orient2d(coord(a), coord(b), coord(c)) > 0.0
}

/// Everything that [`Triangulator::triangulate`] promises, or what is broken.
fn faults(polygon: &Polygon, triangles: &[[u32; 3]]) -> Result<(), String> {
    let points = polygon.points();
    let expected = points.len() + 2 * polygon.hole_count() - 2;
    if triangles.len() != expected {
        return Err(format!("{} triangles, not {expected}", triangles.len()));
    }
    let mut edges: HashMap<(u32, u32), usize> = HashMap::new();
    let mut area = 0.0;
    for &[i, j, k] in triangles {
        let [a, b, c] = [i, j, k].map(|v| points[v as usize]);
        if !turns_left(a, b, c) {
            return Err(format!("{a}, {b}, {c} is flat or turned over"));
        }
        area += 0.5 * (b - a).perp_dot(c - a);
        for edge in [(i, j), (j, k), (k, i)] {
            *edges.entry(edge).or_default() += 1;
        }
    }
    if edges.values().any(|&uses| uses != 1) {
        return Err("an edge is used twice in the same direction".into());
    }
    for ring in polygon.ring_ranges() {
        for from in ring.clone() {
            let to = if from + 1 == ring.end { ring.start } else { from + 1 };
            if edges.remove(&(from as u32, to as u32)).is_none() {
                return Err(format!("no triangle on the side {from} to {to}"));
            }
        }
    }
    if let Some((from, to)) = edges.keys().find(|(from, to)| !edges.contains_key(&(*to, *from))) {
        return Err(format!("the inner edge {from} to {to} has one triangle"));
    }
    // Areas of slivers carry the rounding of products of their length: some 1e-16 of its square a corner.
    let reach = points.iter().map(|p| p.distance_squared(points[0])).fold(0.0, f64::max);
    let allowed = 1e-12 * polygon.area() + 1e-15 * points.len() as f64 * reach;
    if (area - polygon.area()).abs() > allowed {
        return Err(format!("areas sum to {area}, not {}", polygon.area()));
    }
    Ok(())
}

fn cut(polygon: &Polygon) -> Result<Triangles, String> {
    let mut triangles = Triangles::new();
    Triangulator::default().triangulate(polygon, &mut triangles).map_err(|error| error.to_string())?;
    faults(polygon, &triangles)?;
    Ok(triangles)
}

/// The smallest height over the longest side among the triangles: how far from flat the flattest is.
fn least_height(polygon: &Polygon, triangles: &[[u32; 3]]) -> f64 {
    let flatness = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| polygon.points()[v as usize]);
        (b - a).perp_dot(c - a)
            / (b - a).length_squared().max((c - b).length_squared()).max((a - c).length_squared())
    };
    triangles.iter().map(flatness).fold(f64::INFINITY, f64::min)
}

#[test]
fn corners_exactly_in_line_are_used_and_make_no_flat_triangle() {
    // A square with one, two and three corners in the middle of its sides, on whole numbers: exactly in line.
    let corners = [(0, 0), (2, 0), (4, 0), (12, 0), (12, 6), (12, 12), (9, 12), (6, 12), (3, 12), (0, 12)];
    let square = Polygon::new(&corners.map(|(x, y)| DVec2::new(x.into(), y.into())));
    let triangles = cut(&square).unwrap();
    assert!(least_height(&square, &triangles) > 0.05);
    // A triangle whose sides are all but corners in line.
    let along = |a: DVec2, b: DVec2| (0..8).map(move |i| a + (b - a) * f64::from(i) / 8.0);
    let [a, b, c] = [DVec2::ZERO, DVec2::new(16.0, 0.0), DVec2::new(0.0, 8.0)];
    let many: Vec<DVec2> = along(a, b).chain(along(b, c)).chain(along(c, a)).collect();
    cut(&Polygon::new(&many)).unwrap();
}

#[test]
fn a_mosaic_of_a_thousand_pieces_has_no_bad_piece_and_no_needles() {
    for piece in &mosaic(1000, 3) {
        let triangles = cut(piece).unwrap();
        // T-junctions lie out of line by 1e-17: a triangle of nothing but those would be that flat.
        assert!(least_height(piece, &triangles) > 1e-6, "{piece:?}");
    }
}

#[test]
fn thousands_of_corners_and_slivers_are_cut() {
    cut(&shard(5000, 1)).unwrap();
    cut(&Polygon::new(&star(3000, DVec2::ZERO, 1.0, &mut Draw(2)))).unwrap();
    let turn = DVec2::from_angle(0.7);
    for squeeze in [1e-3, 1e-6, 1e-9] {
        for piece in &mosaic(200, 4) {
            cut(&mapped(piece, |p| turn.rotate(DVec2::new(p.x, p.y * squeeze)))).unwrap();
        }
    }
}

#[test]
fn what_is_not_simple_is_refused_and_says_where() {
    let ring = |corners: &[(f64, f64)]| corners.iter().map(|&(x, y)| DVec2::new(x, y)).collect::<Vec<_>>();
    let square = ring(&[(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)]);
    let with_hole = |hole: &[(f64, f64)]| {
        let mut polygon = Polygon::new(&square);
        polygon.push_ring(ring(hole));
        polygon
    };
    let refused = [
        ("crossing", Polygon::new(&ring(&[(0.0, 0.0), (2.0, 2.0), (2.0, 0.0), (0.0, 2.0)]))),
        ("clockwise", Polygon::new(&ring(&[(0.0, 0.0), (0.0, 1.0), (1.0, 0.0)]))),
        ("flat", Polygon::new(&ring(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0)]))),
        ("two corners in one place", Polygon::new(&ring(&[(0.0, 0.0), (1.0, 0.0), (1.0, 0.0), (0.0, 1.0)]))),
        (
            "a corner on a side",
            Polygon::new(&ring(&[(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (2.0, 0.0), (0.0, 4.0)])),
        ),
        ("too few corners", Polygon::new(&square[..2])),
        ("nothing", Polygon::default()),
        ("not finite", Polygon::new(&ring(&[(0.0, 0.0), (1.0, f64::NAN), (0.0, 1.0)]))),
        ("a hole that runs like the outline", with_hole(&[(1.0, 1.0), (2.0, 1.0), (1.0, 2.0)])),
        ("a hole outside", with_hole(&[(5.0, 5.0), (5.0, 6.0), (6.0, 5.0)])),
        ("a hole across the outline", with_hole(&[(3.0, 1.0), (3.0, 2.0), (5.0, 1.0)])),
    ];
    let mut triangles = Triangles::new();
    let mut triangulator = Triangulator::default();
    for (what, polygon) in &refused {
        assert!(triangulator.triangulate(polygon, &mut triangles).is_err(), "{what} was taken");
    }
    // A refusal leaves nothing behind.
    triangulator.triangulate(&Polygon::new(&square), &mut triangles).unwrap();
    assert_eq!(triangles.len(), 2);
}

#[test]
fn what_was_cut_before_does_not_show() {
    // Squares and regular polygons: all their diagonals are as good as each other, so only habit decides.
    let regular = |count: usize| {
        let corner = |i: usize| DVec2::from_angle(std::f64::consts::TAU * i as f64 / count as f64);
        Polygon::new(&(0..count).map(corner).collect::<Vec<_>>())
    };
    let pieces: Vec<Polygon> =
        (4..40).map(regular).chain(mosaic(50, 5)).chain([with_holes(30, 3, 1)]).collect();
    let mut used = Triangulator::default();
    let mut triangles = Triangles::new();
    for piece in pieces.iter().rev() {
        used.triangulate(piece, &mut triangles).unwrap();
    }
    for piece in &pieces {
        used.triangulate(piece, &mut triangles).unwrap();
        assert_eq!(triangles, cut(piece).unwrap());
    }
}

proptest! {
    /// Any fragment, of any shape, anywhere and of any size.
    #[test]
    fn every_fragment_is_cut_right(
        seed in any::<u64>(),
        kind in 0..3,
        count in 6usize..300,
        scale in -4.0f64..2.0,
        place in prop::array::uniform2(-100.0f64..100.0),
    ) {
        let piece = match kind {
            0 => shard(count, seed),
            1 => Polygon::new(&star(count, DVec2::ZERO, 1.0, &mut Draw(seed))),
            _ => with_holes(count.max(12), 1 + (seed % 5) as usize, seed),
        };
        let scale = 10f64.powf(scale);
        let placed = mapped(&piece, |p| DVec2::from_array(place) + p * scale);
        prop_assert_eq!(cut(&placed).err(), None);
    }

    /// Pieces with T-junctions, on every side and of every length.
    #[test]
    fn every_mosaic_is_cut_right(seed in any::<u64>(), cuts in 1usize..60) {
        for piece in &mosaic(cuts, seed) {
            prop_assert_eq!(cut(piece).err(), None);
        }
    }
}
