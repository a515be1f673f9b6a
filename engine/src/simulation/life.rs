//! What is known of a body beside its state: what it is doing, what comes to it, what has become of it.

use glam::{DQuat, DVec3};

use super::queue::LoadQueue;
use super::targets::{Peaks, Shot, Target};
use super::window::Sheet;
use crate::dynamics::standing::Place;
use crate::dynamics::{Hold, RigidBody};
use crate::recording::BodyFacts;

/// What is needed of a body beside its state, and less often.
pub(super) struct Life {
    pub queue: LoadQueue,
    pub place: Place,
    pub corners: Box<[DVec3]>,
    pub object_from_principal: DQuat,
    /// Smaller extent seen from above at the start [m].
    pub extent: f64,
    /// Friction against the ground.
    pub ground_friction: f64,
    /// What holds it until it may move.
    pub held: Option<Box<Held>>,
    /// Of a piece of a pane, how its load follows it.
    pub sheet: Option<Sheet>,
    /// For how long it has been lying calmly [s].
    pub calm: f64,
    /// Impulse of friction in the last step [N s].
    pub rubbed: DVec3,
    pub launched: bool,
    /// Whether it has ever left its place.
    pub away: bool,
    /// Per charge, what it alone does at most.
    pub peaks: Vec<Peaks>,
    /// What the last step asks to be settled between the bodies.
    pub change: Option<Phase>,
    pub facts: BodyFacts,
}

/// What holds a piece of a pane.
pub(super) struct Held {
    pub hold: Hold,
    /// Place and rotation of the piece in the unbent pane.
    pub rest: (DVec3, DQuat),
    /// When it is free [s]; infinite for one that stays.
    pub until: f64,
}

/// What a body is doing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Phase {
    /// It never moves.
    Anchored,
    /// In its place, still.
    Standing,
    /// In its place, pushed over its support.
    Sliding,
    /// Part of a pane, or in its frame.
    Held,
    /// On its own, with loads still to come.
    Free,
    /// On its own, all loads over.
    Flying,
}

/// What of a step concerns other bodies; the gravest counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Concern {
    /// Nothing.
    Nothing,
    /// A body slides on another, or stopped to.
    Slides,
    /// A body left its place or came to rest.
    Settles,
}

impl Life {
    /// `in_place` is the friction where the body stands at the start, `on_ground` against the ground.
    pub fn new(target: Target, hold: Option<Hold>, in_place: f64, on_ground: f64) -> Self {
        let (low, high) = target.bounds;
        let extent = (high.x - low.x).min(high.z - low.z);
        let sheet = hold.is_some().then(|| Sheet::new(&target));
        Self {
            place: Place::new(&target.body, extent, in_place),
            launched: target.queue.end <= 0.0,
            away: false,
            peaks: target.peaks,
            queue: target.queue,
            corners: target.corners,
            object_from_principal: target.object_from_principal,
            extent,
            ground_friction: on_ground,
            sheet,
            held: hold.map(|hold| {
                let rest = (target.body.position, target.body.world_from_principal);
                let until = hold.until.time(target.facts.arrival_time);
                Box::new(Held { hold, rest, until })
            }),
            calm: 0.0,
            rubbed: DVec3::ZERO,
            change: None,
            facts: target.facts,
        }
    }

    /// Whether anything happens to a held piece between two times.
    pub fn is_stirred(&self, t0: f64, t1: f64) -> bool {
        let moves = |held: &Held| held.hold.moves(t0, t1) || held.until <= t1;
        self.queue.acts(t0, t1) || self.held.as_deref().is_some_and(moves)
    }

    /// Whether it is held for good and has come to its last place at a time [s].
    pub fn is_settled(&self, now: f64) -> bool {
        let settled = |held: &Held| held.until.is_infinite() && !held.hold.moves(now, f64::INFINITY);
        self.held.as_deref().is_some_and(settled)
    }

    /// Whether its loads are over at a time [s] and nothing holds it that is yet to let go.
    pub fn is_over(&self, now: f64) -> bool {
        let awaits = self.held.as_ref().is_some_and(|held| held.until.is_finite());
        self.queue.end <= now && !awaits
    }

    /// Takes a charge's loads anew.
    pub fn strike(&mut self, charge: usize, shot: Shot) {
        self.peaks[charge] = shot.peaks;
        self.facts.peak_overpressure = self.peaks.iter().map(|p| p.overpressure).fold(0.0, f64::max);
        self.facts.peak_load = self.peaks.iter().map(|p| p.load).fold(0.0, f64::max);
        self.queue.replace(shot);
        // It was aimed at the body as it lies now, not as it lay in its pane.
        self.sheet = None;
        self.launched = false;
    }

    /// Notes what is only known at the end of a run.
    pub fn finish(&mut self, body: &RigidBody) {
        if !self.launched {
            self.facts.launch_speed = self.facts.launch_speed.max(body.velocity.length());
        }
        self.facts.final_velocity = body.velocity;
    }
}
