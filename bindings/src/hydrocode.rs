//! The hydrocode for Python.

use engine::air::Air;
use engine::hydrocode::blast::{ChargeRun, Start};
use engine::hydrocode::cases::Case;
use engine::hydrocode::{
    Gauge, Godunov, GodunovSettings, Motion, Scheme, Symmetry, Viscosity, ViscositySettings,
};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::floats;
use crate::blast::choose;
use crate::{engine, refused};

pub fn symmetry(name: &str) -> PyResult<Symmetry> {
    choose(
        "geometry",
        name,
        &[
            ("plane", Symmetry::Plane),
            ("cylindrical", Symmetry::Cylindrical),
            ("spherical", Symmetry::Spherical),
        ],
    )
}

#[derive(Clone, Copy, PartialEq)]
enum Method {
    Godunov,
    Viscosity,
}

fn method(name: &str) -> PyResult<Method> {
    choose("scheme", name, &[("godunov", Method::Godunov), ("viscosity", Method::Viscosity)])
}

fn profile<'py>(py: Python<'py>, flow: &impl Scheme) -> PyResult<Bound<'py, PyDict>> {
    let velocities: Vec<f64> = (0..flow.density().len()).map(|cell| flow.velocity(cell)).collect();
    let result = PyDict::new(py);
    result.set_item("time_s", flow.time())?;
    result.set_item("x_m", PyArray1::from_slice(py, flow.centre()))?;
    result.set_item("density_kg_m3", PyArray1::from_slice(py, flow.density()))?;
    result.set_item("velocity_m_s", PyArray1::from_vec(py, velocities))?;
    result.set_item("pressure_pa", PyArray1::from_slice(py, flow.pressure()))?;
    Ok(result)
}

/// Steps between two looks for Ctrl-C.
const PATIENCE: usize = 500;

/// Hears Ctrl-C now and then while the engine works without the interpreter.
struct Listener {
    steps: usize,
    heard: Option<PyErr>,
}

impl Listener {
    fn new() -> Self {
        Self { steps: 0, heard: None }
    }

    fn watch(&mut self) -> engine::Result<()> {
        self.steps += 1;
        if !self.steps.is_multiple_of(PATIENCE) {
            return Ok(());
        }
        Python::attach(|py| py.check_signals()).map_err(|stop| {
            self.heard = Some(stop);
            engine::Error::Cancelled
        })
    }

    fn end<T>(self, result: engine::Result<T>) -> PyResult<T> {
        match self.heard {
            Some(stop) => Err(stop),
            None => result.map_err(refused),
        }
    }
}

/// A well-known case ("sod", "shu-osher", "noh", "sedov") at its end or at `end`: the profile, and the exact
/// solution at the same places where there is one.
///
/// `viscosity` is the quadratic and the linear coefficient of that scheme.
#[pyfunction]
#[pyo3(signature = (*, case, geometry="plane", scheme="godunov", cells=400, courant=None, end=None, viscosity=None))]
#[allow(clippy::too_many_arguments)]
pub fn hydrocode_case<'py>(
    py: Python<'py>,
    case: &str,
    geometry: &str,
    scheme: &str,
    cells: usize,
    courant: Option<f64>,
    end: Option<f64>,
    viscosity: Option<(f64, f64)>,
) -> PyResult<Bound<'py, PyDict>> {
    let case = choose(
        "case",
        case,
        &[("sod", Case::Sod), ("shu-osher", Case::ShuOsher), ("noh", Case::Noh), ("sedov", Case::Sedov)],
    )?;
    let symmetry = symmetry(geometry)?;
    let start = case.cells(symmetry, cells).map_err(refused)?;
    let end = end.unwrap_or(case.end());
    let mut listener = Listener::new();
    let result = match method(scheme)? {
        Method::Godunov => {
            let (inner, outer) = case.boundaries();
            let plain = GodunovSettings::default();
            let courant = courant.unwrap_or(plain.courant);
            let settings = GodunovSettings { courant, motion: Motion::Fixed, inner, outer };
            let mut flow = Godunov::new(&start, settings).map_err(refused)?;
            let done = py.detach(|| flow.run(end, |_| listener.watch()));
            listener.end(done)?;
            profile(py, &flow)?
        }
        Method::Viscosity => {
            let plain = ViscositySettings::default();
            let (quadratic, linear) = viscosity.unwrap_or((plain.quadratic, plain.linear));
            let free = matches!(case, Case::Noh | Case::Sedov);
            let outer_pressure = free.then_some(engine::hydrocode::cases::COLD_PRESSURE);
            let courant = courant.unwrap_or(plain.courant);
            let settings = ViscositySettings { quadratic, linear, courant, outer_pressure, ..plain };
            let mut flow = Viscosity::new(&start, settings).map_err(refused)?;
            let done = py.detach(|| flow.run(end, |_| listener.watch()));
            listener.end(done)?;
            profile(py, &flow)?
        }
    };
    let places: Vec<f64> = result.get_item("x_m")?.expect("set above").extract()?;
    if let Some(solution) = case.exact(symmetry).map_err(refused)? {
        let exact: Vec<_> = places.iter().map(|&x| solution.at(x, end)).collect();
        result.set_item("exact_density_kg_m3", PyArray1::from_iter(py, exact.iter().map(|s| s.density)))?;
        result.set_item("exact_velocity_m_s", PyArray1::from_iter(py, exact.iter().map(|s| s.velocity)))?;
        result.set_item("exact_pressure_pa", PyArray1::from_iter(py, exact.iter().map(|s| s.pressure)))?;
    }
    Ok(result)
}

