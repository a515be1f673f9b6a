//! Convex solids, and where the edges of one are deep in another.

use glam::{DQuat, DVec3};

use crate::geometry::bounds;

/// Points off a plane by less than this part of the solid's extent lie in it.
const FLAT: f64 = 1e-7;
/// Two planes are one where the sine of the angle between them is less than this.
const SAME: f64 = 1e-6;
/// How often the place where an edge is deepest is narrowed down, to two thirds each time.
const NARROWINGS: usize = 24;

/// A convex solid, in the axes of its body.
#[derive(Debug, Clone, Default)]
pub struct Convex {
    /// [m].
    corners: Vec<DVec3>,
    /// Both ends of every edge [m].
    edges: Vec<[DVec3; 2]>,
    faces: Vec<Face>,
    /// Middle of a ball around it, and its radius [m]; infinite for the ground.
    ball: (DVec3, f64),
}

/// A plane with the solid behind it.
#[derive(Debug, Clone, Copy)]
struct Face {
    /// Unit vector away from the solid.
    normal: DVec3,
    /// Distance of the plane from the origin along the normal [m].
    offset: f64,
}

impl Face {
    /// How far a point lies behind the plane [m].
    fn depth(&self, point: DVec3) -> f64 {
        self.offset - self.normal.dot(point)
    }
}

impl Convex {
    /// Everything below a height [m].
    pub fn below(height: f64) -> Self {
        Self {
            faces: vec![Face { normal: DVec3::Y, offset: height }],
            ball: (DVec3::ZERO, f64::INFINITY),
            ..Self::default()
        }
    }

    /// The hull of points [m], found by trying all planes through three of them: there are few, and it is done once a
    /// body. The points must not lie in a plane.
    pub fn hull_of(points: &[DVec3]) -> Self {
        let extent = points.iter().map(|p| p.length()).fold(0.0, f64::max);
        let tolerance = FLAT * extent;
        let mut faces: Vec<Face> = Vec::new();
        for (i, &a) in points.iter().enumerate() {
            for (j, &b) in points.iter().enumerate().skip(i + 1) {
                for &c in &points[j + 1..] {
                    let Some(normal) = (b - a).cross(c - a).try_normalize() else { continue };
                    for normal in [normal, -normal] {
                        let face = Face { normal, offset: normal.dot(a) };
                        let same =
                            |f: &Face| f.normal.dot(normal) > 0.0 && f.normal.cross(normal).length() < SAME;
                        if points.iter().all(|&p| face.depth(p) >= -tolerance) && !faces.iter().any(same) {
                            faces.push(face);
                        }
                    }
                }
            }
        }
        let mut edges = Vec::new();
        for (i, &a) in points.iter().enumerate() {
            for &b in &points[i + 1..] {
                let on = |f: &&Face| f.depth(a).abs().max(f.depth(b).abs()) <= 2.0 * tolerance;
                if faces.iter().filter(on).count() >= 2 {
                    edges.push([a, b]);
                }
            }
        }
        let (low, high) = bounds(points.iter().copied());
        let middle = 0.5 * (low + high);
        let radius = points.iter().map(|p| p.distance(middle)).fold(0.0, f64::max);
        Self { corners: points.to_vec(), edges, faces, ball: (middle, radius) }
    }

    /// The point of this solid's edges that is deepest in another one, where that is deeper than `least` [m]: in this
    /// solid's axes, with its depth below the nearest face. The other one is turned and then moved by `shift` from its
    /// axes into these.
    pub fn deepest_in(&self, other: &Convex, turn: DQuat, shift: DVec3, least: f64) -> Option<(DVec3, f64)> {
        let apart = self.ball.0.distance(turn * other.ball.0 + shift);
        if apart > self.ball.1 + other.ball.1 {
            return None;
        }
        let back = turn.conjugate();
        // Most that are near each other lie on two sides of a face.
        let beyond = |face: &Face| {
            let face =
                Face { normal: turn * face.normal, offset: face.offset + (turn * face.normal).dot(shift) };
            self.corners.iter().all(|&p| face.depth(p) <= least)
        };
        if other.faces.iter().any(beyond) {
            return None;
        }
        let mut deepest: Option<(DVec3, f64)> = None;
        for &[a, b] in &self.edges {
            let least = deepest.map_or(least, |(_, depth)| depth);
            let (from, to) = (back * (a - shift), back * (b - shift));
            if other.faces.iter().any(|f| f.depth(from) <= least && f.depth(to) <= least) {
                continue;
            }
            let (share, depth) = other.deepest_on(from, to);
            if depth > least {
                deepest = Some((a.lerp(b, share), depth));
            }
        }
        deepest
    }

