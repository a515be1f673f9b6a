//! Mass, centre of mass and moment of inertia of solid bodies of one density.

use glam::{DMat3, DQuat, DVec3, Vec3Swizzles};

use super::TriangleMesh;
use crate::error::{Error, Result};

/// Mass properties of a solid of uniform density.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MassProperties {
    /// Mass [kg].
    pub mass: f64,
    /// Centre of mass in the object's own frame [m].
    pub centre: DVec3,
    /// Moment of inertia about the centre of mass, in the object's own axes [kg m²].
    ///
    /// Off-diagonals carry the sign of the matrix: `I_xy = −∫ρ x y dV`.
    pub inertia: DMat3,
}

impl MassProperties {
    /// A box of the given edge lengths, centred on the origin.
    pub fn of_box(size: DVec3, mass: f64) -> Self {
        let s = size * size;
        let diagonal = DVec3::new(s.y + s.z, s.x + s.z, s.x + s.y) * (mass / 12.0);
        Self { mass, centre: DVec3::ZERO, inertia: DMat3::from_diagonal(diagonal) }
    }

    /// The solid inside a closed mesh: exact, by summing signed tetrahedra (Tonon 2004).
    ///
    /// The sum runs about the mesh's own middle, so that a mesh far from the origin loses no digits.
    ///
    /// # Errors
    /// [`Error::Malformed`] when the mesh encloses no volume (flat, or open and inside out).
    pub fn of_mesh(mesh: &TriangleMesh, density: f64) -> Result<Self> {
        let count = mesh.vertices.len() as f64;
        let middle = mesh.vertices.iter().sum::<DVec3>() / count;
        let reach = mesh.vertices.iter().map(|v| v.distance(middle)).fold(0.0, f64::max);
        let mut volume: f64 = 0.0;
        let mut first = DVec3::ZERO;
        let mut second = DMat3::ZERO;
        for corners in mesh.corners() {
            let [a, b, c] = corners.map(|p| p - middle);
            let det = a.dot(b.cross(c));
            let sum = a + b + c;
            volume += det / 6.0;
            first += sum * (det / 24.0);
            // ∫ x xᵀ over the tetrahedron (0, a, b, c) is det/120 · (aaᵀ + bbᵀ + ccᵀ + ssᵀ), s = a + b + c.
            second += (outer(a) + outer(b) + outer(c) + outer(sum)) * (det / 120.0);
        }
        if volume.is_nan() || volume <= 1e-12 * reach * reach * reach {
            return Err(Error::Malformed(format!("the mesh encloses no volume ({volume:.3e} m3)")));
        }
        let offset = first / volume;
        let central = second - outer(offset) * volume;
        let trace = central.x_axis.x + central.y_axis.y + central.z_axis.z;
        let inertia = (DMat3::from_diagonal(DVec3::splat(trace)) - central) * density;
        Ok(Self { mass: volume * density, centre: middle + offset, inertia })
    }

    /// The same shape with another mass: inertia scales along.
    pub fn with_mass(self, mass: f64) -> Self {
        Self { mass, centre: self.centre, inertia: self.inertia * (mass / self.mass) }
    }
}

fn outer(v: DVec3) -> DMat3 {
    DMat3::from_cols(v * v.x, v * v.y, v * v.z)
}

/// The axes in which an inertia tensor is diagonal. The third has the largest moment: it is normal to a plate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PrincipalAxes {
    /// Rotation that takes principal coordinates into the object's own axes.
    pub object_from_principal: DQuat,
    /// Moments of inertia about the three principal axes [kg m²].
    pub moments: DVec3,
}

impl PrincipalAxes {
    /// Diagonalises a symmetric inertia tensor by cyclic Jacobi rotations.
    ///
    /// A tensor that is diagonal already keeps its axes, in their cyclic order, so that a box's axes stay its edges.
    pub fn of(inertia: DMat3) -> Self {
        let mut a = [inertia.x_axis.to_array(), inertia.y_axis.to_array(), inertia.z_axis.to_array()];
        let mut axes = DMat3::IDENTITY;
        let scale = (a[0][0].abs() + a[1][1].abs() + a[2][2].abs()).max(f64::MIN_POSITIVE);
        for _sweep in 0..50 {
            let off = a[0][1].abs() + a[0][2].abs() + a[1][2].abs();
            if off <= 1e-15 * scale {
                break;
            }
            for (p, q) in [(0, 1), (0, 2), (1, 2)] {
                rotate_away(&mut a, &mut axes, p, q, scale);
            }
        }
        if axes.determinant() < 0.0 {
            axes.z_axis = -axes.z_axis;
        }
        let axes = Self {
            object_from_principal: DQuat::from_mat3(&axes).normalize(),
            moments: DVec3::new(a[0][0], a[1][1], a[2][2]),
        };
        axes.largest_last()
    }

    /// Renames the axes in their cyclic order so that the third has the largest moment.
    fn largest_last(self) -> Self {
        let Self { object_from_principal: q, moments: m } = self;
        let third_of_turn = DQuat::from_xyzw(0.5, 0.5, 0.5, 0.5);
        if m.z >= m.x.max(m.y) {
            self
        } else if m.x >= m.y {
            Self { object_from_principal: q * third_of_turn, moments: m.yzx() }
        } else {
            Self { object_from_principal: q * third_of_turn.conjugate(), moments: m.zxy() }
        }
    }
}

/// One Jacobi rotation in the plane (p, q) that zeroes `a[p][q]`.
fn rotate_away(a: &mut [[f64; 3]; 3], axes: &mut DMat3, p: usize, q: usize, scale: f64) {
    if a[p][q].abs() <= 1e-17 * scale {
        return;
    }
    let theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
    let t = theta.signum() / (theta.abs() + libm::sqrt(theta * theta + 1.0));
    let c = 1.0 / libm::sqrt(t * t + 1.0);
    let s = t * c;
    let mut rotation = DMat3::IDENTITY;
    rotation.col_mut(p)[p] = c;
    rotation.col_mut(q)[q] = c;
    rotation.col_mut(q)[p] = s;
    rotation.col_mut(p)[q] = -s;
    let current = DMat3::from_cols_array_2d(a);
    let next = rotation.transpose() * current * rotation;
    *a = next.to_cols_array_2d();
    *axes *= rotation;
}
