//! Bodies of a test that follow their contact world.

use brisance_engine::dynamics::RigidBody;
use brisance_engine::dynamics::contact::{ContactWorld, Moved};

/// A step of `dt` [s], after which the states are those of the world; `heard` learns of each body that was awake.
pub fn follow(world: &mut ContactWorld, states: &mut [RigidBody], dt: f64, mut heard: impl FnMut(Moved)) {
    world.step(dt, |moved, position, rotation, velocity, spin| {
        let state = &mut states[moved.index];
        state.position = position;
        state.world_from_principal = rotation;
        state.velocity = velocity;
        state.angular_momentum = rotation.conjugate() * spin / state.inverse_moments;
        heard(moved);
    });
}
