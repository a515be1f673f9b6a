//! Kinney and Graham (1985): closed forms for overpressure, duration and impulse of chemical explosions.
//!
//! Source: G. F. Kinney, K. J. Graham, "Explosive Shocks in Air", 2nd edition, the book behind the thesis's
//! §2.4.2. Used from `Z` = 0.05 to 40.

use super::{Given, Source};

const ATMOSPHERE: f64 = 101_325.0;

/// 1 bar ms [Pa s].
const BAR_MILLISECOND: f64 = 100.0;

/// Kinney and Graham's curves.
#[derive(Debug, Clone, Copy)]
pub(super) struct KinneyGraham;

impl KinneyGraham {
    /// Positive duration [s/kg^⅓].
    fn duration(z: f64) -> f64 {
        let (sixth, tenth) = {
            let inner = square(z / 0.74);
            let outer = square(z / 0.54);
            (inner * inner * inner, square(square(outer)) * outer)
        };
        let third = square(z / 0.02) * (z / 0.02);
        1e-3 * 980.0 * (1.0 + tenth) / ((1.0 + third) * (1.0 + sixth) * (1.0 + square(z / 6.9)).sqrt())
    }

    /// Positive impulse [Pa s/kg^⅓].
    fn impulse(z: f64) -> f64 {
        let fourth = square(square(z / 0.23));
        let third = square(z / 1.55) * (z / 1.55);
        BAR_MILLISECOND * 0.067 * (1.0 + fourth).sqrt() / (square(z) * libm::cbrt(1.0 + third))
    }
}

impl Source for KinneyGraham {
    fn range(&self) -> (f64, f64) {
        (0.05, 40.0)
    }

    fn overpressure(&self, z: f64) -> f64 {
        let weaken = |length: f64| 1.0 + square(z / length);
        ATMOSPHERE * 808.0 * weaken(4.5) / (weaken(0.048) * weaken(0.32) * weaken(1.35)).sqrt()
    }

    fn given(&self, z: f64) -> Given {
        Given {
            duration: Some(KinneyGraham::duration(z)),
            impulse: Some(KinneyGraham::impulse(z)),
            ..Given::only(self.overpressure(z))
        }
    }
}

fn square(x: f64) -> f64 {
    x * x
}
