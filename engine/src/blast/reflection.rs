//! What a surface makes of the front that strikes it at an angle: the reflection coefficient `C_R(α, ps)`.
//!
//! Source: UFC 3-340-02, Fig. 2-193, digitised by V. D. Kochkarov and P. M. Martyniuk (CC BY 4.0), thinned
//! and interpolated to 20 overpressures × 37 angles: column `CR_chart` of `data/reflection_coefficient.csv`.
//! `α` is the angle between the front's direction and the surface's inward normal: 0 head-on, 90° grazing.
//! Read linearly in `α` and in `ln ps`. Grazing gives 1 exactly.
//!
//! **Weaker** than the chart (1.38 kPa): each coefficient tends, in proportion to `ps`, to the limit of
//! sound, 2 (1 at grazing), so that the chart's last curve is met without a step. **Stronger** (34.5 MPa):
//! held. Past 72° the family of 1379 kPa may read up to 22 % high. Surfaces that face away reflect nothing:
//! 1.

use std::sync::LazyLock;

/// Overpressures of the chart.
pub const PRESSURES: usize = 20;

/// Angles of the chart, every 2.5° from 0 to 90.
pub const ANGLES: usize = 37;

/// Radians between two angles of the chart.
const ANGLE_STEP: f64 = core::f64::consts::FRAC_PI_2 / (ANGLES - 1) as f64;

/// The digitised chart.
#[derive(Debug, Clone)]
pub struct Chart {
    /// Incident overpressures [Pa], rising, at sea level.
    pub overpressure: [f64; PRESSURES],
    /// Angles of incidence [°], rising from 0 to 90.
    pub angle_deg: [f64; ANGLES],
    /// Coefficients, one row an overpressure.
    pub coefficient: [[f64; ANGLES]; PRESSURES],
    log_overpressure: [f64; PRESSURES],
}

static CHART: LazyLock<Chart> =
    LazyLock::new(|| Chart::parse(include_str!("../../data/reflection_coefficient.csv")));

/// The chart that the coefficients are read from.
pub fn chart() -> &'static Chart {
    &CHART
}

/// `C_R` at angle of incidence `angle` [rad, 0 to π/2] of a front of `overpressure` [Pa, sea level, above 0].
pub fn reflection_coefficient(angle: f64, overpressure: f64) -> f64 {
    CHART.read(angle, overpressure)
}

impl Chart {
    /// Reads the table that the engine carries; what it holds is checked by the tests.
    fn parse(text: &str) -> Chart {
        let mut chart = Chart {
            overpressure: [0.0; PRESSURES],
            angle_deg: [0.0; ANGLES],
            coefficient: [[1.0; ANGLES]; PRESSURES],
            log_overpressure: [0.0; PRESSURES],
        };
        for (index, line) in text.lines().skip(1).enumerate() {
            let (row, column) = (index / ANGLES, index % ANGLES);
            let mut cells = line.split(',').map(|cell| cell.parse::<f64>().unwrap_or(f64::NAN));
            let mut cell = |skip: usize| cells.nth(skip).unwrap_or(f64::NAN);
            chart.overpressure[row] = 1e3 * cell(0);
            chart.angle_deg[column] = cell(1);
            chart.coefficient[row][column] = cell(0);
            chart.log_overpressure[row] = libm::log(chart.overpressure[row]);
        }
        chart
    }

    /// `C_R` at `angle` [rad] and `overpressure` [Pa].
    pub fn read(&self, angle: f64, overpressure: f64) -> f64 {
        if angle >= core::f64::consts::FRAC_PI_2 {
            return 1.0;
        }
        let place = angle.max(0.0) / ANGLE_STEP;
        let column = (place as usize).min(ANGLES - 2);
        let fraction = place - column as f64;
        let at_angle = |row: &[f64; ANGLES]| row[column] + fraction * (row[column + 1] - row[column]);
        if overpressure <= self.overpressure[0] {
            let sound = if column + 1 < ANGLES - 1 { 2.0 } else { 2.0 - fraction };
            let share = (overpressure / self.overpressure[0]).max(0.0);
            return sound + share * (at_angle(&self.coefficient[0]) - sound);
        }
        let upper = self.overpressure.partition_point(|sample| *sample <= overpressure).max(1);
        if upper == PRESSURES {
            return at_angle(&self.coefficient[PRESSURES - 1]);
        }
        let (start, end) = (self.log_overpressure[upper - 1], self.log_overpressure[upper]);
        let weight = (libm::log(overpressure) - start) / (end - start);
        let weaker = at_angle(&self.coefficient[upper - 1]);
        weaker + weight * (at_angle(&self.coefficient[upper]) - weaker)
    }
}
