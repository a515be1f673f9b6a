//! The same run where bodies touch: loads and drag change their velocities, the contact world does the rest.
//!
//! A step puts on each body the exact impulse of its loads and of the wind, then all of them move together. Steps are
//! fine while loads act and bodies are thrown, and as long as contacts allow otherwise. Bodies sleep until a load or
//! another body wakes them; a piece of a pane joins when it is free.

use glam::{DQuat, DVec3};
use rayon::prelude::*;

use super::targets::Target;
use super::{Phase, Simulation};
use crate::dynamics::contact::{
    Bond, CollisionShape, ContactBody, ContactWorld, Passes, REACH, bonds_of_bricks, step_at,
};
use crate::dynamics::ground::CALM_SPEED;
use crate::dynamics::{RigidBody, Winds};
use crate::geometry::MassProperties;
use crate::scene::{Body, Scene, Shape};

/// Longest step of bodies that fly freely once all loads are over [s].
const CALM_STEP: f64 = 5e-3;
/// Below this speed the air's resistance is a few thousandths of the weight of the thinnest shard [m/s].
const FELT_SPEED: f64 = 0.3;
/// For how long a body has to be calm to be at rest [s].
const REST: f64 = 0.5;

/// Bounds that overlap by no more than this only touch [m].
const TOUCH: f64 = 1e-4;
/// A body in its place that has shifted by less than this counts as one that never moved [m].
const STAYED: f64 = 5e-3;

/// The bodies that touch, and what is known of each.
pub(super) struct Contacts {
    world: ContactWorld,
    tracks: Vec<Track>,
    /// Speed of the fastest body [m/s].
    fastest: f64,
    /// Middle of the scene [m].
    origin: DVec3,
}

#[derive(Debug, Clone, Copy)]
struct Track {
    /// When any part of it was last faster than a body at rest [s]; 0 if it never was.
    moved: f64,
    asleep: bool,
    /// It has left the place where bodies can touch and flies on by itself.
    far: bool,
}

impl Contacts {
    /// The bodies of a scene, asleep where they stand; those that are held join later.
    pub fn new(scene: &Scene, targets: &[Target]) -> Self {
        let glass: Vec<&Target> = scene
            .bodies
            .iter()
            .zip(targets)
            .filter(|(body, _)| body.hold.is_some())
            .map(|(_, t)| t)
            .collect();
        let passes = |body: &Body, target: &Target| match (&body.hold, body.anchored) {
            (Some(_), _) => Passes::Frames,
            (None, true) if glass.iter().any(|piece| overlap(target, piece)) => Passes::Glass,
            _ => Passes::Nothing,
        };
        let bodies: Vec<ContactBody> = scene
            .bodies
            .par_iter()
            .zip(targets)
            .map(|(body, target)| ContactBody {
                shape: collision_shape(body, target.object_from_principal),
                friction: body.friction,
                anchored: body.anchored,
                passes: passes(body, target),
            })
            .collect();
        let bounds = targets.iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), target| {
            (low.min(target.bounds.0), high.max(target.bounds.1))
        });
        let origin = if targets.is_empty() { DVec3::ZERO } else { 0.5 * (bounds.0 + bounds.1) };
        let mut world = ContactWorld::new(bodies, scene.ground, origin);
        let track = Track { moved: 0.0, asleep: true, far: false };
        let mut tracks = vec![track; targets.len()];
        for (index, (body, target)) in scene.bodies.iter().zip(targets).enumerate() {
            if body.hold.is_none() {
                tracks[index].far = !world.join(index, &target.body, false);
            }
        }
        world.bind(&bonds(scene));
        Self { world, tracks, fastest: 0.0, origin }
    }
}

/// Whether the bounds of two bodies overlap by more than they do where the two touch.
fn overlap(a: &Target, b: &Target) -> bool {
    let common = a.bounds.1.min(b.bounds.1) - a.bounds.0.max(b.bounds.0);
    common.min_element() > TOUCH
}

fn collision_shape(body: &Body, object_from_principal: DQuat) -> CollisionShape {
    match &body.shape {
        Shape::Box { size, .. } => CollisionShape::of_box(*size, object_from_principal),
        Shape::Flat(flat) => CollisionShape::of_flat(&flat.outline, flat.thickness, object_from_principal),
        Shape::Mesh(mesh) => {
            let solid = MassProperties::of_mesh(mesh, 1.0).expect("it was measured before");
            CollisionShape::of_mesh(mesh, solid.mass, solid.centre, object_from_principal)
        }
    }
}

