//! Closed triangle meshes.

use glam::DVec3;

use crate::error::{Error, Result};

/// A triangle mesh that bounds a volume: counter-clockwise triangles seen from outside.
#[derive(Debug, Clone, PartialEq)]
pub struct TriangleMesh {
    /// Corner positions in the object's own frame [m].
    pub vertices: Vec<DVec3>,
    /// Three indices into `vertices` a triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
}

impl TriangleMesh {
    /// Takes vertices and triangles, and checks that every index and coordinate is valid.
    ///
    /// # Errors
    /// [`Error::Malformed`] for an empty mesh, an index out of range or a coordinate that is not finite.
    /// Closedness is not checked: see [`MassProperties::of_mesh`](super::MassProperties::of_mesh), which
    /// refuses a mesh without volume.
    pub fn new(vertices: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Result<Self> {
        if triangles.is_empty() {
            return Err(Error::Malformed("the mesh has no triangles".into()));
        }
        if let Some(i) = vertices.iter().position(|v| !v.is_finite()) {
            return Err(Error::Malformed(format!("vertex {i} of the mesh is not finite")));
        }
        let count = vertices.len();
        if let Some(i) = triangles.iter().position(|t| t.iter().any(|&v| v as usize >= count)) {
            return Err(Error::Malformed(format!(
                "triangle {i} of the mesh names a vertex beyond the last one ({count} vertices)"
            )));
        }
        Ok(Self { vertices, triangles })
    }

    /// The three corners of every triangle, in order.
    pub fn corners(&self) -> impl Iterator<Item = [DVec3; 3]> + '_ {
        self.triangles.iter().map(|t| t.map(|i| self.vertices[i as usize]))
    }

    /// Whether a point lies inside a closed mesh: what surrounds it takes up all directions (Van Oosterom and Strackee
    /// 1983).
    pub fn encloses(&self, point: DVec3) -> bool {
        let angle = |corners: [DVec3; 3]| {
            let [a, b, c] = corners.map(|corner| corner - point);
            let (x, y, z) = (a.length(), b.length(), c.length());
            libm::atan2(a.dot(b.cross(c)), x * y * z + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y)
        };
        self.corners().map(angle).sum::<f64>() > core::f64::consts::PI
    }

    /// The vertices farthest out along 26 directions (axes, edges and corners of a cube), each once.
    ///
    /// They stand for the mesh wherever its convex outline is enough, as on the ground plane.
    pub fn extreme_points(&self) -> Vec<DVec3> {
        let mut chosen: Vec<usize> = Vec::with_capacity(26);
        for code in 0..27 {
            let direction =
                DVec3::new((code % 3) as f64, (code / 3 % 3) as f64, (code / 9) as f64) - DVec3::ONE;
            if direction == DVec3::ZERO {
                continue;
            }
            let farthest = (0..self.vertices.len())
                .max_by(|&a, &b| direction.dot(self.vertices[a]).total_cmp(&direction.dot(self.vertices[b])))
                .expect("a mesh has vertices");
            if !chosen.contains(&farthest) {
                chosen.push(farthest);
            }
        }
        chosen.into_iter().map(|i| self.vertices[i]).collect()
    }
}
