//! Brisance engine: what a blast does to a scene of rigid bodies.
//!
//! Pure computation: no files, no printing, no clock. The parts, in the order in which they use each other:
//!
//! - [`error`], [`air`], [`geometry`]: the ground everything stands on;
//! - [`charge`]: explosives, TNT equivalence, burst; [`material`]: brittle materials and their cracks;
//! - [`blast`]: at this point, from this charge: when does the front come, and what is the pulse?
//! - [`loading`]: what that pulse does to a piece of surface;
//! - [`occlusion`]: what shelters behind what, and how much of the blast comes round;
//! - [`dynamics`]: how bodies stand, slide, fly and land;
//! - [`fracture`]: how a pane breaks; [`structure`]: how it bends before, and other structures under a load;
//! - [`window`]: a pane in its frame, as a scene says it;
//! - [`scene`], [`simulation`], [`recording`]: what a run is given, the run, what it gives back;
//! - [`detonation`], [`hydrocode`]: the theory beside the simulation, on `air` and `charge` alone.
//!
//! Units are SI throughout: metres, kilograms, seconds, pascals, kelvins, radians. Axes are right-handed with
//! y up. Pressures are overpressures, above the ambient one, unless said otherwise.
//!
//! A scene gives the same bits for any number of threads: bodies move independently of each other within a
//! step, and every sum is taken in a fixed order. Transcendental functions come from `libm`, so that the bits
//! do not depend on the platform's mathematics library either.

pub mod air;
pub mod blast;
pub mod charge;
pub mod detonation;
pub mod dynamics;
pub mod error;
pub mod fracture;
pub mod geometry;
pub mod hydrocode;
pub mod loading;
pub mod material;
pub mod occlusion;
pub mod random;
pub mod recording;
mod root;
pub mod scene;
pub mod simulation;
pub mod structure;
pub mod window;

pub use error::{Error, Result};
