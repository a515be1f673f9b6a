//! A one-dimensional hydrocode: the Euler equations of a gas in layers, about an axis or about a point.
//!
//! Thesis §2.3, (2.10)–(2.13). Two schemes for the same flow:
//!
//! - [`godunov`]: conservative, of second order, on faces that stand or move;
//! - [`viscosity`]: the historical one, in the gas's own coordinates, with the artificial viscosity of von
//!   Neumann and Richtmyer (§2.3.1).
//!
//! What they are judged by: [`riemann`], the exact solution of two states that meet, and [`sedov`], that of
//! energy let go at a point. [`cases`] are well-known problems, [`blast`] is a charge of TNT in air, from the
//! end of its detonation outwards, [`gauge`] a place where the passing pressure is recorded.
//!
//! No heat conduction, no viscosity but the artificial one, no chemistry: what the charge's products would
//! still burn in the air is left out.

pub mod blast;
pub mod cases;
pub mod gauge;
pub mod godunov;
mod mesh;
pub mod riemann;
pub mod sedov;
pub mod viscosity;

pub use crate::detonation::Symmetry;
pub use gauge::Gauge;
pub use godunov::{Boundary, Godunov, GodunovSettings, Motion};
pub use mesh::whole;
pub use riemann::{GasState, RiemannProblem};
pub use sedov::Sedov;
pub use viscosity::{Viscosity, ViscositySettings};

use crate::detonation::EquationOfState;
use crate::error::{Error, Result, finite, positive};

/// A gas cut into cells: how a flow starts.
#[derive(Debug, Clone, PartialEq)]
pub struct Cells {
    /// Layers, axis or point.
    pub symmetry: Symmetry,
    /// Places of the faces [m], rising, one more than there are cells.
    pub face: Vec<f64>,
    /// Density of each cell [kg/m³], above 0.
    pub density: Vec<f64>,
    /// Velocity of each cell [m/s], outward.
    pub velocity: Vec<f64>,
    /// Specific internal energy of each cell [J/kg], above 0.
    pub energy: Vec<f64>,
    /// Gases from the inside out: number of cells and equation of state of each.
    pub regions: Vec<(usize, EquationOfState)>,
}

impl Cells {
    /// `count` equal cells of an ideal gas between `from` and `to` [m], in the state that `gas` gives at each
    /// centre.
    pub fn ideal(
        symmetry: Symmetry,
        (from, to): (f64, f64),
        count: usize,
        gamma: f64,
        gas: impl Fn(f64) -> GasState,
    ) -> Cells {
        let place = |face: usize| from + (to - from) * face as f64 / count as f64;
        let mut cells = Cells {
            symmetry,
            face: (0..=count).map(place).collect(),
            density: Vec::with_capacity(count),
            velocity: Vec::with_capacity(count),
            energy: Vec::with_capacity(count),
            regions: vec![(count, EquationOfState::Ideal { gamma })],
        };
        for cell in 0..count {
            let at = mesh::centre(symmetry, cells.face[cell], cells.face[cell + 1]);
            let GasState { density, velocity, pressure } = gas(at);
            cells.density.push(density);
            cells.velocity.push(velocity);
            cells.energy.push(pressure / ((gamma - 1.0) * density));
        }
        cells
    }

    /// Checks that every cell holds a gas, and that the regions hold every cell.
    pub fn validate(&self) -> Result<()> {
        let count = self.face.len().saturating_sub(1);
        let held: usize = self.regions.iter().map(|region| region.0).sum();
        for (what, rows) in [
            ("densities", self.density.len()),
            ("velocities", self.velocity.len()),
            ("energies", self.energy.len()),
            ("cells in its regions", held),
        ] {
            if rows != count {
                return Err(Error::Malformed(format!(
                    "the mesh has {rows} {what}, but must have {count}, one for each cell"
                )));
            }
        }
        for (size, state) in &self.regions {
            positive("number of cells in a region", *size as f64)?;
            state.validate()?;
        }
        for cell in 0..count {
            positive("density of a cell [kg/m³]", self.density[cell])?;
            finite("velocity of a cell [m/s]", self.velocity[cell])?;
            positive("internal energy of a cell [J/kg]", self.energy[cell])?;
        }
        Ok(())
    }
}

/// A scheme that carries a flow forward.
pub trait Scheme {
    /// Time of the flow [s].
    fn time(&self) -> f64;
    /// One step, not beyond the time `until` [s]; an error where the flow cannot go on.
    fn step(&mut self, until: f64) -> Result<()>;
    /// Places of the faces [m].
    fn face(&self) -> &[f64];
    /// Centres of the cells [m].
    fn centre(&self) -> &[f64];
    /// Density of each cell [kg/m³].
    fn density(&self) -> &[f64];
    /// Velocity at the centre of a cell [m/s].
    fn velocity(&self, cell: usize) -> f64;
    /// Pressure of each cell [Pa].
    fn pressure(&self) -> &[f64];
    /// The gas just behind the front that bounds the mesh and that front's velocity [m/s]; `None` where the
    /// mesh holds its shocks inside.
    fn front(&self) -> Option<(GasState, f64)>;

    /// The gas in a cell.
    fn gas(&self, cell: usize) -> GasState {
        GasState {
            density: self.density()[cell],
            velocity: self.velocity(cell),
            pressure: self.pressure()[cell],
        }
    }

    /// Carries the flow to `end` [s]; `watch` sees it after every step and ends the run early with an error.
    fn run(&mut self, end: f64, mut watch: impl FnMut(&Self) -> Result<()>) -> Result<()>
    where
        Self: Sized,
    {
        finite("final time [s]", end)?;
        while self.time() < end {
            self.step(end)?;
            watch(self)?;
        }
        Ok(())
    }
}
