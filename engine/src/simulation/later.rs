//! Later charges: a body that has left its place is hit where it is when the front comes.
//!
//! All charges are aimed before the run, at the places where bodies stand. A body that leaves its place forgets the
//! loads of the fronts that have yet to come to it, and waits for them; when one comes, it is aimed at anew.

use super::queue::LoadQueue;
use super::shelter::Shelters;
use super::targets::{Shot, aim_anew};
use crate::blast::BlastField;
use crate::dynamics::RigidBody;
use crate::scene::Scene;

/// Charges and the bodies that wait for their fronts.
pub(super) struct Later {
    scene: Scene,
    fields: Vec<BlastField>,
    shelters: Shelters,
    /// Per charge, the bodies that wait for its front, in the order in which they left their places.
    waiting: Vec<Vec<usize>>,
}

impl Later {
    /// Nothing for a scene of one charge: it is what makes bodies leave their places.
    pub fn new(scene: &Scene, fields: Vec<BlastField>, shelters: Shelters) -> Option<Self> {
        let waiting = vec![Vec::new(); fields.len()];
        (fields.len() > 1).then(|| Self { scene: scene.clone(), fields, shelters, waiting })
    }

    /// Lets a body that has left its place for the first time wait for the fronts that have not reached it by `now`.
    pub fn put_off(&mut self, index: usize, body: &RigidBody, queue: &mut LoadQueue, now: f64) {
        for (charge, field) in self.fields.iter().enumerate() {
            if !reaches(field, field.front_radius(now), body) {
                queue.remove(charge);
                self.waiting[charge].push(index);
            }
        }
    }

    /// Whether a front reaches one of the waiting bodies by `now`.
    pub fn comes(&self, now: f64, body: impl Fn(usize) -> RigidBody) -> bool {
        self.waiting.iter().zip(&self.fields).any(|(waiting, field)| {
            let radius = if waiting.is_empty() { 0.0 } else { field.front_radius(now) };
            waiting.iter().any(|&index| reaches(field, radius, &body(index)))
        })
    }

    /// Whether any body waits for a front.
    pub fn awaited(&self) -> bool {
        self.waiting.iter().any(|waiting| !waiting.is_empty())
    }

    /// The bodies that a front reaches by `now`, with what it does to them.
    pub fn reached(&mut self, now: f64, body: impl Fn(usize) -> RigidBody) -> Vec<(usize, usize, Shot)> {
        let mut reached = Vec::new();
        for (charge, waiting) in self.waiting.iter_mut().enumerate() {
            let field = &self.fields[charge];
            let radius = if waiting.is_empty() { 0.0 } else { field.front_radius(now) };
            if radius == 0.0 {
                continue;
            }
            waiting.retain(|&index| {
                let state = body(index);
                let waits = !reaches(field, radius, &state);
                if !waits {
                    reached.push((
                        index,
                        charge,
                        aim_anew(&self.scene, &self.fields, &self.shelters, charge, index, state),
                    ));
                }
                waits
            });
        }
        reached
    }
}

/// Whether a front of this radius [m] has come to any point of a body.
fn reaches(field: &BlastField, radius: f64, body: &RigidBody) -> bool {
    radius > 0.0 && body.position.distance(field.position()) - body.reach <= radius
}
