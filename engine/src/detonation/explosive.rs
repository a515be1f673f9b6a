//! An explosive whose reaction is over at the front: its Hugoniot, Rayleigh lines and Chapman–Jouguet point.
//!
//! Thesis §2.2.2, (2.1)–(2.8). One dimension, steady. The Hugoniot of the products does not pass through the
//! initial state, since the reaction's energy lies between them. A Rayleigh line of too small a front velocity
//! misses it; of the one that touches it, the touching point is Chapman and Jouguet's; of a greater velocity
//! there are two crossings, the strong one (more pressure) and the weak one.

use super::equation_of_state::{EquationOfState, Jwl};
use crate::charge::TNT_DENSITY;
use crate::error::{Error, Result, finite, not_negative, positive};
use crate::root::bisect;

/// An explosive: its state at rest, and the gas that it becomes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Explosive {
    /// Density at rest [kg/m³].
    pub density: f64,
    /// Pressure at rest [Pa], 0 or more; negligible for a solid.
    pub pressure: f64,
    /// Energy per mass [J/kg] of the explosive at rest, on the scale of the products' equation of state: what
    /// the products would hold if it reacted in a closed vessel.
    pub energy: f64,
    /// The products.
    pub products: EquationOfState,
}

/// The gas behind a front.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Behind {
    /// Velocity of the front [m/s].
    pub front_velocity: f64,
    /// Pressure [Pa].
    pub pressure: f64,
    /// Density [kg/m³].
    pub density: f64,
    /// Velocity of the gas [m/s], in the front's direction.
    pub velocity: f64,
    /// Speed of sound in it [m/s].
    pub sound_speed: f64,
    /// Specific internal energy [J/kg].
    pub energy: f64,
}

impl Explosive {
    /// Cast TNT with JWL products: 7.0 GJ per cubic metre. Dobratz and Crawford (1985) give for it a
    /// detonation velocity of 6930 m/s and a Chapman–Jouguet pressure of 21.0 GPa.
    pub const TNT: Explosive = Explosive {
        density: TNT_DENSITY,
        pressure: 0.0,
        energy: 7.0e9 / TNT_DENSITY,
        products: EquationOfState::Jwl(Jwl::TNT),
    };

    /// An explosive that becomes an ideal gas, with the given front velocity [m/s] and pressure [Pa] at its
    /// Chapman–Jouguet point, from `density` [kg/m³] and no pressure at rest.
    ///
    /// `γ = ρ0 D²/p − 1` and `q = D²/(2(γ² − 1))`: the two relations of a strong detonation in an ideal gas
    /// (Fickett and Davis, "Detonation", 1979, §2).
    pub fn ideal(density: f64, front_velocity: f64, pressure: f64) -> Result<Explosive> {
        positive("density of the explosive [kg/m³]", density)?;
        positive("detonation velocity [m/s]", front_velocity)?;
        positive("Chapman–Jouguet pressure [Pa]", pressure)?;
        let gamma = density * front_velocity * front_velocity / pressure - 1.0;
        if gamma <= 1.0 {
            return Err(Error::OutOfRange {
                what: "Chapman–Jouguet pressure [Pa]",
                value: pressure,
                expected: "less than half of density times detonation velocity squared",
            });
        }
        let energy = front_velocity * front_velocity / (2.0 * (gamma * gamma - 1.0));
        Ok(Explosive { density, pressure: 0.0, energy, products: EquationOfState::Ideal { gamma } })
    }

    /// Checks that density and energy are above 0 and the products are a gas.
    pub fn validate(&self) -> Result<()> {
        positive("density of the explosive [kg/m³]", self.density)?;
        not_negative("pressure of the explosive at rest [Pa]", self.pressure)?;
        positive("energy of the explosive [J/kg]", self.energy)?;
        self.products.validate()
    }

    /// Specific volume at rest [m³/kg].
    pub fn specific_volume(&self) -> f64 {
        1.0 / self.density
    }

    /// The Hugoniot in p–v (2.5): pressure [Pa] of products at specific volume `volume` [m³/kg], which must
    /// exceed [`Explosive::least_volume`].
    pub fn hugoniot(&self, volume: f64) -> f64 {
        let stiffness = self.products.gruneisen() / volume;
        let half = 0.5 * (self.specific_volume() - volume);
        (self.products.cold_pressure(1.0 / volume) + stiffness * (self.energy + self.pressure * half))
            / (1.0 - stiffness * half)
    }

    /// The specific volume [m³/kg] that no front, however strong, can reach.
    pub fn least_volume(&self) -> f64 {
        let omega = self.products.gruneisen();
        self.specific_volume() * omega / (omega + 2.0)
    }

    /// The Rayleigh line in p–v (2.8): pressure [Pa] at specific volume `volume` [m³/kg] behind a front of
    /// `front_velocity` [m/s].
    pub fn rayleigh(&self, front_velocity: f64, volume: f64) -> f64 {
        let mass_flux = self.density * front_velocity;
        self.pressure + (self.specific_volume() - volume) * mass_flux * mass_flux
    }

    /// The products on the Hugoniot at specific volume `volume` [m³/kg], less than at rest.
    pub fn behind(&self, volume: f64) -> Behind {
        let pressure = self.hugoniot(volume);
        let rise = pressure - self.pressure;
        let fall = self.specific_volume() - volume;
        let density = 1.0 / volume;
        Behind {
            front_velocity: self.specific_volume() * (rise / fall).sqrt(),
            pressure,
            density,
            velocity: (rise * fall).sqrt(),
            sound_speed: self.products.sound_speed_squared(density, pressure).sqrt(),
            energy: self.products.energy(density, pressure),
        }
    }

    /// The Chapman–Jouguet point: where the Rayleigh line touches the Hugoniot, and the gas leaves the front
    /// at the speed of sound.
    pub fn chapman_jouguet(&self) -> Result<Behind> {
        self.validate()?;
        let (low, high) = (self.least_volume() * (1.0 + 1e-9), self.specific_volume() * (1.0 - 1e-9));
        let volume = bisect(low, high, |volume| {
            let state = self.behind(volume);
            let away = state.front_velocity - state.velocity;
            state.sound_speed / away - 1.0
        });
        Ok(self.behind(volume))
    }

    /// The strong and the weak solution for a front of `front_velocity` [m/s], which must not be less than
    /// the Chapman–Jouguet velocity.
    pub fn solutions(&self, front_velocity: f64) -> Result<(Behind, Behind)> {
        finite("front velocity [m/s]", front_velocity)?;
        let touching = self.chapman_jouguet()?;
        if front_velocity < touching.front_velocity {
            return Err(Error::OutOfRange {
                what: "front velocity [m/s]",
                value: front_velocity,
                expected: "at least the Chapman–Jouguet velocity, below which no steady front exists",
            });
        }
        let apart = |volume: f64| self.hugoniot(volume) - self.rayleigh(front_velocity, volume);
        let volume = 1.0 / touching.density;
        let strong = bisect(self.least_volume() * (1.0 + 1e-9), volume, apart);
        let weak = bisect(volume, self.specific_volume() * (1.0 - 1e-12), apart);
        Ok((self.behind(strong), self.behind(weak)))
    }
}
