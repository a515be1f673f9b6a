//! What holds for every crack pattern, whatever its parameters: fragments fill the pane, do not overlap, and share
//! every crack side between exactly two.
//!
//! Each case is drawn from a number, over outlines from 1 mm to 100 m with reflex corners and holes, and over
//! every parameter's range. `BRISANCE_CASES=10000 cargo test --release --test invariants_fracture` runs more.

mod draws;

use std::collections::BTreeMap;
use std::f64::consts::PI;

use brisance_engine::fracture::{
    Depth, Forking, Guide, Nucleus, Order, Pattern, Pieces, Rings, Settings, StressField, Wiggle, outline,
};
use brisance_engine::geometry::Polygon;
use draws::{Draws, cases};
use glam::DVec2;
use robust::{Coord, orient2d};

/// The stream of all numbers here.
const STREAM: u64 = 99;

/// Scale from 1 mm to 100 m, evenly on a logarithmic scale.
fn any_outline(draws: &mut Draws) -> Polygon {
    let size = 1e-3 * 10f64.powf(5.0 * draws.unit());
    let aspect = draws.between(0.2, 1.0);
    let unit: Vec<DVec2> = match draws.whole(0, 4) {
        0 => vec![(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)],
        1 => vec![(0.0, 0.0), (1.0, 0.0), (1.0, 0.4), (0.3, 0.4), (0.3, 1.0), (0.0, 1.0)],
        2 => vec![(0.0, 0.0), (1.0, 0.1), (0.4, 1.0)],
        3 => (0..40)
            .map(|i| f64::from(i) * PI / 20.0)
            .map(|a| (0.5 + 0.5 * a.cos(), 0.5 + 0.5 * a.sin()))
            .collect(),
        // A star with deep reflex corners.
        _ => (0..10)
            .map(|i| (f64::from(i) * PI / 5.0, if i % 2 == 0 { 0.5 } else { 0.22 }))
            .map(|(a, r)| (0.5 + r * a.cos(), 0.5 + r * a.sin()))
            .collect(),
    }
    .into_iter()
    .map(|(x, y)| DVec2::new(x, y))
    .collect();
    let shift = DVec2::new(draws.between(-1.0, 1.0), draws.between(-1.0, 1.0));
    let place = |p: DVec2| (p * DVec2::new(1.0, aspect) + shift) * size;
    let mut polygon = Polygon::default();
    polygon.push_ring(unit.iter().copied().map(place));
    if draws.chance(0.3) {
        let middle = polygon.moments().centroid;
        let radius = 0.05 * size * aspect;
        let corners = draws.whole(3, 9);
        let hole = (0..corners).map(|i| -2.0 * PI * i as f64 / corners as f64);
        let ring: Vec<DVec2> = hole.map(|a| middle + radius * DVec2::from_angle(a)).collect();
        let mut with_hole = polygon.clone();
        with_hole.push_ring(ring);
        if outline::check(&with_hole).is_ok() {
            return with_hole;
        }
    }
    polygon
}

fn any_point(draws: &mut Draws, pane: &Polygon) -> DVec2 {
    let low = pane.points().iter().copied().fold(DVec2::INFINITY, DVec2::min);
    let high = pane.points().iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max);
    // Now and then on a lattice, where cracks meet three and four at a time and level with corners of holes.
    let lattice = draws.chance(0.3);
    loop {
        let mut share = DVec2::new(draws.unit(), draws.unit());
        if lattice {
            share = (share * 12.0).round() / 12.0;
        }
        let point = low + (high - low) * share;
        if outline::contains(pane, point) {
            return point;
        }
    }
}

