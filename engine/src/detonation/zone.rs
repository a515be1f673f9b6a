//! The reaction zone: Hugoniots of a partly reacted explosive, and the structure that Zeldovich, von Neumann
//! and Döring gave to a detonation.
//!
//! Thesis §2.2.1 and Figs. 2.3, 2.6. The explosive and its products are one ideal gas; the reaction only adds
//! energy, `λ q` when a part `λ` of it is over. The front first shocks the explosive unreacted (`λ` = 0: the
//! von Neumann spike `N`), then the state slides down the Rayleigh line as `λ` grows, to the point that the
//! finished reaction allows. With a single reaction that only proceeds, the weak crossing is never reached.

use super::equation_of_state::EquationOfState;
use super::explosive::Explosive;
use crate::error::{Error, Result, positive};

/// A steady detonation with a reaction of finite rate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Detonation {
    explosive: Explosive,
    gamma: f64,
    front_velocity: f64,
    /// Time [s] in which a particle reacts to its end.
    reaction_time: f64,
}

/// A particle within the reaction zone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ZonePoint {
    /// How far the reaction has come, 0 to 1.
    pub progress: f64,
    /// Time since the front passed the particle [s].
    pub time: f64,
    /// Distance behind the front [m].
    pub distance: f64,
    /// Pressure [Pa].
    pub pressure: f64,
    /// Density [kg/m³].
    pub density: f64,
    /// Velocity of the gas [m/s].
    pub velocity: f64,
}

impl Detonation {
    /// A front of `front_velocity` [m/s] through `explosive`, whose products must be an ideal gas; each
    /// particle reacts within `reaction_time` [s], above 0.
    ///
    /// `front_velocity` must not be less than the Chapman–Jouguet velocity; `None` stands for that one.
    pub fn new(explosive: Explosive, front_velocity: Option<f64>, reaction_time: f64) -> Result<Detonation> {
        positive("reaction time [s]", reaction_time)?;
        let EquationOfState::Ideal { gamma } = explosive.products else {
            return Err(Error::Malformed(
                "a reaction zone needs an explosive whose products are an ideal gas".into(),
            ));
        };
        let least = explosive.chapman_jouguet()?.front_velocity;
        let front_velocity = front_velocity.unwrap_or(least);
        if front_velocity.is_nan() || front_velocity < least {
            return Err(Error::OutOfRange {
                what: "front velocity [m/s]",
                value: front_velocity,
                expected: "at least the Chapman–Jouguet velocity, below which no steady front exists",
            });
        }
        Ok(Detonation { explosive, gamma, front_velocity, reaction_time })
    }

    /// Velocity of the front [m/s].
    pub fn front_velocity(&self) -> f64 {
        self.front_velocity
    }

    /// The Hugoniot in p–u of the gas that has reacted up to `progress` (0 to 1): pressure [Pa] behind a front
    /// that gives it `velocity` [m/s, above 0].
    ///
    /// Mass, momentum and energy leave a quadratic for the front's velocity,
    /// `D² − D ((γ+1) u/2 + (γ−1) λ q/u) − γ p0 v0 = 0`.
    pub fn pressure(&self, velocity: f64, progress: f64) -> f64 {
        let rest = &self.explosive;
        let ahead = rest.pressure * rest.specific_volume();
        let heat = progress * (rest.energy - ahead / (self.gamma - 1.0));
        let half = 0.25 * (self.gamma + 1.0) * velocity + 0.5 * (self.gamma - 1.0) * heat / velocity;
        let front = half + (half * half + self.gamma * ahead).sqrt();
        rest.pressure + rest.density * front * velocity
    }

    /// The state at `progress` (0 to 1): the upper crossing of the Rayleigh line with that Hugoniot, as
    /// pressure [Pa], density [kg/m³] and gas velocity [m/s].
    ///
    /// With `x` = 1 − v/v0 the crossing solves `(γ+1) x²/2 − (1 − γ π) x + (γ−1) λ κ = 0`, where
    /// `π = p0 v0/D²` and `κ = q/D²`; the discriminant vanishes at a Chapman–Jouguet point.
    pub fn state(&self, progress: f64) -> (f64, f64, f64) {
        let rest = &self.explosive;
        let square = self.front_velocity * self.front_velocity;
        let ahead = rest.pressure * rest.specific_volume() / square;
        let heat = rest.energy / square - ahead / (self.gamma - 1.0);
        let linear = 1.0 - self.gamma * ahead;
        let discriminant = linear * linear - 2.0 * (self.gamma + 1.0) * (self.gamma - 1.0) * progress * heat;
        let compression = (linear + discriminant.max(0.0).sqrt()) / (self.gamma + 1.0);
        let volume = rest.specific_volume() * (1.0 - compression);
        let velocity = self.front_velocity * compression;
        (rest.rayleigh(self.front_velocity, volume), 1.0 / volume, velocity)
    }

    /// Rate of reaction `r` (2.14) [1/s] at `progress`: `2 √(1 − λ)` over the reaction time, the simple law of
    /// Fickett and Davis whose zone ends at a finite distance.
    pub fn rate(&self, progress: f64) -> f64 {
        2.0 * (1.0 - progress).max(0.0).sqrt() / self.reaction_time
    }

    /// The zone from the spike to the end of the reaction at `points` (2 or more) equal steps of time.
    ///
    /// The rate law integrates to `λ = 1 − (1 − t/τ)²` (2.14); the distance behind the front is the integral
    /// of `D − u` over time, by Simpson's rule.
    pub fn profile(&self, points: usize) -> Result<Vec<ZonePoint>> {
        if points < 2 {
            return Err(Error::Malformed(format!("a profile has {points} points, but must have at least 2")));
        }
        let share = 1.0 / (points - 1) as f64;
        let progress = |part: f64| 1.0 - (1.0 - part) * (1.0 - part);
        let recession = |part: f64| self.front_velocity - self.state(progress(part)).2;
        let mut distance = 0.0;
        let mut profile = Vec::with_capacity(points);
        for index in 0..points {
            let part = (share * index as f64).min(1.0);
            if index > 0 {
                let (start, middle) = (part - share, part - 0.5 * share);
                distance += share * self.reaction_time / 6.0
                    * (recession(start) + 4.0 * recession(middle) + recession(part));
            }
            let progress = progress(part);
            let (pressure, density, velocity) = self.state(progress);
            let time = part * self.reaction_time;
            profile.push(ZonePoint { progress, time, distance, pressure, density, velocity });
        }
        Ok(profile)
    }
}
