//! `brisance._engine`: the engine for Python.
//!
//! Thin: numpy arrays in and out, keyword arguments only, the GIL released while the engine works, Ctrl-C heard.
//! Everything a user gets wrong becomes `brisance.errors.InputError` with the engine's own sentence.

mod arrays;
mod blast;
mod detonation;
mod fracture;
mod hydrocode;
mod material;
mod occlusion;
mod pane;
mod recording;
mod run;
mod scene;
mod structure;

use brisance_engine as engine;
use pyo3::prelude::*;

pyo3::import_exception!(brisance.errors, InputError);

/// The engine's refusal as Python's exception.
fn refused(error: engine::Error) -> PyErr {
    InputError::new_err(error.to_string())
}

#[pymodule]
mod _engine {
    #[pymodule_export]
    use super::blast::{
        curves, explosives, face_history, front_radius, pulse, rankine_hugoniot, reflection_chart,
        reflection_coefficient,
    };
    #[pymodule_export]
    use super::detonation::{detonation_hugoniot, following_flow, inert_hugoniot, reaction_zone};
    #[pymodule_export]
    use super::fracture::{FracturePattern, Pieces, crack_time, fracture, fracture_stages};
    #[pymodule_export]
    use super::hydrocode::{hydrocode_case, hydrocode_charge};
    #[pymodule_export]
    use super::material::{
        critical_length, energy_release, material_facts, materials, mean_fragment_area,
        mean_fragment_velocity,
    };
    #[pymodule_export]
    use super::occlusion::{attenuation, ring_values, sphere_pixels, unfolded_sphere};
    #[pymodule_export]
    use super::pane::Pane;
    #[pymodule_export]
    use super::recording::Recording;
    #[pymodule_export]
    use super::scene::{Scene, mass_properties};
    #[pymodule_export]
    use super::structure::{pressure_impulse, structure_reaches, structure_response};
}