fn any_settings(draws: &mut Draws, pane: &Polygon) -> Settings {
    let size = pane.area().sqrt();
    let count = if draws.chance(0.6) { 1 } else { draws.whole(2, 15) };
    let nuclei = (0..count)
        .map(|_| {
            let arms = draws.whole(1, 9);
            // Now and then in line with the axes and each other, where ties are.
            let angle = if draws.chance(0.3) { 0.0 } else { draws.between(0.0, 2.0 * PI) };
            let start = if draws.chance(0.2) { draws.between(0.0, 0.3 * size) } else { 0.0 };
            Nucleus { start, ..Nucleus::star(any_point(draws, pane), angle, arms) }
        })
        .collect();
    // Now and then the length of a cell of the grid, or a whole number of them.
    let extent = {
        let points = pane.points().iter().copied();
        (points.clone().fold(DVec2::NEG_INFINITY, DVec2::max) - points.fold(DVec2::INFINITY, DVec2::min))
            .max_element()
    };
    let spacing = if draws.chance(0.2) {
        extent / 8.0 * draws.whole(1, 3) as f64
    } else {
        size * draws.between(0.005, 0.1)
    };
    let guide = match draws.whole(0, 5) {
        0 => Guide::Outward { length: size * draws.between(0.02, 0.5) },
        1 => Guide::Direction { angle: draws.between(0.0, PI), length: size * draws.between(0.02, 0.5) },
        2 => Guide::Stress { field: any_field(draws, pane), length: size * draws.between(0.02, 0.5) },
        _ => Guide::None,
    };
    Settings {
        nuclei,
        critical_length: size * draws.between(0.002, 0.2),
        forking: match draws.whole(0, 2) {
            0 => Forking::Literal(Order::FirstInFirstOut),
            1 => Forking::Literal(Order::Random),
            _ => Forking::Driven { room: size * draws.between(0.0, 0.1) },
        },
        // Now and then an angle that makes lattices, in which cracks meet corners and run along each other.
        fork_angle: if draws.chance(0.3) {
            [30.0, 45.0, 60.0, 90.0, 120.0][draws.whole(0, 4)] * PI / 180.0
        } else {
            draws.between(0.02, 2.9)
        },
        fork_variance: if draws.chance(0.4) { 0.0 } else { draws.between(0.0, 2.0) },
        wiggle: Wiggle {
            probability: if draws.chance(0.4) { 0.0 } else { draws.unit() },
            variance: draws.between(0.0, 1.5),
            spacing,
        },
        guide,
        rings: draws.chance(0.3).then(|| Rings {
            spacing: size * draws.between(0.02, 0.3),
            growth: draws.between(1.0, 2.0),
            share: draws.unit(),
        }),
        depth: if draws.chance(0.2) {
            Depth { critical_length: draws.between(0.9, 1.2), fork_angle: draws.between(0.9, 1.1) }
        } else {
            Depth::default()
        },
        fronts: Vec::new(),
        reach: draws.chance(0.2).then(|| size * draws.between(0.05, 0.6)),
        seed: draws.next.wrapping_mul(draws.seed),
    }
}

fn any_field(draws: &mut Draws, pane: &Polygon) -> StressField {
    let size = pane.area().sqrt();
    let samples =
        (0..16).map(|_| [draws.between(-1e7, 1e7), draws.between(-1e7, 1e7), draws.between(-1e7, 1e7)]);
    StressField {
        samples: samples.collect(),
        origin: pane.points()[0],
        spacing: DVec2::splat(size / 3.0),
        columns: 4,
    }
}

fn sign(a: DVec2, b: DVec2, c: DVec2) -> i8 {
    let coord = |p: DVec2| Coord { x: p.x, y: p.y };
    let turn = orient2d(coord(a), coord(b), coord(c));
    i8::from(turn > 0.0) - i8::from(turn < 0.0)
}

/// Every side of every fragment, as numbers of vertices in its own direction.
fn sides(pattern: &Pattern) -> Vec<(u32, u32, bool)> {
    let rings = |f: brisance_engine::fracture::Fragment| {
        f.rings().map(<[u32]>::to_vec).zip(f.on_border().map(<[bool]>::to_vec)).collect::<Vec<_>>()
    };
    pattern
        .fragments()
        .flat_map(rings)
        .flat_map(|(ring, border)| {
            let count = ring.len();
            (0..count).map(move |i| (ring[i], ring[(i + 1) % count], border[i])).collect::<Vec<_>>()
        })
        .collect()
}

/// Every crack side is there once each way, every side of the border once.
fn check_sharing(pattern: &Pattern, case: u64) {
    let mut seen: BTreeMap<(u32, u32), [u32; 2]> = BTreeMap::new();
    let mut border = 0;
    for (a, b, on_border) in sides(pattern) {
        assert_ne!(a, b, "case {case}: a side without length");
        seen.entry((a.min(b), a.max(b))).or_default()[usize::from(a > b)] += 1;
        border += usize::from(on_border);
    }
    let twice = seen.values().filter(|count| **count == [1, 1]).count();
    let once = seen.values().filter(|count| **count == [0, 1] || **count == [1, 0]).count();
    assert_eq!(twice + once, seen.len(), "case {case}: a side in more than two fragments");
    assert_eq!(once, border, "case {case}: a crack side with a fragment on one side only");
}

