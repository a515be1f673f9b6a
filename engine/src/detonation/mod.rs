//! Detonations in one dimension: what a front does to inert material and to an explosive, and what it leaves.
//!
//! Thesis §2.2. An illustration of the theory, and the start of the charge in [`crate::hydrocode`]; constants
//! are those of published tables.
//!
//! - [`equation_of_state`]: pressure from density and energy, of an ideal gas and of detonation products;
//! - [`inert`]: Hugoniot and Rayleigh line of a shock in inert material (2.9);
//! - [`explosive`]: the Hugoniot of a detonation, strong and weak solutions, the Chapman–Jouguet point;
//! - [`zone`]: the reaction zone behind the front;
//! - [`following`]: the flow behind the reaction zone.
//!
//! Not modelled: losses to the sides, curved fronts, several reactions, and the fine structure that real
//! fronts have.

pub mod equation_of_state;
pub mod explosive;
pub mod following;
pub mod inert;
pub mod zone;

pub use equation_of_state::{EquationOfState, Isentrope, Jwl};
pub use explosive::{Behind, Explosive};
pub use following::{FollowingFlow, Symmetry};
pub use inert::Inert;
pub use zone::{Detonation, ZonePoint};
