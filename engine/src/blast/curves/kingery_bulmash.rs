//! Kingery and Bulmash (1984): polynomials through measured TNT bursts, the default curves.
//!
//! Source: C. N. Kingery, G. Bulmash, "Airblast Parameters from TNT Spherical Air Burst and Hemispherical
//! Surface Burst", ARBRL-TR-02555. The coefficients are those of `data/kingery_bulmash.json`, where their
//! verification is recorded: `U = u0 + u1 log10 Z`, `log10 Y = Σ c_i U^i`, `Y` in kPa, ms and m/ms.
//!
//! The set has no dynamic pressure. Its own front velocity agrees with Rankine–Hugoniot of its own
//! overpressure within 3 % for `Z` above 0.3 and runs up to 4.7 % slower nearer in, where air is no longer
//! an ideal gas; its own velocity is what is used. Where two branches of a curve meet they differ by up to
//! 1.8 %; within 0.5 % of `Z` about the joint one is faded into the other, so that the curves are continuous.
//! The duration is only fitted from `Z` = 0.147 (surface: 0.178) outwards; nearer in, where overpressure and
//! impulse are still fitted, the duration is the one that keeps the waveform's shape `i / (ps T)`.

mod coefficients;

use super::{Given, Source};
use crate::charge::Burst;
use coefficients::{HEMISPHERICAL, SPHERICAL};

/// Half width, relative in `Z`, of the band in which two branches are faded into one another.
const FADE: f64 = 0.005;

/// The fitted curves of one burst.
#[derive(Debug)]
struct CurveSet {
    overpressure: &'static [Branch],
    reflected_pressure: &'static [Branch],
    impulse: &'static [Branch],
    reflected_impulse: &'static [Branch],
    arrival_time: &'static [Branch],
    duration: &'static [Branch],
    front_velocity: &'static [Branch],
}

/// One polynomial and where it holds.
#[derive(Debug)]
struct Branch {
    range: (f64, f64),
    map: (f64, f64),
    coefficients: &'static [f64],
}

impl Branch {
    fn log10_value(&self, log10_z: f64) -> f64 {
        let u = self.map.0 + self.map.1 * log10_z;
        self.coefficients.iter().rev().fold(0.0, |sum, coefficient| sum * u + coefficient)
    }
}

/// The curves of one burst, ready to be read.
#[derive(Debug, Clone, Copy)]
pub(super) struct KingeryBulmash {
    set: &'static CurveSet,
    /// `i / (ps T)` at the inner end of the fitted durations.
    inner_shape: f64,
}

impl KingeryBulmash {
    pub(super) fn new(burst: Burst) -> KingeryBulmash {
        let set = match burst {
            Burst::Air => &SPHERICAL,
            Burst::Surface => &HEMISPHERICAL,
        };
        let z = set.duration[0].range.0;
        let read = Reading::new(z);
        let inner_shape = read.value(set.impulse) / (read.value(set.overpressure) * read.value(set.duration));
        KingeryBulmash { set, inner_shape }
    }
}

impl Source for KingeryBulmash {
    fn range(&self) -> (f64, f64) {
        let branches = self.set.overpressure;
        (branches[0].range.0, branches[branches.len() - 1].range.1)
    }

    fn overpressure(&self, z: f64) -> f64 {
        1e3 * Reading::new(z).value(self.set.overpressure)
    }

    fn front_velocity(&self, z: f64) -> Option<f64> {
        Some(1e3 * Reading::new(z).value(self.set.front_velocity))
    }

    fn arrival_time(&self, z: f64) -> Option<f64> {
        Some(1e-3 * Reading::new(z).value(self.set.arrival_time))
    }

    fn given(&self, z: f64) -> Given {
        let read = Reading::new(z);
        let overpressure = 1e3 * read.value(self.set.overpressure);
        // 1 kPa ms is 1 Pa s.
        let impulse = read.value(self.set.impulse);
        let duration = if z < self.set.duration[0].range.0 {
            impulse / (overpressure * self.inner_shape)
        } else {
            1e-3 * read.value(self.set.duration)
        };
        Given {
            overpressure,
            reflected_pressure: Some(1e3 * read.value(self.set.reflected_pressure)),
            dynamic_pressure: None,
            front_velocity: Some(1e3 * read.value(self.set.front_velocity)),
            duration: Some(duration),
            impulse: Some(impulse),
            reflected_impulse: Some(read.value(self.set.reflected_impulse)),
        }
    }
}

/// A scaled distance at which curves are read.
struct Reading {
    z: f64,
    log10_z: f64,
}

impl Reading {
    fn new(z: f64) -> Reading {
        Reading { z, log10_z: libm::log10(z) }
    }

    /// The value of a curve in its own unit.
    fn value(&self, branches: &[Branch]) -> f64 {
        let last = branches.len() - 1;
        let index = branches[..last].iter().position(|branch| self.z < branch.range.1).unwrap_or(last);
        let own = branches[index].log10_value(self.log10_z);
        let towards = |joint: f64, neighbour: usize, sign: f64| {
            let inside = sign * (self.z / joint - 1.0) / FADE;
            (inside < 1.0).then(|| {
                let weight = 0.5 * (1.0 - inside);
                own + weight * (branches[neighbour].log10_value(self.log10_z) - own)
            })
        };
        let outer = if index < last { towards(branches[index].range.1, index + 1, -1.0) } else { None };
        let inner = if index > 0 { towards(branches[index].range.0, index - 1, 1.0) } else { None };
        libm::exp(core::f64::consts::LN_10 * outer.or(inner).unwrap_or(own))
    }
}
