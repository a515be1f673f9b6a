//! Crack patterns for Python.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::{Duration, Instant};

use engine::fracture::{
    Cracks, Fineness, Glass, Grown, Pattern as EnginePattern, Pieces as EnginePieces, Recipe, Shape,
};
use engine::geometry::Polygon;
use glam::{DVec2, DVec3};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::arrays::rows_of_three;
use crate::blast::choose;
use crate::{InputError, engine, refused};

/// How often a growing pattern listens for Ctrl-C.
const HEARTBEAT: Duration = Duration::from_millis(50);

/// Cracks and fragments of a pane. Lengths in metres in the pane's plane; growth [m] is how far the first cracks had
/// run. Arrays are made anew at each access.
#[pyclass(module = "brisance._engine", frozen)]
pub struct FracturePattern {
    pub grown: Arc<Grown>,
    pub seconds: f64,
}

/// Grows the cracks of a finished pattern once more, alone, to see what they and what the fragments cost: wall-clock
/// times of both halves of the work [s].
#[pyfunction]
pub fn fracture_stages(
    py: Python<'_>,
    outline: Vec<PyReadonlyArray2<'_, f64>>,
    pattern: &FracturePattern,
) -> PyResult<(f64, f64)> {
    let pane = polygon(&outline)?;
    py.detach(|| {
        let started = Instant::now();
        let mut go_on = || ControlFlow::Continue(());
        let cracks = Cracks::grow(&pane, &pattern.grown.settings, &mut go_on).map_err(refused)?;
        let grown = started.elapsed();
        drop(cracks.into_pattern());
        Ok((grown.as_secs_f64(), (started.elapsed() - grown).as_secs_f64()))
    })
}

/// How a pane breaks, as Python says it; angles in radians.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct RecipeArgument<'py> {
    glass: String,
    pieces: Option<usize>,
    critical_length: Option<f64>,
    seeds: PyReadonlyArray2<'py, f64>,
    starts: Option<usize>,
    shape: String,
    literal: bool,
    fork_angle: f64,
    fork_variance: f64,
    wiggle_probability: f64,
    wiggle_variance: f64,
    wiggle_spacing: Option<f64>,
    rings: f64,
    reach: Option<f64>,
    toward: Option<f64>,
    seed: u64,
}

impl RecipeArgument<'_> {
    /// The engine's recipe, and whether it says how finely to break.
    pub fn into_engine(self) -> PyResult<(Recipe, bool)> {
        let fineness = match (self.pieces, self.critical_length) {
            (Some(count), None) => Some(Fineness::Pieces(count)),
            (None, Some(length)) => Some(Fineness::CriticalLength(length)),
            (None, None) => None,
            _ => return Err(InputError::new_err("give either pieces or critical_length")),
        };
        let kinds =
            [("annealed", Glass::Annealed), ("tempered", Glass::Tempered), ("laminated", Glass::Laminated)];
        let shapes = [("segment", Shape::Segment), ("cross", Shape::Cross), ("star", Shape::Star)];
        let recipe = Recipe {
            glass: choose("glass", &self.glass, &kinds)?,
            fineness: fineness.unwrap_or(Fineness::Pieces(1)),
            seeds: points(&self.seeds, "seeds")?,
            starts: self.starts,
            shape: choose("shape", &self.shape, &shapes)?,
            literal: self.literal,
            fork_angle: self.fork_angle,
            fork_variance: self.fork_variance,
            wiggle_probability: self.wiggle_probability,
            wiggle_variance: self.wiggle_variance,
            wiggle_spacing: self.wiggle_spacing,
            rings: self.rings,
            reach: self.reach,
            toward: self.toward,
            seed: self.seed,
        };
        Ok((recipe, fineness.is_some()))
    }
}

