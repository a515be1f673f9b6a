//! Numbers that the contact world can hold: it works in single precision, and squares and multiplies them.

use core::ops::RangeInclusive;

use glam::{DVec2, DVec3};

use crate::error::{Error, Result};
use crate::geometry::bounds;
use crate::scene::{Body, Scene, Shape};
use crate::window::Window;

/// Coordinates [m].
const PLACES: RangeInclusive<f64> = -1e6..=1e6;
/// Edges [m].
const SIZES: RangeInclusive<f64> = 1e-6..=1e6;
/// Masses [kg].
const MASSES: RangeInclusive<f64> = 1e-9..=1e12;
/// Coefficients of friction.
const FRICTIONS: RangeInclusive<f64> = 0.0..=1e6;

/// Refuses a scene with bodies that touch where a number is beyond what that can be computed with.
///
/// # Errors
/// [`Error::Malformed`] that names the body or window.
pub(super) fn check(scene: &Scene) -> Result<()> {
    if let Some(ground) = scene.ground {
        within("height [m]", ground.height, PLACES).map_err(|error| error.about("ground"))?;
        within("friction", ground.friction, FRICTIONS).map_err(|error| error.about("ground"))?;
    }
    for (index, body) in scene.bodies.iter().enumerate() {
        check_body(body).map_err(|error| error.about(&format!("body {index}")))?;
    }
    for (index, window) in scene.windows.iter().enumerate() {
        check_window(window).map_err(|error| error.about(&format!("window {index}")))?;
    }
    Ok(())
}

fn check_body(body: &Body) -> Result<()> {
    place(body.position)?;
    let extent = match &body.shape {
        Shape::Box { size, .. } => *size,
        Shape::Mesh(mesh) => extent(mesh.vertices.iter().copied()),
        Shape::Flat(flat) => {
            extent(flat.outline.points().iter().map(|p| p.extend(0.0))).with_z(flat.thickness)
        }
    };
    for edge in extent.to_array() {
        within("size [m]", edge, SIZES)?;
    }
    within("mass [kg]", body.mass, MASSES)?;
    within("friction", body.friction, FRICTIONS)
}

fn check_window(window: &Window) -> Result<()> {
    place(window.position)?;
    let extent = extent(window.outline.points().iter().map(|p: &DVec2| p.extend(0.0)));
    for edge in extent.with_z(window.thickness).to_array() {
        within("size [m]", edge, SIZES)?;
    }
    within("friction", window.friction, FRICTIONS)
}

fn place(position: DVec3) -> Result<()> {
    position.to_array().into_iter().try_for_each(|coordinate| within("position [m]", coordinate, PLACES))
}

fn extent(points: impl Iterator<Item = DVec3>) -> DVec3 {
    let (low, high) = bounds(points);
    high - low
}

fn within(what: &str, value: f64, range: RangeInclusive<f64>) -> Result<()> {
    if range.contains(&value) {
        return Ok(());
    }
    let (least, most) = (range.start(), range.end());
    Err(Error::Malformed(format!(
        "{what} is {value:e}, but where bodies touch it must be from {least:e} to {most:e}"
    )))
}
