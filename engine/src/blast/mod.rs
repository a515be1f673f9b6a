//! The blast: at this point, from this charge, when does the front come and how hard does it strike?
//!
//! [`field::BlastField`] answers for one charge in one atmosphere. It stands on [`curves`] (how a blast
//! weakens with scaled distance), [`front`] (when it arrives), [`pulse`] (how the pressure passes),
//! [`negative`] (the suction that follows) and [`reflection`] (what a surface makes of it).

pub mod curves;
pub mod field;
pub mod front;
pub mod negative;
pub mod pulse;
pub mod reflection;

pub use curves::extension::Extension;
pub use field::{BlastField, BlastPoint};
pub use negative::negative_phase;
pub use pulse::{NegativePhase, Pulse, PulseShape};
