//! How far a step may go, and where its faces go meanwhile.

use super::columns::Row;
use super::flux::waves;
use super::{Boundary, Godunov, Motion};
use crate::air::Air;
use crate::detonation::Symmetry;
use crate::error::Result;
use crate::hydrocode::riemann::{GasState, RiemannProblem};

impl Godunov {
    /// The longest stable step [s].
    pub(super) fn stable_step(&self) -> f64 {
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

    /// Velocities of the faces over the coming step.
    pub(super) fn move_faces(&mut self, step: f64) -> Result<()> {
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
    pub(super) fn meet_front(&mut self, air: &Air, last: Row) -> Result<f64> {
        let left = GasState { density: last.density, velocity: last.velocity, pressure: last.pressure };
        let still = GasState { density: air.density(), velocity: 0.0, pressure: air.pressure };
        let problem = RiemannProblem::new(left, still, air.gamma)?;
        let speed = problem.heads().1;
        self.front = Some((problem.at(speed * (1.0 - 1e-12)), speed));
        Ok(speed)
    }

    /// Nothing flows through the bound between two gases; through a front flows the still air ahead.
    pub(super) fn set_bound_fluxes(&mut self) {
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
}
