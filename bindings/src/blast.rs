//! Air, charges and curves for Python.

use std::collections::HashMap;
use std::sync::Arc;

use engine::air::{Air, Shock, normal_reflection};
use engine::blast::curves::Quantity;
use engine::blast::reflection::chart;
use engine::blast::{BlastField, BlastPoint, Extension, NegativePhase, Pulse, PulseShape};
use engine::charge::{Burst, Charge, CurveSource, CurveTable, EXPLOSIVES};
use engine::loading::{Drag, Face, FaceHistory, HistorySettings, LoadingMode};
use glam::DVec3;
use numpy::{PyArray1, PyArrayMethods, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::{as_floats, floats, map};
use crate::{InputError, engine, refused};

/// A named source of curves, or columns of a table.
#[derive(FromPyObject)]
pub enum Source {
    Name(String),
    Table(HashMap<String, Vec<f64>>),
}

impl Default for Source {
    fn default() -> Self {
        Self::Name("kingery-bulmash".into())
    }
}

impl Source {
    pub fn into_engine(self) -> PyResult<CurveSource> {
        match self {
            Self::Name(name) => choose(
                "source",
                &name,
                &[
                    ("kingery-bulmash", CurveSource::KingeryBulmash),
                    ("brode", CurveSource::Brode),
                    ("henrych", CurveSource::Henrych),
                    ("kinney-graham", CurveSource::KinneyGraham),
                    ("hydrocode", CurveSource::Hydrocode),
                ],
            ),
            Self::Table(mut columns) => {
                let mut take = |name: &str| columns.remove(name);
                let missing =
                    |name: &str| InputError::new_err(format!("the curve table has no column {name}"));
                let table = CurveTable {
                    scaled_distance: take("scaled_distance_m_kg13")
                        .ok_or_else(|| missing("scaled_distance_m_kg13"))?,
                    overpressure: take("overpressure_pa").ok_or_else(|| missing("overpressure_pa"))?,
                    reflected_pressure: take("reflected_pressure_pa"),
                    dynamic_pressure: take("dynamic_pressure_pa"),
                    front_velocity: take("front_velocity_m_s"),
                    duration: take("duration_s_kg13"),
                    impulse: take("impulse_pa_s_kg13"),
                    reflected_impulse: take("reflected_impulse_pa_s_kg13"),
                    arrival_time: take("arrival_time_s_kg13"),
                };
                if let Some(unknown) = columns.keys().min() {
                    return Err(InputError::new_err(format!(
                        "the curve table's column {unknown} is not known"
                    )));
                }
                table.validate().map_err(refused)?;
                Ok(CurveSource::Table(Arc::new(table)))
            }
        }
    }
}

/// The value that goes with a name, or a sentence that lists the names.
pub fn choose<T: Clone>(what: &str, name: &str, choices: &[(&str, T)]) -> PyResult<T> {
    choices.iter().find(|(known, _)| *known == name).map(|(_, value)| value.clone()).ok_or_else(|| {
        let names: Vec<&str> = choices.iter().map(|(known, _)| *known).collect();
        InputError::new_err(format!("{what} is \"{name}\", but must be one of {}", names.join(", ")))
    })
}

pub fn burst(name: &str) -> PyResult<Burst> {
    choose("burst", name, &[("air", Burst::Air), ("surface", Burst::Surface)])
}

pub fn pulse_shape(name: &str) -> PyResult<PulseShape> {
    choose(
        "pulse",
        name,
        &[
            ("friedlander", PulseShape::Friedlander),
            ("triangle-duration", PulseShape::TriangleDuration),
            ("triangle-impulse", PulseShape::TriangleImpulse),
        ],
    )
}

pub fn loading_mode(name: &str) -> PyResult<LoadingMode> {
    choose("mode", name, &[("translational", LoadingMode::Translational), ("surface", LoadingMode::Surface)])
}

pub fn drag(name: &str) -> PyResult<Drag> {
    choose("drag", name, &[("flow-relative", Drag::FlowRelative), ("thesis", Drag::Thesis)])
}

fn field(
    mass: f64,
    tnt_equivalence: f64,
    burst_name: &str,
    source: Option<Source>,
    pressure: f64,
    temperature: f64,
) -> PyResult<BlastField> {
    let charge = Charge {
        tnt_equivalence,
        burst: burst(burst_name)?,
        curves: source.unwrap_or_default().into_engine()?,
        ..Charge::tnt(mass, DVec3::ZERO)
    };
    BlastField::new(&charge, &Air { pressure, temperature, ..Air::default() }).map_err(refused)
}

/// Reads one quantity off a point of the field.
type Column = fn(&BlastPoint) -> f64;

/// The curves at distances [m] from a charge: a dictionary of arrays, keys with units.
#[pyfunction]
#[pyo3(signature = (*, mass, distance, tnt_equivalence=1.0, burst="air", source=None, pressure=101_325.0, temperature=288.15))]
#[allow(clippy::too_many_arguments)]
pub fn curves<'py>(
    py: Python<'py>,
    mass: f64,
    distance: PyReadonlyArray1<'py, f64>,
    tnt_equivalence: f64,
    burst: &str,
    source: Option<Source>,
    pressure: f64,
    temperature: f64,
) -> PyResult<Bound<'py, PyDict>> {
    let field = field(mass, tnt_equivalence, burst, source, pressure, temperature)?;
    let distances = floats(&distance);
    if let Some(bad) = distances.iter().find(|d| !(d.is_finite() && **d > 0.0)) {
        return Err(InputError::new_err(format!(
            "distance is {bad} m, but must be a finite number greater than 0"
        )));
    }
    let points: Vec<BlastPoint> = distances.iter().map(|&d| field.at_distance(d)).collect();
    let result = PyDict::new(py);
    let columns: [(&str, Column); 13] = [
        ("distance_m", |p| p.distance),
        ("scaled_distance_m_kg13", |p| p.scaled_distance),
        ("overpressure_pa", |p| p.overpressure),
        ("reflected_pressure_pa", |p| p.reflected_pressure),
        ("dynamic_pressure_pa", |p| p.dynamic_pressure),
        ("front_velocity_m_s", |p| p.front_velocity),
        ("arrival_time_s", |p| p.arrival_time),
        ("duration_s", |p| p.duration),
        ("impulse_pa_s", |p| p.impulse),
        ("reflected_impulse_pa_s", |p| p.reflected_impulse),
        ("decay", |p| p.decay),
        ("density_kg_m3", |p| p.density),
        ("particle_velocity_m_s", |p| p.particle_velocity),
    ];
    for (name, column) in columns {
        result.set_item(name, PyArray1::from_iter(py, points.iter().map(column)))?;
    }
    let extension = points.iter().map(|p| match p.extension {
        Extension::Near => -1i8,
        Extension::Inside => 0,
        Extension::Far => 1,
    });
    result.set_item("extension", PyArray1::from_iter(py, extension))?;
    result.set_item("derived", derived(&field))?;
    Ok(result)
}

