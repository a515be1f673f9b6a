//! Polygons cut into triangles.
//!
//! The triangles come from the constrained Delaunay triangulation of the crate `spade`, which decides every
//! orientation exactly (adaptive predicates). Of all ways to cut a polygon at its own corners, the Delaunay one
//! makes the smallest angle as large as it can be. That matters for pieces of a crack pattern: most of them have
//! corners in the middle of a straight side, where rounding leaves them out of line by `1e-17`, and a scheme
//! that cuts ears off then closes with a triangle of almost no area.
//!
//! # Which library
//! Measured in one run on one core, in microseconds a piece: 3 001 straight-sided pieces of a mosaic with
//! T-junctions (5.9 corners a piece), and bent shards with 250 and with 4 000 corners.
//!
//! | library | mosaic | 250 corners | 4 000 corners |
//! |---|---|---|---|
//! | `spade` 2.15, as used here | 0.75 | 137 | 2 380 |
//! | `spade` 2.15, bulk loading | 1.9 | 155 | 2 240 |
//! | `i_triangle` 0.51, 64 bits, Delaunay | 0.62 | 46 | 920 |
//! | `earcut` 0.4 | 0.10 | 18 | 500 |
//!
//! `earcut` does not decide exactly, and gave 765 of the mosaic's 3 001 pieces a triangle a billion times longer
//! than high. `i_triangle` works on a grid of integers and gives back other points in another order, so every
//! corner has to be searched for again (0.75, 150 and 28 000 with a plain search); with 32 bits, its default, it
//! turned triangles over and did not return on the mosaic squeezed to a billionth. `spade` cuts the corners that it
//! is given and was right on everything, in less than a microsecond for a common piece.

use spade::handles::{FixedFaceHandle, FixedVertexHandle, InnerTag};
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation, mitigate_underflow};

use super::Polygon;
use crate::error::{Error, Result};

/// Cuts polygons into triangles, one after another, with the memory of the ones before.
///
/// The same polygon gives the same triangles whatever was cut before. Once warm nothing is allocated for a
/// polygon whose sides are all in its Delaunay triangulation, as those of almost every straight-sided piece are;
/// a side that has to be forced in costs the library a short list or two.
#[derive(Debug, Default)]
pub struct Triangulator {
    delaunay: ConstrainedDelaunayTriangulation<Point2<f64>>,
    /// The corner that follows each corner on its ring.
    next: Vec<usize>,
    /// Faces of the Delaunay triangulation known to lie inside.
    inside: Vec<bool>,
    open: Vec<FixedFaceHandle<InnerTag>>,
}

impl Triangulator {
    /// Cuts `polygon` into triangles, written to `triangles` in place of what was there.
    ///
    /// Each is three indices into [`Polygon::points`], counter-clockwise, with an area above 0: none is flat,
    /// whatever the polygon. Every corner is used, those in the middle of a straight side too. Every side of
    /// the polygon is an edge of exactly one triangle, and every other edge belongs to two. A polygon of `n`
    /// corners and `h` holes makes `n + 2h − 2` triangles.
    ///
    /// # Errors
    /// [`Error::Malformed`] when the polygon is not simple: two corners in one place, sides that cross or touch,
    /// a ring that runs the wrong way, a coordinate that is not finite, or fewer than three corners.
    pub fn triangulate(&mut self, polygon: &Polygon, triangles: &mut Vec<[u32; 3]>) -> Result<()> {
        triangles.clear();
        self.insert_corners(polygon)?;
        self.force_sides();
        self.collect_inside(triangles)?;
        let count = polygon.points().len() + 2 * polygon.hole_count();
        if triangles.len() + 2 != count {
            return Err(Error::Malformed(format!(
                "a piece with {} corners and {} holes came apart into {} triangles: a hole must run clockwise and lie \
                 inside the outline",
                polygon.points().len(),
                polygon.hole_count(),
                triangles.len()
            )));
        }
        Ok(())
    }

