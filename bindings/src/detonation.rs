//! Detonations and shocks in inert material for Python.

use engine::detonation::{Behind, Detonation, Explosive, FollowingFlow, Inert};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::{floats, map};
use crate::blast::choose;
use crate::hydrocode::symmetry;
use crate::{InputError, engine, refused};

/// TNT by name of its products: measured JWL constants, or the ideal gas of the same detonation.
fn explosive(products: &str) -> PyResult<Explosive> {
    let tnt = Explosive::TNT;
    let point = tnt.chapman_jouguet().map_err(refused)?;
    let ideal = Explosive::ideal(tnt.density, point.front_velocity, point.pressure).map_err(refused)?;
    choose("products", products, &[("jwl", tnt), ("ideal", ideal)])
}

fn state<'py>(py: Python<'py>, at: &Behind) -> PyResult<Bound<'py, PyDict>> {
    let result = PyDict::new(py);
    result.set_item("front_velocity_m_s", at.front_velocity)?;
    result.set_item("pressure_pa", at.pressure)?;
    result.set_item("density_kg_m3", at.density)?;
    result.set_item("velocity_m_s", at.velocity)?;
    result.set_item("sound_speed_m_s", at.sound_speed)?;
    result.set_item("energy_j_kg", at.energy)?;
    Ok(result)
}

/// TNT's detonation: the Chapman–Jouguet point, the Hugoniot at relative volumes v/v0 (below 1), and the strong
/// and weak solutions for a front velocity [m/s].
#[pyfunction]
#[pyo3(signature = (*, relative_volume, products="jwl", front_velocity=None))]
pub fn detonation_hugoniot<'py>(
    py: Python<'py>,
    relative_volume: PyReadonlyArray1<'py, f64>,
    products: &str,
    front_velocity: Option<f64>,
) -> PyResult<Bound<'py, PyDict>> {
    let explosive = explosive(products)?;
    let least = explosive.least_volume() * explosive.density;
    let volumes = floats(&relative_volume);
    if let Some(bad) = volumes.iter().find(|v| !(**v > least && **v < 1.0)) {
        return Err(InputError::new_err(format!(
            "relative volume is {bad}, but must be between {least:.4}, which no front can reach, and 1"
        )));
    }
    let states: Vec<Behind> = volumes.iter().map(|v| explosive.behind(v / explosive.density)).collect();
    let result = PyDict::new(py);
    result.set_item("density_at_rest_kg_m3", explosive.density)?;
    result.set_item("least_relative_volume", least)?;
    result.set_item("chapman_jouguet", state(py, &explosive.chapman_jouguet().map_err(refused)?)?)?;
    result
        .set_item("specific_volume_m3_kg", PyArray1::from_iter(py, states.iter().map(|s| 1.0 / s.density)))?;
    result.set_item("velocity_m_s", PyArray1::from_iter(py, states.iter().map(|s| s.velocity)))?;
    result.set_item("pressure_pa", PyArray1::from_iter(py, states.iter().map(|s| s.pressure)))?;
    if let Some(front) = front_velocity {
        let (strong, weak) = explosive.solutions(front).map_err(refused)?;
        result.set_item("strong", state(py, &strong)?)?;
        result.set_item("weak", state(py, &weak)?)?;
    }
    Ok(result)
}

/// A shock in inert material with D = c0 + s1 u + s2 u²: states at particle velocities [m/s]; copper by default.
#[pyfunction]
#[pyo3(signature = (*, velocity, density=8930.0, sound_speed=3940.0, slope=1.489, curvature=0.0))]
pub fn inert_hugoniot<'py>(
    py: Python<'py>,
    velocity: &Bound<'py, PyAny>,
    density: f64,
    sound_speed: f64,
    slope: f64,
    curvature: f64,
) -> PyResult<Bound<'py, PyDict>> {
    let material = Inert { density, sound_speed, slope, curvature };
    material.validate().map_err(refused)?;
    let result = PyDict::new(py);
    result.set_item("front_velocity_m_s", map(velocity, |u| material.front_velocity(u))?)?;
    result.set_item("pressure_pa", map(velocity, |u| material.pressure(u))?)?;
    result.set_item("specific_volume_m3_kg", map(velocity, |u| material.specific_volume(u))?)?;
    Ok(result)
}

/// The reaction zone of TNT with ideal-gas products: the profile behind the front, and the p–u Hugoniots of
/// partly reacted gas, one for each `progress`, at particle velocities [m/s, above 0].
#[pyfunction]
#[pyo3(signature = (*, reaction_time, velocity, progress, front_velocity=None, points=200))]
pub fn reaction_zone<'py>(
    py: Python<'py>,
    reaction_time: f64,
    velocity: PyReadonlyArray1<'py, f64>,
    progress: Vec<f64>,
    front_velocity: Option<f64>,
    points: usize,
) -> PyResult<Bound<'py, PyDict>> {
    let detonation = Detonation::new(explosive("ideal")?, front_velocity, reaction_time).map_err(refused)?;
    let profile = detonation.profile(points).map_err(refused)?;
    let velocities = floats(&velocity);
    let hugoniots: Vec<_> = progress
        .iter()
        .map(|&part| PyArray1::from_iter(py, velocities.iter().map(|&u| detonation.pressure(u, part))))
        .collect();
    let result = PyDict::new(py);
    result.set_item("front_velocity_m_s", detonation.front_velocity())?;
    result.set_item("hugoniot_pressure_pa", hugoniots)?;
    let column = |name: &str, pick: fn(&engine::detonation::ZonePoint) -> f64| {
        result.set_item(name, PyArray1::from_iter(py, profile.iter().map(pick)))
    };
    column("progress", |at| at.progress)?;
    column("distance_m", |at| at.distance)?;
    column("pressure_pa", |at| at.pressure)?;
    column("density_kg_m3", |at| at.density)?;
    column("velocity_m_s", |at| at.velocity)?;
    Ok(result)
}

/// The flow behind TNT's detonation at places r/R from 0 to 1 (the front).
#[pyfunction]
#[pyo3(signature = (*, place, products="jwl", geometry="spherical"))]
pub fn following_flow<'py>(
    py: Python<'py>,
    place: PyReadonlyArray1<'py, f64>,
    products: &str,
    geometry: &str,
) -> PyResult<Bound<'py, PyDict>> {
    let flow = FollowingFlow::new(&explosive(products)?, symmetry(geometry)?).map_err(refused)?;
    let points: Vec<_> = floats(&place).into_iter().map(|place| flow.at(place)).collect();
    let result = PyDict::new(py);
    result.set_item("core", flow.core())?;
    result.set_item("pressure_pa", PyArray1::from_iter(py, points.iter().map(|p| p.pressure)))?;
    result.set_item("density_kg_m3", PyArray1::from_iter(py, points.iter().map(|p| p.density)))?;
    result.set_item("velocity_m_s", PyArray1::from_iter(py, points.iter().map(|p| p.velocity)))?;
    Ok(result)
}
