//! The exact solution of Riemann's problem in an ideal gas: what becomes of two states that meet.
//!
//! Source: E. F. Toro, "Riemann Solvers and Numerical Methods for Fluid Dynamics", 3rd edition (2009), chapter
//! 4. The reference for the schemes, which use an approximate solution.

use crate::error::{Error, Result, finite, not_negative, positive};

/// A gas at a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GasState {
    /// Density [kg/m³].
    pub density: f64,
    /// Velocity [m/s].
    pub velocity: f64,
    /// Pressure [Pa].
    pub pressure: f64,
}

impl GasState {
    /// Checks that density is above 0, pressure not negative and velocity finite.
    pub fn validate(&self) -> Result<()> {
        positive("density [kg/m³]", self.density)?;
        finite("velocity [m/s]", self.velocity)?;
        not_negative("pressure [Pa]", self.pressure)?;
        Ok(())
    }
}

/// Two states that meet at `x` = 0 at time 0, and the waves that part from there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RiemannProblem {
    left: GasState,
    right: GasState,
    gamma: f64,
    /// Pressure [Pa] between the two outer waves.
    pub pressure: f64,
    /// Velocity [m/s] of the contact between the two gases.
    pub velocity: f64,
}

impl RiemannProblem {
    /// Solves for the state between the waves; an error if the gases part so fast that a vacuum opens.
    pub fn new(left: GasState, right: GasState, gamma: f64) -> Result<RiemannProblem> {
        for state in [&left, &right] {
            state.validate()?;
            positive("pressure [Pa]", state.pressure)?;
        }
        positive("ratio of specific heats minus 1", gamma - 1.0)?;
        let (cl, cr) = (sound(&left, gamma), sound(&right, gamma));
        let parting = right.velocity - left.velocity;
        let limit = 2.0 * (cl + cr) / (gamma - 1.0);
        if parting >= limit {
            return Err(Error::Malformed(format!(
                "the two gases part at {parting} m/s, which opens a vacuum between them: they must part at \
                 less than {limit} m/s"
            )));
        }
        let total = |pressure: f64| {
            let (fl, dl) = branch(&left, cl, gamma, pressure);
            let (fr, dr) = branch(&right, cr, gamma, pressure);
            (fl + fr + parting, dl + dr, 0.5 * (left.velocity + right.velocity) + 0.5 * (fr - fl))
        };
        // The function rises and is concave: Newton's steps from below stay below the root and approach it.
        let exponent = (gamma - 1.0) / (2.0 * gamma);
        let numerator = cl + cr - 0.5 * (gamma - 1.0) * parting;
        let denominator = cl / libm::pow(left.pressure, exponent) + cr / libm::pow(right.pressure, exponent);
        let two_rarefactions = libm::pow(numerator / denominator, 1.0 / exponent);
        let tiny = 1e-14 * left.pressure.max(right.pressure);
        let mut pressure = if two_rarefactions.is_finite() { two_rarefactions.max(tiny) } else { tiny };
        for _ in 0..100 {
            let (value, slope, _) = total(pressure);
            let next = (pressure - value / slope).max(0.1 * pressure);
            let done = (next - pressure).abs() <= 1e-15 * next;
            pressure = next;
            if done {
                break;
            }
        }
        Ok(RiemannProblem { left, right, gamma, pressure, velocity: total(pressure).2 })
    }

    /// The state on the ray `speed` = x/t [m/s].
    pub fn at(&self, speed: f64) -> GasState {
        if speed < self.velocity {
            return self.side(self.left, self.velocity, speed);
        }
        let mirror = GasState { velocity: -self.right.velocity, ..self.right };
        let mirrored = self.side(mirror, -self.velocity, -speed);
        GasState { velocity: -mirrored.velocity, ..mirrored }
    }

    /// Velocities [m/s] of the head of the left wave and of the right wave.
    pub fn heads(&self) -> (f64, f64) {
        let head = |state: &GasState| {
            let ratio = self.pressure / state.pressure;
            let c = sound(state, self.gamma);
            if ratio > 1.0 { c * shock_mach(ratio, self.gamma) } else { c }
        };
        (self.left.velocity - head(&self.left), self.right.velocity + head(&self.right))
    }

    /// The left half of the solution; the right one is its mirror image.
    fn side(&self, state: GasState, contact: f64, speed: f64) -> GasState {
        let gamma = self.gamma;
        let c = sound(&state, gamma);
        let ratio = self.pressure / state.pressure;
        let beta = (gamma - 1.0) / (gamma + 1.0);
        if ratio > 1.0 {
            if speed < state.velocity - c * shock_mach(ratio, gamma) {
                return state;
            }
            let density = state.density * (ratio + beta) / (beta * ratio + 1.0);
            return GasState { density, velocity: contact, pressure: self.pressure };
        }
        if speed < state.velocity - c {
            return state;
        }
        let inner = c * libm::pow(ratio, (gamma - 1.0) / (2.0 * gamma));
        if speed > contact - inner {
            let density = state.density * libm::pow(ratio, 1.0 / gamma);
            return GasState { density, velocity: contact, pressure: self.pressure };
        }
        let fan = 2.0 / (gamma + 1.0) + beta * (state.velocity - speed) / c;
        GasState {
            density: state.density * libm::pow(fan, 2.0 / (gamma - 1.0)),
            velocity: 2.0 / (gamma + 1.0) * (c + 0.5 * (gamma - 1.0) * state.velocity + speed),
            pressure: state.pressure * libm::pow(fan, 2.0 * gamma / (gamma - 1.0)),
        }
    }
}

fn sound(state: &GasState, gamma: f64) -> f64 {
    (gamma * state.pressure / state.density).sqrt()
}

fn shock_mach(ratio: f64, gamma: f64) -> f64 {
    (((gamma + 1.0) * ratio + gamma - 1.0) / (2.0 * gamma)).sqrt()
}

/// Change of velocity across a wave to `pressure`, and its slope.
fn branch(state: &GasState, c: f64, gamma: f64, pressure: f64) -> (f64, f64) {
    if pressure > state.pressure {
        let a = 2.0 / ((gamma + 1.0) * state.density);
        let b = (gamma - 1.0) / (gamma + 1.0) * state.pressure;
        let root = (a / (pressure + b)).sqrt();
        let rise = pressure - state.pressure;
        (rise * root, root * (1.0 - 0.5 * rise / (pressure + b)))
    } else {
        let exponent = (gamma - 1.0) / (2.0 * gamma);
        let ratio = pressure / state.pressure;
        let change = 2.0 * c / (gamma - 1.0) * (libm::pow(ratio, exponent) - 1.0);
        (change, libm::pow(ratio, -(gamma + 1.0) / (2.0 * gamma)) / (state.density * c))
    }
}