    /// The Delaunay triangulation of all corners, in which corner `i` is vertex `i`.
    fn insert_corners(&mut self, polygon: &Polygon) -> Result<()> {
        self.delaunay.clear();
        self.next.clear();
        for ring in polygon.ring_ranges() {
            self.next.extend(ring.clone().skip(1));
            self.next.extend(ring.clone().take(1));
        }
        let mut last = None;
        for (i, p) in polygon.points().iter().enumerate() {
            let point = mitigate_underflow(Point2::new(p.x, p.y));
            // The corner before is near, so the search for the place starts there.
            let placed = match last {
                None => self.delaunay.insert(point),
                Some(hint) => self.delaunay.insert_with_hint(point, hint),
            };
            match placed {
                Ok(vertex) if vertex.index() == i => last = Some(vertex),
                Ok(_) => {
                    return Err(Error::Malformed(format!("a piece has two corners at ({}, {}) m", p.x, p.y)));
                }
                Err(_) => {
                    return Err(Error::Malformed(format!(
                        "a piece has a corner at ({}, {}) m, but coordinates must be finite",
                        p.x, p.y
                    )));
                }
            }
        }
        Ok(())
    }

    fn has_side(&self, from: usize) -> bool {
        let ends = [from, self.next[from]].map(FixedVertexHandle::from_index);
        self.delaunay.get_edge_from_neighbors(ends[0], ends[1]).is_some()
    }

    /// Makes every side of the polygon an edge, unless all of them are already.
    fn force_sides(&mut self) {
        if (0..self.next.len()).all(|from| self.has_side(from)) {
            return;
        }
        for (from, &to) in self.next.iter().enumerate() {
            let ends = [from, to].map(FixedVertexHandle::from_index);
            self.delaunay.try_add_constraint(ends[0], ends[1]);
        }
    }

    /// Gathers the triangles to the left of the sides, and those reached from them without crossing a side.
    fn collect_inside(&mut self, triangles: &mut Vec<[u32; 3]>) -> Result<()> {
        self.open.clear();
        self.inside.clear();
        self.inside.resize(self.delaunay.num_all_faces(), false);
        for (from, &to) in self.next.iter().enumerate() {
            let ends = [from, to].map(FixedVertexHandle::from_index);
            let Some(side) = self.delaunay.get_edge_from_neighbors(ends[0], ends[1]) else {
                return Err(not_simple(&self.delaunay, from));
            };
            let Some(face) = side.face().as_inner() else {
                return Err(not_simple(&self.delaunay, from));
            };
            mark(&mut self.inside, &mut self.open, face.fix());
        }
        while let Some(handle) = self.open.pop() {
            let face = self.delaunay.face(handle);
            triangles.push(face.vertices().map(|vertex| vertex.index() as u32));
            for edge in face.adjacent_edges() {
                let [a, b] = edge.vertices().map(|vertex| vertex.index());
                if self.next[a] == b || self.next[b] == a {
                    continue;
                }
                let Some(beyond) = edge.rev().face().as_inner() else {
                    return Err(not_simple(&self.delaunay, a));
                };
                mark(&mut self.inside, &mut self.open, beyond.fix());
            }
        }
        Ok(())
    }
}

/// Notes that a face lies inside, once.
fn mark(inside: &mut [bool], open: &mut Vec<FixedFaceHandle<InnerTag>>, face: FixedFaceHandle<InnerTag>) {
    if !core::mem::replace(&mut inside[face.index()], true) {
        open.push(face);
    }
}

fn not_simple(delaunay: &ConstrainedDelaunayTriangulation<Point2<f64>>, corner: usize) -> Error {
    let p = delaunay.vertex(FixedVertexHandle::from_index(corner)).position();
    Error::Malformed(format!(
        "the outline of a piece crosses or touches itself, or runs clockwise, near ({}, {}) m",
        p.x, p.y
    ))
}
