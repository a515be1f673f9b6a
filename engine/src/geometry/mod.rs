//! Shapes and what follows from them alone: mass properties, silhouettes, triangle meshes.
//!
//! This room knows nothing of air, charges or time. Lengths in metres, masses in kilograms.

mod mass;
mod mesh;
mod outline;
mod silhouette;

pub use mass::{MassProperties, PrincipalAxes};
pub use mesh::TriangleMesh;
pub use outline::{JOINT, Outline};
pub use silhouette::Silhouette;
