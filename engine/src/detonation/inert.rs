//! Shocks in inert material: the Hugoniot by the measured relation of front and particle velocity.

use crate::error::{Result, not_negative, positive};

/// A material whose front velocity is a polynomial of its particle velocity, `D = c0 + s1 u + s2 u²` (2.9).
///
/// The thesis prints `s2 u`; the second coefficient belongs to the square, or it could not be told from the
/// first. The pressure ahead of the front is neglected against that behind it, as in (2.3).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Inert {
    /// Density at rest [kg/m³].
    pub density: f64,
    /// Speed of sound at zero pressure `c0` [m/s].
    pub sound_speed: f64,
    /// `s1`, dimensionless, 0 or more.
    pub slope: f64,
    /// `s2` [s/m].
    pub curvature: f64,
}

impl Inert {
    /// Copper: `c0` = 3940 m/s, `s1` = 1.489. Source: S. P. Marsh, "LASL Shock Hugoniot Data" (1980).
    pub const COPPER: Inert = Inert { density: 8930.0, sound_speed: 3940.0, slope: 1.489, curvature: 0.0 };

    /// Velocity of the front [m/s] behind which the material moves at `velocity` [m/s, 0 or more] (2.9).
    pub fn front_velocity(&self, velocity: f64) -> f64 {
        self.sound_speed + velocity * (self.slope + velocity * self.curvature)
    }

    /// The Hugoniot in p–u: pressure [Pa] behind a front whose material moves at `velocity` [m/s] (2.2).
    pub fn pressure(&self, velocity: f64) -> f64 {
        rayleigh(self.density, self.front_velocity(velocity), velocity)
    }

    /// Specific volume [m³/kg] behind the front, from conservation of mass (2.7).
    pub fn specific_volume(&self, velocity: f64) -> f64 {
        (1.0 - velocity / self.front_velocity(velocity)) / self.density
    }

    /// Gain of specific internal energy [J/kg] across the front (2.5): half the square of the velocity.
    pub fn energy(&self, velocity: f64) -> f64 {
        0.5 * self.pressure(velocity) * (1.0 / self.density - self.specific_volume(velocity))
    }

    /// Checks that density and speed of sound are above 0 and the slope is not negative.
    pub fn validate(&self) -> Result<()> {
        positive("density of the material [kg/m³]", self.density)?;
        positive("speed of sound c0 [m/s]", self.sound_speed)?;
        not_negative("slope s1 of front over particle velocity", self.slope)?;
        not_negative("curvature s2 of front over particle velocity [s/m]", self.curvature)?;
        Ok(())
    }
}

/// The Rayleigh line in p–u [Pa]: the momentum that a front of `front_velocity` [m/s] gives to material of
/// `density` [kg/m³] that it brings to `velocity` [m/s] (2.2).
pub fn rayleigh(density: f64, front_velocity: f64, velocity: f64) -> f64 {
    density * front_velocity * velocity
}
