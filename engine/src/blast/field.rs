//! One charge in one atmosphere, as one question with one answer: at this point, when and how hard?
//!
//! Curves and front are those of 1 kg of TNT at sea level. Sachs scaling carries them here: with `W` the
//! equivalent mass of TNT, `p0`, `a0` the ambient pressure and speed of sound and `*` sea level, lengths go
//! as `(W p0*/p0)^⅓`, pressures as `p0/p0*`, velocities as `a0/a0*`, times as lengths over velocities.
//! Density and gas velocity behind the front are Rankine–Hugoniot's of the overpressure in the ambient air.

use glam::DVec3;

use super::curves::extension::Extension;
use super::curves::{Curves, scaled_distance};
use super::front::{Front, STEP};
use super::negative::negative_phase;
use super::pulse::{NegativePhase, Pulse, PulseShape, friedlander_fit};
use super::reflection::reflection_coefficient;
use crate::air::{Air, Shock};
use crate::charge::{Burst, Charge};
use crate::error::Result;

/// The blast of one charge, ready to be asked at any point.
#[derive(Debug, Clone)]
pub struct BlastField {
    curves: Curves,
    front: Front,
    position: DVec3,
    detonation: f64,
    air: Air,
    burst: Burst,
    tnt_mass: f64,
    radius: f64,
    scale: Scale,
}

/// Factors from 1 kg at sea level to the charge in its atmosphere.
#[derive(Debug, Clone, Copy)]
struct Scale {
    length: f64,
    pressure: f64,
    velocity: f64,
    time: f64,
    impulse: f64,
}

/// What a charge does at one point: everything about the incident front and what a wall there would feel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BlastPoint {
    /// Distance from the charge [m].
    pub distance: f64,
    /// `Z` (2.18) with the equivalent mass of TNT, without the factors of a surface burst or of altitude
    /// [m/kg^⅓].
    pub scaled_distance: f64,
    /// Unit vector from the charge to the point; +x at the charge itself.
    pub direction: DVec3,
    /// When the front arrives [s of scene time].
    pub arrival_time: f64,
    /// Peak static overpressure [Pa].
    pub overpressure: f64,
    /// Peak dynamic pressure [Pa].
    pub dynamic_pressure: f64,
    /// Speed of the front [m/s].
    pub front_velocity: f64,
    /// Speed of the gas behind the front [m/s].
    pub particle_velocity: f64,
    /// Density of the gas behind the front [kg/m³].
    pub density: f64,
    /// Duration of the positive phase [s]: the curves' own, adjusted where no Friedlander pulse of that
    /// duration carries their impulse ([`friedlander_fit`]).
    pub duration: f64,
    /// Impulse of the positive phase [Pa s].
    pub impulse: f64,
    /// Peak overpressure on a wall struck head-on [Pa].
    pub reflected_pressure: f64,
    /// Impulse of the positive phase on a wall struck head-on [Pa s].
    pub reflected_impulse: f64,
    /// Friedlander decay `b` of the incident pulse.
    pub decay: f64,
    /// Whether the curves themselves reach this point.
    pub extension: Extension,
}

impl BlastPoint {
    /// The incident pulse in the given shape, without suction.
    pub fn pulse(&self, shape: PulseShape) -> Pulse {
        match shape {
            PulseShape::Friedlander => {
                Pulse { peak: self.overpressure, duration: self.duration, decay: self.decay, negative: None }
            }
            _ => Pulse::new(shape, self.overpressure, self.duration, self.impulse),
        }
    }
}

impl BlastField {
    /// Prepares the field of `charge` in `air`; an error if either is not valid.
    pub fn new(charge: &Charge, air: &Air) -> Result<BlastField> {
        charge.validate()?;
        air.validate()?;
        let curves = Curves::new(&charge.curves, charge.burst)?;
        let front = Front::new(&curves, STEP);
        let scale = Scale::new(charge.tnt_mass() * curves.energy_factor(), air);
        Ok(BlastField {
            curves,
            front,
            position: charge.position,
            detonation: charge.time,
            air: *air,
            burst: charge.burst,
            tnt_mass: charge.tnt_mass(),
            radius: charge.radius(),
            scale,
        })
    }

