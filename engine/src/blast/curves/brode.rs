//! Brode (1955): overpressure of a point explosion, thesis (2.20), (2.21).
//!
//! Overpressure only. The near formula holds above 10 bar, which it reaches at `Z` = 0.9063; the far one
//! from 10 bar, which it reaches at `Z` = 0.9295, down to 0.1 bar at `Z` = 9.924. Each is used exactly where
//! its condition holds, and between the two distances the overpressure stays at 10 bar: the curve is
//! continuous and never rises. Near the charge the formula is far too high (a point source has no size).

use super::{Given, Source};

const BAR: f64 = 1e5;

/// Inner end: the surface of a sphere of TNT.
const INNER: f64 = 0.0531;

/// Where the far formula falls to 0.1 bar.
const OUTER: f64 = 9.9244;

/// Brode's curve.
#[derive(Debug, Clone, Copy)]
pub(super) struct Brode;

impl Source for Brode {
    fn range(&self) -> (f64, f64) {
        (INNER, OUTER)
    }

    fn overpressure(&self, z: f64) -> f64 {
        let inverse = 1.0 / z;
        let near = 1.0 + 6.7 * inverse * inverse * inverse;
        let far = -0.019 + inverse * (0.975 + inverse * (1.455 + inverse * 5.85));
        BAR * if near > 10.0 { near } else { far.min(10.0) }
    }

    fn given(&self, z: f64) -> Given {
        Given::only(self.overpressure(z))
    }
}