/// The joints of all walls with mortar. Bricks of a wall are turned alike.
fn bonds(scene: &Scene) -> Vec<Bond> {
    let mut all = Vec::new();
    for (&assembly, &mortar) in &scene.mortar {
        let members = || (0..scene.bodies.len()).filter(|&i| scene.bodies[i].assembly == Some(assembly));
        let Some(first) = members().next() else { continue };
        let world_from_wall = scene.bodies[first].orientation;
        let bricks: Vec<_> = members()
            .filter_map(|i| {
                let body = &scene.bodies[i];
                let Shape::Box { size, .. } = body.shape else { return None };
                Some((i, world_from_wall.conjugate() * body.position, size))
            })
            .collect();
        all.extend(bonds_of_bricks(&bricks, world_from_wall, mortar));
    }
    all
}

impl Simulation {
    /// Steps from the frame before to this one.
    pub(super) fn steps_to(&self, frame: usize) -> usize {
        let (t0, t1) = ((frame - 1) as f64 / self.frame_rate, frame as f64 / self.frame_rate);
        let Some(contacts) = &self.contacts else {
            let calm = libm::ceil((t1 - t0) / CALM_STEP - 1e-9).max(1.0) as usize;
            return if t0 < self.calm { self.steps_per_frame } else { calm.min(self.steps_per_frame) };
        };
        let loaded = self.lives.iter().any(|life| life.is_stirred(t0, t1))
            || self.later.as_ref().is_some_and(|later| later.comes(t1, |i| self.bodies.get(i)));
        let short = step_at(contacts.fastest);
        let steps = libm::ceil((t1 - t0) / short - 1e-9).max(1.0) as usize;
        if loaded { steps.max(self.steps_per_frame) } else { steps }
    }

    /// One step of bodies that touch.
    pub(super) fn touch(&mut self, t0: f64, t1: f64) {
        let mut freed = Vec::new();
        for index in 0..self.lives.len() {
            match self.phases[index] {
                Phase::Anchored | Phase::Held => {
                    if self.lives[index].is_stirred(t0, t1) && self.stir(index, t0, t1) {
                        freed.push(index);
                    }
                }
                _ => self.push(index, t0, t1),
            }
        }
        self.move_together(t0, t1);
        for index in freed {
            self.phases[index] = Phase::Free;
            self.lives[index].change = None;
            let contacts = self.contacts.as_mut().expect("bodies touch");
            let far = !contacts.world.join(index, &self.bodies.get(index), true);
            contacts.tracks[index] = Track { moved: t1, asleep: false, far };
            self.part(index, t1);
        }
        for index in 0..self.lives.len() {
            self.account(index, t1);
        }
    }

    /// A step of a body that does not move by itself. Returns whether it is free now.
    fn stir(&mut self, index: usize, t0: f64, t1: f64) -> bool {
        let mut body = self.bodies.get(index);
        let carry = self.support.carry(index);
        self.world.step(&mut body, &mut self.phases[index], &mut self.lives[index], carry, t0, t1);
        self.bodies.set(index, &body);
        self.lives[index].change.is_some()
    }

    /// Puts loads, wind and the air's resistance on a body's velocity.
    fn push(&mut self, index: usize, t0: f64, t1: f64) {
        let contacts = self.contacts.as_mut().expect("bodies touch");
        let (track, life) = (contacts.tracks[index], &mut self.lives[index]);
        let loaded = life.queue.acts(t0, t1);
        if track.asleep && !loaded {
            return;
        }
        let mut body = self.bodies.get(index);
        if track.far {
            contacts.tracks[index].asleep = false;
            if loaded {
                self.world.fly_loaded(&mut body, life, t0, t1);
            } else {
                body.fly(self.world.air, t1 - t0);
                self.world.land(&mut body, life, t1 - t0);
            }
            life.change = None;
            self.bodies.set(index, &body);
        } else if loaded {
            let before = (body.velocity, body.angular_momentum);
            let away = life.away;
            self.world.load(&mut body, life, t0, t1, away);
            if (body.velocity, body.angular_momentum) != before {
                contacts.world.drive(index, &body);
            }
        } else if body.velocity.length_squared() > FELT_SPEED * FELT_SPEED {
            body.blow(Winds { winds: &[], air: self.world.air }, t0, t1);
            contacts.world.drive(index, &body);
        }
    }

