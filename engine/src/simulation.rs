//! The run: bodies wait for the front, are loaded, leave their places, fly and land.

mod contacts;
mod frames;
mod free_flight;
mod later;
mod life;
mod motion;
mod queue;
mod range;
mod shelter;
mod state;
mod steps;
mod targets;
mod warnings;
mod window;
mod world;

use std::ops::ControlFlow;

use crate::blast::BlastField;
use crate::error::{Error, Result};
use crate::recording::Recording;
use crate::scene::{Scene, Time};
use motion::Motion;
pub use shelter::{Shelters, seen_from};
use state::State;
use steps::Steps;
pub use window::{Fate, Pane, Panes, standing};

/// A scene made ready to run.
pub struct Simulation {
    state: State,
    /// How the bodies move.
    motion: Box<dyn Motion>,
    time: Time,
    step: f64,
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
        motion::check(scene)?;
        let first_pieces = panes.first_pieces(scene.bodies.len());
        let (scene, shelters) = panes.in_pieces(scene, shelters);
        let fields: Vec<BlastField> =
            scene.charges.iter().map(|charge| BlastField::new(charge, &scene.air)).collect::<Result<_>>()?;
        let targets = targets::aim(&scene, &fields, &shelters, panes.outlines(), observer)?;
        let mut warnings = warnings::reach(&targets, fields.len());
        warnings.extend_from_slice(&shelters.warnings);
        let steps = Steps::of(&scene, &targets);
        let motion = motion::motion(&scene, &targets, steps);
        let state = State::new(&scene, fields, shelters, targets, first_pieces);
        if scene.ground.is_some() {
            warnings.extend(warnings::hanging(state.hanging()));
        }
        let step = 1.0 / (scene.time.frame_rate * steps.loaded as f64);
        Ok(Self { state, motion, time: scene.time, step, warnings })
    }

    /// The simulation step while loads act [s]: a whole number of them makes a frame.
    pub fn step(&self) -> f64 {
        self.step
    }

    /// Runs to the end. `observer` hears after each step how many frames are done, and of how many, and may stop
    /// the run.
    ///
    /// # Errors
    /// [`Error::Cancelled`] when the observer breaks off; [`Error::Overflow`] where numbers that are each possible lead
    /// to a body at no finite place.
    pub fn run(mut self, observer: &mut dyn FnMut(usize, usize) -> ControlFlow<()>) -> Result<Recording> {
        let frames = self.time.frames();
        let mut recording = Recording { step: self.step, ..Recording::default() };
        if !self.time.until_rest {
            recording.positions.reserve_exact(frames * self.state.len());
            recording.orientations.reserve_exact(frames * self.state.len());
        }
        let mut now = 0.0;
        for frame in 0..frames {
            if frame > 0 {
                let next = frame as f64 / self.time.frame_rate;
                let steps = self.motion.steps(&self.state, now, next);
                let dt = 1.0 / (self.time.frame_rate * steps as f64);
                for step in (frame - 1) * steps..frame * steps {
                    self.advance(step as f64 * dt, (step + 1) as f64 * dt)?;
                    if observer(frame, frames).is_break() {
                        return Err(Error::Cancelled);
                    }
                }
                now = next;
            }
            self.record(now, &mut recording)?;
            if self.time.until_rest && self.motion.rests(&self.state, now) {
                break;
            }
        }
        self.warnings.extend(self.motion.conclude(&mut self.state, now));
        if self.time.until_rest {
            self.warnings.extend(warnings::moving(&self.state, now));
        }
        recording.facts = self.state.facts(now)?;
        recording.warnings = self.warnings;
        Ok(recording)
    }

    /// One step: fronts that come in it, then all bodies.
    fn advance(&mut self, t0: f64, t1: f64) -> Result<()> {
        self.state.meet_fronts(t1);
        self.motion.advance(&mut self.state, t0, t1)
    }

    /// Writes down where all bodies are.
    fn record(&self, now: f64, recording: &mut Recording) -> Result<()> {
        let before = recording.orientations.len().checked_sub(self.state.len());
        recording.times.push(now);
        for (index, (position, rotation)) in self.state.poses().enumerate() {
            let (position, rotation) = (position.as_vec3(), rotation.as_quat());
            if !(position.is_finite() && rotation.is_finite()) {
                return Err(self.state.overflow(index, "its pose", now));
            }
            recording.positions.push(position);
            let flips = match before {
                Some(first) => recording.orientations[first + index].dot(rotation) < 0.0,
                None => rotation.w < 0.0,
            };
            recording.orientations.push(if flips { -rotation } else { rotation });
        }
        Ok(())
    }
}
