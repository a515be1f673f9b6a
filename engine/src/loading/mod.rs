//! What a blast does to the faces of a body: pressure over time on panels, and the wind's drag.
//!
//! - [`Panel`]: a piece of surface, a unit of simulation and not of geometry (thesis 3.5.1);
//! - [`Clearing`]: how far the relief has to come from the edge (thesis 2.6.4, 2.31);
//! - [`FaceHistory`]: pressure on one panel, with its impulse in closed form (thesis 2.6.4, 2.10);
//! - [`Wind`] and [`Resistance`]: drag and lift (thesis 2.32, 2.38, 2.39, 3.2).

mod clearing;
mod drag;
mod history;
mod panel;

pub use clearing::Clearing;
pub use drag::{Resistance, Wind};
pub use history::{Drag, Face, FaceHistory, HistorySettings, LoadingMode};
pub use panel::{BoxFace, Panel, box_panels, flat_panels, mesh_panels};