    /// Moves all bodies that are awake and takes over where they are.
    fn move_together(&mut self, t0: f64, t1: f64) {
        let contacts = self.contacts.as_mut().expect("bodies touch");
        let (bodies, tracks) = (&mut self.bodies, &mut contacts.tracks);
        let (mut fastest, mut strays) = (0.0_f64, Vec::new());
        contacts.world.step(t1 - t0, |moved, position, rotation, velocity, spin| {
            let (index, track) = (moved.index, &mut tracks[moved.index]);
            let mut body = bodies.get(index);
            body.position = position;
            body.world_from_principal = rotation;
            (body.velocity, body.angular_momentum) = (DVec3::ZERO, DVec3::ZERO);
            track.asleep = moved.asleep;
            if !moved.asleep {
                body.velocity = velocity;
                body.angular_momentum = momentum(&body, spin);
                fastest = fastest.max(velocity.length());
                if !moved.still && velocity.length() + spin.length() * body.reach > CALM_SPEED {
                    track.moved = t1;
                }
            }
            if position.distance(contacts.origin) > REACH {
                strays.push(index);
            }
            bodies.set(index, &body);
        });
        contacts.fastest = fastest;
        for index in strays {
            contacts.world.leave(index);
            contacts.tracks[index].far = true;
        }
    }

    /// Notes what a step has made of a body.
    fn account(&mut self, index: usize, t1: f64) {
        let (phase, life) = (self.phases[index], &mut self.lives[index]);
        if matches!(phase, Phase::Anchored | Phase::Held) {
            return;
        }
        let track = self.contacts.as_ref().expect("bodies touch").tracks[index];
        if life.launched && (track.asleep || life.away) {
            return;
        }
        let body = self.bodies.get(index);
        let leaves = !life.away && life.place.is_left(&body);
        if leaves {
            self.phases[index] = Phase::Free;
            self.part(index, t1);
        }
        self.world.launch(&body, &mut self.phases[index], &mut self.lives[index], t1);
    }

    /// A body has left its place: it waits for the fronts that have yet to come to it.
    fn part(&mut self, index: usize, now: f64) {
        let life = &mut self.lives[index];
        if let Some(later) = self.later.as_mut().filter(|_| !life.away) {
            later.put_off(index, &self.bodies.get(index), &mut life.queue, now);
        }
        life.away = true;
    }

    /// Whether all loads are over and every body rests.
    pub(super) fn rests(&self, now: f64) -> bool {
        let over = |index: usize| {
            let (life, phase) = (&self.lives[index], self.phases[index]);
            let held = life.hold.as_ref().is_some_and(|hold| hold.0.until.is_finite());
            let still = match &self.contacts {
                Some(contacts) => contacts.tracks[index].rests(now),
                None => matches!(phase, Phase::Standing | Phase::Anchored | Phase::Held),
            };
            life.queue.end <= now && !held && (still || matches!(phase, Phase::Anchored | Phase::Held))
        };
        !self.later.as_ref().is_some_and(super::Later::awaited) && (0..self.lives.len()).all(over)
    }

    /// Notes when bodies came to rest, and says how many have not where the run was to last until all do.
    pub(super) fn conclude(&mut self, now: f64) {
        if let Some(contacts) = &self.contacts {
            for (index, (life, track)) in self.lives.iter_mut().zip(&contacts.tracks).enumerate() {
                let shift = self.bodies.get(index).position.distance(life.place.origin);
                let stayed = !life.away && shift < STAYED;
                let rest = if stayed { 0.0 } else { track.moved };
                life.facts.rest_time = if track.rests(now) { rest } else { f64::NAN };
            }
        }
        let far =
            self.contacts.as_ref().map_or(0, |contacts| contacts.tracks.iter().filter(|t| t.far).count());
        if far > 0 {
            self.warnings.push(format!(
                "{far} of {} bodies are more than {} km from the middle of the scene or too large: they meet only the \
                 ground",
                self.lives.len(),
                REACH / 1e3
            ));
        }
        let moving = self.lives.iter().filter(|life| life.facts.rest_time.is_nan()).count();
        if self.until_rest && moving > 0 {
            self.warnings.push(format!(
                "{moving} of {} bodies still move at {now:.2} s, where the run ends at the latest",
                self.lives.len()
            ));
        }
    }
}

impl Track {
    fn rests(&self, now: f64) -> bool {
        self.asleep || (!self.far && now - self.moved >= REST)
    }
}

/// Angular momentum in principal axes [kg m²/s] of a body that turns at `spin` in the world [rad/s].
fn momentum(body: &RigidBody, spin: DVec3) -> DVec3 {
    let own = body.world_from_principal.conjugate() * spin;
    let along = |i: usize| if body.inverse_moments[i] > 0.0 { own[i] / body.inverse_moments[i] } else { 0.0 };
    DVec3::new(along(0), along(1), along(2))
}
