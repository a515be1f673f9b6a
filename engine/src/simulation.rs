//! The run: bodies wait for the front, are loaded, leave their places, fly and land.

mod contacts;
mod later;
mod life;
mod queue;
mod shelter;
mod steps;
mod targets;
mod window;
mod world;

use std::ops::ControlFlow;

use fearless_simd::Level;
use glam::DVec3;
use rayon::prelude::*;

use crate::blast::{BlastField, Extension};
use crate::dynamics::ground::{CALM_TIME, joint_friction};
use crate::dynamics::standing::Place;
use crate::dynamics::{Air, Bodies, Footing, LANES, RigidBody, Support};
use crate::error::{Error, Result};
use crate::recording::Recording;
use crate::scene::Scene;
use contacts::Contacts;
use later::Later;
use life::{Concern, Life, Phase};
pub use shelter::{Shelters, seen_from};
use steps::steps_per_frame;
use targets::Target;
pub use window::{Fate, Pane, Panes, standing};
use world::World;

/// Below this many bodies a step is not worth sharing among threads.
const WORTH_SHARING: usize = 2048;
/// Blocks of bodies a thread takes at once.
const CHUNK: usize = 32;

/// A scene made ready to run.
pub struct Simulation {
    bodies: Bodies,
    phases: Vec<Phase>,
    lives: Vec<Life>,
    support: Support,
    /// Fronts that come after bodies have left their places.
    later: Option<Later>,
    /// Bodies that touch; `None` where each moves for itself and meets the ground alone.
    contacts: Option<Contacts>,
    world: World,
    until_rest: bool,
    frames: usize,
    frame_rate: f64,
    steps_per_frame: usize,
    /// When the last load is over and the last piece of a pane free, and steps may be longer [s]; infinite where the
    /// user sets the step, or where fronts come later.
    calm: f64,
    /// Whether any body slid in the step before.
    slid: bool,
    warnings: Vec<String>,
}

impl Simulation {
    /// Checks a scene, finds what shelters behind what and works out all loads.
    ///
    /// # Errors
    /// What [`Scene::validate`] refuses, curves that cannot be used, and meshes without volume.
    pub fn prepare(scene: &Scene) -> Result<Self> {
        let go_on = &mut || ControlFlow::Continue(());
        let mut shelters = Shelters::find(scene)?;
        let panes = Panes::find(scene, &mut shelters, usize::MAX, go_on)?;
        Self::prepare_broken(scene, shelters, &panes, go_on)
    }

