//! Into how many steps a frame is divided: fine ones while loads act, coarse ones once they are over.

use super::targets::Target;
use crate::dynamics::Until;
use crate::scene::Scene;

/// Steps the loading of a body is resolved with when the step is left to the engine.
const STEPS_A_LOAD: f64 = 8.0;
/// Longest step the engine chooses while loads act [s].
const LONGEST_STEP: f64 = 2e-3;
/// Shortest step the engine chooses [s].
const SHORTEST_STEP: f64 = 1e-5;
/// Longest step of bodies that fly freely once all loads are over [s].
const CALM_STEP: f64 = 5e-3;

/// The steps of a scene.
#[derive(Debug, Clone, Copy)]
pub(super) struct Steps {
    /// Steps a frame while loads act.
    pub loaded: usize,
    /// When the last load is over and the last piece of a pane free, and steps may be longer [s]; infinite where the
    /// user sets the step, or where fronts come later.
    calm: f64,
}

impl Steps {
    /// As many steps a frame as the user asks for, or as resolve the shortest loading of a body.
    ///
    /// Panel loads are integrated exactly over any step; what the step has to resolve is the wind on a moving body.
    pub fn of(scene: &Scene, targets: &[Target]) -> Self {
        let interval = 1.0 / scene.time.frame_rate;
        let step = scene.time.step.unwrap_or_else(|| {
            let shortest = targets.iter().map(|t| t.queue.shortest()).fold(f64::INFINITY, f64::min);
            (shortest / STEPS_A_LOAD).clamp(SHORTEST_STEP, LONGEST_STEP)
        });
        Self { loaded: steps_of(interval, step), calm: calm(scene, targets) }
    }

    /// Steps of bodies that fly freely from `t0` to `t1` [s], one frame after the other.
    pub fn between(&self, t0: f64, t1: f64) -> usize {
        if t0 < self.calm { self.loaded } else { steps_of(t1 - t0, CALM_STEP).min(self.loaded) }
    }
}

/// The fewest even steps of an interval that are no longer than `longest` [s].
pub(super) fn steps_of(interval: f64, longest: f64) -> usize {
    (libm::ceil(interval / longest - 1e-9) as usize).max(1)
}

fn calm(scene: &Scene, targets: &[Target]) -> f64 {
    if scene.time.step.is_some() || scene.charges.len() > 1 {
        return f64::INFINITY;
    }
    // A piece that waits for the front is free before its loads are over.
    let known = |until| if let Until::Time(time) = until { Some(time) } else { None };
    let holds = scene.bodies.iter().filter_map(|body| known(body.hold.as_ref()?.until));
    let loads = targets.iter().map(|target| target.queue.end);
    loads.chain(holds).fold(0.0, f64::max)
}
