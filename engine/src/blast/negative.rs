//! The suction that follows a blast's positive phase.
//!
//! Source: UFC 3-340-02, Fig. 2-8 (negative shock-wave parameters, spherical burst in free air), 17 samples
//! of its incident underpressure and impulse, read log–log (`data/negative_phase.json`; about 5 % reading
//! accuracy). The duration is the one with which Granström's cubic carries the chart's impulse: 2 to 11 %
//! under the chart's own for `Z` of 3 and more, down to 0.55 of it at `Z` = 1, where the chart's pulse is
//! no cubic. The underpressure never exceeds the ambient pressure (a vacuum). Beyond `Z` = 40 both fall as
//! `1/Z`; nearer than 0.1 they are held. A surface burst is a sphere of 1.8 times the mass.

use super::pulse::NegativePhase;
use crate::air::Air;
use crate::charge::{Burst, SURFACE_ENERGY_FACTOR};

/// Scaled distance [m/kg^⅓], incident underpressure [kPa], incident negative impulse [kPa ms/kg^⅓].
const CHART: [[f64; 3]; 17] = [
    [0.1, 103.571, 495.32],
    [0.2, 105.1, 496.83],
    [0.3, 104.389, 491.31],
    [0.5, 102.527, 438.11],
    [0.7, 99.44, 358.78],
    [1.0, 84.164, 266.79],
    [1.5, 44.536, 174.48],
    [2.0, 25.042, 123.8],
    [3.0, 14.332, 79.62],
    [4.0, 10.179, 58.16],
    [5.0, 8.084, 46.34],
    [7.0, 5.619, 33.12],
    [10.0, 3.707, 23.0],
    [15.0, 2.431, 15.1],
    [20.0, 1.836, 11.32],
    [30.0, 1.316, 7.76],
    [40.0, 1.034, 6.19],
];

/// Suction at scaled distance `z` [m/kg^⅓, 0 or more] from `tnt_mass` [kg] of TNT, at sea level.
///
/// `z` is `R / tnt_mass^⅓` for both bursts.
pub fn negative_phase(z: f64, tnt_mass: f64, burst: Burst) -> NegativePhase {
    let factor = match burst {
        Burst::Air => 1.0,
        Burst::Surface => SURFACE_ENERGY_FACTOR,
    };
    let (peak, impulse) = scaled(z / libm::cbrt(factor));
    NegativePhase { peak, duration: 16.0 / 9.0 * impulse / peak * libm::cbrt(factor * tnt_mass) }
}

/// Peak [Pa] and impulse [Pa s/kg^⅓] of a spherical burst.
fn scaled(z: f64) -> (f64, f64) {
    let (first, last) = (CHART[0][0], CHART[CHART.len() - 1][0]);
    let place = z.clamp(first, last);
    let upper = CHART.partition_point(|row| row[0] <= place).clamp(1, CHART.len() - 1);
    let (start, end) = (CHART[upper - 1], CHART[upper]);
    let fraction = libm::log(place / start[0]) / libm::log(end[0] / start[0]);
    let read = |column: usize| start[column] * libm::pow(end[column] / start[column], fraction);
    let fall = (last / z).min(1.0);
    ((1e3 * fall * read(1)).min(Air::SEA_LEVEL.pressure), fall * read(2))
}
