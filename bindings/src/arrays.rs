//! Between numpy arrays and the engine's vectors.

use glam::{DQuat, DVec3};
use numpy::{
    PyArray1, PyArray2, PyArrayDyn, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods,
};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::InputError;

/// Anything numpy can read as an array of float64 of any shape.
pub fn as_floats<'py>(value: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let numpy = value.py().import("numpy")?;
    let kwargs = PyDict::new(value.py());
    kwargs.set_item("dtype", "float64")?;
    Ok(numpy.call_method("asarray", (value,), Some(&kwargs))?.cast_into::<PyArrayDyn<f64>>()?)
}

/// Applies a function to every element; the result has the shape of the input.
pub fn map<'py>(value: &Bound<'py, PyAny>, f: impl Fn(f64) -> f64) -> PyResult<Bound<'py, PyAny>> {
    let array = as_floats(value)?;
    let mapped: Vec<f64> = array.readonly().as_array().iter().map(|&x| f(x)).collect();
    PyArray1::from_vec(value.py(), mapped).call_method1("reshape", (array.shape().to_vec(),))
}

/// Rows of three numbers.
pub fn vectors(array: &PyReadonlyArray2<f64>, name: &str) -> PyResult<Vec<DVec3>> {
    columns(array, name, 3)?;
    Ok(array.as_array().rows().into_iter().map(|r| DVec3::new(r[0], r[1], r[2])).collect())
}

/// Rows of four numbers, w first.
pub fn quaternions(array: &PyReadonlyArray2<f64>, name: &str) -> PyResult<Vec<DQuat>> {
    columns(array, name, 4)?;
    Ok(array.as_array().rows().into_iter().map(|r| quaternion([r[0], r[1], r[2], r[3]])).collect())
}

/// A unit quaternion from w, x, y, z.
pub fn quaternion([w, x, y, z]: [f64; 4]) -> DQuat {
    DQuat::from_xyzw(x, y, z, w).normalize()
}

/// Three numbers a row into an array of shape (n, 3).
pub fn rows_of_three<'py>(py: Python<'py>, rows: impl Iterator<Item = DVec3>) -> Bound<'py, PyArray2<f64>> {
    let flat: Vec<f64> = rows.flat_map(|v| v.to_array()).collect();
    let count = flat.len() / 3;
    PyArray1::from_vec(py, flat).reshape([count, 3]).expect("three numbers a row")
}

/// A one-dimensional array as a slice, copied if it is not contiguous.
pub fn floats(array: &PyReadonlyArray1<f64>) -> Vec<f64> {
    array.as_array().to_vec()
}

/// Checks that an argument has as many rows as the first one.
pub fn same_length(name: &str, length: usize, expected: usize) -> PyResult<()> {
    if length == expected {
        return Ok(());
    }
    Err(InputError::new_err(format!("{name} has {length} rows, but must have {expected}")))
}

fn columns(array: &PyReadonlyArray2<f64>, name: &str, expected: usize) -> PyResult<()> {
    if array.shape()[1] == expected {
        return Ok(());
    }
    Err(InputError::new_err(format!("{name} must have the shape (n, {expected})")))
}
