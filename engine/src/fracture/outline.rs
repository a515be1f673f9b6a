//! Whether an outline bounds a pane: simple, with area, its holes inside.

use glam::DVec2;
use robust::{Coord, orient2d};

use crate::error::{Error, Result};
use crate::geometry::{Polygon, bounds};

/// An outline may lie this many times its own size away from the origin, or its digits no longer tell places in it
/// apart.
const FARTHEST: f64 = 1e3;
/// A pane has at least this area, in squares of its longer side: narrower ones are lost in rounding.
const NARROWEST: f64 = 1e-6;

/// Checks that rings bound a pane: the outer one counter-clockwise, holes clockwise inside it, no side meeting
/// another one.
///
/// # Errors
/// [`Error::Malformed`] with the first fault.
pub fn check(outline: &Polygon) -> Result<()> {
    let refuse = |why: &str| Err(Error::Malformed(format!("the outline {why}")));
    let points = outline.points();
    if points.iter().any(|p| !p.is_finite()) {
        return refuse("has a point that is not finite");
    }
    for (index, ring) in outline.rings().enumerate() {
        if ring.len() < 3 {
            return refuse("needs at least three points in each ring");
        }
        let area = Polygon::new(ring).area();
        if area == 0.0 || (area > 0.0) != (index == 0) {
            return refuse("must run counter-clockwise round an area, and its holes clockwise");
        }
    }
    let (low, high) = bounds(points.iter().copied());
    if low.abs().max(high.abs()).max_element() > FARTHEST * (high - low).max_element() {
        return refuse("lies too far from the origin for its size; move it nearer");
    }
    let longer = (high - low).max_element();
    if outline.area() < NARROWEST * longer * longer {
        return refuse(
            "is too narrow for its length; its area must be a millionth of its longer side squared or more",
        );
    }
    if let Some((p, q)) = crossing(outline) {
        return refuse(&format!(
            "crosses or touches itself between ({}, {}) and ({}, {}); give a simple polygon",
            p.x, p.y, q.x, q.y
        ));
    }
    let mut rings = outline.rings();
    let outer = Polygon::new(rings.next().expect("an outline has a ring"));
    let holes: Vec<Polygon> = rings.map(Polygon::new).collect();
    for (index, hole) in holes.iter().enumerate() {
        let others = holes.iter().enumerate().filter(|(i, _)| *i != index);
        if !contains(&outer, hole.points()[0])
            || others.into_iter().any(|(_, other)| contains(other, hole.points()[0]))
        {
            return refuse("has a hole outside the pane or inside another hole");
        }
    }
    Ok(())
}

/// Whether a point lies inside a polygon and outside its holes, whichever way the rings run.
pub fn contains(polygon: &Polygon, point: DVec2) -> bool {
    let mut inside = false;
    for (a, b) in polygon.sides() {
        if (a.y > point.y) != (b.y > point.y) {
            let (low, high) = if a.y < b.y { (a, b) } else { (b, a) };
            inside ^= turn(low, high, point) > 0.0;
        }
    }
    inside
}

/// Distance from a point to the nearest side [m].
pub fn clearance(polygon: &Polygon, point: DVec2) -> f64 {
    let to_side = |(a, b): (DVec2, DVec2)| {
        let along = ((point - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
        point.distance(a + (b - a) * along)
    };
    polygon.sides().map(to_side).fold(f64::INFINITY, f64::min)
}

/// Twice the signed area of a triangle, with an exact sign: above 0 where it turns left.
pub(super) fn turn(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    let coord = |p: DVec2| Coord { x: p.x, y: p.y };
    orient2d(coord(a), coord(b), coord(c))
}

/// The first side that meets another one it does not adjoin, or folds back on its neighbour.
fn crossing(outline: &Polygon) -> Option<(DVec2, DVec2)> {
    let mut sides: Vec<(DVec2, DVec2)> = outline.sides().collect();
    if let Some(&side) = sides.iter().find(|(a, b)| a == b) {
        return Some(side);
    }
    // Sorted along x, only sides that overlap there need comparing.
    sides.sort_by(|(a, b), (c, d)| a.x.min(b.x).total_cmp(&c.x.min(d.x)));
    for (i, &(a, b)) in sides.iter().enumerate() {
        let right = a.x.max(b.x);
        for &(c, d) in sides[i + 1..].iter().take_while(|(c, d)| c.x.min(d.x) <= right) {
            if touch((a, b), (c, d)) {
                return Some((a, b));
            }
        }
    }
    None
}

/// Whether two sides have a point in common that is not the one at which neighbours join.
fn touch((a, b): (DVec2, DVec2), (c, d): (DVec2, DVec2)) -> bool {
    let joint = [(a, b, c, d), (a, b, d, c), (b, a, c, d), (b, a, d, c)];
    if let Some(&(_, tail, _, head)) = joint.iter().find(|(p, _, q, _)| p == q) {
        let middle = if tail == a { b } else { a };
        // Neighbours, unless one folds back along the other.
        return turn(tail, middle, head) == 0.0 && (tail - middle).dot(head - middle) > 0.0;
    }
    let apart = |p: DVec2, q: DVec2, r: DVec2, s: DVec2| {
        let (one, two) = (turn(p, q, r), turn(p, q, s));
        (one > 0.0 && two > 0.0) || (one < 0.0 && two < 0.0)
    };
    let boxes = a.min(b).cmple(c.max(d)).all() && c.min(d).cmple(a.max(b)).all();
    boxes && !apart(a, b, c, d) && !apart(c, d, a, b)
}
