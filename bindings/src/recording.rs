//! A finished run for Python.

use std::time::Duration;

use engine::recording::{BodyFacts, Recording as EngineRecording};
use numpy::{PyArray1, PyArray2, PyArray3, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::rows_of_three;
use crate::engine;
use crate::pane::Pane;
use engine::simulation::Pane as EnginePane;

/// Poses and facts of a finished run. Arrays are made anew at each access.
#[pyclass(module = "brisance._engine", frozen)]
pub struct Recording {
    inner: EngineRecording,
    panes: Vec<Pane>,
    timing: Timing,
}

/// Wall-clock time of a run's parts.
pub struct Timing {
    pub occlusion: Duration,
    pub fracture: Duration,
    pub load: Duration,
    pub dynamics: Duration,
}

impl Recording {
    pub fn new(inner: EngineRecording, panes: Vec<EnginePane>, timing: Timing) -> Self {
        Self { inner, panes: panes.into_iter().map(Pane::new).collect(), timing }
    }

    fn fact<'py>(&self, py: Python<'py>, fact: fn(&BodyFacts) -> f64) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_iter(py, self.inner.facts.iter().map(fact))
    }

    fn poses<'py>(
        &self,
        flat: Bound<'py, PyArray1<f32>>,
        width: usize,
    ) -> PyResult<Bound<'py, PyArray3<f32>>> {
        flat.reshape([self.inner.times.len(), self.inner.facts.len(), width])
    }
}

#[pymethods]
impl Recording {
    /// Time of each frame [s], (frames,).
    #[getter]
    fn times<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, &self.inner.times)
    }

    /// Centres of mass in the world [m], (frames, bodies, 3).
    #[getter]
    fn positions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f32>>> {
        let flat: Vec<f32> = self.inner.positions.iter().flat_map(|p| p.to_array()).collect();
        self.poses(PyArray1::from_vec(py, flat), 3)
    }

    /// Rotations from body into world, (frames, bodies, 4), w first.
    #[getter]
    fn orientations<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f32>>> {
        let flat: Vec<f32> = self.inner.orientations.iter().flat_map(|q| [q.w, q.x, q.y, q.z]).collect();
        self.poses(PyArray1::from_vec(py, flat), 4)
    }

    /// Masses [kg], (bodies,).
    #[getter]
    fn mass_kg<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.fact(py, |f| f.mass)
    }

    /// Open areas projected toward the nearest charge [m²], (bodies,).
    #[getter]
    fn frontal_area_m2<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.fact(py, |f| f.frontal_area)
    }

    /// Distances from the nearest charge [m], (bodies,).
    #[getter]
    fn distance_m<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.fact(py, |f| f.distance)
    }

    /// Arrival of the first front [s], (bodies,).
    #[getter]
    fn arrival_time_s<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.fact(py, |f| f.arrival_time)
    }

    /// Highest incident overpressures [Pa], (bodies,).
    #[getter]
    fn peak_overpressure_pa<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.fact(py, |f| f.peak_overpressure)
    }

    /// Highest pressures on the most loaded panel [Pa], (bodies,).
    #[getter]
    fn peak_load_pa<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.fact(py, |f| f.peak_load)
    }

    /// Impulses received [N s], (bodies, 3).
    #[getter]
    fn impulse_n_s<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        rows_of_three(py, self.inner.facts.iter().map(|f| f.impulse))
    }

    /// Shares of the unsheltered load received, (bodies,).
    #[getter]
    fn attenuation<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.fact(py, |f| f.attenuation)
    }

    /// Speeds at the end of loading [m/s], (bodies,).
    #[getter]
    fn launch_speed_m_s<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.fact(py, |f| f.launch_speed)
    }

    /// When bodies came to rest for good [s]; not a number where they still move, (bodies,).
    #[getter]
    fn rest_time_s<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.fact(py, |f| f.rest_time)
    }

    /// Of pieces of panes, the part of the impulse that pane and frame took before they were free [N s], (bodies, 3).
    #[getter]
    fn held_back_n_s<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        rows_of_three(py, self.inner.facts.iter().map(|f| f.held_back))
    }

    /// When pieces of panes were free [s]; not a number where they stay, and for other bodies, (bodies,).
    #[getter]
    fn free_time_s<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.fact(py, |f| f.free_time)
    }

    /// What became of the panes, in order; their pieces are the last bodies.
    #[getter]
    fn panes(&self) -> Vec<Pane> {
        self.panes.clone()
    }

    /// The simulation step [s].
    #[getter]
    fn step_s(&self) -> f64 {
        self.inner.step
    }

    /// What was approximated, in sentences.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.inner.warnings.clone()
    }

    /// Wall-clock time of the run's parts [s]: occlusion, fracture, load, dynamics.
    #[getter]
    fn timing_s<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let timing = PyDict::new(py);
        timing.set_item("occlusion", self.timing.occlusion.as_secs_f64())?;
        timing.set_item("fracture", self.timing.fracture.as_secs_f64())?;
        timing.set_item("load", self.timing.load.as_secs_f64())?;
        timing.set_item("dynamics", self.timing.dynamics.as_secs_f64())?;
        Ok(timing)
    }
}
