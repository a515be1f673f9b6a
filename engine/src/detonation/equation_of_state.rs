//! Equations of state of gases: pressure from density and energy.
//!
//! Both are of Mie–Grüneisen form with a constant coefficient, `p = a(ρ) + ω ρ e`: the ideal gas with `a` = 0
//! and `ω` = γ − 1, and the products of a detonation by Jones, Wilkins and Lee.

use crate::charge::TNT_DENSITY;
use crate::error::{Result, positive};

/// Jones–Wilkins–Lee constants of detonation products.
///
/// `p = A (1 − ω/(R1 V)) e^(−R1 V) + B (1 − ω/(R2 V)) e^(−R2 V) + ω E / V` with `V` the volume over that of
/// the unreacted explosive and `E` the energy per volume of unreacted explosive. Source: E. L. Lee, H. C.
/// Hornig, J. W. Kury, "Adiabatic expansion of high explosive detonation products", UCRL-50422 (1968).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jwl {
    /// `A` [Pa].
    pub a: f64,
    /// `B` [Pa].
    pub b: f64,
    /// `R1`, dimensionless.
    pub r1: f64,
    /// `R2`, dimensionless.
    pub r2: f64,
    /// Grüneisen coefficient `ω`, dimensionless: far expanded, the products are an ideal gas of γ = 1 + ω.
    pub omega: f64,
    /// Density of the unreacted explosive [kg/m³].
    pub density: f64,
}

impl Jwl {
    /// Products of cast TNT: B. M. Dobratz, P. C. Crawford, "LLNL Explosives Handbook", UCRL-52997 (1985).
    pub const TNT: Jwl =
        Jwl { a: 371.2e9, b: 3.231e9, r1: 4.15, r2: 0.95, omega: 0.30, density: TNT_DENSITY };

    /// `A e^(−R1 V)` and `B e^(−R2 V)` [Pa] at relative volume `v`.
    fn terms(&self, v: f64) -> (f64, f64) {
        (self.a * libm::exp(-self.r1 * v), self.b * libm::exp(-self.r2 * v))
    }
}

/// Pressure of a gas from its density and energy.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum EquationOfState {
    /// `p = (γ − 1) ρ e`.
    Ideal {
        /// Ratio of specific heats, above 1.
        gamma: f64,
    },
    /// Detonation products.
    Jwl(Jwl),
}

impl EquationOfState {
    /// Grüneisen coefficient `ω`: γ − 1 for an ideal gas.
    pub fn gruneisen(&self) -> f64 {
        match self {
            EquationOfState::Ideal { gamma } => gamma - 1.0,
            EquationOfState::Jwl(jwl) => jwl.omega,
        }
    }

    /// The part `a(ρ)` [Pa] of the pressure that does not depend on energy, at `density` [kg/m³].
    pub fn cold_pressure(&self, density: f64) -> f64 {
        match self {
            EquationOfState::Ideal { .. } => 0.0,
            EquationOfState::Jwl(jwl) => {
                let v = jwl.density / density;
                let (first, second) = jwl.terms(v);
                first * (1.0 - jwl.omega / (jwl.r1 * v)) + second * (1.0 - jwl.omega / (jwl.r2 * v))
            }
        }
    }

    /// `da/dρ` [m²/s²].
    fn cold_slope(&self, density: f64) -> f64 {
        match self {
            EquationOfState::Ideal { .. } => 0.0,
            EquationOfState::Jwl(jwl) => {
                let v = jwl.density / density;
                let (first, second) = jwl.terms(v);
                let slope = |term: f64, r: f64| term * (jwl.omega / (r * v * v) + jwl.omega / v - r);
                -(slope(first, jwl.r1) + slope(second, jwl.r2)) * v / density
            }
        }
    }

    /// Pressure [Pa] at `density` [kg/m³] and specific internal energy `energy` [J/kg].
    pub fn pressure(&self, density: f64, energy: f64) -> f64 {
        self.cold_pressure(density) + self.gruneisen() * density * energy
    }

    /// Specific internal energy [J/kg] at `density` [kg/m³] and `pressure` [Pa].
    pub fn energy(&self, density: f64, pressure: f64) -> f64 {
        (pressure - self.cold_pressure(density)) / (self.gruneisen() * density)
    }

    /// Speed of sound squared [m²/s²] at `density` [kg/m³] and `pressure` [Pa]: `dp/dρ` at constant entropy.
    pub fn sound_speed_squared(&self, density: f64, pressure: f64) -> f64 {
        let thermal = pressure - self.cold_pressure(density) + self.gruneisen() * pressure;
        self.cold_slope(density) + thermal / density
    }

    /// The curve of constant entropy through `density` [kg/m³] and `pressure` [Pa].
    pub fn isentrope(&self, density: f64, pressure: f64) -> Isentrope {
        let unit = Isentrope { state: *self, coefficient: 0.0, exponent: 1.0 + self.gruneisen() };
        let coefficient = (pressure - unit.pressure(density)) / libm::pow(density, unit.exponent);
        Isentrope { coefficient, ..unit }
    }

    /// Checks that the constants make a gas: γ above 1, or every constant of JWL above 0.
    pub fn validate(&self) -> Result<()> {
        match self {
            EquationOfState::Ideal { gamma } => {
                positive("ratio of specific heats minus 1", gamma - 1.0)?;
            }
            EquationOfState::Jwl(jwl) => {
                for value in [jwl.a, jwl.b, jwl.r1, jwl.r2, jwl.omega, jwl.density] {
                    positive("a constant of the JWL equation of state", value)?;
                }
            }
        }
        Ok(())
    }
}

/// States that a gas passes through without gain or loss of heat.
///
/// `p = A e^(−R1 V) + B e^(−R2 V) + C ρ^(1+ω)`, of which the ideal gas is the case A = B = 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Isentrope {
    state: EquationOfState,
    coefficient: f64,
    exponent: f64,
}

impl Isentrope {
    /// Pressure [Pa] at `density` [kg/m³].
    pub fn pressure(&self, density: f64) -> f64 {
        let cold = match self.state {
            EquationOfState::Ideal { .. } => 0.0,
            EquationOfState::Jwl(jwl) => {
                let (first, second) = jwl.terms(jwl.density / density);
                first + second
            }
        };
        cold + self.coefficient * libm::pow(density, self.exponent)
    }

    /// Speed of sound [m/s] at `density` [kg/m³].
    pub fn sound_speed(&self, density: f64) -> f64 {
        self.state.sound_speed_squared(density, self.pressure(density)).sqrt()
    }

    /// Specific internal energy [J/kg] at `density` [kg/m³].
    pub fn energy(&self, density: f64) -> f64 {
        self.state.energy(density, self.pressure(density))
    }
}
