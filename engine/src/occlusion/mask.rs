//! What each group of bodies hides: its pixels with their depths, and its rim.
//!
//! A **group** is what stands together: the bricks of one wall, the fragments of one pane, or a body alone. Its
//! mask is the union of its members. Stretches of a ray inside the group that are less than [`JOINT`] apart count
//! as one.
//!
//! The **rim** is finer than the pixels: between a covered pixel and a neighbour that is not, it is where the
//! silhouette itself crosses the way from centre to centre. Where a group stands on the ground it has no rim: nothing
//! flows under it.
//!
//! A **small group**, on fewer than [`FEW`] pixels, covers them by the share that makes its solid angle right. If no
//! ray meets it at all, it goes to the pixel that holds its middle. So nothing is too thin to be seen, and nothing
//! thin hides more than it covers.

use std::collections::BTreeSet;

use glam::DVec3;

use super::raster::Hit;
use super::solid::View;
use super::sphere_map::SphereMap;
use crate::geometry::JOINT;

/// Pixels below which a group's solid angle is worked out instead of counted, and a body read at its points.
pub(super) const FEW: usize = 8;

/// Height above the ground up to which a rim stands on it [m], and how much more a metre of distance, for what a
/// group's rim is known to.
const ON_GROUND: (f64, f64) = (0.01, 3e-4);

/// A group on one pixel, from `near` to `far` [m].
#[derive(Debug, Clone, Copy)]
pub(super) struct Entry {
    pub pixel: u32,
    pub near: f32,
    pub far: f32,
    /// Share of the pixel that is covered.
    pub cover: f32,
}

/// A point of a group's rim, between a covered pixel and the one `beyond` it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rim {
    pub pixel: u32,
    pub beyond: u32,
    /// Distance of the covered pixel [m].
    pub near: f32,
    /// How far from the one centre to the other.
    pub share: f32,
    /// Distance of the silhouette there [m].
    pub depth: f32,
    pub direction: DVec3,
}

/// What one group hides.
#[derive(Debug, Clone, Default)]
pub(super) struct Mask {
    /// By pixel, then by distance.
    pub entries: Vec<Entry>,
    pub rims: Vec<Rim>,
    /// No ray meets it: it covers part of the one pixel that holds its middle.
    pub unmet: bool,
}

impl Mask {
    /// The mask of a group from its members and their hits. `ground` is the height of the ground above the charge
    /// [m], below 0 as a rule; −∞ without one.
    pub fn new(map: &SphereMap, views: &[&View], hits: &[&[Hit]], ground: f64) -> Self {
        let mut all: Vec<Hit> = hits.concat();
        if hits.len() > 1 {
            all.sort_by(|a, b| a.pixel.cmp(&b.pixel).then(a.near.total_cmp(&b.near)));
        }
        let mut entries: Vec<Entry> = Vec::with_capacity(all.len());
        for hit in all {
            match entries.last_mut() {
                Some(last) if last.pixel == hit.pixel && hit.near - last.far < JOINT as f32 => {
                    last.far = last.far.max(hit.far);
                }
                _ => entries.push(Entry { pixel: hit.pixel, near: hit.near, far: hit.far, cover: 1.0 }),
            }
        }
        let mut mask = Self { entries, ..Self::default() };
        if views.len() > 1 {
            mask.close_joints(map, views);
        }
        mask.rims = mask.find_rims(map, views);
        mask.rims.retain(|rim| {
            let depth = f64::from(rim.depth);
            rim.direction.y * depth > ground + ON_GROUND.0 + ON_GROUND.1 * depth
        });
        mask.cover_small(map, views);
        mask
    }

    /// Whether the group covers a pixel, and from which distance [m].
    pub fn nearest(&self, pixel: u32) -> Option<f32> {
        let at = self.entries.partition_point(|entry| entry.pixel < pixel);
        self.entries.get(at).filter(|entry| entry.pixel == pixel).map(|entry| entry.near)
    }

