//! Beyond the ends of a source's curves: stated rules in place of a polynomial's wild ends.
//!
//! **Farther** than the source reaches, a weak shock decays: with `Ze` the last scaled distance,
//! `ps = ps(Ze) (Ze/Z) √(L / (L + ln(Z/Ze)))`, where `L` makes the slope continuous at `Ze`; the duration
//! grows as `√(1 + ln(Z/Ze)/L)` and the impulse falls as `1/Z`, so that the pulse keeps its shape. Velocity,
//! dynamic and reflected pressure are those of Rankine–Hugoniot, times the ratio in which the source's last
//! values stand to it, that ratio fading to 1 with `ps`; the reflected impulse likewise tends to twice the
//! incident one.
//!
//! **Nearer** than the source reaches, its first values are continued in proportion to Kingery–Bulmash's
//! curves, down to those curves' own inner end (about the surface of the charge); from there inwards
//! everything is held.

use super::{CurvePoint, Curves};
use crate::air::{Air, Shock, normal_reflection};

/// Whether a source of curves reaches a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Extension {
    /// Within the source's range.
    #[default]
    Inside,
    /// Nearer to the charge than the source reaches.
    Near,
    /// Farther from the charge than the source reaches.
    Far,
}

/// Continuation towards the charge.
#[derive(Debug, Clone)]
pub(super) struct NearField {
    edge: CurvePoint,
    /// The reference curves at the same place as `edge`.
    reference_edge: Option<CurvePoint>,
}

impl NearField {
    pub(super) fn new(inner: f64, edge: CurvePoint, reference: Option<&Curves>) -> NearField {
        NearField { edge, reference_edge: reference.map(|curves| curves.at(inner)) }
    }

    pub(super) fn at(&self, z: f64, reference: Option<&Curves>) -> CurvePoint {
        let edge = CurvePoint { extension: Extension::Near, ..self.edge };
        let (Some(from), Some(to)) = (self.reference_edge, reference.map(|curves| curves.at(z))) else {
            return edge;
        };
        CurvePoint {
            overpressure: edge.overpressure * to.overpressure / from.overpressure,
            reflected_pressure: edge.reflected_pressure * to.reflected_pressure / from.reflected_pressure,
            dynamic_pressure: edge.dynamic_pressure * to.dynamic_pressure / from.dynamic_pressure,
            front_velocity: edge.front_velocity * to.front_velocity / from.front_velocity,
            duration: edge.duration * to.duration / from.duration,
            impulse: edge.impulse * to.impulse / from.impulse,
            reflected_impulse: edge.reflected_impulse * to.reflected_impulse / from.reflected_impulse,
            extension: Extension::Near,
        }
    }
}

/// Weak-shock decay away from the charge.
#[derive(Debug, Clone)]
pub(super) struct FarField {
    z: f64,
    edge: CurvePoint,
    /// `L`, the logarithm of `Ze` over the distance at which the decay law starts.
    span: f64,
    /// How much the edge's values exceed Rankine–Hugoniot, relative.
    excess: Excess,
}

#[derive(Debug, Clone, Copy)]
struct Excess {
    reflected_pressure: f64,
    dynamic_pressure: f64,
    front_velocity: f64,
    reflected_impulse: f64,
}

impl FarField {
    pub(super) fn new(z: f64, edge: CurvePoint, overpressure: impl Fn(f64) -> f64) -> FarField {
        let step = 1e-4;
        let inner = overpressure(z * libm::exp(-step));
        let steepness = libm::log(inner / edge.overpressure) / step;
        // A weak shock never decays slower than sound, 1/Z; the bounds keep `L` positive and finite.
        let span = 0.5 / (steepness.clamp(1.02, 10.0) - 1.0);
        let shock = Shock::behind(&Air::SEA_LEVEL, edge.overpressure);
        let reflected = normal_reflection(&Air::SEA_LEVEL, edge.overpressure);
        let excess = Excess {
            reflected_pressure: edge.reflected_pressure / reflected - 1.0,
            dynamic_pressure: edge.dynamic_pressure / shock.dynamic_pressure - 1.0,
            front_velocity: edge.front_velocity / shock.front_velocity - 1.0,
            reflected_impulse: edge.reflected_impulse * edge.overpressure / (edge.impulse * reflected) - 1.0,
        };
        FarField { z, edge, span, excess }
    }

    pub(super) fn at(&self, z: f64) -> CurvePoint {
        let stretch = (1.0 + libm::log(z / self.z) / self.span).sqrt();
        let fall = self.z / (z * stretch);
        let overpressure = self.edge.overpressure * fall;
        let impulse = self.edge.impulse * self.z / z;
        let shock = Shock::behind(&Air::SEA_LEVEL, overpressure);
        let reflected = normal_reflection(&Air::SEA_LEVEL, overpressure);
        let fade = |excess: f64| 1.0 + excess * fall;
        CurvePoint {
            overpressure,
            reflected_pressure: reflected * fade(self.excess.reflected_pressure),
            dynamic_pressure: shock.dynamic_pressure * fade(self.excess.dynamic_pressure),
            front_velocity: shock.front_velocity * fade(self.excess.front_velocity),
            duration: self.edge.duration * stretch,
            impulse,
            reflected_impulse: impulse * reflected / overpressure * fade(self.excess.reflected_impulse),
            extension: Extension::Far,
        }
    }
}
