//! The outline of several bodies that stand together, and how far a place lies from its open edge.

use glam::{DVec2, DVec3};

use super::{Silhouette, bounds};

/// Gaps between the members of an outline narrower than this relieve nothing [m].
pub const JOINT: f64 = 0.02;

/// The outline of many bodies projected along one direction onto a plane [m]: what is left of the members' own
/// silhouettes where no other member goes on. It follows notches, holes and steps wider than [`JOINT`]; each member
/// counts as convex.
#[derive(Debug, Clone)]
pub struct Outline {
    right: DVec3,
    up: DVec3,
    /// Pieces of the outline past which air can flow.
    open: Vec<(DVec2, DVec2)>,
}

/// A member as a convex polygon, with its bounding box.
struct Member {
    corners: Vec<(DVec2, bool)>,
    low: DVec2,
    high: DVec2,
}

impl Outline {
    /// Projects the points of each member along the unit vector `direction`.
    ///
    /// `closed(p)` says of a point that nothing can flow past it, because it stands on the ground: an edge between
    /// two such points is not open.
    pub fn new<'a>(
        members: impl Iterator<Item = &'a [DVec3]>,
        direction: DVec3,
        closed: impl Fn(DVec3) -> bool,
    ) -> Self {
        let (right, up) = direction.any_orthonormal_pair();
        let mut members: Vec<Member> =
            members.map(|points| Member::new(&Silhouette::new(points, direction, &closed))).collect();
        members.sort_by(|a, b| a.low.x.total_cmp(&b.low.x));
        let widest = members.iter().map(|member| member.high.x - member.low.x).fold(0.0, f64::max);
        let mut open = Vec::new();
        for (own, member) in members.iter().enumerate() {
            for (a, b) in member.open_edges() {
                let outward = (a - b).perp().normalize_or_zero() * JOINT;
                let (from, to) = (a + outward, b + outward);
                let (low, high) = (from.min(to), from.max(to));
                let first = members.partition_point(|other| other.low.x < low.x - widest);
                let mut covered: Vec<(f64, f64)> = members[first..]
                    .iter()
                    .take_while(|other| other.low.x <= high.x)
                    .zip(first..)
                    .filter(|(other, index)| *index != own && other.meets(low, high))
                    .filter_map(|(other, _)| other.clip(from, to))
                    .collect();
                // Where members end flush, rounding leaves slivers; what is left of an edge that is partly covered
                // counts from a joint's width on.
                let least = (JOINT / a.distance(b)).min(0.5);
                let left = gaps(&mut covered).into_iter().filter(|(start, end)| end - start > least);
                open.extend(left.map(|(start, end)| (a.lerp(b, start), a.lerp(b, end))));
            }
        }
        Self { right, up, open: joined(open) }
    }

    /// Distance from a point, seen in the plane, to the nearest open piece of the outline [m]; infinite when none is
    /// open.
    pub fn distance_to_edge(&self, point: DVec3) -> f64 {
        let p = DVec2::new(self.right.dot(point), self.up.dot(point));
        let nearest = self
            .open
            .iter()
            .map(|&(a, b)| {
                let along = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
                p.distance_squared(a.lerp(b, along))
            })
            .fold(f64::INFINITY, f64::min);
        libm::sqrt(nearest)
    }
}

impl Member {
    fn new(silhouette: &Silhouette) -> Self {
        let corners = silhouette.corners().to_vec();
        let (low, high) = bounds(corners.iter().map(|&(corner, _)| corner));
        Self { corners, low, high }
    }

    fn open_edges(&self) -> impl Iterator<Item = (DVec2, DVec2)> + '_ {
        self.edges().filter(|(a, b, open)| *open && a != b).map(|(a, b, _)| (a, b))
    }

    fn edges(&self) -> impl Iterator<Item = (DVec2, DVec2, bool)> + '_ {
        let count = self.corners.len();
        (0..count).map(move |i| (self.corners[i].0, self.corners[(i + 1) % count].0, self.corners[i].1))
    }

    fn meets(&self, low: DVec2, high: DVec2) -> bool {
        self.low.cmple(high).all() && low.cmple(self.high).all()
    }

    /// The part of the way from `a` to `b` that lies in the polygon, as shares of the way (Cyrus & Beck 1978).
    fn clip(&self, a: DVec2, b: DVec2) -> Option<(f64, f64)> {
        let (mut start, mut end) = (0.0_f64, 1.0_f64);
        for (p, q, _) in self.edges() {
            let (at_a, at_b) = ((q - p).perp_dot(a - p), (q - p).perp_dot(b - p));
            if at_a < 0.0 && at_b < 0.0 {
                return None;
            }
            let share = at_a / (at_a - at_b);
            if at_a < 0.0 {
                start = start.max(share);
            } else if at_b < 0.0 {
                end = end.min(share);
            }
        }
        (end > start).then_some((start, end))
    }
}

/// What is left of [0, 1] outside the intervals.
fn gaps(covered: &mut [(f64, f64)]) -> Vec<(f64, f64)> {
    covered.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut left = Vec::new();
    let mut reached = 0.0;
    for &mut (start, end) in covered {
        if start > reached {
            left.push((reached, start));
        }
        reached = f64::max(reached, end);
    }
    if reached < 1.0 {
        left.push((reached, 1.0));
    }
    left
}

/// Joins pieces that go on straight from one another, such as the tops of the bricks of a course.
fn joined(mut pieces: Vec<(DVec2, DVec2)>) -> Vec<(DVec2, DVec2)> {
    // Along one line pieces follow each other by their place on it; lines differ in slope or offset by far more
    // than a micrometre or a microradian.
    let line = |&(a, b): &(DVec2, DVec2)| {
        let way = (b - a).normalize_or_zero();
        let steps = |x: f64| libm::rint(x * 1e5) as i64;
        (steps(way.x), steps(way.y), steps(way.perp_dot(a)))
    };
    pieces.sort_by(|p, q| {
        let way = p.1 - p.0;
        line(p).cmp(&line(q)).then(way.dot(p.0).total_cmp(&way.dot(q.0)))
    });
    let mut joined: Vec<(DVec2, DVec2)> = Vec::new();
    for piece in pieces {
        match joined.last_mut() {
            Some(last) if line(last) == line(&piece) && last.1.distance(piece.0) < JOINT => last.1 = piece.1,
            _ => joined.push(piece),
        }
    }
    joined
}
