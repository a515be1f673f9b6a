//! What a run of the Godunov scheme can be told.

use crate::air::Air;
use crate::error::{Error, Result};

/// What lies beyond an end of the mesh.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Boundary {
    /// A rigid wall, or the centre of symmetry.
    #[default]
    Wall,
    /// More of the same gas: waves leave.
    Open,
    /// Still air into which a shock runs; only at the outer end, with [`Motion::Follow`].
    Front(Air),
}

/// How the faces move.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Motion {
    /// They do not: Eulerian.
    #[default]
    Fixed,
    /// With the gas: Lagrangian.
    WithGas,
    /// Bounds between regions with the gas, a front with the shock, the others in between.
    Follow,
}

/// How a run is to be computed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GodunovSettings {
    /// Courant number, above 0 and up to 1: the part of a cell that the fastest wave may cross in a step. More
    /// is faster and less stable.
    pub courant: f64,
    /// Motion of the faces.
    pub motion: Motion,
    /// Beyond the first face.
    pub inner: Boundary,
    /// Beyond the last face.
    pub outer: Boundary,
}

impl Default for GodunovSettings {
    fn default() -> Self {
        GodunovSettings { courant: 0.8, motion: Motion::Fixed, inner: Boundary::Wall, outer: Boundary::Wall }
    }
}

impl GodunovSettings {
    pub(super) fn validate(&self) -> Result<()> {
        check_courant(self.courant)?;
        if let Boundary::Front(_) = self.inner {
            return Err(Error::Malformed("a shock front can only bound the outer end of the mesh".into()));
        }
        if let Boundary::Front(air) = self.outer {
            air.validate()?;
            if self.motion != Motion::Follow {
                return Err(Error::Malformed("a mesh bounded by a front must follow it".into()));
            }
        }
        Ok(())
    }
}

/// Checks a Courant number: above 0 and at most 1.
pub(in crate::hydrocode) fn check_courant(courant: f64) -> Result<()> {
    if courant > 0.0 && courant <= 1.0 {
        return Ok(());
    }
    Err(Error::OutOfRange { what: "Courant number", value: courant, expected: "above 0 and at most 1" })
}
