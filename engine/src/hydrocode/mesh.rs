//! Cells of a one-dimensional mesh: areas, volumes and centres in each symmetry.
//!
//! Per unit of solid angle (sphere), of angle (axis) or of area (plane): a face at `r` has the area `r^j` with
//! `j` = 2, 1, 0, and a cell the volume `(r₁^(j+1) − r₀^(j+1))/(j + 1)`.

use crate::detonation::Symmetry;
use crate::error::{Error, Result, finite};

/// Mean area of a face that moves evenly from `from` to `to` [m]: times the way it is the swept volume.
#[inline(always)]
pub(super) fn mean_area(symmetry: Symmetry, from: f64, to: f64) -> f64 {
    match symmetry {
        Symmetry::Plane => 1.0,
        Symmetry::Cylindrical => 0.5 * (from + to),
        Symmetry::Spherical => (from * from + from * to + to * to) / 3.0,
    }
}

/// Volume of the cell from `from` to `to` [m].
#[inline(always)]
pub(super) fn volume(symmetry: Symmetry, from: f64, to: f64) -> f64 {
    mean_area(symmetry, from, to) * (to - from)
}

/// Centre of volume of the cell from `from` to `to` [m]: where a linear function takes its mean value.
#[inline(always)]
pub(super) fn centre(symmetry: Symmetry, from: f64, to: f64) -> f64 {
    let sum = from + to;
    match symmetry {
        Symmetry::Plane => 0.5 * sum,
        Symmetry::Cylindrical => 2.0 * (sum * sum - from * to) / (3.0 * sum),
        Symmetry::Spherical => 0.75 * sum * (from * from + to * to) / (from * from + from * to + to * to),
    }
}

/// What the whole of a symmetric body is, over the part that the mesh counts: 1, 2π, 4π.
pub fn whole(symmetry: Symmetry) -> f64 {
    match symmetry {
        Symmetry::Plane => 1.0,
        Symmetry::Cylindrical => 2.0 * core::f64::consts::PI,
        Symmetry::Spherical => 4.0 * core::f64::consts::PI,
    }
}

/// Checks the faces of a mesh: two cells or more, finite and rising, and not below 0 but in the plane.
pub(super) fn check_faces(symmetry: Symmetry, faces: &[f64]) -> Result<()> {
    if faces.len() < 3 {
        return Err(Error::Malformed(format!(
            "the mesh has {} cells, but must have at least 2",
            faces.len().saturating_sub(1)
        )));
    }
    for face in faces {
        finite("a face of the mesh [m]", *face)?;
    }
    if let Some(index) = faces.windows(2).position(|pair| pair[1] <= pair[0]) {
        return Err(Error::Malformed(format!(
            "the mesh has a face at {} m after one at {} m, but the faces must rise",
            faces[index + 1],
            faces[index]
        )));
    }
    if symmetry != Symmetry::Plane && faces[0] < 0.0 {
        return Err(Error::OutOfRange {
            what: "first face of the mesh [m]",
            value: faces[0],
            expected: "0 or more about an axis or a point",
        });
    }
    Ok(())
}
