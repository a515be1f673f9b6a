//! Blast curves: how a blast weakens with scaled distance, whatever the source.
//!
//! Everything here is at sea level ([`Air::SEA_LEVEL`]) and for 1 kg of TNT: `Z` [m/kg^⅓] in, pressures [Pa],
//! velocities [m/s], times [s/kg^⅓] and impulses [Pa s/kg^⅓] out. [`super::field`] scales the answers to a
//! charge and an atmosphere.
//!
//! **What a source lacks** is derived, and [`Curves::derived`] names it:
//! - front velocity, dynamic and reflected pressure by Rankine–Hugoniot of the source's overpressure;
//! - duration and impulse from Kingery–Bulmash (spherical) at the same `Z`: the momentum of a blast depends
//!   on the charge and the distance, hardly on how a source fits the peak, so the peak only reshapes the
//!   pulse;
//! - reflected impulse: impulse times Kingery–Bulmash's own ratio of the two at the same `Z`.
//!
//! **Outside a source's range** see [`extension`]; [`CurvePoint::extension`] says that it was needed.

mod brode;
pub mod extension;
mod henrych;
mod hydrocode;
mod kingery_bulmash;
mod kinney_graham;
mod table;

use std::sync::Arc;

use crate::air::{Air, Shock, normal_reflection};
use crate::charge::{Burst, SURFACE_ENERGY_FACTOR, TNT_DENSITY, TNT_DETONATION_VELOCITY};
pub use crate::charge::{CurveSource, CurveTable};
use crate::error::Result;
use extension::{Extension, FarField, NearField};

/// Scaled distance `Z = R / W^⅓` (2.18) [m/kg^⅓] at `distance` [m] from `tnt_mass` [kg].
pub fn scaled_distance(distance: f64, tnt_mass: f64) -> f64 {
    distance / libm::cbrt(tnt_mass)
}

/// Distance [m] at which `other_mass` [kg] of TNT gives the overpressure that `tnt_mass` [kg] gives at
/// `distance` [m] (2.19).
pub fn equivalent_distance(distance: f64, tnt_mass: f64, other_mass: f64) -> f64 {
    distance * libm::cbrt(other_mass / tnt_mass)
}

/// A quantity that curves give.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Peak static overpressure.
    Overpressure,
    /// Peak overpressure on a wall struck head-on.
    ReflectedPressure,
    /// Peak dynamic pressure.
    DynamicPressure,
    /// Speed of the front.
    FrontVelocity,
    /// Duration of the positive phase.
    Duration,
    /// Impulse of the positive phase.
    Impulse,
    /// Impulse of the positive phase on a wall struck head-on.
    ReflectedImpulse,
    /// Time of the front's arrival.
    ArrivalTime,
}

/// What curves say at one scaled distance, at sea level for 1 kg of TNT.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurvePoint {
    /// Peak static overpressure [Pa].
    pub overpressure: f64,
    /// Peak overpressure on a wall struck head-on [Pa].
    pub reflected_pressure: f64,
    /// Peak dynamic pressure [Pa].
    pub dynamic_pressure: f64,
    /// Speed of the front [m/s].
    pub front_velocity: f64,
    /// Duration of the positive phase [s/kg^⅓].
    pub duration: f64,
    /// Impulse of the positive phase [Pa s/kg^⅓].
    pub impulse: f64,
    /// Impulse of the positive phase on a wall struck head-on [Pa s/kg^⅓].
    pub reflected_impulse: f64,
    /// Whether the source itself reaches this far.
    pub extension: Extension,
}

/// What a source says itself within its range; `None` where it is silent.
pub(crate) struct Given {
    overpressure: f64,
    reflected_pressure: Option<f64>,
    dynamic_pressure: Option<f64>,
    front_velocity: Option<f64>,
    duration: Option<f64>,
    impulse: Option<f64>,
    reflected_impulse: Option<f64>,
}

impl Given {
    fn only(overpressure: f64) -> Given {
        Given {
            overpressure,
            reflected_pressure: None,
            dynamic_pressure: None,
            front_velocity: None,
            duration: None,
            impulse: None,
            reflected_impulse: None,
        }
    }
}

/// One published or user-made set of curves, asked only within its range.
trait Source: core::fmt::Debug + Send + Sync {
    /// Nearest and farthest scaled distance.
    fn range(&self) -> (f64, f64);
    /// Peak static overpressure [Pa].
    fn overpressure(&self, z: f64) -> f64;
    /// Everything at once.
    fn given(&self, z: f64) -> Given;
    /// Speed of the front [m/s], if the source has its own.
    fn front_velocity(&self, _z: f64) -> Option<f64> {
        None
    }
    /// Arrival time [s/kg^⅓], if the source has its own.
    fn arrival_time(&self, _z: f64) -> Option<f64> {
        None
    }
}

/// A source of curves, completed and extended: an answer at every scaled distance.
#[derive(Debug, Clone)]
pub struct Curves {
    source: Arc<dyn Source>,
    /// Kingery–Bulmash, spherical, for what the source lacks; `None` where the source is Kingery–Bulmash.
    reference: Option<Arc<Curves>>,
    energy_factor: f64,
    near: NearField,
    far: FarField,
}

