//! Moments of plane figures and of the prisms on them: against exact integers, against the thesis's formulas
//! (corrected), and against adding up a fine grid.

mod fragments;

use brisance_engine::geometry::{PlaneMoments, Polygon, Triangulator};
use fragments::{mapped, mosaic, shard, with_holes};
use glam::{DMat3, DVec2, DVec3};
use proptest::prelude::*;

/// A polygon with corners on a lattice of 2⁻²⁰ m, so that integers hold its moments exactly.
fn on_lattice(corners: &[[i64; 2]], offset: DVec2) -> Polygon {
    let place = |c: &[i64; 2]| offset + DVec2::new(c[0] as f64, c[1] as f64) / 1_048_576.0;
    Polygon::new(&corners.iter().map(place).collect::<Vec<_>>())
}

/// Twice the area, six times the first moments, and 12, 12 and 24 times the second moments about the origin, in
/// lattice units: exact.
fn exact_sums(corners: &[[i64; 2]]) -> [i128; 6] {
    let mut sums = [0; 6];
    for (i, p) in corners.iter().enumerate() {
        let q = corners[(i + 1) % corners.len()];
        let [px, py, qx, qy] = [p[0], p[1], q[0], q[1]].map(i128::from);
        let cross = px * qy - py * qx;
        let terms = [
            1,
            px + qx,
            py + qy,
            px * px + px * qx + qx * qx,
            py * py + py * qy + qy * qy,
            2 * px * py + 2 * qx * qy + px * qy + qx * py,
        ];
        for (sum, term) in sums.iter_mut().zip(terms) {
            *sum += cross * term;
        }
    }
    sums
}

/// Area, centroid and second moments about the centroid from the exact sums, by Steiner's rule on whole numbers:
/// only the last divisions round.
fn exact_moments(corners: &[[i64; 2]]) -> PlaneMoments {
    let [s, sx, sy, sxx, syy, sxy] = exact_sums(corners);
    // About the centroid (sx/3s, sy/3s), with area s/2: xx − s/2 (sx/3s)² = (3 s sxx − 2 sx²)/(36 s).
    let central =
        |second: i128, one: i128, other: i128| (3 * s * second - 2 * one * other) as f64 / (36 * s) as f64;
    let unit = 1.0 / 1_048_576.0;
    let unit4 = unit * unit * unit * unit;
    PlaneMoments {
        area: 0.5 * s as f64 * unit * unit,
        centroid: DVec2::new(sx as f64, sy as f64) / (3 * s) as f64 * unit,
        xx: central(sxx, sx, sx) * unit4,
        yy: central(syy, sy, sy) * unit4,
        // xy comes as 24 times: half of what the others carry.
        xy: (3 * s * sxy - 4 * sx * sy) as f64 / (72 * s) as f64 * unit4,
    }
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

#[test]
fn a_ring_that_is_cleared_and_filled_again_is_the_new_one() {
    let mut polygon = with_holes(20, 3, 1);
    assert_eq!((polygon.rings().count(), polygon.hole_count()), (4, 3));
    polygon.clear();
    assert_eq!((polygon.area(), polygon.moments()), (0.0, PlaneMoments::default()));
    let square = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)].map(DVec2::from);
    polygon.push_ring(square);
    assert_eq!(polygon, Polygon::new(&square));
    assert_eq!(polygon.area(), 4.0);
    assert_eq!(polygon.sides().last(), Some((square[3], square[0])));
}

#[test]
fn the_long_axis_is_the_direction_of_greatest_spread() {
    for degrees in (-90..90).step_by(5) {
        let turn = DVec2::from_angle(f64::from(degrees).to_radians());
        let plate =
            [(-3.0, -1.0), (3.0, -1.0), (3.0, 1.0), (-3.0, 1.0)].map(DVec2::from).map(|p| turn.rotate(p));
        let moments = Polygon::new(&plate).moments();
        assert!(moments.long_axis().perp_dot(turn).abs() < 1e-14, "{degrees}°");
        let [along, across] = moments.principal();
        // A rectangle a by b: a³b/12.
        assert!((along - 36.0).abs() < 1e-12 && (across - 4.0).abs() < 1e-12);
    }
    let square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(DVec2::from);
    assert_eq!(Polygon::new(&square).moments().long_axis(), DVec2::X);
}

