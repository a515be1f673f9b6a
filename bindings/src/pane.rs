//! What became of a pane, for Python.

use std::sync::Arc;

use engine::dynamics::Bowing;
use engine::fracture::{Grown, Pieces as EnginePieces};
use engine::simulation::{Fate, Pane as EnginePane};
use engine::structure::Plate;
use numpy::{PyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

use crate::engine;
use crate::fracture::{FracturePattern, Pieces, points};

/// A pane after a run. Lengths in metres in its own frame.
#[pyclass(module = "brisance._engine", frozen)]
#[derive(Clone)]
pub struct Pane {
    fate: Fate,
    peak_pressure: f64,
    peak_stress: f64,
    staying: usize,
    warnings: Vec<String>,
    plate: Arc<Plate>,
    bowing: Arc<Bowing>,
    grown: Arc<Grown>,
    pieces: Arc<EnginePieces>,
}

impl Pane {
    pub fn new(pane: EnginePane) -> Self {
        Self {
            fate: pane.fate,
            peak_pressure: pane.peak_pressure,
            peak_stress: pane.peak_stress,
            staying: pane.staying(),
            warnings: pane.warnings,
            plate: pane.plate,
            bowing: pane.bowing,
            grown: Arc::new(pane.grown),
            pieces: Arc::new(pane.pieces),
        }
    }
}

#[pymethods]
impl Pane {
    /// "holds", "fails" or "in pieces" (before the blast came).
    #[getter]
    fn fate(&self) -> &'static str {
        match self.fate {
            Fate::Holds => "holds",
            Fate::Fails { .. } => "fails",
            Fate::InPieces => "in pieces",
        }
    }

    /// When it failed [s]; None if it did not.
    #[getter]
    fn failure_time_s(&self) -> Option<f64> {
        if let Fate::Fails { time, .. } = self.fate { Some(time) } else { None }
    }

    /// Where it failed [m]; None if it did not.
    #[getter]
    fn failure_place_m(&self) -> Option<(f64, f64)> {
        if let Fate::Fails { place, .. } = self.fate { Some((place.x, place.y)) } else { None }
    }

    /// Highest mean pressure on it from one charge [Pa].
    #[getter]
    fn peak_pressure_pa(&self) -> f64 {
        self.peak_pressure
    }

    /// Greatest stress in it until it failed [Pa].
    #[getter]
    fn peak_stress_pa(&self) -> f64 {
        self.peak_stress
    }

    /// How many of its pieces stay where they are.
    #[getter]
    fn staying(&self) -> usize {
        self.staying
    }

    /// What was approximated, in sentences.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.warnings.clone()
    }

    /// Its cracks and fragments.
    #[getter]
    fn pattern(&self) -> FracturePattern {
        FracturePattern { grown: Arc::clone(&self.grown), seconds: 0.0 }
    }

    /// Its pieces as solids.
    #[getter]
    fn pieces(&self) -> Pieces {
        Pieces { inner: Arc::clone(&self.pieces), seconds: 0.0 }
    }

    /// Angular frequency of its free swing [rad/s].
    #[getter]
    fn frequency_rad_s(&self) -> f64 {
        self.plate.frequency()
    }

    /// The greatest stress in it under a pressure of 1 Pa.
    #[getter]
    fn stress_per_pressure(&self) -> f64 {
        self.plate.strongest()
    }

    /// How far it bends at `places` (n, 2) under a pressure of 1 Pa, along its own +z [m/Pa], (n,).
    fn deflection<'py>(
        &self,
        py: Python<'py>,
        places: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let places = points(&places, "places")?;
        Ok(PyArray1::from_iter(py, places.into_iter().map(|place| self.plate.deflection(place))))
    }

    /// How far it was bent at some times [s], as the pressure that would bend it as far at rest [Pa].
    fn amplitude<'py>(&self, py: Python<'py>, times: Vec<f64>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_iter(py, times.into_iter().map(|t| self.bowing.at(t)[0]))
    }
}