/// Keys of `curves` that the source does not give itself.
fn derived(field: &BlastField) -> Vec<&'static str> {
    let mut names: Vec<&'static str> =
        field.curves().derived().iter().map(|quantity| key(*quantity)).collect();
    names.retain(|name| *name != "arrival_time_s");
    names.extend(["arrival_time_s", "density_kg_m3", "particle_velocity_m_s", "decay"]);
    names
}

fn key(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Overpressure => "overpressure_pa",
        Quantity::ReflectedPressure => "reflected_pressure_pa",
        Quantity::DynamicPressure => "dynamic_pressure_pa",
        Quantity::FrontVelocity => "front_velocity_m_s",
        Quantity::Duration => "duration_s",
        Quantity::Impulse => "impulse_pa_s",
        Quantity::ReflectedImpulse => "reflected_impulse_pa_s",
        Quantity::ArrivalTime => "arrival_time_s",
    }
}

/// Radius of the shock front [m] at times since detonation [s].
#[pyfunction]
#[pyo3(signature = (*, mass, times, tnt_equivalence=1.0, burst="air", source=None, pressure=101_325.0, temperature=288.15))]
#[allow(clippy::too_many_arguments)]
pub fn front_radius<'py>(
    py: Python<'py>,
    mass: f64,
    times: PyReadonlyArray1<'py, f64>,
    tnt_equivalence: f64,
    burst: &str,
    source: Option<Source>,
    pressure: f64,
    temperature: f64,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let field = field(mass, tnt_equivalence, burst, source, pressure, temperature)?;
    Ok(PyArray1::from_iter(py, floats(&times).into_iter().map(|t| field.front_radius(t))))
}

/// Reflection coefficient at angles [degrees] and overpressures [Pa], broadcast against each other.
#[pyfunction]
#[pyo3(signature = (*, angle_deg, overpressure, pressure=101_325.0))]
pub fn reflection_coefficient<'py>(
    py: Python<'py>,
    angle_deg: &Bound<'py, PyAny>,
    overpressure: &Bound<'py, PyAny>,
    pressure: f64,
) -> PyResult<Bound<'py, PyAny>> {
    let both = py.import("numpy")?.call_method1("broadcast_arrays", (angle_deg, overpressure))?;
    let (angles, pressures) = (as_floats(&both.get_item(0)?)?, as_floats(&both.get_item(1)?)?);
    let shape = both.get_item(0)?.getattr("shape")?;
    let scale = Air::default().pressure / pressure;
    let values: Vec<f64> = (angles.readonly().as_array().iter())
        .zip(pressures.readonly().as_array().iter())
        .map(|(angle, ps)| engine::blast::reflection::reflection_coefficient(angle.to_radians(), ps * scale))
        .collect();
    PyArray1::from_vec(py, values).call_method1("reshape", (shape,))
}

/// The chart behind `reflection_coefficient`, at sea level: its pressures, angles and coefficients.
#[pyfunction]
pub fn reflection_chart(py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
    let chart = chart();
    let result = PyDict::new(py);
    let flat: Vec<f64> = chart.coefficient.iter().flatten().copied().collect();
    let coefficient =
        PyArray1::from_vec(py, flat).reshape([chart.overpressure.len(), chart.angle_deg.len()])?;
    result.set_item("overpressure_pa", PyArray1::from_slice(py, &chart.overpressure))?;
    result.set_item("angle_deg", PyArray1::from_slice(py, &chart.angle_deg))?;
    result.set_item("coefficient", coefficient)?;
    Ok(result)
}

