//! How many steps a frame is divided into where bodies do not touch.

use super::targets::Target;
use crate::scene::Scene;

/// Steps the loading of a body is resolved with when the step is left to the engine.
const STEPS_A_LOAD: f64 = 8.0;
/// Longest step the engine chooses [s].
const LONGEST_STEP: f64 = 2e-3;
/// Shortest step the engine chooses [s].
const SHORTEST_STEP: f64 = 1e-5;

/// Steps a frame: as many as the user asks for, or as resolve the shortest loading of a body.
///
/// Panel loads are integrated exactly over any step; what the step has to resolve is the wind on a moving body.
pub(super) fn steps_per_frame(scene: &Scene, targets: &[Target]) -> usize {
    let interval = 1.0 / scene.time.frame_rate;
    let step = scene.time.step.unwrap_or_else(|| {
        let shortest = targets.iter().map(|t| t.queue.shortest()).fold(f64::INFINITY, f64::min);
        (shortest / STEPS_A_LOAD).clamp(SHORTEST_STEP, LONGEST_STEP)
    });
    (libm::ceil(interval / step - 1e-9) as usize).max(1)
}