    /// Where a segment is deepest below all faces: the part of it that lies before that place, and the depth [m].
    fn deepest_on(&self, from: DVec3, to: DVec3) -> (f64, f64) {
        let depth = |share: f64| {
            let point = from.lerp(to, share);
            self.faces.iter().map(|face| face.depth(point)).fold(f64::INFINITY, f64::min)
        };
        // The least of straight lines has one peak.
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..NARROWINGS {
            let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
            if depth(a) < depth(b) { low = a } else { high = b }
        }
        let middle = 0.5 * (low + high);
        [0.0, middle, 1.0]
            .map(|share| (share, depth(share)))
            .into_iter()
            .max_by(|a, b| a.1.total_cmp(&b.1))
            .expect("three")
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::geometry::box_corners;

    fn cube() -> Convex {
        Convex::hull_of(&box_corners(DVec3::splat(-0.5), DVec3::splat(0.5)))
    }

    #[test]
    fn a_box_has_its_faces_and_edges() {
        let solid = Convex::hull_of(&box_corners(DVec3::new(0.9, 1.8, 3.0), DVec3::new(1.1, 2.2, 3.006)));
        assert_eq!((solid.faces.len(), solid.edges.len()), (6, 12));
        // Euler: corners − edges + faces = 2, of a prism over seven corners as well.
        let ring = |z: f64| (0..7).map(move |k| DVec3::new(f64::from(k).cos(), f64::from(k).sin(), z));
        let prism = Convex::hull_of(&ring(0.0).chain(ring(0.01)).collect::<Vec<_>>());
        assert_eq!((prism.faces.len(), prism.edges.len()), (9, 21));
    }

    #[test]
    fn a_corner_in_the_ground_is_as_deep_as_it_is() {
        let turn = DQuat::from_rotation_arc(DVec3::splat(1.0).normalize(), DVec3::NEG_Y);
        // The cube stands on its corner, 2 mm in the ground: seen from its axes, the ground lies aslant.
        let shift = turn.conjugate() * DVec3::NEG_Y * (0.75_f64.sqrt() - 2e-3);
        let (point, depth) = cube()
            .deepest_in(&Convex::below(0.0), turn.conjugate(), shift, 1e-3)
            .expect("it is in the ground");
        assert!((depth - 2e-3).abs() < 1e-12 && point.distance(DVec3::splat(0.5)) < 1e-12, "{point} {depth}");
        assert_eq!(cube().deepest_in(&Convex::below(0.0), turn.conjugate(), shift, 3e-3), None);
    }

    /// Bars that cross have no corner in each other: each is deepest in the middle of an edge.
    #[test]
    fn an_edge_across_another_body_is_deepest_between_its_ends() {
        let bar = Convex::hull_of(&box_corners(-DVec3::new(1.0, 0.1, 0.1), DVec3::new(1.0, 0.1, 0.1)));
        let shift = DVec3::new(0.1, 0.19, 0.0);
        let (point, depth) =
            bar.deepest_in(&bar, DQuat::from_rotation_y(1.57), shift, 1e-3).expect("they cross");
        assert!((depth - 0.01).abs() < 1e-3 && (point.y - 0.1).abs() < 1e-12, "{point} {depth}");
        assert!(point.x.abs() < 0.9, "{point}");
    }

    proptest! {
        /// Beside 400 points of every edge of one random hull, each looked for in the other.
        #[test]
        fn the_deepest_point_is_that_of_a_search(
            points in prop::collection::vec(prop::array::uniform3(-1.0..1.0_f64), 8..16),
            others in prop::collection::vec(prop::array::uniform3(-1.0..1.0_f64), 8..16),
            axis in prop::array::uniform3(-1.0..1.0_f64), angle in -3.0..3.0_f64,
            shift in prop::array::uniform3(-1.0..1.0_f64),
        ) {
            let solid = |points: Vec<[f64; 3]>| Convex::hull_of(&points.into_iter().map(DVec3::from).collect::<Vec<_>>());
            let (one, other) = (solid(points), solid(others));
            prop_assume!(DVec3::from(axis).length() > 0.1);
            let turn = DQuat::from_axis_angle(DVec3::from(axis).normalize(), angle);
            let shift = DVec3::from(shift);
            let depth = |p: DVec3| {
                let there = turn.conjugate() * (p - shift);
                other.faces.iter().map(|face| face.depth(there)).fold(f64::INFINITY, f64::min)
            };
            let searched = one.edges.iter().flat_map(|&[a, b]| (0..=400).map(move |k| a.lerp(b, f64::from(k) / 400.0)));
            let searched = searched.map(depth).fold(f64::NEG_INFINITY, f64::max);
            let found = one.deepest_in(&other, turn, shift, 1e-3);
            // Between two of those points an edge, of 3.5 at most, gets deeper by less than 0.0044.
            match found {
                Some((point, at)) => {
                    prop_assert!((depth(point) - at).abs() < 1e-12);
                    prop_assert!(at > searched - 1e-2 && at < searched + 5e-3, "{} beside {}", at, searched);
                }
                None => prop_assert!(searched <= 1e-3),
            }
        }
    }
}
