//! Convex solids, and where the edges of one are deep in another.

use glam::{DQuat, DVec3};

/// Points off a plane by less than this part of the solid's extent lie in it.
const FLAT: f64 = 1e-7;
/// Two planes are one where the sine of the angle between them is less than this.
const SAME: f64 = 1e-6;
/// How often the place where an edge is deepest is narrowed down, to two thirds each time.
const NARROWINGS: usize = 16;

/// A convex solid, in the axes of its body.
#[derive(Debug, Clone, Default)]
pub struct Convex {
    /// Both ends of every edge [m].
    edges: Vec<[DVec3; 2]>,
    faces: Vec<Face>,
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
        Self { edges: Vec::new(), faces: vec![Face { normal: DVec3::Y, offset: height }] }
    }

    /// The hull of points [m], found by trying all planes through three of them: there are few, and each body is looked
    /// at once. The points must not lie in a plane.
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
        Self { edges, faces }
    }

    /// A box with its middle and half edges [m].
    pub fn of_box(middle: DVec3, half: DVec3) -> Self {
        let corner = |code: usize| {
            let sign = |bit: usize| if code >> bit & 1 == 0 { -1.0 } else { 1.0 };
            middle + half * DVec3::new(sign(0), sign(1), sign(2))
        };
        let corners: Vec<DVec3> = (0..8).map(corner).collect();
        Self::hull_of(&corners)
    }

    /// The point of this solid's edges that is deepest in another one, where that is deeper than `least` [m]: in this
    /// solid's axes, with its depth below the nearest face. The other one is turned and then moved by `shift` from its
    /// axes into these.
    pub fn deepest_in(&self, other: &Convex, turn: DQuat, shift: DVec3, least: f64) -> Option<(DVec3, f64)> {
        let back = turn.conjugate();
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