/// A charge of TNT from the end of its detonation: what passed each of the distances [m], and the profile in
/// the end, which comes when the positive phase has passed all of them, or at `end` [s] if that is later. Times
/// count from detonation at the centre.
#[pyfunction]
#[pyo3(signature = (*, mass, distance, geometry="spherical", scheme="godunov", product_cells=None, air_cells=None,
    courant=None, start="detonation", end=0.0, pressure=101_325.0, temperature=288.15))]
#[allow(clippy::too_many_arguments)]
pub fn hydrocode_charge<'py>(
    py: Python<'py>,
    mass: f64,
    distance: PyReadonlyArray1<'py, f64>,
    geometry: &str,
    scheme: &str,
    product_cells: Option<usize>,
    air_cells: Option<usize>,
    courant: Option<f64>,
    start: &str,
    end: f64,
    pressure: f64,
    temperature: f64,
) -> PyResult<Bound<'py, PyDict>> {
    let method = method(scheme)?;
    // The historical scheme spends its steps on the smallest cells, so it starts with fewer.
    let plain = match method {
        Method::Godunov => ChargeRun::default(),
        Method::Viscosity => {
            ChargeRun { product_cells: 30, air_cells: 400, courant: 0.4, ..ChargeRun::default() }
        }
    };
    let run = ChargeRun {
        mass,
        symmetry: symmetry(geometry)?,
        air: Air { pressure, temperature, ..Air::default() },
        start: choose(
            "start",
            start,
            &[("detonation", Start::Detonation), ("constant-volume", Start::ConstantVolume)],
        )?,
        product_cells: product_cells.unwrap_or(plain.product_cells),
        air_cells: air_cells.unwrap_or(plain.air_cells),
        courant: courant.unwrap_or(plain.courant),
    };
    let distances = floats(&distance);
    let (gauges, result) = match method {
        Method::Godunov => {
            let mut flow = run.godunov().map_err(refused)?;
            (record(py, &run, &mut flow, &distances, end)?, profile(py, &flow)?)
        }
        Method::Viscosity => {
            let settings = ViscositySettings { courant: run.courant, ..ViscositySettings::default() };
            let mut flow = run.viscosity(run.reach(&distances, end), settings).map_err(refused)?;
            (record(py, &run, &mut flow, &distances, end)?, profile(py, &flow)?)
        }
    };
    let since_start: f64 = result.get_item("time_s")?.expect("set above").extract()?;
    result.set_item("time_s", since_start + run.detonation_time().map_err(refused)?)?;
    result.set_item("charge_radius_m", run.radius())?;
    result.set_item("product_cells", run.product_cells)?;
    result.set_item("air_cells", run.air_cells)?;
    result.set_item("courant", run.courant)?;
    set_gauges(py, &result, &gauges)?;
    Ok(result)
}

fn record(
    py: Python<'_>,
    run: &ChargeRun,
    flow: &mut (impl Scheme + Send),
    distances: &[f64],
    end: f64,
) -> PyResult<Vec<Gauge>> {
    let mut listener = Listener::new();
    let done = py.detach(|| run.record(flow, distances, end, |_| listener.watch()));
    listener.end(done)
}

fn set_gauges<'py>(py: Python<'py>, result: &Bound<'py, PyDict>, gauges: &[Gauge]) -> PyResult<()> {
    let column = |name: &str, pick: fn(&Gauge) -> f64| {
        result.set_item(name, PyArray1::from_iter(py, gauges.iter().map(pick)))
    };
    column("distance_m", |g| g.distance)?;
    column("overpressure_pa", |g| g.overpressure)?;
    column("dynamic_pressure_pa", |g| g.dynamic_pressure)?;
    column("front_velocity_m_s", |g| g.front_velocity.unwrap_or(f64::NAN))?;
    column("arrival_time_s", |g| g.arrival.unwrap_or(f64::NAN))?;
    column("duration_s", |g| g.duration.unwrap_or(f64::NAN))?;
    column("impulse_pa_s", |g| g.impulse)?;
    let histories: Vec<_> = gauges
        .iter()
        .map(|gauge| {
            let times = PyArray1::from_iter(py, gauge.history.iter().map(|sample| sample.0));
            (times, PyArray1::from_iter(py, gauge.history.iter().map(|sample| sample.1)))
        })
        .collect();
    result.set_item("history", histories)
}
