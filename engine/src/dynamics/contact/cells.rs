//! A mesh in convex hulls: cut by planes where that fits it better.
//!
//! The hull of what a mesh has in a box is that of its surface clipped to the box and of those corners of the box that
//! lie inside it. A cut is as good as the volume by which it makes the hulls smaller; the best one is made, again and
//! again, until the hulls together are nearly as small as the mesh.

use glam::DVec3;

use super::hull::hull_of;
use crate::geometry::{TriangleMesh, bounds, box_corners};

/// Hulls may together have this many times the volume of the mesh.
const ENOUGH: f64 = 1.05;
/// Most hulls of one mesh.
const MOST_HULLS: usize = 16;
/// A cut that takes off less than this part of the mesh's volume is not worth a hull.
const WORTH: f64 = 0.01;
/// Places along each axis of a box where it may be cut.
const PLACES: usize = 7;
/// A mesh of more triangles counts as its one hull: the search takes time in proportion.
const MOST_TRIANGLES: usize = 20_000;

/// A box, what of the surface is in it, and its hull.
struct Cell {
    low: DVec3,
    high: DVec3,
    surface: Vec<[DVec3; 3]>,
    points: Vec<DVec3>,
    volume: f64,
}

/// A mesh of this volume [m³] as the corners of convex hulls [m].
pub fn mesh_hulls(mesh: &TriangleMesh, volume: f64) -> Vec<Vec<DVec3>> {
    let (low, high) = bounds(mesh.vertices.iter().copied());
    let whole = Cell {
        low,
        high,
        surface: mesh.corners().collect(),
        points: mesh.vertices.clone(),
        volume: hull_of(&mesh.vertices).map_or(0.0, |hull| hull.volume),
    };
    if mesh.triangles.len() > MOST_TRIANGLES || whole.volume <= ENOUGH * volume {
        return vec![whole.points];
    }
    let cuts = |cell: &Cell| best_cut(mesh, cell);
    let mut cells = vec![(cuts(&whole), whole)];
    while cells.len() < MOST_HULLS && cells.iter().map(|(_, c)| c.volume).sum::<f64>() > ENOUGH * volume {
        let gain = |(cut, cell): &(Option<[Cell; 2]>, Cell)| {
            cut.as_ref().map_or(0.0, |[a, b]| cell.volume - a.volume - b.volume)
        };
        let best = (0..cells.len()).max_by(|&a, &b| gain(&cells[a]).total_cmp(&gain(&cells[b])));
        let best = best.expect("there are cells");
        if gain(&cells[best]) < WORTH * volume {
            break;
        }
        let (cut, _) = cells.swap_remove(best);
        cells.extend(cut.into_iter().flatten().map(|cell| (cuts(&cell), cell)));
    }
    cells.into_iter().filter(|(_, cell)| cell.volume > 0.0).map(|(_, cell)| cell.points).collect()
}

/// The cut that makes a cell's hull smallest.
fn best_cut(mesh: &TriangleMesh, cell: &Cell) -> Option<[Cell; 2]> {
    let cuts = (0..3).flat_map(|axis| (1..=PLACES).map(move |k| (axis, k as f64 / (PLACES + 1) as f64)));
    cuts.map(|(axis, share)| {
        let at = cell.low[axis] + (cell.high[axis] - cell.low[axis]) * share;
        let (mut middle_high, mut middle_low) = (cell.high, cell.low);
        middle_high[axis] = at;
        middle_low[axis] = at;
        let below = Cell::of(mesh, cell, cell.low, middle_high, axis, at, -1.0);
        let above = Cell::of(mesh, cell, middle_low, cell.high, axis, at, 1.0);
        [below, above]
    })
    .min_by(|[a, b], [c, d]| (a.volume + b.volume).total_cmp(&(c.volume + d.volume)))
}

impl Cell {
    /// The part of `parent` on one side of the plane `axis = at`.
    fn of(
        mesh: &TriangleMesh,
        parent: &Cell,
        low: DVec3,
        high: DVec3,
        axis: usize,
        at: f64,
        side: f64,
    ) -> Self {
        let mut surface = Vec::new();
        for triangle in &parent.surface {
            clip(triangle, axis, at, side, &mut surface);
        }
        let mut points: Vec<DVec3> = surface.iter().flatten().copied().collect();
        points.extend(box_corners(low, high).into_iter().filter(|&corner| mesh.encloses(corner)));
        let volume = if points.len() < 4 { 0.0 } else { hull_of(&points).map_or(0.0, |hull| hull.volume) };
        Self { low, high, surface, points, volume }
    }
}

/// Adds what of a triangle lies on one side of a plane, in triangles.
fn clip(triangle: &[DVec3; 3], axis: usize, at: f64, side: f64, out: &mut Vec<[DVec3; 3]>) {
    let inside = |p: DVec3| (p[axis] - at) * side;
    let mut ring: Vec<DVec3> = Vec::with_capacity(4);
    for k in 0..3 {
        let (from, to) = (triangle[k], triangle[(k + 1) % 3]);
        let (a, b) = (inside(from), inside(to));
        if a >= 0.0 {
            ring.push(from);
        }
        if (a > 0.0 && b < 0.0) || (a < 0.0 && b > 0.0) {
            let mut cut = from + (to - from) * (a / (a - b));
            cut[axis] = at;
            ring.push(cut);
        }
    }
    for k in 2..ring.len() {
        out.push([ring[0], ring[k - 1], ring[k]]);
    }
}