    /// Works out all loads of a scene whose shelters are already found and whose panes are broken; `observer` is asked
    /// now and then and may stop the work.
    ///
    /// # Errors
    /// As [`prepare`](Self::prepare), and [`Error::Cancelled`] when the observer breaks off.
    pub fn prepare_broken(
        scene: &Scene,
        shelters: Shelters,
        panes: &Panes,
        observer: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<Self> {
        scene.validate()?;
        let (scene, shelters) = &panes.in_pieces(scene, shelters);
        let fields: Vec<BlastField> =
            scene.charges.iter().map(|charge| BlastField::new(charge, &scene.air)).collect::<Result<_>>()?;
        let targets = targets::aim(scene, &fields, shelters, panes.outlines(), observer)?;
        let steps_per_frame = steps_per_frame(scene, &targets);
        let calm = if scene.time.step.is_some() || scene.charges.len() > 1 {
            f64::INFINITY
        } else {
            let holds = scene.bodies.iter().filter_map(|body| body.hold.as_ref()).map(|hold| hold.until);
            let loads = targets.iter().map(|target| target.queue.end);
            loads.chain(holds.filter(|until| until.is_finite())).fold(0.0, f64::max)
        };
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
        let height = scene.ground.map(|g| g.height);
        let support = Support::new(&footings, height);
        let mut warnings = reach_warnings(&targets, fields.len());
        warnings.extend_from_slice(&shelters.warnings);
        if scene.ground.is_some() {
            let anchored = |index: &usize| scene.bodies[*index].anchored;
            warnings.extend(hanging_warning(
                (0..footings.len())
                    .filter(|&i| !anchored(&i) && !footings[i].held && support.hangs(i))
                    .count(),
            ));
        }
        let bodies: Vec<RigidBody> = targets.iter().map(|target| target.body).collect();
        let phases = footings
            .iter()
            .map(|f| match (f.anchored, f.held) {
                (true, _) => Phase::Anchored,
                (false, true) => Phase::Held,
                (false, false) => Phase::Standing,
            })
            .collect();
        let contacts = scene.dynamics.contacts.then(|| Contacts::new(scene, &targets));
        let lives = targets
            .into_iter()
            .zip(&scene.bodies)
            .enumerate()
            .map(|(index, (target, body))| {
                let on_ground = joint_friction(body.friction, scene.ground.map_or(0.0, |g| g.friction));
                let on_carriers = support.carriers(index).iter().map(|&(carrier, share)| {
                    share * joint_friction(body.friction, scene.bodies[carrier].friction)
                });
                let in_place = if support.is_grounded(index) {
                    on_ground
                } else if support.hangs(index) {
                    body.friction
                } else {
                    on_carriers.sum()
                };
                Life::new(target, body.hold.clone(), in_place, on_ground)
            })
            .collect();
        Ok(Self {
            bodies: Bodies::new(&bodies),
            phases,
            lives,
            support,
            later: Later::new(scene, fields, shelters.clone()),
            world: World {
                ground: scene.ground,
                rotation: scene.dynamics.rotation_factor,
                air: Air { density: scene.air.density(), damping: scene.dynamics.damping_factor },
                level: Level::new(),
            },
            contacts,
            until_rest: scene.time.until_rest,
            frames: scene.time.frames(),
            frame_rate: scene.time.frame_rate,
            steps_per_frame,
            calm,
            slid: false,
            warnings,
        })
    }

    /// The simulation step [s]: a whole number of them makes a frame.
    pub fn step(&self) -> f64 {
        1.0 / (self.frame_rate * self.steps_per_frame as f64)
    }

    /// Runs to the end. `observer` hears after each step how many frames are done, and of how many, and may stop
    /// the run.
    ///
    /// # Errors
    /// [`Error::Cancelled`] when the observer breaks off.
    pub fn run(mut self, observer: &mut dyn FnMut(usize, usize) -> ControlFlow<()>) -> Result<Recording> {
        let mut recording = Recording { step: self.step(), ..Recording::default() };
        if !self.until_rest {
            recording.positions.reserve_exact(self.frames * self.bodies.len());
            recording.orientations.reserve_exact(self.frames * self.bodies.len());
        }
        let mut left = Vec::new();
        for frame in 0..self.frames {
            if frame > 0 {
                let steps = self.steps_to(frame);
                let dt = 1.0 / (self.frame_rate * steps as f64);
                for step in (frame - 1) * steps..frame * steps {
                    self.advance(step as f64 * dt, (step + 1) as f64 * dt, &mut left);
                    if observer(frame, self.frames).is_break() {
                        return Err(Error::Cancelled);
                    }
                }
            }
            self.record(frame, &mut recording);
            if self.until_rest && self.rests(frame as f64 / self.frame_rate) {
                break;
            }
        }
        self.conclude(recording.times.last().copied().unwrap_or(0.0));
        let bodies = (0..self.bodies.len()).map(|index| self.bodies.get(index));
        recording.facts = bodies.zip(self.lives).map(|(body, life)| life.finish(&body)).collect();
        recording.warnings = self.warnings;
        Ok(recording)
    }

    /// One step of every body, then what they change for each other.
    fn advance(&mut self, t0: f64, t1: f64, left: &mut Vec<usize>) {
        self.meet_fronts(t1);
        if self.contacts.is_some() {
            return self.touch(t0, t1);
        }
        let (world, support) = (&self.world, &self.support);
        let (blocks, shared) = (self.bodies.blocks_mut(), self.phases.len() >= WORTH_SHARING);
        let one = |(index, ((block, phases), lives))| {
            world.step_block(block, phases, lives, |lane| support.carry(index * LANES + lane), t0, t1)
        };
        let concern = if shared {
            blocks
                .par_iter_mut()
                .zip(self.phases.par_chunks_mut(LANES))
                .zip(self.lives.par_chunks_mut(LANES))
                .enumerate()
                .with_min_len(CHUNK)
                .map(one)
                .reduce(|| Concern::Nothing, Concern::max)
        } else {
            blocks
                .iter_mut()
                .zip(self.phases.chunks_mut(LANES))
                .zip(self.lives.chunks_mut(LANES))
                .enumerate()
                .map(one)
                .fold(Concern::Nothing, Concern::max)
        };
        if concern == Concern::Settles {
            self.settle(t1, left);
        }
        let slides = concern >= Concern::Slides;
        if slides || self.slid {
            let (bodies, lives) = (&self.bodies, &self.lives);
            self.support.pass_on(|i| bodies.get(i).velocity, |i| lives[i].rubbed);
        }
        self.slid = slides;
    }

    /// Aims the charges whose fronts come by `t1` at the bodies that have left their places.
    fn meet_fronts(&mut self, t1: f64) {
        let Some(later) = &mut self.later else { return };
        for (index, charge, shot) in later.reached(t1, |index| self.bodies.get(index)) {
            self.lives[index].strike(charge, shot);
            if self.phases[index] == Phase::Flying {
                self.phases[index] = Phase::Free;
            }
        }
    }

    /// Bodies that left let down what they carried; bodies that came to rest carry themselves again.
    fn settle(&mut self, now: f64, left: &mut Vec<usize>) {
        left.clear();
        for (index, life) in self.lives.iter_mut().enumerate() {
            match life.change.take() {
                Some(Phase::Free) => left.push(index),
                Some(Phase::Standing) => {
                    let mut body = self.bodies.get(index);
                    body.velocity = DVec3::ZERO;
                    body.angular_momentum = DVec3::ZERO;
                    self.bodies.set(index, &body);
                    life.place = Place::new(&body, life.extent, life.ground_friction);
                    life.facts.rest_time = now - CALM_TIME;
                    self.support.stand_up(index);
                    self.phases[index] = Phase::Standing;
                }
                _ => {}
            }
        }
        if left.is_empty() {
            return;
        }
        self.support.leave(left);
        for &index in left.iter() {
            self.phases[index] = Phase::Free;
            let life = &mut self.lives[index];
            life.facts.rest_time = f64::NAN;
            life.calm = 0.0;
            if let Some(later) = self.later.as_mut().filter(|_| !life.away) {
                later.put_off(index, &self.bodies.get(index), &mut life.queue, now);
            }
            life.away = true;
        }
    }

    fn record(&self, frame: usize, recording: &mut Recording) {
        recording.times.push(frame as f64 / self.frame_rate);
        let count = self.bodies.len();
        for (index, life) in self.lives.iter().enumerate() {
            let body = self.bodies.get(index);
            recording.positions.push(body.position.as_vec3());
            let rotation =
                (body.world_from_principal * life.object_from_principal.conjugate()).normalize().as_quat();
            let before = (frame > 0).then(|| recording.orientations[(frame - 1) * count + index]);
            let flips = before.map_or(rotation.w < 0.0, |b| b.dot(rotation) < 0.0);
            recording.orientations.push(if flips { -rotation } else { rotation });
        }
    }
}

/// One sentence a charge about bodies outside the range of its curves.
fn reach_warnings(targets: &[Target], charges: usize) -> Vec<String> {
    let mut warnings = Vec::new();
    for charge in 0..charges {
        let count = |extension| targets.iter().filter(|t| t.reach[charge] == extension).count();
        let near = count(Extension::Near);
        if near > 0 {
            warnings.push(format!(
                "{near} of {} bodies are nearer to charge {charge} than its curves reach: the curves' innermost \
                 values are held",
                targets.len()
            ));
        }
        let far = count(Extension::Far);
        if far > 0 {
            warnings.push(format!(
                "{far} of {} bodies are farther from charge {charge} than its curves reach: the decay of a weak \
                 shock continues them",
                targets.len()
            ));
        }
    }
    warnings
}

fn hanging_warning(hanging: usize) -> Option<String> {
    (hanging > 0).then(|| {
        format!("{hanging} bodies stand on nothing: they are held in place until a blast moves them")
    })
}
