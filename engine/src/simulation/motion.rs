//! The one interface of all ways to move: how a run asks for a step, whoever takes it.
//!
//! [`FreeFlight`] moves each body for itself; [`Contacts`] moves all together as they touch. What both work on is the
//! [`State`]; what only one of them needs it keeps to itself. The loop does not know which runs.

use super::contacts::Contacts;
use super::free_flight::FreeFlight;
use super::range;
use super::state::State;
use super::steps::Steps;
use super::targets::Target;
use crate::error::Result;
use crate::scene::Scene;

/// A way to move the bodies of a run.
pub(super) trait Motion {
    /// Into how many even steps to divide the time from `t0` to `t1` [s], at least 1.
    fn steps(&self, state: &State, t0: f64, t1: f64) -> usize;

    /// Moves all bodies from `t0` to `t1` [s].
    ///
    /// # Errors
    /// [`Error::Overflow`](crate::Error::Overflow) where it cannot go on with a body that is at no finite place; what
    /// can, leaves that to whoever looks at the poses.
    fn advance(&mut self, state: &mut State, t0: f64, t1: f64) -> Result<()>;

    /// Whether all loads are over at `now` [s] and every body rests.
    fn rests(&self, state: &State, now: f64) -> bool;

    /// Notes what is only known at the end of a run, at `now` [s]: when bodies came to rest for good. Returns what the user
    /// should know of how they moved.
    fn conclude(&self, state: &mut State, now: f64) -> Option<String>;
}

/// Refuses a scene whose numbers are beyond the way in which its bodies move.
///
/// # Errors
/// [`Error::Malformed`](crate::Error::Malformed) that names the body.
pub(super) fn check(scene: &Scene) -> Result<()> {
    if scene.dynamics.contacts { range::check(scene) } else { Ok(()) }
}

/// The way in which the bodies of a scene move, as it asks for.
pub(super) fn motion(scene: &Scene, targets: &[Target], steps: Steps) -> Box<dyn Motion> {
    if scene.dynamics.contacts {
        Box::new(Contacts::new(scene, targets, steps.loaded))
    } else {
        Box::new(FreeFlight::new(steps))
    }
}
