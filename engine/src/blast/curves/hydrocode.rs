//! Brisance's own curves: a charge of TNT computed by its one-dimensional hydrocode.
//!
//! The table is the result of [`crate::hydrocode::blast::ChargeRun`], stored so that a scene need not compute
//! it; its first lines name the settings, and `brisance theory hydrocode --curve-table` makes it again. It
//! leaves out what the products still burn in the air, so its impulses are a fifth to a third lower than the
//! measured ones; see `docs/theory.md`.

use std::sync::LazyLock;

use super::table::LogTable;
use crate::charge::CurveTable;

static TABLE: LazyLock<LogTable> =
    LazyLock::new(|| LogTable::new(&parse(include_str!("../../../data/hydrocode_curves.csv"))));

/// The table prepared for reading.
pub(super) fn curves() -> LogTable {
    TABLE.clone()
}

/// Reads the table that the engine carries; what it holds is checked by the tests.
fn parse(text: &str) -> CurveTable {
    let mut columns: [Vec<f64>; 7] = Default::default();
    for line in text.lines().filter(|line| !line.starts_with('#')).skip(1) {
        for (column, cell) in columns.iter_mut().zip(line.split(',')) {
            column.push(cell.parse().unwrap_or(f64::NAN));
        }
    }
    let [z, overpressure, dynamic, front, duration, impulse, arrival] = columns;
    CurveTable {
        scaled_distance: z,
        overpressure,
        dynamic_pressure: Some(dynamic),
        front_velocity: Some(front),
        duration: Some(duration),
        impulse: Some(impulse),
        arrival_time: Some(arrival),
        ..CurveTable::default()
    }
}
