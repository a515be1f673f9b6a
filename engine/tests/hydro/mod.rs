//! Running the hydrocode on its cases, for its tests.
#![allow(dead_code)]

use brisance_engine::hydrocode::cases::Case;
use brisance_engine::hydrocode::{
    Godunov, GodunovSettings, Motion, Scheme, Symmetry, Viscosity, ViscositySettings,
};

pub const SYMMETRIES: [Symmetry; 3] = [Symmetry::Plane, Symmetry::Cylindrical, Symmetry::Spherical];

pub fn relative(got: f64, expected: f64) -> f64 {
    (got - expected).abs() / expected.abs()
}

/// `case` run to its end by the Godunov scheme.
pub fn godunov(case: Case, symmetry: Symmetry, cells: usize, motion: Motion) -> Godunov {
    let (inner, outer) = case.boundaries();
    let settings = GodunovSettings { motion, inner, outer, ..GodunovSettings::default() };
    let mut flow = Godunov::new(&case.cells(symmetry, cells).unwrap(), settings).unwrap();
    flow.run(case.end(), |_| Ok(())).unwrap();
    flow
}

/// `case` run to its end by the scheme with viscosity.
pub fn viscosity(case: Case, symmetry: Symmetry, cells: usize) -> Viscosity {
    let outer_pressure = if case == Case::Sod { None } else { Some(1e-6) };
    let settings = ViscositySettings { outer_pressure, ..ViscositySettings::default() };
    let mut flow = Viscosity::new(&case.cells(symmetry, cells).unwrap(), settings).unwrap();
    flow.run(case.end(), |_| Ok(())).unwrap();
    flow
}

/// Mean difference in density from `exact`, over places between `from` and `to`.
pub fn mean_error(flow: &impl Scheme, (from, to): (f64, f64), exact: impl Fn(f64) -> f64) -> f64 {
    let (mut sum, mut width) = (0.0, 0.0);
    for cell in 0..flow.density().len() {
        let at = flow.centre()[cell];
        if at > from && at < to {
            let here = flow.face()[cell + 1] - flow.face()[cell];
            sum += here * (flow.density()[cell] - exact(at)).abs();
            width += here;
        }
    }
    sum / width
}

/// [`mean_error`] of a case from its exact solution.
pub fn case_error(flow: &impl Scheme, case: Case, symmetry: Symmetry, within: (f64, f64)) -> f64 {
    let exact = case.exact(symmetry).unwrap().unwrap();
    mean_error(flow, within, |at| exact.at(at, case.end()).density)
}

/// Order of convergence from errors at doubling resolution, the coarsest first.
pub fn order(errors: &[f64]) -> f64 {
    let last = errors.len() - 1;
    (errors[0] / errors[last]).log2() / last as f64
}