/// Rings (n, 2) as a polygon.
pub fn polygon(outline: &[PyReadonlyArray2<'_, f64>]) -> PyResult<Polygon> {
    let mut pane = Polygon::default();
    for ring in outline {
        pane.push_ring(points(ring, "outline")?);
    }
    Ok(pane)
}

/// Grows the cracks of a pane. `outline` is a list of rings (n, 2), the outer one counter-clockwise and holes
/// clockwise; `recipe` says how it breaks, with either `pieces` or `critical_length`.
#[pyfunction]
#[pyo3(signature = (*, outline, recipe))]
pub fn fracture(
    py: Python<'_>,
    outline: Vec<PyReadonlyArray2<'_, f64>>,
    recipe: RecipeArgument<'_>,
) -> PyResult<FracturePattern> {
    let pane = polygon(&outline)?;
    let (recipe, fine) = recipe.into_engine()?;
    if !fine {
        return Err(InputError::new_err("give either pieces or critical_length"));
    }
    let started = Instant::now();
    let grown = py.detach(|| grow(&recipe, &pane))?;
    Ok(FracturePattern { grown: Arc::new(grown), seconds: started.elapsed().as_secs_f64() })
}

/// Grows a pattern without the GIL, taking it back now and then to listen for Ctrl-C.
fn grow(recipe: &Recipe, pane: &Polygon) -> PyResult<Grown> {
    let mut last_beat = Instant::now();
    let mut interruption = None;
    let mut observer = || {
        if last_beat.elapsed() < HEARTBEAT {
            return ControlFlow::Continue(());
        }
        last_beat = Instant::now();
        match Python::attach(|py| py.check_signals()) {
            Ok(()) => ControlFlow::Continue(()),
            Err(error) => {
                interruption = Some(error);
                ControlFlow::Break(())
            }
        }
    };
    let grown = recipe.grow_observed(pane, &mut observer);
    match interruption {
        Some(error) => Err(error),
        None => grown.map_err(refused),
    }
}

pub fn points(array: &PyReadonlyArray2<f64>, name: &str) -> PyResult<Vec<DVec2>> {
    if array.shape()[1] != 2 {
        return Err(InputError::new_err(format!("{name} must have the shape (n, 2)")));
    }
    Ok(array.as_array().rows().into_iter().map(|r| DVec2::new(r[0], r[1])).collect())
}

/// Numbers of a fixed count a row into an array of shape (n, count).
fn rows<'py>(py: Python<'py>, flat: Vec<f64>, width: usize) -> Bound<'py, PyArray2<f64>> {
    let count = flat.len() / width;
    PyArray1::from_vec(py, flat).reshape([count, width]).expect("whole rows")
}

impl FracturePattern {
    fn pattern(&self) -> &EnginePattern {
        &self.grown.pattern
    }
}

#[pymethods]
impl FracturePattern {
    fn __len__(&self) -> usize {
        self.pattern().len()
    }

    /// Critical length a_c of the cracks [m].
    #[getter]
    fn critical_length_m(&self) -> f64 {
        self.grown.settings.critical_length
    }

    /// How many places cracks started from.
    #[getter]
    fn nuclei(&self) -> usize {
        self.grown.settings.nuclei.len()
    }

    /// Wall-clock time of the growth [s].
    #[getter]
    fn seconds(&self) -> f64 {
        self.seconds
    }

    /// Vertices [m], (vertices, 2).
    #[getter]
    fn vertices<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        rows(py, self.pattern().vertices().iter().flat_map(|v| v.to_array()).collect(), 2)
    }

    /// Vertices of all rings one after the other, (n,): outlines counter-clockwise, holes clockwise.
    #[getter]
    fn ring_vertices<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u32>> {
        PyArray1::from_iter(py, self.pattern().fragments().flat_map(|f| f.rings()).flatten().copied())
    }

    /// For each entry of `ring_vertices`, whether the side that starts there is a piece of the pane's border, (n,).
    #[getter]
    fn on_border<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<bool>> {
        PyArray1::from_iter(py, self.pattern().fragments().flat_map(|f| f.on_border()).flatten().copied())
    }

    /// How many vertices each ring has, (rings,).
    #[getter]
    fn ring_sizes<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u32>> {
        let sizes = self.pattern().fragments().flat_map(|f| f.rings()).map(|ring| ring.len() as u32);
        PyArray1::from_iter(py, sizes)
    }

    /// How many rings each fragment has, the first its outline and the others holes, (fragments,).
    #[getter]
    fn rings_per_fragment<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u32>> {
        PyArray1::from_iter(py, self.pattern().fragments().map(|f| f.rings().len() as u32))
    }

    /// Growth when each fragment's outline closed [m], (fragments,).
    #[getter]
    fn closed_at_m<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_iter(py, self.pattern().fragments().map(|f| f.closed_at()))
    }

    /// Ends of all cracks in the order in which they were cut, x0 y0 x1 y1 [m], (cracks, 4).
    #[getter]
    fn crack_ends<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        let ends = self.pattern().cracks.iter().flat_map(|c| c.ends).flat_map(|p| p.to_array());
        rows(py, ends.collect(), 4)
    }

    /// Growth when each end of each crack was cut [m], (cracks, 2).
    #[getter]
    fn crack_growth_m<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        rows(py, self.pattern().cracks.iter().flat_map(|c| c.growth).collect(), 2)
    }

    /// The crack that each goes on or branches from, −1 at a nucleus, (cracks,).
    #[getter]
    fn crack_parents<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i64>> {
        PyArray1::from_iter(py, self.pattern().cracks.iter().map(|c| c.parent.map_or(-1, i64::from)))
    }

    /// The tip that cut each crack, (cracks,).
    #[getter]
    fn crack_tips<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u32>> {
        PyArray1::from_iter(py, self.pattern().cracks.iter().map(|c| c.tip))
    }

    /// Makes solid pieces `thickness` [m] thick of a density [kg/m³].
    #[pyo3(signature = (*, thickness, density))]
    fn pieces(&self, py: Python<'_>, thickness: f64, density: f64) -> PyResult<Pieces> {
        let started = Instant::now();
        let inner = py.detach(|| EnginePieces::of(self.pattern(), thickness, density)).map_err(refused)?;
        Ok(Pieces { inner: Arc::new(inner), seconds: started.elapsed().as_secs_f64() })
    }
}

