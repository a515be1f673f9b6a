//! Bodies as the map sees them: what a ray from the charge meets, and the edges of the silhouette.

use std::sync::Arc;

use glam::{DMat3, DVec3};

use crate::geometry::{TriangleMesh, bounds};

/// A body in the world, ready to be seen from any charge.
#[derive(Debug, Clone)]
pub struct Solid {
    /// Its shape.
    pub form: Form,
    /// Bodies of equal group stand together and do not hide each other.
    pub group: u32,
    /// Whether it hides what is behind it.
    pub occludes: bool,
    /// Where its shelter is read when asked per panel, or when it is too small for the map.
    pub points: Vec<SurfacePoint>,
    /// Whether shelter is read at each of its points whatever the settings say, and on that point's own ray: for a large
    /// body that comes apart, and may fill an opening narrower than a pixel.
    pub by_point: bool,
}

/// A place on a body's surface that stands for some area around it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfacePoint {
    /// Where it is in the world [m].
    pub position: DVec3,
    /// Area × outward unit normal [m²].
    pub area: DVec3,
}

/// Shape of a solid in the world.
#[derive(Debug, Clone)]
pub enum Form {
    /// A box: its centre [m], half its edges [m], and its axes as columns.
    Box {
        /// Centre in the world [m].
        centre: DVec3,
        /// Half the edge lengths [m].
        half: DVec3,
        /// Rotation from the box into the world.
        world_from_box: DMat3,
    },
    /// A closed mesh, its vertices moved into the world [m].
    Mesh(Arc<TriangleMesh>),
}

impl Form {
    fn vertices(&self) -> Vec<DVec3> {
        match self {
            Self::Box { centre, half, world_from_box } => (0..8)
                .map(|code| {
                    let sign = |bit: u32| if code & bit == 0 { -1.0 } else { 1.0 };
                    *centre + *world_from_box * (*half * DVec3::new(sign(1), sign(2), sign(4)))
                })
                .collect(),
            Self::Mesh(mesh) => mesh.vertices.clone(),
        }
    }

    fn triangles(&self) -> &[[u32; 3]] {
        match self {
            Self::Box { .. } => &BOX_TRIANGLES,
            Self::Mesh(mesh) => &mesh.triangles,
        }
    }
}

/// A solid as seen from one place, which is the origin of everything here.
pub(super) struct View<'a> {
    pub form: &'a Form,
    /// Corners [m].
    pub vertices: Vec<DVec3>,
    /// Centre and radius of a sphere around them [m].
    pub middle: DVec3,
    pub radius: f64,
    eye: DVec3,
}

impl<'a> View<'a> {
    pub fn new(form: &'a Form, eye: DVec3) -> Self {
        let mut vertices = form.vertices();
        vertices.iter_mut().for_each(|v| *v -= eye);
        let (low, high) = bounds(vertices.iter().copied());
        let middle = 0.5 * (low + high);
        let reach = vertices.iter().map(|v| v.distance_squared(middle)).fold(0.0, f64::max);
        Self { form, vertices, middle, radius: libm::sqrt(reach), eye }
    }

    /// Where a ray along `direction` enters and leaves a box, in lengths of `direction`. Only for boxes.
    pub fn through_box(&self, direction: DVec3) -> Option<(f64, f64)> {
        let Form::Box { centre, half, world_from_box } = self.form else { return None };
        let turn = world_from_box.transpose();
        slabs(turn * (self.eye - *centre), turn * direction, *half)
    }

    /// Whether the ray along the unit vector `direction` meets the solid.
    pub fn is_met(&self, direction: DVec3) -> bool {
        let along = self.middle.dot(direction);
        let off = self.middle.length_squared() - along * along;
        if off > self.radius * self.radius || along < -self.radius {
            return false;
        }
        match self.form {
            Form::Box { .. } => self.through_box(direction).is_some(),
            Form::Mesh(_) => self.corners().any(|[a, b, c]| {
                let volume = a.dot(b.cross(c));
                let sides = [b.cross(c), c.cross(a), a.cross(b)].map(|side| side.dot(direction) * volume);
                volume != 0.0 && sides.iter().all(|&side| side >= 0.0)
            }),
        }
    }

    /// Solid angle of the surface [sr], counted once for a convex body.
    pub fn solid_angle(&self) -> f64 {
        self.corners().map(|corners| 0.5 * triangle_solid_angle(corners).abs()).sum()
    }

    /// Whether the eye lies in the solid or on its surface.
    pub fn holds_eye(&self) -> bool {
        if self.middle.length() > self.radius * (1.0 + 1e-9) {
            return false;
        }
        // From outside, a closed surface turns as much away as toward: the signed sum is 0; from inside it is 4π.
        self.corners().any(lies_on) || self.corners().map(triangle_solid_angle).sum::<f64>().abs() > 1.0
    }

