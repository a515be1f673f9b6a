//! From mass, momentum and energy back to the gas, and what to do where there is none.

use super::{Godunov, Region};
use crate::detonation::EquationOfState;
use crate::error::{Error, Result};
use crate::hydrocode::mesh::{centre, volume};

/// Internal energy over kinetic energy below which the former is lost in the rounding of the latter.
const COLD: f64 = 1e-10;

impl Godunov {
    /// The gas from mass, momentum and energy; an error where there is none left.
    pub(super) fn recover(&mut self) -> Result<()> {
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

    pub(super) fn unhealthy(&self) -> Error {
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
