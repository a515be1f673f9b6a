//! Shapes and what follows from them alone: mass properties, silhouettes, triangle meshes, and polygons made into
//! solid pieces.
//!
//! This room knows nothing of air, charges or time. Lengths in metres, masses in kilograms.

mod bounds;
mod convex;
mod mass;
mod mesh;
mod moments;
mod outline;
mod polygon;
mod prism;
mod samples;
mod silhouette;
mod triangulation;

pub use bounds::{Coordinates, bounds, box_corners};
pub use convex::{convex_hull, convex_parts, simplified};
pub use mass::{MassProperties, PrincipalAxes};
pub use mesh::TriangleMesh;
pub use moments::PlaneMoments;
pub use outline::{JOINT, Outline};
pub use polygon::Polygon;
pub use prism::{PieceMesh, PieceMeshes};
pub use samples::{Sample, sample_panels};
pub use silhouette::Silhouette;
pub use triangulation::Triangulator;
