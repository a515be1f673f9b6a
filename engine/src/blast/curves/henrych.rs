//! Henrych (1979): overpressure in three fields, thesis (2.22)–(2.24).
//!
//! Overpressure only. The last term of the middle field, (2.23), is printed in the thesis with a minus; it
//! is a plus: with it the fields meet at `Z` = 0.3 (96.0 bar on both sides) and `Z` = 1 (8.00 bar), with the
//! minus the overpressure would be negative at `Z` = 0.3.

use super::{Given, Source};

const BAR: f64 = 1e5;

/// Henrych's curve.
#[derive(Debug, Clone, Copy)]
pub(super) struct Henrych;

impl Source for Henrych {
    fn range(&self) -> (f64, f64) {
        (0.05, 10.0)
    }

    fn overpressure(&self, z: f64) -> f64 {
        let inverse = 1.0 / z;
        let coefficients = if z <= 0.3 {
            [14.072, 5.540, -0.357, 0.00625]
        } else if z <= 1.0 {
            [6.194, -0.326, 2.132, 0.0]
        } else {
            [0.662, 4.05, 3.288, 0.0]
        };
        BAR * coefficients.iter().rev().fold(0.0, |sum, coefficient| (sum + coefficient) * inverse)
    }

    fn given(&self, z: f64) -> Given {
        Given::only(self.overpressure(z))
    }
}
