//! Bodies that touch: loads and drag change their velocities, the contact world does the rest.
//!
//! A step puts on each body the exact impulse of its loads and of the wind, then all of them move together. Steps are
//! fine while loads act and bodies are thrown, and as long as contacts allow otherwise. Bodies sleep until a load or
//! another body wakes them; a piece of a pane joins when it is free, or when it is sure to stay where it is.

use glam::{DQuat, DVec3};
use rayon::prelude::*;

use super::frames::Frames;
use super::life::Phase;
use super::motion::Motion;
use super::state::State;
use super::steps::steps_of;
use super::targets::Target;
use super::warnings;
use crate::dynamics::contact::{
    Bond, CollisionShape, ContactBody, ContactWorld, Passes, REACH, bonds_of_bricks, step_at,
};
use crate::dynamics::ground::CALM_SPEED;
use crate::dynamics::{Bodies, RigidBody, Winds};
use crate::error::Result;
use crate::geometry::{MassProperties, bounds};
use crate::scene::{Body, Scene, Shape};

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
    /// Steps a frame while loads act, at least.
    loaded: usize,
    /// Speed of the fastest body [m/s].
    fastest: f64,
    /// Middle of the scene [m].
    origin: DVec3,
    frames: Frames,
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
    pub fn new(scene: &Scene, targets: &[Target], loaded: usize) -> Self {
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
        let frames = Frames::new(scene, targets, &bodies);
        let (low, high) = bounds(targets.iter().flat_map(|target| [target.bounds.0, target.bounds.1]));
        let origin = if targets.is_empty() { DVec3::ZERO } else { 0.5 * (low + high) };
        let mut world = ContactWorld::new(bodies, scene.ground, origin);
        let track = Track { moved: 0.0, asleep: true, far: false };
        let mut tracks = vec![track; targets.len()];
        for (index, (body, target)) in scene.bodies.iter().zip(targets).enumerate() {
            if body.hold.is_none() {
                tracks[index].far = !world.join(index, &target.body, false);
            }
        }
        world.bind(&bonds(scene));
        Self { world, tracks, loaded, fastest: 0.0, origin, frames }
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

impl Motion for Contacts {
    fn steps(&self, state: &State, t0: f64, t1: f64) -> usize {
        let steps = steps_of(t1 - t0, step_at(self.fastest));
        if state.is_stirred(t0, t1) { steps.max(self.loaded) } else { steps }
    }

    fn advance(&mut self, state: &mut State, t0: f64, t1: f64) -> Result<()> {
        let mut freed = Vec::new();
        for index in 0..state.len() {
            match state.phases[index] {
                Phase::Anchored | Phase::Held => {
                    if state.lives[index].is_stirred(t0, t1) && stir(state, index, t0, t1) {
                        freed.push(index);
                    }
                }
                _ => self.push(state, index, t0, t1)?,
            }
        }
        if let Some(lost) = self.move_together(&mut state.bodies, t0, t1) {
            return Err(state.overflow(lost, "its motion among others", t1));
        }
        for index in freed {
            state.phases[index] = Phase::Free;
            state.lives[index].change = None;
            let far = !self.world.join(index, &sound(state, index, state.bodies.get(index), t1)?, true);
            self.tracks[index] = Track { moved: t1, asleep: false, far };
            self.frames.release(index);
            state.part(index, t1);
        }
        self.frames.settle(state, &mut self.world, t1);
        self.frames.clear(state, &mut self.world);
        for index in 0..state.len() {
            self.account(state, index, t1);
        }
        Ok(())
    }

    fn rests(&self, state: &State, now: f64) -> bool {
        state.rests(now, |index| self.tracks[index].rests(now))
    }

    fn conclude(&self, state: &mut State, now: f64) -> Option<String> {
        for (index, (life, track)) in state.lives.iter_mut().zip(&self.tracks).enumerate() {
            let shift = state.bodies.get(index).position.distance(life.place.origin);
            let stayed = !life.away && shift < STAYED;
            let rest = if stayed { 0.0 } else { track.moved };
            life.facts.rest_time = if track.rests(now) { rest } else { f64::NAN };
        }
        warnings::far(self.tracks.iter().filter(|track| track.far).count(), state.len(), REACH)
    }
}

impl Contacts {
    /// Puts loads, wind and the air's resistance on a body's velocity.
    fn push(&mut self, state: &mut State, index: usize, t0: f64, t1: f64) -> Result<()> {
        let (track, life, world) = (self.tracks[index], &mut state.lives[index], &state.world);
        let loaded = life.queue.acts(t0, t1);
        if track.asleep && !loaded {
            return Ok(());
        }
        let mut body = state.bodies.get(index);
        if track.far {
            self.tracks[index].asleep = false;
            if loaded {
                world.fly_loaded(&mut body, life, t0, t1);
            } else {
                body.fly(world.air, t1 - t0);
                world.land(&mut body, life, t1 - t0);
            }
            life.change = None;
            state.bodies.set(index, &body);
        } else if loaded {
            let before = (body.velocity, body.angular_momentum);
            let away = life.away;
            world.load(&mut body, life, t0, t1, away);
            if (body.velocity, body.angular_momentum) != before {
                self.world.drive(index, &sound(state, index, body, t1)?);
            }
        } else if body.velocity.length_squared() > FELT_SPEED * FELT_SPEED {
            body.blow(Winds { winds: &[], air: world.air }, t0, t1);
            self.world.drive(index, &sound(state, index, body, t1)?);
        }
        Ok(())
    }

    /// Moves all bodies that are awake and takes over where they are. Returns one whose motion could not be solved.
    fn move_together(&mut self, bodies: &mut Bodies, t0: f64, t1: f64) -> Option<usize> {
        let tracks = &mut self.tracks;
        let mut lost = None;
        let (mut fastest, mut strays) = (0.0_f64, Vec::new());
        self.world.step(t1 - t0, |moved, position, rotation, velocity, spin| {
            let (index, track) = (moved.index, &mut tracks[moved.index]);
            if ![position, velocity, spin].iter().all(|v| v.is_finite()) {
                lost = lost.or(Some(index));
            }
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
            if position.distance(self.origin) > REACH {
                strays.push(index);
            }
            bodies.set(index, &body);
        });
        self.fastest = fastest;
        for index in strays {
            self.world.leave(index);
            self.tracks[index].far = true;
        }
        lost
    }

    /// Notes what a step has made of a body.
    fn account(&self, state: &mut State, index: usize, t1: f64) {
        let (phase, life) = (state.phases[index], &state.lives[index]);
        if matches!(phase, Phase::Anchored | Phase::Held) {
            return;
        }
        if life.launched && (self.tracks[index].asleep || life.away) {
            return;
        }
        let body = state.bodies.get(index);
        if !life.away && life.place.is_left(&body) {
            state.phases[index] = Phase::Free;
            state.part(index, t1);
        }
        state.world.launch(&body, &mut state.phases[index], &mut state.lives[index], t1);
    }
}

/// The state of a body as it is given to the contact world, which works in single precision.
fn sound(state: &State, index: usize, body: RigidBody, now: f64) -> Result<RigidBody> {
    let finite = |v: DVec3| v.as_vec3().is_finite();
    if finite(body.position) && finite(body.velocity) && finite(body.angular_velocity()) {
        Ok(body)
    } else {
        Err(state.overflow(index, "its motion", now))
    }
}

/// A step of a body that does not move by itself. Returns whether it is free now.
fn stir(state: &mut State, index: usize, t0: f64, t1: f64) -> bool {
    let mut body = state.bodies.get(index);
    let (carry, life) = (state.support.carry(index), &mut state.lives[index]);
    state.world.step(&mut body, &mut state.phases[index], life, carry, t0, t1);
    state.bodies.set(index, &body);
    life.change.is_some()
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