    fn corners(&self) -> impl Iterator<Item = [DVec3; 3]> + '_ {
        self.form.triangles().iter().map(|triangle| triangle.map(|v| self.vertices[v as usize]))
    }

    /// Edges between a triangle that faces the eye and one that does not: the silhouette and, on a body that is
    /// not convex, edges inside it.
    pub fn silhouette(&self) -> Vec<Edge> {
        let triangles = self.form.triangles();
        let mut edges: Vec<(u32, u32, bool)> = Vec::with_capacity(3 * triangles.len());
        for (triangle, [a, b, c]) in triangles.iter().zip(self.corners()) {
            let front = (b - a).cross(c - a).dot(a) < 0.0;
            for k in 0..3 {
                let (from, to) = (triangle[k], triangle[(k + 1) % 3]);
                edges.push((from.min(to), from.max(to), front));
            }
        }
        edges.sort_unstable();
        edges
            .chunk_by(|a, b| (a.0, a.1) == (b.0, b.1))
            .filter(|sides| sides.len() == 1 || sides.iter().any(|s| s.2 != sides[0].2))
            .map(|sides| Edge {
                from: self.vertices[sides[0].0 as usize],
                to: self.vertices[sides[0].1 as usize],
            })
            .collect()
    }
}

/// Where a ray enters and leaves a box about the world's origin, in lengths of `direction`.
fn slabs(origin: DVec3, direction: DVec3, half: DVec3) -> Option<(f64, f64)> {
    let (mut near, mut far) = (0.0_f64, f64::INFINITY);
    for axis in 0..3 {
        let (o, d, h) = (origin[axis], direction[axis], half[axis]);
        if d == 0.0 {
            if o.abs() > h {
                return None;
            }
            continue;
        }
        let (a, b) = ((-h - o) / d, (h - o) / d);
        near = near.max(a.min(b));
        far = far.min(a.max(b));
    }
    (near <= far).then_some((near, far))
}

/// A straight edge seen from the origin.
#[derive(Debug, Clone, Copy)]
pub(super) struct Edge {
    pub from: DVec3,
    pub to: DVec3,
}

impl Edge {
    /// Where the edge crosses the way from the direction `a` to the direction `b`: the share of the way, and the
    /// distance of the edge there [m].
    pub fn crossing(&self, a: DVec3, b: DVec3) -> Option<(f64, f64)> {
        let plane = self.from.cross(self.to);
        let (at_a, at_b) = (plane.dot(a), plane.dot(b));
        if at_a * at_b > 0.0 || at_a == at_b {
            return None;
        }
        let share = at_a / (at_a - at_b);
        let x = a + (b - a) * share;
        let (before, after) = (self.from.cross(x).dot(plane), x.cross(self.to).dot(plane));
        if before < 0.0 || after < 0.0 || before + after <= 0.0 {
            return None;
        }
        let along = before / (before + after);
        Some((share, (self.from + (self.to - self.from) * along).length()))
    }
}

/// The twelve triangles of a box whose corners are numbered x + 2y + 4z.
const BOX_TRIANGLES: [[u32; 3]; 12] = [
    [0, 4, 6],
    [0, 6, 2],
    [1, 3, 7],
    [1, 7, 5],
    [0, 1, 5],
    [0, 5, 4],
    [2, 6, 7],
    [2, 7, 3],
    [0, 2, 3],
    [0, 3, 1],
    [4, 5, 7],
    [4, 7, 6],
];

/// Volume and denominator of the solid angle of a triangle seen from the origin (Van Oosterom & Strackee 1983).
fn solid_angle_parts([a, b, c]: [DVec3; 3]) -> (f64, f64) {
    let (x, y, z) = (a.length(), b.length(), c.length());
    (a.dot(b.cross(c)), x * y * z + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y)
}

/// Solid angle of a triangle seen from the origin [sr], negative if it faces it.
fn triangle_solid_angle(corners: [DVec3; 3]) -> f64 {
    let (volume, below) = solid_angle_parts(corners);
    2.0 * libm::atan2(volume, below)
}

/// Whether the origin lies on a triangle, within a billionth of its distance from the corners.
fn lies_on(corners: [DVec3; 3]) -> bool {
    let (volume, below) = solid_angle_parts(corners);
    let size = corners.iter().map(|corner| corner.length()).fold(0.0, f64::max);
    let nothing = 1e-9 * size * size * size;
    volume.abs() <= nothing && below <= nothing
}
