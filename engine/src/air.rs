//! Ambient air and the state behind a shock front moving into it.
//!
//! Source: thesis (2.15)–(2.17), (2.25)–(2.29), written for any ratio of specific heats; the thesis's
//! forms are the case `gamma` = 1.4. The gas is ideal. Real air dissociates behind very strong shocks:
//! above some 100 bar of overpressure its reflected pressure exceeds the ideal limit and its front runs
//! a few percent slower.

use crate::error::{Result, positive};

/// Specific gas constant of dry air [J/(kg K)].
pub const GAS_CONSTANT: f64 = 287.05;

/// The still air that a blast runs into.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Air {
    /// Absolute pressure [Pa], above 0. Sea level: 101 325.
    pub pressure: f64,
    /// Absolute temperature [K], above 0. Standard: 288.15 (15 °C).
    pub temperature: f64,
    /// Ratio of specific heats, above 1. Air: 1.4.
    pub gamma: f64,
}

impl Air {
    /// Air at sea level, 15 °C: the ambient for which blast curves are published.
    pub const SEA_LEVEL: Air = Air { pressure: 101_325.0, temperature: 288.15, gamma: 1.4 };

    /// Density [kg/m³] of an ideal gas (2.25).
    pub fn density(&self) -> f64 {
        self.pressure / (GAS_CONSTANT * self.temperature)
    }

    /// Speed of sound [m/s] (2.26), with the specific gas constant.
    pub fn sound_speed(&self) -> f64 {
        (self.gamma * GAS_CONSTANT * self.temperature).sqrt()
    }

    /// Checks that pressure and temperature are positive and `gamma` is above 1, all finite.
    pub fn validate(&self) -> Result<()> {
        positive("air pressure [Pa]", self.pressure)?;
        positive("air temperature [K]", self.temperature)?;
        positive("ratio of specific heats minus 1", self.gamma - 1.0)?;
        Ok(())
    }
}

impl Default for Air {
    fn default() -> Self {
        Air::SEA_LEVEL
    }
}

/// The gas just behind a shock front that runs into still air.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shock {
    /// Peak static overpressure `ps` [Pa], 0 or more.
    pub overpressure: f64,
    /// Speed of the front `Us` [m/s] (2.15); the speed of sound where `ps` is 0.
    pub front_velocity: f64,
    /// Density `ρs` [kg/m³] (2.16).
    pub density: f64,
    /// Dynamic pressure `qs` = ½ρu² [Pa] (2.17), (2.27).
    pub dynamic_pressure: f64,
    /// Velocity of the gas behind the front [m/s], from conservation of mass (2.1).
    pub particle_velocity: f64,
}

impl Shock {
    /// The Rankine–Hugoniot state behind a front of `overpressure` [Pa, 0 or more].
    ///
    /// With `γ` = 1.4 these are (2.15)–(2.17). Momentum (2.2) gives `ps = ρ0 Us u`, mass (2.1) gives
    /// `ρs (Us − u) = ρ0 Us`.
    pub fn behind(air: &Air, overpressure: f64) -> Shock {
        let Air { pressure, gamma, .. } = *air;
        let stiff = 2.0 * gamma * pressure;
        let front_velocity = air.sound_speed() * (1.0 + (gamma + 1.0) * overpressure / stiff).sqrt();
        let expansion = stiff + (gamma - 1.0) * overpressure;
        Shock {
            overpressure,
            front_velocity,
            density: air.density() * (stiff + (gamma + 1.0) * overpressure) / expansion,
            dynamic_pressure: overpressure * overpressure / expansion,
            particle_velocity: overpressure / (air.density() * front_velocity),
        }
    }
}

/// Overpressure [Pa] on a rigid wall struck head-on by a front of `overpressure` [Pa, 0 or more] (2.28).
///
/// `pr = 2 ps + (γ + 1) qs`, which for `γ` = 1.4 is (2.29). `pr / ps` tends to 2 for weak fronts and to
/// `2 + (γ + 1)/(γ − 1)`, 8 for air, for strong ones.
pub fn normal_reflection(air: &Air, overpressure: f64) -> f64 {
    let Air { pressure, gamma, .. } = *air;
    let dynamic = overpressure * overpressure / (2.0 * gamma * pressure + (gamma - 1.0) * overpressure);
    2.0 * overpressure + (gamma + 1.0) * dynamic
}
