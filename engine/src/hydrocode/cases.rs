//! Well-known problems with exact or published solutions, by which a hydrocode is judged.
//!
//! Without units, as published; γ = 1.4 but for Noh's 5/3.

use super::riemann::{GasState, RiemannProblem};
use super::sedov::Sedov;
use super::{Boundary, Cells};
use crate::detonation::Symmetry;
use crate::error::{Error, Result};

/// A problem.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Case {
    /// G. A. Sod (1978): a membrane between gas of pressure 1 and 0.1 bursts. In the plane.
    Sod,
    /// C.-W. Shu, S. Osher (1989): a shock of Mach number 3 runs into waves of density. In the plane.
    ShuOsher,
    /// W. F. Noh (1987): cold gas falls on a wall, an axis or a point, and a shock comes back.
    Noh,
    /// L. I. Sedov and G. I. Taylor: energy let go at a plane, a line or a point.
    Sedov,
}

/// Pressure of gas that should be cold: small against that of the motion.
pub const COLD_PRESSURE: f64 = 1e-6;

impl Case {
    /// The time at which the solution is usually compared.
    pub fn end(self) -> f64 {
        match self {
            Case::Sod => 0.2,
            Case::ShuOsher => 1.8,
            Case::Noh => 0.6,
            Case::Sedov => 1.0,
        }
    }

    /// First and last place of the mesh.
    pub fn span(self) -> (f64, f64) {
        match self {
            Case::Sod | Case::Noh => (0.0, 1.0),
            Case::ShuOsher => (-5.0, 5.0),
            Case::Sedov => (0.0, 1.2),
        }
    }

    /// Ratio of specific heats.
    pub fn gamma(self) -> f64 {
        if self == Case::Noh { 5.0 / 3.0 } else { 1.4 }
    }

    /// What bounds the mesh.
    pub fn boundaries(self) -> (Boundary, Boundary) {
        match self {
            Case::Sod | Case::ShuOsher => (Boundary::Open, Boundary::Open),
            Case::Noh | Case::Sedov => (Boundary::Wall, Boundary::Open),
        }
    }

    /// Checks that the problem exists in `symmetry`: Sod's, and Shu and Osher's, are of the plane.
    pub fn check(self, symmetry: Symmetry) -> Result<()> {
        let plane_only = matches!(self, Case::Sod | Case::ShuOsher);
        if plane_only && symmetry != Symmetry::Plane {
            return Err(Error::Malformed("this case is one of the plane; choose the plane geometry".into()));
        }
        Ok(())
    }

    /// The problem at time 0 on `count` equal cells, 10 or more.
    ///
    /// Sedov's energy is what brings the shock to 1 (0.75 about an axis, 0.5 in the plane) at time 1; it lies
    /// in the first three cells.
    pub fn cells(self, symmetry: Symmetry, count: usize) -> Result<Cells> {
        self.check(symmetry)?;
        if count < 10 {
            return Err(Error::OutOfRange {
                what: "number of cells",
                value: count as f64,
                expected: "10 or more",
            });
        }
        let gas = |x: f64| match self {
            Case::Sod => sod(x >= 0.5),
            Case::ShuOsher => shu_osher(x),
            Case::Noh => GasState { density: 1.0, velocity: -1.0, pressure: COLD_PRESSURE },
            Case::Sedov => GasState { density: 1.0, velocity: 0.0, pressure: COLD_PRESSURE },
        };
        let mut cells = Cells::ideal(symmetry, self.span(), count, self.gamma(), gas);
        if self == Case::Sedov {
            let hot = 3;
            let volume = super::mesh::volume(symmetry, cells.face[0], cells.face[hot]);
            let both = if symmetry == Symmetry::Plane { 2.0 } else { 1.0 };
            let energy = sedov_energy(symmetry) / (both * super::whole(symmetry) * volume);
            cells.energy[..hot].fill(energy);
        }
        Ok(cells)
    }

    /// The exact solution; `None` for Shu and Osher's problem, which has none.
    pub fn exact(self, symmetry: Symmetry) -> Result<Option<Exact>> {
        self.check(symmetry)?;
        Ok(match self {
            Case::Sod => Some(Exact::Sod(RiemannProblem::new(sod(false), sod(true), self.gamma())?)),
            Case::ShuOsher => None,
            Case::Noh => Some(Exact::Noh(symmetry)),
            Case::Sedov => {
                Some(Exact::Sedov(Sedov::new(symmetry, self.gamma(), 1.0, sedov_energy(symmetry))?))
            }
        })
    }
}

/// The exact solution of a problem.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Exact {
    /// The waves that part from the membrane.
    Sod(RiemannProblem),
    /// A shock of constant velocity.
    Noh(Symmetry),
    /// The strong blast.
    Sedov(Sedov),
}

impl Exact {
    /// The gas at place `x` and `time`, above 0.
    pub fn at(&self, x: f64, time: f64) -> GasState {
        match self {
            Exact::Sod(problem) => problem.at((x - 0.5) / time),
            Exact::Noh(symmetry) => noh(*symmetry, x, time),
            Exact::Sedov(blast) => blast.at(x, time),
        }
    }
}

fn sod(right: bool) -> GasState {
    let (density, pressure) = if right { (0.125, 0.1) } else { (1.0, 1.0) };
    GasState { density, velocity: 0.0, pressure }
}

fn shu_osher(x: f64) -> GasState {
    if x < -4.0 {
        return GasState { density: 3.857143, velocity: 2.629369, pressure: 10.333333 };
    }
    GasState { density: 1.0 + 0.2 * libm::sin(5.0 * x), velocity: 0.0, pressure: 1.0 }
}

/// A shock of speed 1/3; behind it `4^(j+1)`, at rest; ahead of it `(1 + t/r)^j`.
fn noh(symmetry: Symmetry, r: f64, time: f64) -> GasState {
    let exponent = symmetry.exponent();
    if r < time / 3.0 {
        let density = libm::pow(4.0, f64::from(exponent + 1));
        return GasState { density, velocity: 0.0, pressure: density / 3.0 };
    }
    let density = libm::pow(1.0 + time / r, f64::from(exponent));
    GasState { density, velocity: -1.0, pressure: COLD_PRESSURE }
}

/// The energies of Kamm and Timmes's standard problems; theirs of the plane is that of one side.
fn sedov_energy(symmetry: Symmetry) -> f64 {
    match symmetry {
        Symmetry::Plane => 2.0 * 0.0673185,
        Symmetry::Cylindrical => 0.311357,
        Symmetry::Spherical => 0.851072,
    }
}