/// Which forms of (6.2) to (6.4) to take.
#[derive(Clone, Copy, PartialEq)]
enum Forms {
    Corrected,
    /// (6.2) as printed: its second term divided by 3.
    Printed62,
    /// (6.4) with `3b` in its second term.
    Printed64Second,
    /// (6.4) with its last term as in its printed third line, not divided by 3.
    Printed64Last,
}

/// Fig. 6.3: a part of a triangle between two lines `y = m x + b` and two uprights.
struct Section {
    upper: (f64, f64),
    lower: (f64, f64),
    left: f64,
    right: f64,
}

/// The thesis's closed forms over a section, of thickness `t` and density 1.
impl Section {
    /// The two sections of a triangle, cut by the upright through its middle corner.
    fn of_triangle(mut corners: [DVec2; 3]) -> Vec<Section> {
        corners.sort_by(|a, b| a.x.total_cmp(&b.x));
        let [a, b, c] = corners;
        let line = |p: DVec2, q: DVec2| {
            let m = (q.y - p.y) / (q.x - p.x);
            (m, p.y - m * p.x)
        };
        let mut sections = Vec::new();
        for (p, q) in [(a, b), (b, c)] {
            if q.x > p.x {
                let (short, long) = (line(p, q), line(a, c));
                let above = long.0 * b.x + long.1 < b.y;
                let (upper, lower) = if above { (short, long) } else { (long, short) };
                sections.push(Section { upper, lower, left: p.x, right: q.x });
            }
        }
        sections
    }

    /// `x_r^n − x_l^n`.
    fn power(&self, n: i32) -> f64 {
        self.right.powi(n) - self.left.powi(n)
    }

    /// `f(m_u, b_u) − f(m_l, b_l)`.
    fn between(&self, f: impl Fn(f64, f64) -> f64) -> f64 {
        f(self.upper.0, self.upper.1) - f(self.lower.0, self.lower.1)
    }

    fn area(&self) -> f64 {
        self.between(|m, _| m) * self.power(2) / 2.0 + self.between(|_, b| b) * self.power(1)
    }

    /// (6.9) and (6.10).
    fn first(&self) -> DVec2 {
        let x = self.between(|m, _| m) * self.power(3) / 3.0 + self.between(|_, b| b) * self.power(2) / 2.0;
        let y = 0.5
            * (self.between(|m, _| m * m) * self.power(3) / 3.0
                + self.between(|m, b| m * b) * self.power(2)
                + self.between(|_, b| b * b) * self.power(1));
        DVec2::new(x, y)
    }

    /// (6.2) to (6.6), as a matrix.
    fn inertia(&self, t: f64, forms: Forms) -> DMat3 {
        let through = self.area() * t * t * t / 12.0;
        let second = if forms == Forms::Printed62 { self.power(3) / 3.0 } else { self.power(3) };
        let i11 = (self.between(|m, _| m * m * m) * self.power(4) / 4.0
            + self.between(|m, b| m * m * b) * second
            + 1.5 * self.between(|m, b| m * b * b) * self.power(2)
            + self.between(|_, b| b * b * b) * self.power(1))
            * t
            / 3.0
            + through;
        let i22 =
            (self.between(|m, _| m) * self.power(4) / 4.0 + self.between(|_, b| b) * self.power(3) / 3.0) * t
                + through;
        let factor = if forms == Forms::Printed64Second { 3.0 } else { 1.0 };
        let last = if forms == Forms::Printed64Last { 1.0 } else { 3.0 };
        let i33 = (self.between(|m, _| m * m * m / 3.0 + m) * self.power(4) / 4.0
            + self.between(|m, b| m * m * b + factor * b) * self.power(3) / 3.0
            + self.between(|m, b| m * b * b) * self.power(2) / 2.0
            + self.between(|_, b| b * b * b) * self.power(1) / last)
            * t;
        let i12 = -(self.between(|m, _| m * m) * self.power(4) / 4.0
            + 2.0 * self.between(|m, b| m * b) * self.power(3) / 3.0
            + self.between(|_, b| b * b) * self.power(2) / 2.0)
            * t
            / 2.0;
        // (6.6): ∫ z dz from −t/2 to t/2.
        let through_z = (t / 2.0).powi(2) - (-t / 2.0).powi(2);
        let (i13, i23) = (-self.first().x * through_z / 2.0, -self.first().y * through_z / 2.0);
        DMat3::from_cols(DVec3::new(i11, i12, i13), DVec3::new(i12, i22, i23), DVec3::new(i13, i23, i33))
    }
}