/// No two sides have a point in common but where they end in the same vertex. With the areas this means that
/// fragments are simple and do not overlap.
fn check_planar(pattern: &Pattern, case: u64) {
    let points = pattern.vertices();
    let mut edges: Vec<(DVec2, DVec2, u32, u32)> = sides(pattern)
        .into_iter()
        .filter(|(a, b, border)| a < b || *border)
        .map(|(a, b, _)| (points[a as usize], points[b as usize], a, b))
        .collect();
    edges.sort_by(|p, q| p.0.x.min(p.1.x).total_cmp(&q.0.x.min(q.1.x)));
    for (i, &(a, b, na, nb)) in edges.iter().enumerate() {
        let right = a.x.max(b.x);
        for &(c, d, nc, nd) in edges[i + 1..].iter().take_while(|e| e.0.x.min(e.1.x) <= right) {
            let shared = [na, nb].iter().filter(|&&n| n == nc || n == nd).count();
            assert!(shared < 2, "case {case}: two sides between the same vertices");
            let crosses = if shared == 1 {
                let (tip, tail) = if na == nc || na == nd { (b, a) } else { (a, b) };
                let head = if nc == na || nc == nb { d } else { c };
                sign(tail, tip, head) == 0 && (tip - tail).dot(head - tail) > 0.0
            } else {
                a.min(b).cmple(c.max(d)).all()
                    && c.min(d).cmple(a.max(b)).all()
                    && sign(a, b, c) * sign(a, b, d) <= 0
                    && sign(c, d, a) * sign(c, d, b) <= 0
            };
            assert!(!crosses, "case {case}: sides {a}–{b} and {c}–{d} meet");
        }
    }
}

/// No fragment has a vertex twice: none hangs together by a point, or holds a crack that parts nothing.
fn check_rings(pattern: &Pattern, case: u64) {
    for fragment in pattern.fragments() {
        let mut vertices: Vec<u32> = fragment.rings().flatten().copied().collect();
        let count = vertices.len();
        vertices.sort_unstable();
        vertices.dedup();
        assert_eq!(vertices.len(), count, "case {case}: a fragment comes by a vertex twice");
    }
}

#[test]
fn fragments_fill_the_pane_without_overlap_and_share_every_crack() {
    let mut pieces = 0;
    for case in 0..cases(300) {
        let mut draws = Draws::new(case, STREAM);
        let pane = any_outline(&mut draws);
        let settings = any_settings(&mut draws, &pane);
        let pattern = Pattern::grow(&pane, &settings).unwrap_or_else(|e| panic!("case {case}: {e}"));
        pieces += pattern.len();
        let mut polygon = Polygon::default();
        let mut sum = 0.0;
        for fragment in pattern.fragments() {
            fragment.outline(&mut polygon);
            let area = polygon.area();
            assert!(area > 0.0, "case {case}: a fragment of area {area}");
            sum += area;
        }
        // Rounding of sums over some thousand vertices; the promise is 1e-9.
        assert!((sum / pane.area() - 1.0).abs() < 1e-9, "case {case}: {sum} of {}", pane.area());
        check_sharing(&pattern, case);
        check_planar(&pattern, case);
        check_rings(&pattern, case);
        // Whatever is not simple has no triangulation.
        let solids = Pieces::of(&pattern, 1e-3, 2500.0).unwrap_or_else(|e| panic!("case {case}: {e}"));
        assert_eq!(solids.len(), pattern.len());
    }
    assert!(pieces as u64 > 20 * cases(300), "the cases are too easy: {pieces} pieces");
}

/// Cracks that turn often and far curl up and meet themselves: then a stem leads to a loop, with one fragment on
/// both sides.
#[test]
fn curled_cracks_leave_no_stems() {
    let pane = Polygon::new(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(DVec2::from));
    let mut holes = 0;
    for seed in 0..20 {
        let mut settings = Settings::literal(DVec2::splat(0.5), 0.05, 0.5);
        settings.wiggle = Wiggle { probability: 1.0, variance: 1.2, spacing: 0.004 };
        settings.seed = seed;
        let pattern = Pattern::grow(&pane, &settings).unwrap();
        let mut sum = 0.0;
        for fragment in pattern.fragments() {
            let mut corners: Vec<u32> = fragment.rings().flatten().copied().collect();
            let count = corners.len();
            corners.sort_unstable();
            corners.dedup();
            assert_eq!(corners.len(), count, "a fragment of seed {seed} comes by a vertex twice");
            holes += fragment.rings().len() - 1;
            let mut polygon = Polygon::default();
            fragment.outline(&mut polygon);
            sum += polygon.area();
        }
        // The area is exact but for rounding, whether or not a stem is counted.
        assert!((sum - 1.0).abs() < 1e-9, "areas of seed {seed} sum to {sum}");
        Pieces::of(&pattern, 0.01, 2500.0).unwrap();
    }
    assert!(holes > 0, "no crack curled up");
}

#[test]
fn the_same_settings_give_the_same_bits() {
    for case in 0..20 {
        let mut draws = Draws::new(case, STREAM);
        let pane = any_outline(&mut draws);
        let settings = any_settings(&mut draws, &pane);
        let grow = || Pattern::grow(&pane, &settings).unwrap();
        let (one, two) = (grow(), grow());
        let bits =
            |p: &Pattern| p.vertices().iter().map(|v| v.to_array().map(f64::to_bits)).collect::<Vec<_>>();
        assert_eq!(bits(&one), bits(&two));
        assert_eq!(sides(&one), sides(&two));
    }
}
