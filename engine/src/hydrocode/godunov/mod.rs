//! A Godunov scheme of second order on a mesh that may move.
//!
//! Mass, momentum and energy of each cell change by what flows through its faces, so they are conserved to
//! rounding. The faces stand still ([`Motion::Fixed`], Eulerian), go with the gas ([`Motion::WithGas`],
//! Lagrangian), or keep their places between boundaries that do: [`Motion::Follow`] lets the bounds between
//! regions go with the gas and, with [`Boundary::Front`], the last face with the shock front. That face then
//! *is* the shock: it is not smeared at all, and no cells are spent on the still air ahead of it.
//!
//! Limits: one dimension; each region one gas; shocks inside the mesh spread over two to three cells; a gas
//! colder than a rounding of its kinetic energy is given that much heat back, which
//! [`Godunov::added_energy`] counts.

mod columns;
mod flux;
mod motion;
mod reconstruct;
mod recover;
mod settings;

use super::mesh::{check_faces, mean_area, volume};
use super::riemann::GasState;
use super::{Cells, Scheme};
use crate::detonation::{EquationOfState, Symmetry};
use crate::error::Result;
use columns::{Columns, Row};
use flux::{Fluxes, through_faces, with_the_gas};
use reconstruct::{Grid, Place, half_step, half_steps, limited_slopes};
pub(super) use settings::check_courant;
pub use settings::{Boundary, GodunovSettings, Motion};

/// Cells of one gas.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Region {
    from: usize,
    to: usize,
    state: EquationOfState,
}

/// A flow under way.
#[derive(Debug, Clone)]
pub struct Godunov {
    symmetry: Symmetry,
    settings: GodunovSettings,
    regions: Vec<Region>,
    time: f64,
    added_energy: f64,
    face: Vec<f64>,
    face_velocity: Vec<f64>,
    area: Vec<f64>,
    mass: Vec<f64>,
    momentum: Vec<f64>,
    energy: Vec<f64>,
    /// With ghosts, as the columns of `gas`.
    centre: Vec<f64>,
    inverse_gap: Vec<f64>,
    gas: Columns,
    sound_speed: Vec<f64>,
    stiffness: Vec<f64>,
    slopes: Columns,
    low: Columns,
    high: Columns,
    middle_pressure: Vec<f64>,
    fluxes: Fluxes,
    /// The gas just behind the front, where there is one.
    front: Option<(GasState, f64)>,
}

impl Godunov {
    /// A flow that starts from `cells`.
    pub fn new(cells: &Cells, settings: GodunovSettings) -> Result<Godunov> {
        settings.validate()?;
        cells.validate()?;
        check_faces(cells.symmetry, &cells.face)?;
        let count = cells.density.len();
        let mut from = 0;
        let regions = cells.regions.iter().map(|(size, state)| {
            let region = Region { from, to: from + size, state: *state };
            from += size;
            region
        });
        let mut flow = Godunov {
            symmetry: cells.symmetry,
            settings,
            regions: regions.collect(),
            time: 0.0,
            added_energy: 0.0,
            face: cells.face.clone(),
            face_velocity: vec![0.0; count + 1],
            area: vec![0.0; count + 1],
            mass: vec![0.0; count],
            momentum: vec![0.0; count],
            energy: vec![0.0; count],
            centre: vec![0.0; count + 2],
            inverse_gap: vec![0.0; count + 1],
            gas: Columns::zeros(count + 2),
            sound_speed: vec![0.0; count + 2],
            stiffness: vec![0.0; count + 2],
            slopes: Columns::zeros(count),
            low: Columns::zeros(count + 2),
            high: Columns::zeros(count + 2),
            middle_pressure: vec![0.0; count],
            fluxes: Fluxes::zeros(count + 1),
            front: None,
        };
        for cell in 0..count {
            let volume = volume(flow.symmetry, flow.face[cell], flow.face[cell + 1]);
            let (density, velocity) = (cells.density[cell], cells.velocity[cell]);
            flow.mass[cell] = density * volume;
            flow.momentum[cell] = density * velocity * volume;
            flow.energy[cell] = density * (cells.energy[cell] + 0.5 * velocity * velocity) * volume;
        }
        flow.recover()?;
        if let Boundary::Front(air) = flow.settings.outer {
            let last = flow.gas.row(count);
            flow.meet_front(&air, last)?;
        }
        Ok(flow)
    }

    /// Energy [J, per unit of angle or area] that was added to cells too cold for rounding; 0 as a rule.
    pub fn added_energy(&self) -> f64 {
        self.added_energy
    }

    /// Mass, momentum and energy in the mesh, per unit of solid angle, angle or area.
    pub fn totals(&self) -> (f64, f64, f64) {
        (self.mass.iter().sum(), self.momentum.iter().sum(), self.energy.iter().sum())
    }

    fn cells(&self) -> usize {
        self.mass.len()
    }