    /// Covers the pixels whose rays slip through a joint between members, from the pixels beside them inward.
    fn close_joints(&mut self, map: &SphereMap, views: &[&View]) {
        let mut edge = self.entries.clone();
        let mut seen = BTreeSet::new();
        while !edge.is_empty() {
            let mut closed: Vec<Entry> = Vec::new();
            for entry in &edge {
                for pixel in map.neighbours(entry.pixel as usize) {
                    let fresh = self.nearest(pixel as u32).is_none() && seen.insert(pixel);
                    if fresh && in_joint(views, map.centre(pixel), f64::from(entry.near)) {
                        closed.push(Entry { pixel: pixel as u32, ..*entry });
                    }
                }
            }
            self.entries.extend_from_slice(&closed);
            self.entries.sort_by(|a, b| a.pixel.cmp(&b.pixel).then(a.near.total_cmp(&b.near)));
            edge = closed;
        }
    }

    fn find_rims(&self, map: &SphereMap, views: &[&View]) -> Vec<Rim> {
        let mut rims = Vec::new();
        let edges = if let [single] = views { single.silhouette() } else { Vec::new() };
        let mut before = None;
        for entry in &self.entries {
            if before.replace(entry.pixel) == Some(entry.pixel) {
                continue;
            }
            for beyond in map.neighbours(entry.pixel as usize) {
                if self.nearest(beyond as u32).is_some() {
                    continue;
                }
                let (inside, outside) = (map.centre(entry.pixel as usize), map.centre(beyond));
                let (share, depth) = if views.len() == 1 {
                    // Edges inside a body that is not convex come before the silhouette.
                    edges
                        .iter()
                        .filter_map(|edge| edge.crossing(inside, outside))
                        .max_by(|a, b| a.0.total_cmp(&b.0))
                        .unwrap_or((0.5, f64::from(entry.near)))
                } else {
                    last_covered(views, inside, outside, f64::from(entry.near))
                };
                rims.push(Rim {
                    pixel: entry.pixel,
                    beyond: beyond as u32,
                    near: entry.near,
                    share: share as f32,
                    depth: depth as f32,
                    direction: inside.lerp(outside, share).normalize(),
                });
            }
        }
        rims
    }

    fn cover_small(&mut self, map: &SphereMap, views: &[&View]) {
        let mut pixels: Vec<u32> = self.entries.iter().map(|entry| entry.pixel).collect();
        pixels.dedup();
        if pixels.len() >= FEW {
            return;
        }
        let size: f64 = views.iter().map(|view| view.solid_angle()).sum();
        if pixels.is_empty() {
            self.unmet = true;
            let middle = views.iter().map(|view| view.middle).sum::<DVec3>() / views.len() as f64;
            let distances = || views.iter().flat_map(|view| &view.vertices).map(|v| v.length());
            let pixel = map.pixel(middle);
            self.entries.push(Entry {
                pixel: pixel as u32,
                near: distances().fold(f64::INFINITY, f64::min) as f32,
                far: distances().fold(0.0, f64::max) as f32,
                cover: (size / map.solid_angle(pixel)).min(1.0) as f32,
            });
            return;
        }
        let counted: f64 = pixels.iter().map(|&pixel| map.solid_angle(pixel as usize)).sum();
        let cover = (size / counted).min(1.0) as f32;
        self.entries.iter_mut().for_each(|entry| entry.cover = cover);
    }
}

/// Whether a ray that meets no member has members on two opposite sides of it, within the width of a joint.
fn in_joint(views: &[&View], direction: DVec3, distance: f64) -> bool {
    let (right, up) = direction.any_orthonormal_pair();
    let is_met = |offset: DVec3| {
        let aside = (direction + offset * (JOINT / distance)).normalize();
        views.iter().any(|view| view.is_met(aside))
    };
    [right, up, (right + up).normalize(), (right - up).normalize()]
        .into_iter()
        .any(|offset| is_met(offset) && is_met(-offset))
}

/// How far from the covered direction `a` to the uncovered one `b` the last member reaches, to a 256th, and its distance
/// there [m]; that of a mesh is taken from `a`, where it is `near`.
fn last_covered(views: &[&View], a: DVec3, b: DVec3, near: f64) -> (f64, f64) {
    let (mut covered, mut open) = (0.0, 1.0);
    for _ in 0..8 {
        let middle = 0.5 * (covered + open);
        let direction = a.lerp(b, middle).normalize();
        if views.iter().any(|view| view.is_met(direction)) {
            covered = middle;
        } else {
            open = middle;
        }
    }
    let last = a.lerp(b, covered).normalize();
    let met = views.iter().filter_map(|view| view.through_box(last)).map(|(enter, _)| enter);
    let depth = met.fold(f64::INFINITY, f64::min);
    (0.5 * (covered + open), if depth.is_finite() { depth } else { near })
}
