//! The user's own curves: samples read log–log, as the thesis reads its charts (§3.4).

use super::{Given, Source};
use crate::charge::CurveTable;

/// A curve table prepared for reading: natural logarithms of every column.
#[derive(Debug, Clone)]
pub(super) struct LogTable {
    /// First and last scaled distance as they were given.
    range: (f64, f64),
    z: Vec<f64>,
    overpressure: Vec<f64>,
    reflected_pressure: Option<Vec<f64>>,
    dynamic_pressure: Option<Vec<f64>>,
    front_velocity: Option<Vec<f64>>,
    duration: Option<Vec<f64>>,
    impulse: Option<Vec<f64>>,
    reflected_impulse: Option<Vec<f64>>,
    arrival_time: Option<Vec<f64>>,
}

impl LogTable {
    /// Prepares a table that has been validated.
    pub(super) fn new(table: &CurveTable) -> LogTable {
        let logs = |column: &Vec<f64>| column.iter().map(|value| libm::log(*value)).collect::<Vec<_>>();
        let optional = |column: &Option<Vec<f64>>| column.as_ref().map(logs);
        LogTable {
            range: (table.scaled_distance[0], table.scaled_distance[table.scaled_distance.len() - 1]),
            z: logs(&table.scaled_distance),
            overpressure: logs(&table.overpressure),
            reflected_pressure: optional(&table.reflected_pressure),
            dynamic_pressure: optional(&table.dynamic_pressure),
            front_velocity: optional(&table.front_velocity),
            duration: optional(&table.duration),
            impulse: optional(&table.impulse),
            reflected_impulse: optional(&table.reflected_impulse),
            arrival_time: optional(&table.arrival_time),
        }
    }

    fn locate(&self, z: f64) -> Place {
        let log_z = libm::log(z);
        let upper = self.z.partition_point(|sample| *sample <= log_z).clamp(1, self.z.len() - 1);
        let (start, end) = (self.z[upper - 1], self.z[upper]);
        Place { lower: upper - 1, fraction: ((log_z - start) / (end - start)).clamp(0.0, 1.0) }
    }
}

/// A place between two rows.
#[derive(Clone, Copy)]
struct Place {
    lower: usize,
    fraction: f64,
}

impl Place {
    fn read(self, column: &[f64]) -> f64 {
        let (start, end) = (column[self.lower], column[self.lower + 1]);
        libm::exp(start + self.fraction * (end - start))
    }

    fn read_optional(self, column: &Option<Vec<f64>>) -> Option<f64> {
        column.as_ref().map(|column| self.read(column))
    }
}

impl Source for LogTable {
    fn range(&self) -> (f64, f64) {
        self.range
    }

    fn overpressure(&self, z: f64) -> f64 {
        self.locate(z).read(&self.overpressure)
    }

    fn front_velocity(&self, z: f64) -> Option<f64> {
        self.locate(z).read_optional(&self.front_velocity)
    }

    fn arrival_time(&self, z: f64) -> Option<f64> {
        self.locate(z).read_optional(&self.arrival_time)
    }

    fn given(&self, z: f64) -> Given {
        let place = self.locate(z);
        Given {
            overpressure: place.read(&self.overpressure),
            reflected_pressure: place.read_optional(&self.reflected_pressure),
            dynamic_pressure: place.read_optional(&self.dynamic_pressure),
            front_velocity: place.read_optional(&self.front_velocity),
            duration: place.read_optional(&self.duration),
            impulse: place.read_optional(&self.impulse),
            reflected_impulse: place.read_optional(&self.reflected_impulse),
        }
    }
}
