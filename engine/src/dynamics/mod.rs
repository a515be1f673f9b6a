//! Rigid bodies: how they turn, fly, stand, slide and meet the ground.
//!
//! - [`RigidBody`]: state and the free step, Newton–Euler (thesis 2.40–2.44, 3.3, 3.4);
//! - [`Bodies`]: all bodies of a run, laid out so that several fly at once;
//! - [`Support`]: what stands on what, and with which weight (thesis 3.6);
//! - [`standing`]: friction that must be exceeded;
//! - [`Hold`]: pieces of a pane before they are free (thesis 6.7);
//! - [`ground`]: a plane that bodies fall on;
//! - [`contact`]: bodies that collide, pile up and come to rest, through a physics engine (thesis 7.1).
//!
//! Each body moves on its own within a step; only what stands on what couples them, and that is settled between
//! steps.
//! This is what makes the result the same for any number of threads.

mod bodies;
mod body;
pub mod contact;
pub mod ground;
mod hold;
pub mod standing;
mod support;

pub use bodies::{Block, Bodies, LANES};
pub use body::{Air, RigidBody, Winds};
pub use hold::{Bowing, Displacement, Hold, Swing, Until};
pub use support::{Carry, Footing, Support};

/// Acceleration of free fall [m/s²], along −y.
pub const GRAVITY: f64 = 9.806_65;
