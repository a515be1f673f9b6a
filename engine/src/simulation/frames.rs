//! Frames, the glass that stays in them, and when what comes free meets either.
//!
//! Glass lies in the rebate, inside the frame's own shape, and what breaks out lies against what stays. If the two met
//! at once they would be driven apart. So what overlaps passes until it is clear, by bounds: a piece that comes free
//! passes frames and splinters, and whatever overlaps a splinter at the moment when that settles passes splinters.

use glam::{DQuat, DVec3};

use super::life::Phase;
use super::state::State;
use super::targets::Target;
use crate::dynamics::RigidBody;
use crate::dynamics::contact::{ContactBody, ContactWorld, Passes};
use crate::geometry::bounds;
use crate::scene::Scene;

/// Corner with the lowest and with the highest coordinates [m].
type Bounds = (DVec3, DVec3);

/// What glass sits in, the glass that stays there, and who is in their way.
pub(super) struct Frames {
    frames: Vec<Solid>,
    splinters: Vec<Solid>,
    /// Pieces of panes that stay but have not settled yet, with their bounds in principal axes.
    settling: Vec<(usize, Bounds)>,
    leaving: Vec<Leaving>,
}

/// A body that does not move.
struct Solid {
    place: DVec3,
    principal_from_world: DQuat,
    /// Bounds in its principal axes about its centre of mass, and in the world.
    own: Bounds,
    world: Bounds,
}

/// A free body that is not clear of what it passes.
struct Leaving {
    index: usize,
    /// [`Passes::Frames`] or [`Passes::Splinters`].
    passes: Passes,
    /// Number of a solid that it was found in last: as long as it is there, the others need no look.
    last: usize,
}

impl Frames {
    /// `bodies` are what the contact world knows of those of the scene.
    pub fn new(scene: &Scene, targets: &[Target], bodies: &[ContactBody]) -> Self {
        let all = || bodies.iter().zip(targets);
        let holds_glass = |(body, _): &(&ContactBody, &Target)| body.passes == Passes::Glass;
        let stays = |&index: &usize| {
            let hold = scene.bodies[index].hold.as_ref();
            hold.is_some_and(|hold| hold.until.time(targets[index].facts.arrival_time).is_infinite())
        };
        Self {
            frames: all()
                .filter(holds_glass)
                .map(|(body, target)| Solid::new(&target.body, body.shape.bounds(), target.bounds))
                .collect(),
            splinters: Vec::new(),
            settling: (0..bodies.len())
                .filter(stays)
                .map(|index| (index, bodies[index].shape.bounds()))
                .collect(),
            leaving: Vec::new(),
        }
    }

    /// A piece of a pane has come free and joined.
    pub fn release(&mut self, index: usize) {
        self.leaving.push(Leaving { index, passes: Passes::Frames, last: 0 });
    }

    /// Makes obstacles of the pieces that stay and have come to their last place by `now` [s].
    pub fn settle(&mut self, state: &State, world: &mut ContactWorld, now: f64) {
        let before = self.splinters.len();
        let splinters = &mut self.splinters;
        self.settling.retain(|&(index, own)| {
            let life = &state.lives[index];
            let settled = life.is_settled(now);
            if settled {
                let body = state.bodies.get(index);
                if world.anchor(index, &body) {
                    splinters.push(Solid::new(&body, own, world_bounds(&body, &life.corners)));
                }
            }
            !settled
        });
        if splinters.len() == before {
            return;
        }
        for index in 0..state.len() {
            if matches!(state.phases[index], Phase::Anchored | Phase::Held) {
                continue;
            }
            let body = state.bodies.get(index);
            let corners = &state.lives[index].corners;
            let overlaps = |solid: &Solid| solid.is_reached(&body, corners);
            let Some(last) = self.splinters[before..].iter().position(overlaps) else { continue };
            if self.leaving.iter().all(|leaving| leaving.index != index) {
                world.pass(index, Passes::Splinters);
                self.leaving.push(Leaving { index, passes: Passes::Splinters, last: before + last });
            }
        }
    }

    /// Lets bodies meet what they passed as soon as they are clear of it.
    pub fn clear(&mut self, state: &State, world: &mut ContactWorld) {
        let (frames, splinters) = (&self.frames, &self.splinters);
        self.leaving.retain_mut(|leaving| {
            let index = leaving.index;
            let (body, corners) = (state.bodies.get(index), &state.lives[index].corners);
            if leaving.passes == Passes::Frames {
                if leaving.is_in(frames, &body, corners) {
                    return true;
                }
                leaving.passes = Passes::Splinters;
                world.pass(index, Passes::Splinters);
            }
            let is_in = leaving.is_in(splinters, &body, corners);
            if !is_in {
                world.pass(index, Passes::Nothing);
            }
            is_in
        });
    }
}

impl Leaving {
    fn is_in(&mut self, solids: &[Solid], body: &RigidBody, corners: &[DVec3]) -> bool {
        let reached = |solid: &Solid| solid.is_reached(body, corners);
        if solids.get(self.last).is_some_and(reached) {
            return true;
        }
        let found = solids.iter().position(reached);
        self.last = found.unwrap_or(0);
        found.is_some()
    }
}

impl Solid {
    fn new(body: &RigidBody, own: Bounds, world: Bounds) -> Self {
        Self { place: body.position, principal_from_world: body.world_from_principal.conjugate(), own, world }
    }

    /// Whether the bounds of a body with these corners in its principal axes [m] overlap its own: those along the axes of
    /// the world as well as those along the solid's.
    fn is_reached(&self, body: &RigidBody, corners: &[DVec3]) -> bool {
        let nearest = body.position.clamp(self.world.0, self.world.1);
        if body.position.distance_squared(nearest) > body.reach * body.reach {
            return false;
        }
        let place = self.principal_from_world * (body.position - self.place);
        let turn = self.principal_from_world * body.world_from_principal;
        overlap(world_bounds(body, corners), self.world)
            && overlap(bounds(corners.iter().map(|&corner| place + turn * corner)), self.own)
    }
}

fn world_bounds(body: &RigidBody, corners: &[DVec3]) -> Bounds {
    bounds(corners.iter().map(|&corner| body.position + body.world_from_principal * corner))
}

fn overlap(one: Bounds, other: Bounds) -> bool {
    one.0.cmplt(other.1).all() && one.1.cmpgt(other.0).all()
}
