//! The scheme of von Neumann and Richtmyer: the gas's own coordinates and an artificial viscosity.
//!
//! Thesis §2.3.1. Cells hold mass, density, energy and pressure; faces hold velocity, half a step apart in time
//! (J. von Neumann, R. D. Richtmyer, J. Appl. Phys. 21, 1950; R. Landshoff added the linear term in 1955).
//! Where a cell is squeezed its pressure is raised by
//!
//! ```text
//! q = ρ (b² Δu² + d c |Δu|)
//! ```
//!
//! which spreads a shock over some `2 b` to `3 b` cells whatever its strength, so that the differences can
//! follow it. Without it (`quadratic` = `linear` = 0) the cells behind a shock ring: the spurious oscillation
//! that the thesis describes. Mass is conserved exactly, total energy to the order of the scheme.

use super::godunov::check_courant;
use super::mesh::{centre, check_faces, mean_area, volume};
use super::riemann::GasState;
use super::{Cells, Scheme};
use crate::detonation::{EquationOfState, Symmetry};
use crate::error::{Error, Result, not_negative};

/// How a run is to be computed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ViscositySettings {
    /// `b`, 0 or more: cells over which a strong shock spreads, as half its width. Default 1.4.
    pub quadratic: f64,
    /// `d`, 0 or more: damps what is left of the ringing, and weak shocks. Default 0.2.
    pub linear: f64,
    /// Courant number, above 0 and up to 1; default 0.4.
    pub courant: f64,
    /// Pressure [Pa] on the last face if it is free to move; `None`: it is a wall.
    pub outer_pressure: Option<f64>,
    /// Velocity [m/s] at which the first face is driven as a piston; 0: a wall or the centre.
    pub piston: f64,
}

impl Default for ViscositySettings {
    fn default() -> Self {
        ViscositySettings { quadratic: 1.4, linear: 0.2, courant: 0.4, outer_pressure: None, piston: 0.0 }
    }
}

/// A flow under way.
#[derive(Debug, Clone)]
pub struct Viscosity {
    symmetry: Symmetry,
    settings: ViscositySettings,
    /// Equation of state of each region, and the cell at which it ends.
    regions: Vec<(usize, EquationOfState)>,
    time: f64,
    /// The last step [s]: velocities lag half of it behind.
    last_step: f64,
    face: Vec<f64>,
    face_velocity: Vec<f64>,
    mass: Vec<f64>,
    /// Mass that moves with each face.
    face_mass: Vec<f64>,
    centre: Vec<f64>,
    density: Vec<f64>,
    energy: Vec<f64>,
    pressure: Vec<f64>,
    viscous: Vec<f64>,
    sound_speed: Vec<f64>,
}

impl Viscosity {
    /// A flow that starts from `cells`; a face takes the mean velocity of its neighbours.
    pub fn new(cells: &Cells, settings: ViscositySettings) -> Result<Viscosity> {
        check_courant(settings.courant)?;
        not_negative("quadratic viscosity", settings.quadratic)?;
        not_negative("linear viscosity", settings.linear)?;
        cells.validate()?;
        check_faces(cells.symmetry, &cells.face)?;
        let count = cells.density.len();
        let mut end = 0;
        let regions = cells.regions.iter().map(|(size, state)| {
            end += size;
            (end, *state)
        });
        let mut flow = Viscosity {
            symmetry: cells.symmetry,
            settings,
            regions: regions.collect(),
            time: 0.0,
            last_step: 0.0,
            face: cells.face.clone(),
            face_velocity: vec![0.0; count + 1],
            mass: vec![0.0; count],
            face_mass: vec![0.0; count + 1],
            centre: vec![0.0; count],
            density: cells.density.clone(),
            energy: cells.energy.clone(),
            pressure: vec![0.0; count],
            viscous: vec![0.0; count],
            sound_speed: vec![0.0; count],
        };
        for cell in 0..count {
            flow.mass[cell] =
                flow.density[cell] * volume(flow.symmetry, flow.face[cell], flow.face[cell + 1]);
        }
        for face in 0..=count {
            let (before, after) = (face.saturating_sub(1), face.min(count - 1));
            let inner = if face > 0 { 0.5 * flow.mass[before] } else { 0.0 };
            let outer = if face < count { 0.5 * flow.mass[after] } else { 0.0 };
            flow.face_mass[face] = inner + outer;
            flow.face_velocity[face] = 0.5 * (cells.velocity[before] + cells.velocity[after]);
        }
        flow.face_velocity[0] = settings.piston;
        if settings.outer_pressure.is_none() {
            flow.face_velocity[count] = 0.0;
        }
        flow.set_states();
        Ok(flow)
    }

    /// Mass and energy in the mesh, per unit of solid angle, angle or area. Velocities lag half a step.
    pub fn totals(&self) -> (f64, f64) {
        let kinetic = |face: usize| 0.5 * self.face_mass[face] * self.face_velocity[face].powi(2);
        let internal: f64 = (0..self.mass.len()).map(|cell| self.mass[cell] * self.energy[cell]).sum();
        (self.mass.iter().sum(), internal + (0..self.face.len()).map(kinetic).sum::<f64>())
    }