/// Fragments as solid pieces, in their order. Arrays are made anew at each access.
#[pyclass(module = "brisance._engine", frozen)]
pub struct Pieces {
    pub inner: Arc<EnginePieces>,
    pub seconds: f64,
}

#[pymethods]
impl Pieces {
    fn __len__(&self) -> usize {
        self.inner.len()
    }

    /// Wall-clock time of the making [s].
    #[getter]
    fn seconds(&self) -> f64 {
        self.seconds
    }

    /// Corners of all pieces, each about its own centroid [m], (vertices, 3): front first, then back.
    #[getter]
    fn vertices<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        let all: Vec<DVec3> = self.inner.meshes.iter().flat_map(|m| m.vertices.iter().copied()).collect();
        rows_of_three(py, all.into_iter())
    }

    /// Where each corner was in the pane [m], (vertices, 2).
    #[getter]
    fn uv<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        rows(py, self.inner.meshes.iter().flat_map(|m| m.uv).flat_map(|v| v.to_array()).collect(), 2)
    }

    /// Triangles of all pieces, counter-clockwise seen from outside, naming corners from each piece's first, (triangles, 3):
    /// of each piece the front, the back and the broken faces.
    #[getter]
    fn triangles<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<u32>> {
        let flat: Vec<u32> = (self.inner.meshes.iter())
            .flat_map(|m| [m.front, m.back, m.broken].into_iter().flatten().flatten().copied())
            .collect();
        let count = flat.len() / 3;
        PyArray1::from_vec(py, flat).reshape([count, 3]).expect("three corners a triangle")
    }

    /// Of each piece: corners, triangles of the front, as many of the back, and triangles of the broken faces,
    /// (pieces, 4).
    #[getter]
    fn counts<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<u32>> {
        let counts = |m: engine::geometry::PieceMesh| {
            [m.vertices.len(), m.front.len(), m.back.len(), m.broken.len()].map(|n| n as u32)
        };
        let flat: Vec<u32> = self.inner.meshes.iter().flat_map(counts).collect();
        PyArray1::from_vec(py, flat).reshape([self.inner.len(), 4]).expect("four counts a piece")
    }

    /// Areas of the faces [m²], (pieces,).
    #[getter]
    fn area_m2<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_iter(py, self.inner.moments.iter().map(|m| m.area))
    }

    /// Centroids in the pane [m], (pieces, 2).
    #[getter]
    fn centroid_m<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        rows(py, self.inner.moments.iter().flat_map(|m| m.centroid.to_array()).collect(), 2)
    }

    /// Length over width of the faces: the root of the ratio of their principal second moments, (pieces,).
    #[getter]
    fn aspect_ratio<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let ratio = |[long, short]: [f64; 2]| (long / short).sqrt();
        PyArray1::from_iter(py, self.inner.moments.iter().map(|m| ratio(m.principal())))
    }

    /// Masses [kg], (pieces,).
    #[getter]
    fn mass_kg<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_iter(py, self.inner.masses.iter().map(|m| m.mass))
    }

    /// Inertia about the centre of mass, row after row [kg m²], (pieces, 9).
    #[getter]
    fn inertia_kg_m2<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        rows(py, self.inner.masses.iter().flat_map(|m| m.inertia.to_cols_array()).collect(), 9)
    }

    /// Panels on which a piece's load is sampled: centre from its centroid x y [m], area [m²]; (panels, 3).
    #[getter]
    fn panels<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        let flat: Vec<f64> = (0..self.inner.len())
            .flat_map(|index| self.inner.samples(index))
            .flat_map(|s| [s.centre.x, s.centre.y, s.area])
            .collect();
        rows(py, flat, 3)
    }

    /// How many panels each piece has, (pieces,).
    #[getter]
    fn panels_per_piece<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u32>> {
        PyArray1::from_iter(py, (0..self.inner.len()).map(|index| self.inner.samples(index).len() as u32))
    }
}

/// Times at which cracks have grown so far [s]: thesis (5.6) integrated. `growth` [m], `terminal_speed` [m/s].
#[pyfunction]
#[pyo3(signature = (growth, *, terminal_speed, critical_length))]
pub fn crack_time<'py>(
    growth: &Bound<'py, PyAny>,
    terminal_speed: f64,
    critical_length: f64,
) -> PyResult<Bound<'py, PyAny>> {
    if !(terminal_speed > 0.0 && terminal_speed.is_finite() && critical_length >= 0.0) {
        return Err(InputError::new_err("terminal_speed must be above 0 and critical_length at least 0"));
    }
    let clock = engine::fracture::CrackClock { terminal_speed, critical_length };
    crate::arrays::map(growth, |s| clock.time(s))
}