    /// Ghost cells: mirror images at walls, copies at open ends, the state behind a front.
    fn set_ghosts(&mut self) {
        let count = self.cells();
        for (ghost, cell, face, boundary) in [
            (0, 1, self.face[0], self.settings.inner),
            (count + 1, count, self.face[count], self.settings.outer),
        ] {
            let row = self.gas.row(cell);
            let (row, place) = match (boundary, self.front) {
                (Boundary::Front(_), Some((state, _))) => {
                    let energy = state.pressure * row.energy / row.pressure;
                    let GasState { density, velocity, pressure } = state;
                    (Row { density, velocity, pressure, energy }, face)
                }
                (Boundary::Wall, _) => {
                    (Row { velocity: -row.velocity, ..row }, 2.0 * face - self.centre[cell])
                }
                _ => (row, 2.0 * face - self.centre[cell]),
            };
            self.gas.set(ghost, row);
            self.centre[ghost] = place;
            self.sound_speed[ghost] = self.sound_speed[cell];
            self.stiffness[ghost] = self.stiffness[cell];
        }
        for (gap, pair) in self.inverse_gap.iter_mut().zip(self.centre.windows(2)) {
            *gap = 1.0 / (pair[1] - pair[0]);
        }
    }

    fn set_slopes(&mut self) {
        let (gas, gap, slopes) = (&self.gas, &self.inverse_gap, &mut self.slopes);
        limited_slopes(&gas.density, gap, &mut slopes.density);
        limited_slopes(&gas.velocity, gap, &mut slopes.velocity);
        limited_slopes(&gas.pressure, gap, &mut slopes.pressure);
        limited_slopes(&gas.energy, gap, &mut slopes.energy);
    }

    /// The states at the faces of one cell after half of `step`, with the present motion of the faces.
    fn ends_of(&self, cell: usize, step: f64) -> (Row, Row) {
        let place = Place {
            centre: self.centre[cell + 1],
            low: self.face[cell],
            high: self.face[cell + 1],
            low_velocity: self.face_velocity[cell],
            high_velocity: self.face_velocity[cell + 1],
        };
        let slope = self.slopes.row(cell);
        let exponent = f64::from(self.symmetry.exponent());
        let sound = self.sound_speed[cell + 1];
        let (low, high, _) = half_step(self.gas.row(cell + 1), slope, sound, place, exponent, step);
        (low, high)
    }

    /// States beyond the ends, for the fluxes through the first and the last face.
    fn set_end_states(&mut self) {
        let count = self.cells();
        let beyond = |row: Row, boundary: Boundary| match boundary {
            Boundary::Wall => Row { velocity: -row.velocity, ..row },
            _ => row,
        };
        let (first, last) = (self.low.row(1), self.high.row(count));
        self.high.set(0, beyond(first, self.settings.inner));
        self.low.set(count + 1, beyond(last, self.settings.outer));
    }

    fn set_fluxes(&mut self, step: f64) {
        let grid = Grid {
            centre: &self.centre,
            face: &self.face,
            face_velocity: &self.face_velocity,
            exponent: f64::from(self.symmetry.exponent()),
        };
        let out = (&mut self.low, &mut self.high, &mut self.middle_pressure[..]);
        half_steps(&self.gas, &self.slopes, &self.sound_speed, &grid, step, out);
        self.set_end_states();
        let (low, high, stiffness) = (&self.low, &self.high, &self.stiffness);
        if self.settings.motion == Motion::WithGas {
            with_the_gas(low, high, stiffness, &mut self.face_velocity, &mut self.fluxes);
            return;
        }
        through_faces(low, high, stiffness, &self.face_velocity, &mut self.fluxes);
        if self.settings.motion == Motion::Follow {
            self.set_bound_fluxes();
        }
    }

    /// Moves the faces and lets the fluxes act.
    fn advance(&mut self, step: f64) {
        for (face, (area, velocity)) in
            self.face.iter_mut().zip(self.area.iter_mut().zip(&self.face_velocity))
        {
            let next = *face + step * velocity;
            *area = mean_area(self.symmetry, *face, next);
            *face = next;
        }
        let faces = self.area.len();
        let (area, mass) = (&self.area[..faces], &self.fluxes.mass[..faces]);
        let (momentum, energy) = (&self.fluxes.momentum[..faces], &self.fluxes.energy[..faces]);
        let cells = self.mass.len();
        let middle = &self.middle_pressure[..cells];
        for cell in 0..cells {
            let (low, high) = (area[cell], area[cell + 1]);
            self.mass[cell] += step * (low * mass[cell] - high * mass[cell + 1]);
        }
        for cell in 0..cells {
            let (low, high) = (area[cell], area[cell + 1]);
            let push = low * momentum[cell] - high * momentum[cell + 1] + middle[cell] * (high - low);
            self.momentum[cell] += step * push;
        }
        for cell in 0..cells {
            let (low, high) = (area[cell], area[cell + 1]);
            self.energy[cell] += step * (low * energy[cell] - high * energy[cell + 1]);
        }
    }
}

impl Scheme for Godunov {
    fn time(&self) -> f64 {
        self.time
    }

    fn step(&mut self, until: f64) -> Result<()> {
        self.set_ghosts();
        let step = self.stable_step().min(until - self.time);
        if !(step > 0.0 && step.is_finite()) {
            return Err(self.unhealthy());
        }
        self.set_slopes();
        self.move_faces(step)?;
        self.set_fluxes(step);
        self.advance(step);
        self.time = if step == until - self.time { until } else { self.time + step };
        self.recover()
    }

    fn face(&self) -> &[f64] {
        &self.face
    }

    fn centre(&self) -> &[f64] {
        &self.centre[1..=self.cells()]
    }

    fn density(&self) -> &[f64] {
        &self.gas.density[1..=self.cells()]
    }

    fn velocity(&self, cell: usize) -> f64 {
        self.gas.velocity[cell + 1]
    }

    fn pressure(&self) -> &[f64] {
        &self.gas.pressure[1..=self.cells()]
    }

    fn front(&self) -> Option<(GasState, f64)> {
        self.front
    }
}
