//! Brittle materials for Python.

use engine::material::{self, MATERIALS, Material};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::{InputError, engine, refused};

fn named(name: &str) -> PyResult<Material> {
    Material::named(name).ok_or_else(|| {
        let known: Vec<&str> = MATERIALS.iter().map(|(name, _)| *name).collect();
        InputError::new_err(format!("material is \"{name}\", but must be one of {}", known.join(", ")))
    })
}

/// Names of the brittle materials.
#[pyfunction]
pub fn materials() -> Vec<&'static str> {
    MATERIALS.iter().map(|(name, _)| *name).collect()
}

/// What is known of a material, in SI units: density, stiffness, toughness, strength, and the speeds of waves and cracks.
#[pyfunction]
#[pyo3(name = "material")]
pub fn material_facts<'py>(py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyDict>> {
    let material = named(name)?;
    let facts = PyDict::new(py);
    facts.set_item("density_kg_m3", material.density)?;
    facts.set_item("young_modulus_pa", material.young_modulus)?;
    facts.set_item("poisson_ratio", material.poisson_ratio)?;
    facts.set_item("fracture_energy_j_m2", material.critical_energy_release())?;
    facts.set_item("toughness_pa_m12", material.critical_stress_intensity())?;
    facts.set_item("tensile_strength_pa", material.tensile_strength)?;
    facts.set_item("wave_speed_m_s", material.wave_speed())?;
    facts.set_item("crack_speed_m_s", material.terminal_crack_speed())?;
    Ok(facts)
}

/// The crack that a tensile stress [Pa] just makes run [m] (5.5); infinite without tension.
#[pyfunction]
#[pyo3(signature = (*, material, stress))]
pub fn critical_length(material: &str, stress: f64) -> PyResult<f64> {
    Ok(named(material)?.critical_length(stress))
}

/// Energy that a crack of `length` [m] under `stress` [Pa] releases for each area it grows by [J/m²].
#[pyfunction]
#[pyo3(signature = (*, material, stress, length))]
pub fn energy_release(material: &str, stress: f64, length: f64) -> PyResult<f64> {
    Ok(named(material)?.energy_release(stress, length))
}

/// Mean frontal area of a window's fragments [m²] (2.45), and whether it is held at the least that makes sense.
#[pyfunction]
#[pyo3(signature = (*, pressure))]
pub fn mean_fragment_area(pressure: f64) -> PyResult<(f64, bool)> {
    let mean = material::mean_fragment_area(pressure).map_err(refused)?;
    Ok((mean.area, mean.is_floor()))
}

/// Mean velocity of a window's fragments [m/s] (2.46), from the pressure on it [Pa] and its thickness [m].
#[pyfunction]
#[pyo3(signature = (*, pressure, thickness))]
pub fn mean_fragment_velocity(pressure: f64, thickness: f64) -> PyResult<f64> {
    material::mean_fragment_velocity(pressure, thickness).map_err(refused)
}
