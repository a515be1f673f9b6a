//! The gas within each cell: limited slopes, and the states at its two faces half a step on.
//!
//! B. van Leer, "Towards the ultimate conservative difference scheme V", J. Comput. Phys. 32 (1979), in the
//! form of Hancock: a linear profile in each cell, moved on by half a step with the cell's own Euler equations.
//! The slope is that of the central difference, held to twice the smaller one-sided difference, and 0 at an
//! extremum.

use super::columns::{BLOCK, Columns, Row, RowBlock};

/// Limited slope of one column in every cell. `values` carries its ghosts, `inverse_gap` the inverse distance
/// between neighbouring centres.
pub(super) fn limited_slopes(values: &[f64], inverse_gap: &[f64], slopes: &mut [f64]) {
    let cells = slopes.len();
    let (values, inverse_gap) = (&values[..cells + 2], &inverse_gap[..cells + 1]);
    for cell in 0..cells {
        let before = (values[cell + 1] - values[cell]) * inverse_gap[cell];
        let after = (values[cell + 2] - values[cell + 1]) * inverse_gap[cell + 1];
        let (a, b) = (before.abs(), after.abs());
        let least = 2.0 * if a < b { a } else { b };
        let mean = 0.5 * (before + after);
        let size = if mean.abs() < least { mean.abs() } else { least };
        let held = if mean < 0.0 { -size } else { size };
        slopes[cell] = if before * after > 0.0 { held } else { 0.0 };
    }
}

/// Where a cell lies and how its faces move.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    pub centre: f64,
    pub low: f64,
    pub high: f64,
    pub low_velocity: f64,
    pub high_velocity: f64,
}

/// The states at a cell's lower and upper face after half of `step`, and the pressure at its centre then.
///
/// The Euler equations in the variables themselves, with `j` the exponent of symmetry. A cell whose profile
/// would leave density or pressure below 0 anywhere is taken as uniform.
#[inline(always)]
pub(super) fn half_step(
    row: Row,
    slope: Row,
    sound_speed: f64,
    place: Place,
    exponent: f64,
    step: f64,
) -> (Row, Row, f64) {
    let half = 0.5 * step;
    let spread = if exponent == 0.0 { 0.0 } else { exponent * row.velocity / place.centre };
    let divergence = slope.velocity + spread;
    let stiffness = row.density * sound_speed * sound_speed;
    let rate = Row {
        density: -row.velocity * slope.density - row.density * divergence,
        velocity: -row.velocity * slope.velocity - slope.pressure / row.density,
        pressure: -row.velocity * slope.pressure - stiffness * divergence,
        energy: -row.velocity * slope.energy - (row.energy + row.pressure) * divergence,
    };
    let below = place.low + half * place.low_velocity - place.centre;
    let above = place.high + half * place.high_velocity - place.centre;
    let change = |way: f64| Row {
        density: slope.density * way + half * rate.density,
        velocity: slope.velocity * way + half * rate.velocity,
        pressure: slope.pressure * way + half * rate.pressure,
        energy: slope.energy * way + half * rate.energy,
    };
    let (low, high) = (change(below), change(above));
    let floor = |value: f64| -0.99 * value;
    let sound = (low.density > floor(row.density))
        & (high.density > floor(row.density))
        & (low.pressure > floor(row.pressure))
        & (high.pressure > floor(row.pressure));
    let keep = if sound { 1.0 } else { 0.0 };
    let add = |change: Row| Row {
        density: row.density + keep * change.density,
        velocity: row.velocity + keep * change.velocity,
        pressure: row.pressure + keep * change.pressure,
        energy: row.energy + keep * change.energy,
    };
    (add(low), add(high), row.pressure + keep * half * rate.pressure)
}

/// What [`half_steps`] reads beside the gas itself.
pub(super) struct Grid<'a> {
    /// Centres, with ghosts.
    pub centre: &'a [f64],
    /// Faces and their velocities.
    pub face: &'a [f64],
    pub face_velocity: &'a [f64],
    pub exponent: f64,
}

/// [`half_step`] of every cell: `low` and `high` are the states at its faces, by cell with ghosts.
pub(super) fn half_steps(
    cells: &Columns,
    slopes: &Columns,
    sound_speed: &[f64],
    grid: &Grid<'_>,
    step: f64,
    (low, high, middle): (&mut Columns, &mut Columns, &mut [f64]),
) {
    let count = middle.len();
    let mut from = 0;
    while from < count {
        let rows = BLOCK.min(count - from);
        let (mut lows, mut highs, mut pressures) = (RowBlock::new(), RowBlock::new(), [0.0; BLOCK]);
        let (gas, slope) = (cells.stretch(from + 1, from + 1 + rows), slopes.stretch(from, from + rows));
        let sound = &sound_speed[from + 1..from + 1 + rows];
        let centre = &grid.centre[from + 1..from + 1 + rows];
        let face = &grid.face[from..from + rows + 1];
        let velocity = &grid.face_velocity[from..from + rows + 1];
        for row in 0..rows {
            let place = Place {
                centre: centre[row],
                low: face[row],
                high: face[row + 1],
                low_velocity: velocity[row],
                high_velocity: velocity[row + 1],
            };
            let (below, above, pressure) =
                half_step(gas.row(row), slope.row(row), sound[row], place, grid.exponent, step);
            lows.set(row, below);
            highs.set(row, above);
            pressures[row] = pressure;
        }
        lows.store(low, from + 1, rows);
        highs.store(high, from + 1, rows);
        middle[from..from + rows].copy_from_slice(&pressures[..rows]);
        from += rows;
    }
}