/// The inertia of a polygon's prism by the thesis's way: cut into triangles, moved so that the centre of mass by
/// (6.9), (6.10) is the origin, and summed over their sections. Also that centre.
fn thesis_inertia(polygon: &Polygon, t: f64, forms: Forms) -> (DMat3, DVec2) {
    let mut triangles = Vec::new();
    Triangulator::default().triangulate(polygon, &mut triangles).unwrap();
    let sections = |origin: DVec2| -> Vec<Section> {
        let corners = triangles.iter().map(|t| t.map(|i| polygon.points()[i as usize] - origin));
        corners.flat_map(Section::of_triangle).collect()
    };
    let whole = sections(DVec2::ZERO);
    let area: f64 = whole.iter().map(Section::area).sum();
    let centre = whole.iter().map(Section::first).sum::<DVec2>() / area;
    let inertia = sections(centre).iter().map(|s| s.inertia(t, forms)).fold(DMat3::ZERO, |sum, i| sum + i);
    (inertia, centre)
}

fn trace(m: DMat3) -> f64 {
    m.x_axis.x + m.y_axis.y + m.z_axis.z
}

fn largest_difference(a: DMat3, b: DMat3) -> f64 {
    (a - b).to_cols_array().iter().fold(0.0, |most, x| most.max(x.abs()))
}

#[test]
fn the_printed_forms_of_6_2_and_6_4_fail_and_the_corrected_ones_hold() {
    let triangle = Polygon::new(&[DVec2::new(0.0, 0.0), DVec2::new(2.0, 0.5), DVec2::new(0.7, 3.0)]);
    let ours = triangle.moments().prism(0.1, 1.0).inertia;
    let thesis = |forms| thesis_inertia(&triangle, 0.1, forms).0;
    assert!(largest_difference(ours, thesis(Forms::Corrected)) < 1e-12 * trace(ours));
    for (forms, entry) in [(Forms::Printed62, 0), (Forms::Printed64Second, 2), (Forms::Printed64Last, 2)] {
        let difference = ours - thesis(forms);
        assert!(difference.col(entry)[entry].abs() > 0.01 * trace(ours), "a printed form holds");
        // Only that one entry is wrong.
        let mut rest = difference;
        rest.col_mut(entry)[entry] = 0.0;
        assert!(largest_difference(rest, DMat3::ZERO) < 1e-12 * trace(ours));
    }
}

#[test]
fn the_corrected_forms_hold_over_whole_fragments() {
    // `y = m x + b` has no upright sides, and steep ones cost digits, as their cubes cancel: the pane is turned, so
    // that its border is not upright, and a part in a million is allowed.
    let turn = DVec2::from_angle(0.3);
    let turned = mosaic(200, 8).into_iter().map(|piece| mapped(&piece, |p| turn.rotate(p)));
    let pieces = turned.chain((0..50).map(|seed| shard(30, seed)));
    for piece in pieces.chain((0..50).map(|seed| with_holes(16, 2, seed))) {
        let moments = piece.moments();
        let solid = moments.prism(0.05, 1.0);
        let (inertia, centre) = thesis_inertia(&piece, 0.05, Forms::Corrected);
        assert!(largest_difference(solid.inertia, inertia) < 1e-6 * trace(inertia), "{piece:?}");
        assert!(solid.centre.truncate().distance(centre) < 1e-8);
    }
}

#[test]
fn a_fine_grid_adds_up_to_the_same_inertia() {
    // A cell counts whole or not at all, so the sums are right to the share of cells on the outline, and those
    // err to both sides.
    let pieces = (0..4).map(|seed| shard(40, seed)).chain((0..4).map(|seed| with_holes(16, 3, seed)));
    for piece in pieces {
        let (count, thickness, density) = (800, 0.2, 2500.0);
        let low = piece.points().iter().copied().reduce(DVec2::min).unwrap();
        let step = (piece.points().iter().copied().reduce(DVec2::max).unwrap() - low) / f64::from(count);
        let solid = piece.moments().prism(thickness, density);
        let cell = density * thickness * step.x * step.y;
        let (mut mass, mut inertia) = (0.0, DMat3::ZERO);
        for i in 0..count {
            for j in 0..count {
                let p = low + step * (DVec2::new(f64::from(i), f64::from(j)) + 0.5);
                if !holds(&piece, p) {
                    continue;
                }
                let r = (p - solid.centre.truncate()).extend(0.0);
                mass += cell;
                // ∫ z² over the thickness is t²/12 of the mass, and odd powers vanish.
                let spread = DMat3::from_diagonal(DVec3::new(1.0, 1.0, 0.0)) * (thickness * thickness / 12.0);
                let outer = DMat3::from_cols(r * r.x, r * r.y, r * r.z);
                inertia += (DMat3::IDENTITY * r.length_squared() - outer + spread) * cell;
            }
        }
        assert!((mass / solid.mass - 1.0).abs() < 2e-3);
        assert!(largest_difference(inertia, solid.inertia) < 2e-3 * trace(inertia));
    }
}

