//! How a brittle pane breaks: cracks that run, fork, turn and stop, and the fragments they leave (thesis 5.4).
//!
//! - [`Settings`]: how cracks run; [`Nucleus`]: where they start;
//! - [`Recipe`]: the same as an artist says it, for a kind of [`Glass`];
//! - [`Pattern`]: the cracks and the fragments, from [`Pattern::grow`];
//! - [`CrackClock`]: from growth to time (5.6);
//! - [`outline`]: whether an outline bounds a pane.
//!
//! The growth is an exact simulation of events, not of steps on a grid: it has no resolution of its own, and the
//! same settings give the same pattern everywhere. Fragments are the faces of the planar graph of the cracks: their
//! areas add up to the pane's, they do not overlap, and every crack side belongs to exactly two of them.

mod calendar;
mod clock;
mod glass;
mod graph;
mod grid;
mod growth;
mod order;
pub mod outline;
mod pattern;
mod pieces;
mod run;
mod settings;

pub use clock::{CrackClock, HEAD_START};
pub use glass::{Fineness, Glass, Grown, Recipe, Shape};
pub use pattern::{Crack, Cracks, Fragment, Pattern, Stopper};
pub use pieces::Pieces;
pub use settings::{Depth, Forking, Guide, Nucleus, Order, Rings, Settings, StressField, Wiggle};
