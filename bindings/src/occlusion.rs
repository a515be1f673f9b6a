//! The propagation model's own functions for Python: the map's sheet, distance values, attenuation.

use engine::occlusion::{Attenuation, SphereMap};
use numpy::{PyArray1, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::arrays::{as_floats, vectors};
use crate::{InputError, engine, refused};

/// Corners of every pixel on the unfolded sheet of Fig. 4.3, (pixels, 3, 2), in edge lengths.
#[pyfunction]
#[pyo3(signature = (*, resolution))]
pub fn unfolded_sphere(py: Python<'_>, resolution: usize) -> PyResult<Bound<'_, PyArray3<f64>>> {
    let map = SphereMap::new(resolution).map_err(refused)?;
    let flat: Vec<f64> =
        (0..map.len()).flat_map(|pixel| map.unfolded(pixel).into_iter().flat_map(|p| p.to_array())).collect();
    PyArray1::from_vec(py, flat).reshape([map.len(), 3, 2])
}

/// The pixel that holds each direction (n, 3), whatever its length, (n,).
#[pyfunction]
#[pyo3(signature = (*, directions, resolution))]
pub fn sphere_pixels<'py>(
    py: Python<'py>,
    directions: PyReadonlyArray2<'py, f64>,
    resolution: usize,
) -> PyResult<Bound<'py, PyArray1<i64>>> {
    let map = SphereMap::new(resolution).map_err(refused)?;
    let pixels = vectors(&directions, "directions")?.into_iter().map(|direction| map.pixel(direction) as i64);
    Ok(PyArray1::from_iter(py, pixels))
}

/// Distance values of Fig. 4.4 of a shape on square pixels, (rows, columns).
#[pyfunction]
#[pyo3(signature = (*, shape))]
pub fn ring_values<'py>(
    py: Python<'py>,
    shape: PyReadonlyArray2<'py, bool>,
) -> PyResult<Bound<'py, PyArray2<u32>>> {
    let (rows, columns) = (shape.shape()[0], shape.shape()[1]);
    let inside: Vec<bool> = shape.as_array().iter().copied().collect();
    let values = engine::occlusion::ring_values(&inside, columns);
    PyArray1::from_vec(py, values).reshape([rows, columns])
}

/// Share f of the load that comes through (4.1), of blocking factors and separations of one shape.
#[pyfunction]
#[pyo3(signature = (*, blocking, separation, offset, slope, exponent, power))]
pub fn attenuation<'py>(
    blocking: &Bound<'py, PyAny>,
    separation: &Bound<'py, PyAny>,
    offset: f64,
    slope: f64,
    exponent: f64,
    power: f64,
) -> PyResult<Bound<'py, PyAny>> {
    let parameters = Attenuation { offset, slope, exponent, power };
    parameters.validate().map_err(refused)?;
    let (b, k) = (as_floats(blocking)?, as_floats(separation)?);
    if b.shape() != k.shape() {
        return Err(InputError::new_err("blocking and separation must have the same shape"));
    }
    let (b_values, k_values) = (b.readonly(), k.readonly());
    let shares =
        b_values.as_array().into_iter().zip(k_values.as_array()).map(|(&b, &k)| parameters.factor(b, k));
    let flat = PyArray1::from_iter(blocking.py(), shares);
    flat.call_method1("reshape", (b.shape().to_vec(),))
}
