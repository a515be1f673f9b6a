//! The Sedov–Taylor solution: energy let go at a point, a line or a plane in a gas without pressure.
//!
//! Closed form in a parameter. Source: L. I. Sedov, "Similarity and Dimensional Methods in Mechanics" (1959);
//! written as in J. R. Kamm, F. X. Timmes, "On efficient generation of numerically robust Sedov solutions",
//! LA-UR-07-2849 (2007), for uniform density and γ below 2 (7 in the sphere: no vacuum inside).

use super::riemann::GasState;
use crate::detonation::Symmetry;
use crate::error::{Error, Result, positive};
use crate::root::bisect;

/// A strong blast from a point, a line or a plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sedov {
    /// 1, 2 or 3 dimensions.
    dimensions: f64,
    gamma: f64,
    density: f64,
    energy: f64,
    /// `α` in `R = (E t²/(α ρ))^(1/(j + 2))`.
    alpha: f64,
}

impl Sedov {
    /// A blast of `energy` [J; J/m along a line; J/m² of a plane, to both sides] in gas of `density` [kg/m³].
    pub fn new(symmetry: Symmetry, gamma: f64, density: f64, energy: f64) -> Result<Sedov> {
        positive("density [kg/m³]", density)?;
        positive("energy [J]", energy)?;
        if !(gamma > 1.0 && gamma < 2.0) {
            return Err(Error::OutOfRange {
                what: "ratio of specific heats",
                value: gamma,
                expected: "between 1 and 2",
            });
        }
        let dimensions = f64::from(symmetry.exponent() + 1);
        let mut sedov = Sedov { dimensions, gamma, density, energy, alpha: 1.0 };
        sedov.alpha = sedov.energy_integral(symmetry);
        Ok(sedov)
    }

    /// The energy constant `α`; 0.851072 for the sphere and γ = 1.4.
    pub fn alpha(&self) -> f64 {
        self.alpha
    }

    /// Radius of the shock [m] at `time` [s].
    pub fn radius(&self, time: f64) -> f64 {
        let scale = self.energy * time * time / (self.alpha * self.density);
        libm::pow(scale, 1.0 / (self.dimensions + 2.0))
    }

    /// The gas at `distance` [m] and `time` [s, above 0]; at rest and without pressure outside the shock.
    pub fn at(&self, distance: f64, time: f64) -> GasState {
        let radius = self.radius(time);
        if distance > radius {
            return GasState { density: self.density, velocity: 0.0, pressure: 0.0 };
        }
        let shock = self.behind(2.0 / (self.dimensions + 2.0) * radius / time);
        let (_, f, g, h) = self.shape(self.parameter(distance / radius));
        GasState { density: shock.density * g, velocity: shock.velocity * f, pressure: shock.pressure * h }
    }

    fn behind(&self, speed: f64) -> GasState {
        let gamma = self.gamma;
        GasState {
            density: self.density * (gamma + 1.0) / (gamma - 1.0),
            velocity: 2.0 / (gamma + 1.0) * speed,
            pressure: 2.0 / (gamma + 1.0) * self.density * speed * speed,
        }
    }

    /// The parameter `V`, from the centre to the shock.
    fn ends(&self) -> (f64, f64) {
        let j2 = self.dimensions + 2.0;
        (2.0 / (j2 * self.gamma), 4.0 / (j2 * (self.gamma + 1.0)))
    }

    /// How far the parameter `V` lies from its value at the centre, at `place` = r/R.
    fn parameter(&self, place: f64) -> f64 {
        let (centre, shock) = self.ends();
        // The place grows steeply near the centre: search in the logarithm of the distance from it.
        let span = shock - centre;
        let v = |log: f64| span * libm::exp(log);
        v(bisect(-600.0, 0.0, |log| self.place(v(log)) - place).min(0.0))
    }

    /// Distance over that of the shock, where the parameter lies `from_centre` from its value at the centre.
    fn place(&self, from_centre: f64) -> f64 {
        let (x, a) = (self.factors(from_centre), self.exponents());
        let log = libm::log;
        libm::exp(-a[0] * log(x[0]) - a[2] * log(x[1]) - a[1] * log(x[2]))
    }

    /// Distance, velocity, density and pressure over those at the shock.
    fn shape(&self, from_centre: f64) -> (f64, f64, f64, f64) {
        let (x, a) = (self.factors(from_centre), self.exponents());
        let (place, power) = (self.place(from_centre), libm::pow);
        let density = power(x[1], a[3]) * power(x[2], a[4]) * power(x[3], a[5]);
        let pressure =
            power(x[0], a[0] * self.dimensions) * power(x[2], a[4] - 2.0 * a[1]) * power(x[3], 1.0 + a[5]);
        (place, x[0] * place, density, pressure)
    }

    /// `x₁` to `x₄` of Kamm and Timmes: each 1 at the shock.
    fn factors(&self, from_centre: f64) -> [f64; 4] {
        let v = self.ends().0 + from_centre;
        let (j, gamma) = (self.dimensions, self.gamma);
        let j2 = j + 2.0;
        let b = (gamma + 1.0) / (gamma - 1.0);
        let c = j2 * gamma / 2.0;
        let d = j2 * (gamma + 1.0) / (j2 * (gamma + 1.0) - 2.0 * (2.0 + j * (gamma - 1.0)));
        let e = (2.0 + j * (gamma - 1.0)) / 2.0;
        [
            j2 * (gamma + 1.0) / 4.0 * v,
            // `c V − 1`, a small difference near the centre.
            b * c * from_centre,
            d * (1.0 - e * v),
            b * (1.0 - c * v / gamma),
        ]
    }

    /// `α₀` to `α₅` of Kamm and Timmes, for uniform density.
    fn exponents(&self) -> [f64; 6] {
        let (j, gamma) = (self.dimensions, self.gamma);
        let j2 = j + 2.0;
        let a2 = -(gamma - 1.0) / (2.0 * (gamma - 1.0) + j);
        let a1 = j2 * gamma / (2.0 + j * (gamma - 1.0)) * (2.0 * j * (2.0 - gamma) / (gamma * j2 * j2) - a2);
        let a3 = j / (2.0 * (gamma - 1.0) + j);
        [2.0 / j2, a1, a2, a3, a1 * j2 / (2.0 - gamma), -2.0 / (2.0 - gamma)]
    }

    /// `α`: the energy inside a shock of radius 1 at time 1, over the density.
    fn energy_integral(&self, symmetry: Symmetry) -> f64 {
        let shock = self.behind(2.0 / (self.dimensions + 2.0));
        let (centre, end) = self.ends();
        let (steps, deepest) = (20_000, -60.0);
        let row = |index: i32| {
            let log = deepest * (1.0 - f64::from(index) / f64::from(steps));
            let (place, f, g, h) = self.shape((end - centre) * libm::exp(log));
            let kinetic = 0.5 * shock.density * g * (shock.velocity * f) * (shock.velocity * f);
            (libm::pow(place, self.dimensions), kinetic + shock.pressure * h / (self.gamma - 1.0))
        };
        // Trapezium over the volume, and the core inside the first sample at its nearly uniform pressure.
        let mut last = row(0);
        let mut sum = last.0 * last.1;
        for index in 1..=steps {
            let next = row(index);
            sum += 0.5 * (last.1 + next.1) * (next.0 - last.0);
            last = next;
        }
        let whole = match symmetry {
            Symmetry::Plane => 2.0,
            Symmetry::Cylindrical => core::f64::consts::PI,
            Symmetry::Spherical => 4.0 / 3.0 * core::f64::consts::PI,
        };
        whole * sum / self.density
    }
}
