//! Moments of plane figures and of the prisms on them, against closed forms and exact integer arithmetic.

use brisance_engine::geometry::Polygon;
use glam::DVec2;
use proptest::prelude::*;

/// A polygon with corners on a lattice of 2⁻²⁰ m, so that integers hold its moments exactly.
fn on_lattice(corners: &[[i64; 2]], offset: DVec2) -> Polygon {
    let place = |c: &[i64; 2]| offset + DVec2::new(c[0] as f64, c[1] as f64) / 1_048_576.0;
    Polygon::new(&corners.iter().map(place).collect::<Vec<_>>())
}

/// Twice the area and six times the first moments, in lattice units: exact.
fn exact_sums(corners: &[[i64; 2]]) -> [i128; 3] {
    let mut sums = [0; 3];
    for (i, p) in corners.iter().enumerate() {
        let q = corners[(i + 1) % corners.len()];
        let [px, py, qx, qy] = [p[0], p[1], q[0], q[1]].map(i128::from);
        let cross = px * qy - py * qx;
        sums[0] += cross;
        sums[1] += cross * (px + qx);
        sums[2] += cross * (py + qy);
    }
    sums
}

#[test]
fn a_rectangle_with_a_hole_has_its_closed_form_moments() {
    let (a, b, r, s) = (3.0, 2.0, 0.5, 0.25);
    let centre = DVec2::new(0.4, -0.3);
    let rectangle = |c: DVec2, w: f64, h: f64| {
        [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| c + 0.5 * DVec2::new(x * w, y * h))
    };
    let mut polygon = Polygon::new(&rectangle(DVec2::ZERO, a, b));
    polygon.push_ring(rectangle(centre, r, s).into_iter().rev());
    let m = polygon.moments();
    let (outer, hole) = (a * b, r * s);
    let area = outer - hole;
    assert!((m.area - area).abs() < 1e-14 && (polygon.area() - area).abs() < 1e-14);
    let c = -hole * centre / area;
    assert!(m.centroid.distance(c) < 1e-15);
    // Steiner: about the common origin, hole taken off, then to the centroid.
    let xx = outer * a * a / 12.0 - hole * (r * r / 12.0 + centre.x * centre.x) - area * c.x * c.x;
    let yy = outer * b * b / 12.0 - hole * (s * s / 12.0 + centre.y * centre.y) - area * c.y * c.y;
    let xy = -hole * centre.x * centre.y - area * c.x * c.y;
    assert!((m.xx - xx).abs() < 1e-14 && (m.yy - yy).abs() < 1e-14 && (m.xy - xy).abs() < 1e-14);
}

proptest! {
    /// A piece of a millimetre has the same moments 100 m from the origin: the lattice keeps its corners exact
    /// there, so nothing but the sums' rounding is left.
    #[test]
    fn a_small_piece_far_away_keeps_its_digits(
        corners in prop::array::uniform5(prop::array::uniform2(-1000i64..1000)),
        offset in prop::array::uniform2(-100i32..100),
    ) {
        let [twice_area, six_x, six_y] = exact_sums(&corners);
        prop_assume!(twice_area.abs() > 100_000);
        let offset = DVec2::new(offset[0].into(), offset[1].into());
        let unit = 1.0 / 1_048_576.0;
        let near = on_lattice(&corners, DVec2::ZERO).moments();
        let far = on_lattice(&corners, offset).moments();
        let area = 0.5 * twice_area as f64 * unit * unit;
        prop_assert!((far.area / area - 1.0).abs() < 1e-13);
        let centroid = DVec2::new(six_x as f64, six_y as f64) / (3.0 * twice_area as f64) * unit;
        // The centroid is as fine as doubles are 100 m from the origin: 1.4e-14 m.
        prop_assert!((far.centroid - offset).distance(centroid) < 3e-14);
        let size = near.xx.abs() + near.yy.abs();
        for (f, n) in [(far.xx, near.xx), (far.yy, near.yy), (far.xy, near.xy)] {
            prop_assert!((f - n).abs() <= 1e-11 * size);
        }
    }
}
