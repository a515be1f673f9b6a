//! Structures for Python.

use engine::structure::{Load, LoadTable, Oscillator, Pulse, Response, diagram, respond};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::floats;
use crate::blast::choose;
use crate::{engine, refused};

/// The pulse called `name`; a step may last for ever.
fn pulse(name: &str, peak: f64, duration: f64, decay: f64) -> PyResult<Pulse> {
    let pulse = choose(
        "pulse",
        name,
        &[
            ("triangle", Pulse::Triangle { peak, duration }),
            ("friedlander", Pulse::Friedlander { peak, duration, decay }),
            ("step", Pulse::Step { peak, duration }),
        ],
    )?;
    pulse.validate().map_err(refused)?;
    Ok(pulse)
}

fn oscillator(
    mass: f64,
    stiffness: f64,
    damping: f64,
    yield_resistance: Option<f64>,
) -> PyResult<Oscillator> {
    let yield_resistance = yield_resistance.unwrap_or(f64::INFINITY);
    let oscillator = Oscillator { mass, stiffness, damping, yield_resistance };
    oscillator.validate().map_err(refused)?;
    Ok(oscillator)
}

/// The response of a structure to a pulse or to a table of forces: maxima, and the motion over time.
///
/// Left out, the step is a thousandth of the period, and the run ends two periods after the load.
#[pyfunction]
#[pyo3(signature = (*, mass, stiffness, damping=0.0, yield_resistance=None, peak_force=0.0, duration=f64::INFINITY,
    pulse="triangle", decay=0.0, table=None, step=None, end=None))]
#[allow(clippy::too_many_arguments)]
pub fn structure_response<'py>(
    py: Python<'py>,
    mass: f64,
    stiffness: f64,
    damping: f64,
    yield_resistance: Option<f64>,
    peak_force: f64,
    duration: f64,
    pulse: &str,
    decay: f64,
    table: Option<(PyReadonlyArray1<'py, f64>, PyReadonlyArray1<'py, f64>)>,
    step: Option<f64>,
    end: Option<f64>,
) -> PyResult<Bound<'py, PyDict>> {
    let oscillator = oscillator(mass, stiffness, damping, yield_resistance)?;
    let response = match table {
        Some((times, forces)) => {
            let load = LoadTable::new(floats(&times), floats(&forces)).map_err(refused)?;
            run(py, &oscillator, &load, step, end)?
        }
        None => {
            let load = self::pulse(pulse, peak_force, duration, decay)?;
            run(py, &oscillator, &load, step, end)?
        }
    };
    let result = PyDict::new(py);
    result.set_item("max_displacement_m", response.max_displacement)?;
    result.set_item("time_of_max_s", response.time_of_max)?;
    result.set_item("permanent_set_m", response.permanent_set)?;
    result.set_item("period_s", oscillator.period())?;
    let column = |name: &str, pick: fn(&engine::structure::Motion) -> f64| {
        result.set_item(name, PyArray1::from_iter(py, response.history.iter().map(pick)))
    };
    column("time_s", |at| at.time)?;
    column("displacement_m", |at| at.displacement)?;
    column("velocity_m_s", |at| at.velocity)?;
    column("resistance_n", |at| at.resistance)?;
    Ok(result)
}

fn run(
    py: Python<'_>,
    oscillator: &Oscillator,
    load: &(impl Load + Sync),
    step: Option<f64>,
    end: Option<f64>,
) -> PyResult<Response> {
    let period = oscillator.period();
    let step = step.unwrap_or(1e-3 * period);
    let end = end.unwrap_or(load.end() + 2.0 * period);
    py.detach(|| respond(oscillator, load, step, end)).map_err(refused)
}

/// The pressure–impulse diagram of a structure, in force [N] and impulse [N s], with both asymptotes.
#[pyfunction]
#[pyo3(signature = (*, mass, stiffness, limit, damping=0.0, yield_resistance=None, pulse="triangle", decay=0.0,
    shortest=0.01, longest=100.0, points=41))]
#[allow(clippy::too_many_arguments)]
pub fn pressure_impulse<'py>(
    py: Python<'py>,
    mass: f64,
    stiffness: f64,
    limit: f64,
    damping: f64,
    yield_resistance: Option<f64>,
    pulse: &str,
    decay: f64,
    shortest: f64,
    longest: f64,
    points: usize,
) -> PyResult<Bound<'py, PyDict>> {
    let oscillator = oscillator(mass, stiffness, damping, yield_resistance)?;
    let shape = self::pulse(pulse, 1.0, 1.0, decay)?;
    let drawn =
        py.detach(|| diagram(&oscillator, &shape, limit, (shortest, longest), points)).map_err(refused)?;
    let result = PyDict::new(py);
    result.set_item("force_asymptote_n", drawn.force_asymptote)?;
    result.set_item("impulse_asymptote_n_s", drawn.impulse_asymptote)?;
    result.set_item("period_s", oscillator.period())?;
    let column = |name: &str, pick: fn(&engine::structure::Threshold) -> f64| {
        result.set_item(name, PyArray1::from_iter(py, drawn.curve.iter().map(pick)))
    };
    column("duration_s", |at| at.duration)?;
    column("force_n", |at| at.force)?;
    column("impulse_n_s", |at| at.impulse)?;
    Ok(result)
}

/// Whether a pulse brings a structure to the displacement `limit` [m].
#[pyfunction]
#[pyo3(signature = (*, mass, stiffness, limit, peak_force, duration, damping=0.0, yield_resistance=None,
    pulse="triangle", decay=0.0))]
#[allow(clippy::too_many_arguments)]
pub fn structure_reaches(
    mass: f64,
    stiffness: f64,
    limit: f64,
    peak_force: f64,
    duration: f64,
    damping: f64,
    yield_resistance: Option<f64>,
    pulse: &str,
    decay: f64,
) -> PyResult<bool> {
    let oscillator = oscillator(mass, stiffness, damping, yield_resistance)?;
    let load = self::pulse(pulse, peak_force, duration, decay)?;
    engine::structure::reaches(&oscillator, &load, limit).map_err(refused)
}