    /// What happens at `point` [m].
    pub fn at(&self, point: DVec3) -> BlastPoint {
        let offset = point - self.position;
        let distance = offset.length();
        let direction = if distance > 0.0 { offset / distance } else { DVec3::X };
        BlastPoint { direction, ..self.at_distance(distance) }
    }

    /// What happens at `distance` [m, 0 or more] in direction +x.
    pub fn at_distance(&self, distance: f64) -> BlastPoint {
        let z = distance / self.scale.length;
        let curve = self.curves.at(z);
        let overpressure = curve.overpressure * self.scale.pressure;
        let shock = Shock::behind(&self.air, overpressure);
        let (duration, decay) = friedlander_fit(curve.overpressure, curve.duration, curve.impulse);
        BlastPoint {
            distance,
            scaled_distance: scaled_distance(distance, self.tnt_mass),
            direction: DVec3::X,
            arrival_time: self.detonation + self.front.arrival_time(z) * self.scale.time,
            overpressure,
            dynamic_pressure: curve.dynamic_pressure * self.scale.pressure,
            front_velocity: curve.front_velocity * self.scale.velocity,
            particle_velocity: shock.particle_velocity,
            density: shock.density,
            duration: duration * self.scale.time,
            impulse: curve.impulse * self.scale.impulse,
            reflected_pressure: curve.reflected_pressure * self.scale.pressure,
            reflected_impulse: curve.reflected_impulse * self.scale.impulse,
            decay,
            extension: curve.extension,
        }
    }

    /// When the front arrives at `distance` [m, 0 or more] from the charge [s of scene time].
    pub fn arrival_time(&self, distance: f64) -> f64 {
        self.detonation + self.front.arrival_time(distance / self.scale.length) * self.scale.time
    }

    /// Radius of the front [m] at `time` [s of scene time]; 0 before the detonation.
    pub fn front_radius(&self, time: f64) -> f64 {
        self.front.radius((time - self.detonation) / self.scale.time) * self.scale.length
    }

    /// Reflection coefficient `C_R` of a surface that a front of `overpressure` [Pa] strikes; `cos_alpha` is
    /// the cosine between the surface's outward normal and the direction back to the charge: 1 head-on, 0 and
    /// below grazing or facing away, where `C_R` is 1.
    pub fn reflection_coefficient(&self, cos_alpha: f64, overpressure: f64) -> f64 {
        if cos_alpha <= 0.0 {
            return 1.0;
        }
        reflection_coefficient(libm::acos(cos_alpha.min(1.0)), overpressure / self.scale.pressure)
    }

    /// The suction behind the positive phase at `distance` [m] from the charge.
    pub fn negative_phase(&self, distance: f64) -> NegativePhase {
        let sachs = libm::cbrt(self.scale.pressure);
        let z = scaled_distance(distance, self.tnt_mass) * sachs;
        let phase = negative_phase(z, self.tnt_mass, self.burst);
        NegativePhase {
            peak: phase.peak * self.scale.pressure,
            duration: phase.duration / (sachs * self.scale.velocity),
        }
    }

    /// The curves behind the field, at sea level for 1 kg of TNT.
    pub fn curves(&self) -> &Curves {
        &self.curves
    }

    /// The air that the blast runs into.
    pub fn air(&self) -> &Air {
        &self.air
    }

    /// Where the charge lies [m].
    pub fn position(&self) -> DVec3 {
        self.position
    }

    /// Radius of the charge itself [m], as TNT: a body nearer than this lies inside it.
    pub fn charge_radius(&self) -> f64 {
        self.radius
    }

    /// Nearest and farthest distance [m] that the curves themselves reach.
    pub fn reach(&self) -> (f64, f64) {
        let (inner, outer) = self.curves.range();
        (inner * self.scale.length, outer * self.scale.length)
    }
}

impl Scale {
    /// Sachs scaling for `mass` [kg] of TNT, factors included.
    fn new(mass: f64, air: &Air) -> Scale {
        let pressure = air.pressure / Air::SEA_LEVEL.pressure;
        let velocity = air.sound_speed() / Air::SEA_LEVEL.sound_speed();
        let length = libm::cbrt(mass / pressure);
        let time = length / velocity;
        Scale { length, pressure, velocity, time, impulse: pressure * time }
    }
}