    /// The longest stable step [s]: sound, and the viscosity's own diffusion, must not cross a cell.
    fn stable_step(&self) -> f64 {
        let mut rate = 0.0_f64;
        let (b, d) = (self.settings.quadratic, self.settings.linear);
        for cell in 0..self.mass.len() {
            let width = self.face[cell + 1] - self.face[cell];
            let squeeze = (self.face_velocity[cell] - self.face_velocity[cell + 1]).max(0.0);
            let sound = self.sound_speed[cell];
            let here = (sound * (1.0 + 2.0 * d) + (1.0 + 4.0 * b * b) * squeeze) / width;
            rate = rate.max(here);
        }
        // A step may not grow at once: the velocities were centred by the last one.
        let longest = self.settings.courant / rate;
        if self.last_step > 0.0 { longest.min(1.1 * self.last_step) } else { longest }
    }

    /// Pressure on the cells pushes the faces, over the mean of the last step and this one.
    fn push(&mut self, step: f64) {
        let count = self.mass.len();
        let between = 0.5 * (self.last_step + step);
        for face in 1..=count {
            let beyond = if face < count {
                self.pressure[face] + self.viscous[face]
            } else {
                match self.settings.outer_pressure {
                    Some(pressure) => pressure,
                    None => continue,
                }
            };
            let difference = self.pressure[face - 1] + self.viscous[face - 1] - beyond;
            let at = self.face[face];
            let area = mean_area(self.symmetry, at, at);
            self.face_velocity[face] += between * area * difference / self.face_mass[face];
        }
    }

    /// Faces move, cells are squeezed, and the work of pressure and viscosity heats them (2.13).
    fn squeeze(&mut self, step: f64) -> Result<()> {
        let (b, d) = (self.settings.quadratic, self.settings.linear);
        for (face, velocity) in self.face.iter_mut().zip(&self.face_velocity) {
            *face += step * velocity;
        }
        let mut from = 0;
        for (end, state) in &self.regions {
            let grip = state.gruneisen();
            for cell in from..*end {
                let (low, high) = (self.face[cell], self.face[cell + 1]);
                let before = self.density[cell];
                let after = self.mass[cell] / volume(self.symmetry, low, high);
                if !(after > 0.0 && after.is_finite()) {
                    return Err(Error::Malformed(format!(
                        "at {:.6e} s two faces cross {low:.6} m out; lower the Courant number or raise the \
                         viscosity",
                        self.time
                    )));
                }
                let closing = self.face_velocity[cell] - self.face_velocity[cell + 1];
                let viscous = if closing > 0.0 {
                    0.5 * (before + after) * closing * (b * b * closing + d * self.sound_speed[cell])
                } else {
                    0.0
                };
                // p = a + g e at the new density, so that e₁ = e₀ − (½(p₀ + p₁) + q) Δv is linear in e₁.
                let change = 1.0 / after - 1.0 / before;
                let cold = state.cold_pressure(after);
                let known = 0.5 * (self.pressure[cell] + cold) + viscous;
                self.energy[cell] =
                    (self.energy[cell] - known * change) / (1.0 + 0.5 * grip * after * change);
                self.density[cell] = after;
                self.viscous[cell] = viscous;
            }
            from = *end;
        }
        Ok(())
    }

    /// Pressure and speed of sound from density and energy.
    fn set_states(&mut self) {
        let mut from = 0;
        for (end, state) in &self.regions {
            for cell in from..*end {
                let density = self.density[cell];
                let pressure = state.pressure(density, self.energy[cell]);
                self.pressure[cell] = pressure;
                self.sound_speed[cell] = state.sound_speed_squared(density, pressure).max(0.0).sqrt();
                self.centre[cell] = centre(self.symmetry, self.face[cell], self.face[cell + 1]);
            }
            from = *end;
        }
    }
}

impl Scheme for Viscosity {
    fn time(&self) -> f64 {
        self.time
    }

    fn step(&mut self, until: f64) -> Result<()> {
        let step = self.stable_step().min(until - self.time);
        if !(step > 0.0 && step.is_finite()) {
            return Err(Error::Malformed(format!(
                "at {:.6e} s no step is short enough: a cell has no width or no pressure left",
                self.time
            )));
        }
        self.push(step);
        self.squeeze(step)?;
        self.set_states();
        self.last_step = step;
        self.time = if step == until - self.time { until } else { self.time + step };
        Ok(())
    }

    fn face(&self) -> &[f64] {
        &self.face
    }

    fn centre(&self) -> &[f64] {
        &self.centre
    }

    fn density(&self) -> &[f64] {
        &self.density
    }

    fn velocity(&self, cell: usize) -> f64 {
        0.5 * (self.face_velocity[cell] + self.face_velocity[cell + 1])
    }

    fn pressure(&self) -> &[f64] {
        &self.pressure
    }

    fn front(&self) -> Option<(GasState, f64)> {
        None
    }
}
