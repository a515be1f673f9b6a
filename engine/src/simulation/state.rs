//! All bodies of a run and what they share, in whichever way they move.

use fearless_simd::Level;
use glam::{DQuat, DVec3};

use super::later::Later;
use super::life::{Life, Phase};
use super::shelter::Shelters;
use super::targets::Target;
use super::world::World;
use crate::blast::BlastField;
use crate::dynamics::ground::joint_friction;
use crate::dynamics::{Air, Bodies, Footing, RigidBody, Support};
use crate::error::{Error, Result};
use crate::recording::BodyFacts;
use crate::scene::Scene;

/// All bodies of a run.
pub(super) struct State {
    pub bodies: Bodies,
    pub phases: Vec<Phase>,
    pub lives: Vec<Life>,
    pub support: Support,
    /// Fronts that come after bodies have left their places.
    pub later: Option<Later>,
    pub world: World,
    /// Of each pane, the number of its first piece; bodies before that are no pieces of panes.
    panes: Vec<usize>,
}

impl State {
    /// The bodies of a scene as they stand before the blast.
    ///
    /// `panes` are the numbers of the first pieces of panes.
    pub fn new(
        scene: &Scene,
        fields: Vec<BlastField>,
        shelters: Shelters,
        targets: Vec<Target>,
        panes: Vec<usize>,
    ) -> Self {
        let footings: Vec<Footing> = targets
            .iter()
            .zip(&scene.bodies)
            .map(|(target, body)| Footing {
                low: target.bounds.0,
                high: target.bounds.1,
                centre: target.body.position,
                mass: body.mass,
                anchored: body.anchored,
                held: body.hold.is_some(),
            })
            .collect();
        let support = Support::new(&footings, scene.ground.map(|ground| ground.height));
        let bodies: Vec<RigidBody> = targets.iter().map(|target| target.body).collect();
        let phases = footings
            .iter()
            .map(|f| match (f.anchored, f.held) {
                (true, _) => Phase::Anchored,
                (false, true) => Phase::Held,
                (false, false) => Phase::Standing,
            })
            .collect();
        let lives = targets
            .into_iter()
            .zip(&scene.bodies)
            .enumerate()
            .map(|(index, (target, body))| {
                let on_ground = joint_friction(body.friction, scene.ground.map_or(0.0, |g| g.friction));
                let in_place = friction_in_place(scene, &support, index, on_ground);
                Life::new(target, body.hold.clone(), in_place, on_ground)
            })
            .collect();
        Self {
            bodies: Bodies::new(&bodies),
            phases,
            lives,
            support,
            later: Later::new(scene, fields, shelters),
            world: World {
                ground: scene.ground,
                rotation: scene.dynamics.rotation_factor,
                air: Air { density: scene.air.density(), damping: scene.dynamics.damping_factor },
                level: Level::new(),
            },
            panes,
        }
    }

    /// How many bodies there are.
    pub fn len(&self) -> usize {
        self.lives.len()
    }

    /// Of each body, where its centre of mass is [m] and the rotation from its own frame into the world.
    pub fn poses(&self) -> impl Iterator<Item = (DVec3, DQuat)> {
        self.lives.iter().enumerate().map(|(index, life)| {
            let body = self.bodies.get(index);
            let rotation = body.world_from_principal * life.object_from_principal.conjugate();
            (body.position, rotation.normalize())
        })
    }

    /// What has become of each body by `now` [s], the end of the run.
    ///
    /// # Errors
    /// [`Error::Overflow`].
    pub fn facts(&mut self, now: f64) -> Result<Vec<BodyFacts>> {
        for (index, life) in self.lives.iter_mut().enumerate() {
            life.finish(&self.bodies.get(index));
            if !life.facts.is_finite() {
                return Err(self.overflow(index, "its load", now));
            }
        }
        Ok(self.lives.iter().map(|life| life.facts).collect())
    }

    /// What is wrong with a body of which something is not a finite number any more at a time [s].
    pub fn overflow(&self, index: usize, what: &'static str, time: f64) -> Error {
        let whose = match self.panes.partition_point(|&first| first <= index) {
            0 => format!("body {index}"),
            after => format!("a piece of window {}", after - 1),
        };
        Error::Overflow { whose, what, time }
    }

    /// How many bodies stand on nothing.
    pub fn hanging(&self) -> usize {
        let stands = |&index: &usize| self.phases[index] == Phase::Standing;
        (0..self.len()).filter(stands).filter(|&index| self.support.hangs(index)).count()
    }

    /// Aims the charges whose fronts come by `t1` at the bodies that have left their places.
    pub fn meet_fronts(&mut self, t1: f64) {
        let Some(later) = &mut self.later else { return };
        for (index, charge, shot) in later.reached(t1, |index| self.bodies.get(index)) {
            self.lives[index].strike(charge, shot);
            if self.phases[index] == Phase::Flying {
                self.phases[index] = Phase::Free;
            }
        }
    }

    /// A body has left its place: it waits for the fronts that have yet to come to it.
    pub fn part(&mut self, index: usize, now: f64) {
        let life = &mut self.lives[index];
        if let Some(later) = self.later.as_mut().filter(|_| !life.away) {
            later.put_off(index, &self.bodies.get(index), &mut life.queue, now);
        }
        life.away = true;
    }

    /// Whether any load acts between two times, or a piece of a pane moves or comes free.
    pub fn is_stirred(&self, t0: f64, t1: f64) -> bool {
        self.lives.iter().any(|life| life.is_stirred(t0, t1))
            || self.later.as_ref().is_some_and(|later| later.comes(t1, |i| self.bodies.get(i)))
    }

    /// Whether all loads are over at `now` [s], no piece of a pane has yet to come free, and every other body that
    /// could move is `still`.
    pub fn rests(&self, now: f64, still: impl Fn(usize) -> bool) -> bool {
        let rests = |index: usize| {
            let fixed = matches!(self.phases[index], Phase::Anchored | Phase::Held);
            self.lives[index].is_over(now) && (fixed || still(index))
        };
        !self.later.as_ref().is_some_and(Later::awaited) && (0..self.len()).all(rests)
    }
}

/// The friction of a body where it stands at the start; `on_ground` is that against the ground.
fn friction_in_place(scene: &Scene, support: &Support, index: usize, on_ground: f64) -> f64 {
    let own = scene.bodies[index].friction;
    if support.is_grounded(index) {
        on_ground
    } else if support.hangs(index) {
        own
    } else {
        let on =
            |&(carrier, share): &(usize, f64)| share * joint_friction(own, scene.bodies[carrier].friction);
        support.carriers(index).iter().map(on).sum()
    }
}