impl Curves {
    /// Prepares the curves of `source` for a burst; an error if a table is not valid.
    pub fn new(source: &CurveSource, burst: Burst) -> Result<Curves> {
        let (source, energy_factor): (Arc<dyn Source>, f64) = match source {
            CurveSource::KingeryBulmash => return Ok(Curves::kingery_bulmash(burst)),
            CurveSource::Brode => (Arc::new(brode::Brode), surface_factor(burst)),
            CurveSource::Henrych => (Arc::new(henrych::Henrych), surface_factor(burst)),
            CurveSource::KinneyGraham => (Arc::new(kinney_graham::KinneyGraham), surface_factor(burst)),
            CurveSource::Hydrocode => (Arc::new(hydrocode::curves()), surface_factor(burst)),
            CurveSource::Table(samples) => {
                samples.validate()?;
                (Arc::new(table::LogTable::new(samples)), surface_factor(burst))
            }
        };
        let reference = Some(Arc::new(Curves::kingery_bulmash(Burst::Air)));
        Ok(Curves::assemble(source, reference, energy_factor))
    }

    fn kingery_bulmash(burst: Burst) -> Curves {
        Curves::assemble(Arc::new(kingery_bulmash::KingeryBulmash::new(burst)), None, 1.0)
    }

    fn assemble(source: Arc<dyn Source>, reference: Option<Arc<Curves>>, energy_factor: f64) -> Curves {
        let (inner, outer) = source.range();
        let complete = |z: f64| complete(source.given(z), reference.as_ref().map(|curves| curves.at(z)));
        let near = NearField::new(inner, complete(inner), reference.as_deref());
        let far = FarField::new(outer, complete(outer), |z| source.overpressure(z));
        Curves { source, reference, energy_factor, near, far }
    }

    /// Factor on the charge's mass before `Z` is formed: 1.8 for a surface burst by curves that only know
    /// spheres (thesis §2.5.1), 1 otherwise (Kingery–Bulmash has its own hemispherical set).
    pub fn energy_factor(&self) -> f64 {
        self.energy_factor
    }

    /// Nearest and farthest scaled distance [m/kg^⅓] that the source itself reaches.
    pub fn range(&self) -> (f64, f64) {
        self.source.range()
    }

    /// The quantities that the source does not give itself.
    pub fn derived(&self) -> Vec<Quantity> {
        let outer = self.source.range().1;
        let given = self.source.given(outer);
        [
            (Quantity::ReflectedPressure, given.reflected_pressure),
            (Quantity::DynamicPressure, given.dynamic_pressure),
            (Quantity::FrontVelocity, given.front_velocity),
            (Quantity::Duration, given.duration),
            (Quantity::Impulse, given.impulse),
            (Quantity::ReflectedImpulse, given.reflected_impulse),
            (Quantity::ArrivalTime, self.source.arrival_time(outer)),
        ]
        .into_iter()
        .filter_map(|(quantity, value)| value.is_none().then_some(quantity))
        .collect()
    }

    /// Everything at scaled distance `z` [m/kg^⅓], 0 or more.
    pub fn at(&self, z: f64) -> CurvePoint {
        let (inner, outer) = self.source.range();
        if z < inner {
            self.near.at(z, self.reference.as_deref())
        } else if z > outer {
            self.far.at(z)
        } else {
            self.inside(z)
        }
    }

    /// Speed of the front [m/s] at scaled distance `z`: [`Curves::at`]'s, at less cost.
    pub fn front_velocity(&self, z: f64) -> f64 {
        let (inner, outer) = self.source.range();
        if z < inner || z > outer {
            return self.at(z).front_velocity;
        }
        self.source
            .front_velocity(z)
            .unwrap_or_else(|| Shock::behind(&Air::SEA_LEVEL, self.source.overpressure(z)).front_velocity)
    }

    /// The source's own arrival time [s/kg^⅓] after detonation; `None` if it has none or does not reach `z`.
    pub fn arrival_time(&self, z: f64) -> Option<f64> {
        let (inner, outer) = self.source.range();
        if (inner..=outer).contains(&z) { self.source.arrival_time(z) } else { None }
    }

    /// Where and when [m/kg^⅓, s/kg^⅓] the front starts: at the source's first own arrival time, else at the
    /// surface of a TNT sphere that detonated from its centre.
    pub(crate) fn front_start(&self) -> (f64, f64) {
        let inner = self.source.range().0;
        match self.source.arrival_time(inner) {
            Some(time) => (inner, time),
            None => {
                let radius = libm::cbrt(3.0 / (4.0 * core::f64::consts::PI * TNT_DENSITY));
                (radius, radius / TNT_DETONATION_VELOCITY)
            }
        }
    }

    fn inside(&self, z: f64) -> CurvePoint {
        complete(self.source.given(z), self.reference.as_ref().map(|reference| reference.at(z)))
    }
}

fn surface_factor(burst: Burst) -> f64 {
    match burst {
        Burst::Air => 1.0,
        Burst::Surface => SURFACE_ENERGY_FACTOR,
    }
}

/// Fills what a source lacks; `reference` is needed only where times or impulses are missing.
fn complete(given: Given, reference: Option<CurvePoint>) -> CurvePoint {
    let overpressure = given.overpressure;
    let shock = Shock::behind(&Air::SEA_LEVEL, overpressure);
    let from_reference = |pick: fn(&CurvePoint) -> f64| reference.as_ref().map_or(0.0, pick);
    let impulse = given.impulse.unwrap_or_else(|| from_reference(|point| point.impulse));
    CurvePoint {
        overpressure,
        reflected_pressure: given
            .reflected_pressure
            .unwrap_or_else(|| normal_reflection(&Air::SEA_LEVEL, overpressure)),
        dynamic_pressure: given.dynamic_pressure.unwrap_or(shock.dynamic_pressure),
        front_velocity: given.front_velocity.unwrap_or(shock.front_velocity),
        duration: given.duration.unwrap_or_else(|| from_reference(|point| point.duration)),
        impulse,
        reflected_impulse: given
            .reflected_impulse
            .unwrap_or_else(|| impulse * from_reference(|point| point.reflected_impulse / point.impulse)),
        extension: Extension::Inside,
    }
}
