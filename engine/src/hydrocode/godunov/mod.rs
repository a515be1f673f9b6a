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
mod reconstruct;

use super::mesh::{centre, check_faces, mean_area, volume};
use super::riemann::{GasState, RiemannProblem};
use super::{Cells, Scheme};
use crate::air::Air;
use crate::detonation::{EquationOfState, Symmetry};
use crate::error::{Error, Result};
use columns::{Columns, Row};
use flux::{Fluxes, through_faces, waves, with_the_gas};
use reconstruct::{Grid, Place, half_step, half_steps, limited_slopes};

/// Internal energy over kinetic energy below which the former is lost in the rounding of the latter.
const COLD: f64 = 1e-10;

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
    fn validate(&self) -> Result<()> {
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
pub(super) fn check_courant(courant: f64) -> Result<()> {
    if courant > 0.0 && courant <= 1.0 {
        return Ok(());
    }
    Err(Error::OutOfRange { what: "Courant number", value: courant, expected: "above 0 and at most 1" })
}

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

    /// The longest stable step [s].
    fn stable_step(&self) -> f64 {
        let mut rate = 0.0_f64;
        for cell in 0..self.cells() {
            let width = self.face[cell + 1] - self.face[cell];
            let (w0, w1) = (self.face_velocity[cell], self.face_velocity[cell + 1]);
            let velocity = &self.gas.velocity[cell..cell + 3];
            let (a, b) = ((velocity[1] - w0).abs(), (velocity[1] - w1).abs());
            let relative = if self.settings.motion == Motion::WithGas {
                // Faces will go with the gas: it is their closing in on each other that counts, and a third of
                // a cell is as much as the work done on it may be taken in one piece.
                1.5 * (velocity[2] - velocity[0]).abs()
            } else if a > b {
                a
            } else {
                b
            };
            let here = (relative + self.sound_speed[cell + 1]) / width;
            rate = if here > rate { here } else { rate };
        }
        if self.symmetry == Symmetry::Spherical {
            // The ball in the middle has three times the face for its volume that a layer has: at more than
            // 0.72 of a layer's step the least rounding grows there.
            let width = self.face[1] - self.face[0];
            let speed = self.gas.velocity[1].abs() + self.sound_speed[1];
            rate = rate.max(1.5 * speed / width);
        }
        self.settings.courant / rate
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

    /// Velocities of the faces over the coming step.
    fn move_faces(&mut self, step: f64) -> Result<()> {
        match self.settings.motion {
            Motion::Fixed => {}
            // A first guess, for the states half a step on; the faces then go with the contacts found.
            Motion::WithGas => {
                let velocity = &self.gas.velocity;
                for (face, speed) in self.face_velocity.iter_mut().enumerate() {
                    *speed = 0.5 * (velocity[face] + velocity[face + 1]);
                }
            }
            Motion::Follow => self.follow(step)?,
        }
        Ok(())
    }

    fn follow(&mut self, step: f64) -> Result<()> {
        let count = self.cells();
        let mut from = (0, self.face_velocity[0]);
        for index in 0..self.regions.len() {
            let bound = self.regions[index].to;
            let speed = if bound < count {
                let (left, right) = (self.ends_of(bound - 1, step).1, self.ends_of(bound, step).0);
                waves(left, right, (self.stiffness[bound], self.stiffness[bound + 1])).contact
            } else if let Boundary::Front(air) = self.settings.outer {
                let last = self.ends_of(count - 1, step).1;
                self.meet_front(&air, last)?
            } else {
                0.0
            };
            let (start, end) = (self.face[from.0], self.face[bound]);
            let stretch = (speed - from.1) / (end - start);
            for face in from.0..=bound {
                self.face_velocity[face] = from.1 + stretch * (self.face[face] - start);
            }
            from = (bound, speed);
        }
        Ok(())
    }

    /// The shock that `last` drives into still air: remembers the state behind it, returns its velocity.
    fn meet_front(&mut self, air: &Air, last: Row) -> Result<f64> {
        let left = GasState { density: last.density, velocity: last.velocity, pressure: last.pressure };
        let still = GasState { density: air.density(), velocity: 0.0, pressure: air.pressure };
        let problem = RiemannProblem::new(left, still, air.gamma)?;
        let speed = problem.heads().1;
        self.front = Some((problem.at(speed * (1.0 - 1e-12)), speed));
        Ok(speed)
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

    /// Nothing flows through the bound between two gases; through a front flows the still air ahead.
    fn set_bound_fluxes(&mut self) {
        let count = self.cells();
        for region in &self.regions {
            let bound = region.to;
            let speed = self.face_velocity[bound];
            if bound < count {
                let (left, right) = (self.high.row(bound), self.low.row(bound + 1));
                let push = waves(left, right, (self.stiffness[bound], self.stiffness[bound + 1])).pressure;
                self.fluxes.set(bound, 0.0, push, push * speed);
            } else if let Boundary::Front(air) = self.settings.outer {
                let heat = air.pressure / (air.gamma - 1.0);
                self.fluxes.set(bound, -speed * air.density(), air.pressure, -speed * heat);
            }
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

    /// The gas from mass, momentum and energy; an error where there is none left.
    fn recover(&mut self) -> Result<()> {
        let mut healthy = true;
        for cell in 0..self.cells() {
            let (low, high) = (self.face[cell], self.face[cell + 1]);
            let inverse = 1.0 / volume(self.symmetry, low, high);
            self.centre[cell + 1] = centre(self.symmetry, low, high);
            let density = self.mass[cell] * inverse;
            let velocity = self.momentum[cell] / self.mass[cell];
            let kinetic = 0.5 * density * velocity * velocity;
            let internal = self.energy[cell] * inverse - kinetic;
            healthy &= (density > 0.0) & (internal > -0.01 * kinetic) & (high > low);
            self.gas.density[cell + 1] = density;
            self.gas.velocity[cell + 1] = velocity;
            self.gas.energy[cell + 1] = internal;
        }
        if !healthy {
            return Err(self.unhealthy());
        }
        self.warm();
        for region in 0..self.regions.len() {
            let Region { from, to, state } = self.regions[region];
            self.set_pressures(from + 1, to + 1, state);
        }
        Ok(())
    }

    /// Gives heat to cells whose internal energy is lost in rounding.
    fn warm(&mut self) {
        for cell in 0..self.cells() {
            let velocity = self.gas.velocity[cell + 1];
            let least = COLD * 0.5 * self.gas.density[cell + 1] * velocity * velocity;
            let internal = self.gas.energy[cell + 1];
            if internal < least {
                let volume = self.mass[cell] / self.gas.density[cell + 1];
                self.gas.energy[cell + 1] = least;
                self.energy[cell] += (least - internal) * volume;
                self.added_energy += (least - internal) * volume;
            }
        }
    }

    fn set_pressures(&mut self, from: usize, to: usize, state: EquationOfState) {
        let (density, energy) = (&self.gas.density[from..to], &self.gas.energy[from..to]);
        let pressure = &mut self.gas.pressure[from..to];
        let (sound, stiffness) = (&mut self.sound_speed[from..to], &mut self.stiffness[from..to]);
        match state {
            EquationOfState::Ideal { gamma } => {
                for cell in 0..density.len() {
                    pressure[cell] = (gamma - 1.0) * energy[cell];
                    sound[cell] = (gamma * pressure[cell] / density[cell]).sqrt();
                    stiffness[cell] = gamma;
                }
            }
            EquationOfState::Jwl(_) => {
                for cell in 0..density.len() {
                    let here = state.pressure(density[cell], energy[cell] / density[cell]);
                    let square = state.sound_speed_squared(density[cell], here);
                    pressure[cell] = here;
                    sound[cell] = square.sqrt();
                    stiffness[cell] = density[cell] * square / here;
                }
            }
        }
    }

    fn unhealthy(&self) -> Error {
        let cell = (0..self.cells())
            .find(|&cell| {
                let (density, velocity) = (self.gas.density[cell + 1], self.gas.velocity[cell + 1]);
                let internal = self.gas.energy[cell + 1];
                !(density > 0.0 && internal > -0.005 * density * velocity * velocity)
                    || self.face[cell + 1] <= self.face[cell]
            })
            .unwrap_or(0);
        Error::Malformed(format!(
            "at {:.6e} s the gas {:.6} m out has a density of {:.3e} kg/m³ and an internal energy of {:.3e} \
             J/m³: a vacuum has opened or the step is too long; lower the Courant number or use more cells",
            self.time,
            self.face[cell],
            self.gas.density[cell + 1],
            self.gas.energy[cell + 1]
        ))
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