/// Whether a point lies inside: an upright ray crosses an odd number of sides.
fn holds(polygon: &Polygon, point: DVec2) -> bool {
    let crossed = polygon.sides().filter(|(p, q)| {
        (p.x > point.x) != (q.x > point.x) && point.y < p.y + (q.y - p.y) * (point.x - p.x) / (q.x - p.x)
    });
    crossed.count() % 2 == 1
}

proptest! {
    /// A piece of a millimetre has its exact moments 100 m from the origin too: its corners are exact there, so
    /// only the sums round.
    #[test]
    fn a_small_piece_far_away_keeps_its_digits(
        corners in prop::array::uniform5(prop::array::uniform2(-1000i64..1000)),
        offset in prop::array::uniform2(-100i32..100),
    ) {
        prop_assume!(exact_sums(&corners)[0].abs() > 100_000);
        let exact = exact_moments(&corners);
        let offset = DVec2::new(offset[0].into(), offset[1].into());
        let far = on_lattice(&corners, offset).moments();
        prop_assert!((far.area / exact.area - 1.0).abs() < 1e-13);
        // The centroid is as fine as doubles are 100 m from the origin: 1.4e-14 m.
        prop_assert!((far.centroid - offset).distance(exact.centroid) < 3e-14);
        // Corners cross each other at random, so areas of both signs cancel, by up to 8e6/1e5.
        let size = exact.xx.abs() + exact.yy.abs();
        for (ours, exact) in [(far.xx, exact.xx), (far.yy, exact.yy), (far.xy, exact.xy)] {
            prop_assert!((ours - exact).abs() <= 1e-12 * size);
        }
    }

    /// (6.2) to (6.6), (6.9) and (6.10), corrected, for any triangle that has no almost upright side: the cubes
    /// of its slopes cancel.
    #[test]
    fn the_thesis_s_triangle_is_ours(corners in prop::array::uniform3(prop::array::uniform2(-1.0f64..1.0)), t in 0.01f64..0.5) {
        let [a, b, c] = corners.map(DVec2::from_array);
        prop_assume!([(a, b), (b, c), (c, a)].iter().all(|(p, q)| (p.x - q.x).abs() > 0.05));
        prop_assume!((b - a).perp_dot(c - a) > 0.01);
        let triangle = Polygon::new(&[a, b, c]);
        let solid = triangle.moments().prism(t, 1.0);
        let (inertia, centre) = thesis_inertia(&triangle, t, Forms::Corrected);
        prop_assert!(largest_difference(solid.inertia, inertia) < 1e-8 * trace(inertia));
        prop_assert!(solid.centre.truncate().distance(centre) < 1e-9);
        prop_assert!(centre.distance((a + b + c) / 3.0) < 1e-9);
    }

    /// Turning a figure turns its tensor, and moving it changes nothing but the centroid.
    #[test]
    fn moments_follow_the_figure(seed in any::<u64>(), angle in -3.2f64..3.2, place in prop::array::uniform2(-10.0f64..10.0)) {
        let piece = shard(20, seed);
        let (turn, place) = (DVec2::from_angle(angle), DVec2::from_array(place));
        let m = piece.moments();
        let moved = mapped(&piece, |p| place + turn.rotate(p)).moments();
        prop_assert!((moved.area / m.area - 1.0).abs() < 1e-12);
        prop_assert!(moved.centroid.distance(place + turn.rotate(m.centroid)) < 1e-13);
        let (c, s) = (turn.x, turn.y);
        let xx = c * c * m.xx - 2.0 * c * s * m.xy + s * s * m.yy;
        let yy = s * s * m.xx + 2.0 * c * s * m.xy + c * c * m.yy;
        let xy = c * s * (m.xx - m.yy) + (c * c - s * s) * m.xy;
        let size = m.xx + m.yy;
        prop_assert!((moved.xx - xx).abs() < 1e-12 * size);
        prop_assert!((moved.yy - yy).abs() < 1e-12 * size);
        prop_assert!((moved.xy - xy).abs() < 1e-12 * size);
    }
}
