//! Outlines of bodies as seen along a direction: convex, in a plane.

use glam::{DVec2, DVec3};

/// The convex outline of a set of points projected along a direction onto a plane [m].
#[derive(Debug, Clone)]
pub struct Silhouette {
    /// Corners of the outline, counter-clockwise, with whether the edge to the next corner is open.
    outline: Vec<(DVec2, bool)>,
}

impl Silhouette {
    /// Projects `points` along the unit vector `direction`.
    ///
    /// `closed(p)` says of a point that nothing can flow past it, because it stands on the ground: an edge
    /// between two such points is no open edge. Needs three points that are not in line to have any width.
    pub fn new(points: &[DVec3], direction: DVec3, closed: impl Fn(DVec3) -> bool) -> Self {
        let (right, up) = direction.any_orthonormal_pair();
        let mut flat: Vec<(DVec2, bool)> =
            points.iter().map(|&p| (DVec2::new(right.dot(p), up.dot(p)), closed(p))).collect();
        flat.sort_by(|(a, _), (b, _)| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
        let lower = half_hull(flat.iter().copied());
        let upper = half_hull(flat.iter().rev().copied());
        let mut corners: Vec<(DVec2, bool)> = lower;
        corners.pop();
        corners.extend(upper);
        corners.pop();
        let count = corners.len();
        let outline =
            (0..count).map(|i| (corners[i].0, !(corners[i].1 && corners[(i + 1) % count].1))).collect();
        Self { outline }
    }

    /// The smaller of the outline's extents: the least distance between two parallel lines that hold it [m].
    pub fn least_width(&self) -> f64 {
        self.edges()
            .map(|(a, b, _)| {
                let normal = (b - a).perp().normalize_or_zero();
                self.outline.iter().map(|(p, _)| normal.dot(*p - a)).fold(0.0, f64::max)
            })
            .fold(f64::INFINITY, f64::min)
    }

    /// Corners of the outline in the plane of `direction`'s orthonormal pair, counter-clockwise, with whether the edge
    /// to the next one is open.
    pub fn corners(&self) -> &[(DVec2, bool)] {
        &self.outline
    }

    /// Whether the outline holds a point of space, projected along the `direction` that the outline was made with.
    pub fn holds(&self, point: DVec3, direction: DVec3) -> bool {
        let (right, up) = direction.any_orthonormal_pair();
        let p = DVec2::new(right.dot(point), up.dot(point));
        self.edges().all(|(a, b, _)| (b - a).perp_dot(p - a) > 0.0)
    }

    fn edges(&self) -> impl Iterator<Item = (DVec2, DVec2, bool)> + '_ {
        let count = self.outline.len();
        (0..count).map(move |i| (self.outline[i].0, self.outline[(i + 1) % count].0, self.outline[i].1))
    }
}

/// One chain of Andrew's monotone chain hull over points sorted along x; the corners turn left.
fn half_hull(points: impl Iterator<Item = (DVec2, bool)>) -> Vec<(DVec2, bool)> {
    let mut chain: Vec<(DVec2, bool)> = Vec::new();
    for (p, closed) in points {
        while chain.len() >= 2 {
            let [(a, _), (b, _)] = chain[chain.len() - 2..] else { unreachable!() };
            if (b - a).perp_dot(p - a) > 0.0 {
                break;
            }
            chain.pop();
        }
        chain.push((p, closed));
    }
    chain
}