/// A pressure pulse at times since arrival [s]: pressure, impulse up to then, and the decay it was given.
#[pyfunction]
#[pyo3(signature = (*, peak, duration, impulse, times, shape="friedlander", negative=None))]
#[allow(clippy::too_many_arguments)]
pub fn pulse<'py>(
    py: Python<'py>,
    peak: f64,
    duration: f64,
    impulse: f64,
    times: PyReadonlyArray1<'py, f64>,
    shape: &str,
    negative: Option<(f64, f64)>,
) -> PyResult<Bound<'py, PyDict>> {
    for (name, value) in [("peak [Pa]", peak), ("duration [s]", duration), ("impulse [Pa s]", impulse)] {
        if !(value.is_finite() && value > 0.0) {
            return Err(InputError::new_err(format!(
                "{name} is {value}, but must be a finite number greater than 0"
            )));
        }
    }
    let mut pulse = Pulse::new(pulse_shape(shape)?, peak, duration, impulse);
    pulse.negative = negative.map(|(peak, duration)| NegativePhase { peak, duration });
    let times = floats(&times);
    let result = PyDict::new(py);
    result.set_item("pressure_pa", PyArray1::from_iter(py, times.iter().map(|&t| pulse.value(t))))?;
    result.set_item("impulse_pa_s", PyArray1::from_iter(py, times.iter().map(|&t| pulse.impulse(0.0, t))))?;
    result.set_item("duration_s", pulse.duration)?;
    result.set_item("decay", pulse.decay)?;
    Ok(result)
}

/// The state behind a front of given overpressure [Pa], and the pressure of its normal reflection.
#[pyfunction]
#[pyo3(signature = (*, overpressure, pressure=101_325.0, temperature=288.15, gamma=1.4))]
pub fn rankine_hugoniot<'py>(
    py: Python<'py>,
    overpressure: &Bound<'py, PyAny>,
    pressure: f64,
    temperature: f64,
    gamma: f64,
) -> PyResult<Bound<'py, PyDict>> {
    let air = Air { pressure, temperature, gamma };
    air.validate().map_err(refused)?;
    let result = PyDict::new(py);
    result.set_item("front_velocity_m_s", map(overpressure, |p| Shock::behind(&air, p).front_velocity)?)?;
    result.set_item("density_kg_m3", map(overpressure, |p| Shock::behind(&air, p).density)?)?;
    result
        .set_item("dynamic_pressure_pa", map(overpressure, |p| Shock::behind(&air, p).dynamic_pressure)?)?;
    result.set_item(
        "particle_velocity_m_s",
        map(overpressure, |p| Shock::behind(&air, p).particle_velocity)?,
    )?;
    result.set_item("reflected_pressure_pa", map(overpressure, |p| normal_reflection(&air, p))?)?;
    Ok(result)
}

/// The explosives of Table 2.1 with their TNT equivalence.
#[pyfunction]
pub fn explosives() -> Vec<(&'static str, f64)> {
    EXPLOSIVES.iter().map(|explosive| (explosive.name, explosive.tnt_equivalence)).collect()
}

/// Pressure [Pa] on a face at times since detonation [s].
#[pyfunction]
#[pyo3(signature = (*, face, mode, drag, mass, distance, angle_deg, clearing_length, drag_coefficient, times,
    tnt_equivalence=1.0, burst="air", source=None, pressure=101_325.0, temperature=288.15, pulse="friedlander",
    negative_phase=false))]
#[allow(clippy::too_many_arguments)]
pub fn face_history<'py>(
    py: Python<'py>,
    face: &str,
    mode: &str,
    drag: &str,
    mass: f64,
    distance: f64,
    angle_deg: f64,
    clearing_length: f64,
    drag_coefficient: f64,
    times: PyReadonlyArray1<'py, f64>,
    tnt_equivalence: f64,
    burst: &str,
    source: Option<Source>,
    pressure: f64,
    temperature: f64,
    pulse: &str,
    negative_phase: bool,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let field = field(mass, tnt_equivalence, burst, source, pressure, temperature)?;
    let settings = HistorySettings {
        mode: loading_mode(mode)?,
        drag: self::drag(drag)?,
        shape: pulse_shape(pulse)?,
        negative_phase,
        gain: 1.0,
    };
    let cos_alpha = angle_deg.to_radians().cos();
    let (face, cos_alpha) = choose(
        "face",
        face,
        &[
            ("front", (Face::Front { clearing_length }, cos_alpha)),
            ("side", (Face::Rear { clearing_length }, 0.0)),
            ("rear", (Face::Rear { clearing_length }, -cos_alpha)),
        ],
    )?;
    let point = field.at_distance(distance);
    let history = FaceHistory::new(&field, &point, cos_alpha, face, drag_coefficient, settings);
    Ok(PyArray1::from_iter(py, floats(&times).into_iter().map(|t| history.pressure(t))))
}
