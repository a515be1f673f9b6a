//! Simple polygons with holes, in a plane.

use glam::DVec2;

use super::PlaneMoments;

/// A simple polygon, concave allowed, with holes: rings of points [m], the outer one first and
/// counter-clockwise, holes clockwise.
///
/// A reusable buffer: [`clear`](Self::clear) keeps its memory. A ring is closed by itself: its first point is
/// not repeated. A vertex may lie in the middle of a straight side, where the corner of a neighbour meets it.
/// None of this is checked here; it is what the functions that take a polygon rely on.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Polygon {
    points: Vec<DVec2>,
    /// Ring `i` is `points[ring_ends[i - 1]..ring_ends[i]]`.
    ring_ends: Vec<usize>,
}

impl Polygon {
    /// A polygon without holes, from its outline, counter-clockwise [m].
    pub fn new(outer: &[DVec2]) -> Self {
        Self { points: outer.to_vec(), ring_ends: vec![outer.len()] }
    }

    /// Removes every ring and keeps the memory.
    pub fn clear(&mut self) {
        self.points.clear();
        self.ring_ends.clear();
    }

    /// Adds a ring [m]: the outline, counter-clockwise, or after it a hole, clockwise.
    pub fn push_ring(&mut self, ring: impl IntoIterator<Item = DVec2>) {
        self.points.extend(ring);
        self.ring_ends.push(self.points.len());
    }

    /// The rings in order, the outline first.
    pub fn rings(&self) -> impl Iterator<Item = &[DVec2]> {
        self.ring_ranges().map(|range| &self.points[range])
    }

    /// Where each ring lies among [`points`](Self::points), the outline first.
    pub fn ring_ranges(&self) -> impl Iterator<Item = core::ops::Range<usize>> {
        let starts = core::iter::once(0).chain(self.ring_ends.iter().copied());
        starts.zip(self.ring_ends.iter().copied()).map(|(start, end)| start..end)
    }

    /// All points, ring after ring [m]: what a triangulation's indices count.
    pub fn points(&self) -> &[DVec2] {
        &self.points
    }

    /// How many holes it has.
    pub fn hole_count(&self) -> usize {
        self.ring_ends.len().saturating_sub(1)
    }

    /// Every side from its first point to its second, ring after ring.
    pub fn sides(&self) -> impl Iterator<Item = (DVec2, DVec2)> {
        self.rings().flat_map(|ring| {
            let ahead = ring.iter().skip(1).chain(ring.first());
            ring.iter().copied().zip(ahead.copied())
        })
    }

    /// Area [m²], holes taken off; 0 for an empty polygon.
    ///
    /// Summed about the polygon's first point, so that a small polygon far from the origin loses no digits.
    pub fn area(&self) -> f64 {
        let Some(&origin) = self.points.first() else { return 0.0 };
        0.5 * self.sides().map(|(p, q)| (p - origin).perp_dot(q - origin)).sum::<f64>()
    }

    /// Area, centroid and second moments of area: see [`PlaneMoments::of`].
    pub fn moments(&self) -> PlaneMoments {
        PlaneMoments::of(self)
    }
}
