//! Structures under a blast: how far they are pushed, and what it takes to push them too far.
//!
//! Thesis §2.7 and §2.8. A structure is one mass on one spring, which may yield; a pane finds its mass and spring from plate theory.
//!
//! - [`load`]: forces over time;
//! - [`oscillator`]: the structure and its response;
//! - [`closed_form`]: the response to a triangle, exactly;
//! - [`pressure_impulse`]: diagrams of what does damage;
//! - [`plate`]: a pane that bends.

pub mod closed_form;
pub mod load;
pub mod oscillator;
pub mod plate;
pub mod pressure_impulse;

pub use closed_form::triangle_response;
pub use load::{Load, LoadTable, Pulse};
pub use oscillator::{Motion, Oscillator, Response, respond};
pub use plate::Plate;
pub use pressure_impulse::{Diagram, Threshold, diagram, impulsive_limit, quasi_static_force, reaches};
