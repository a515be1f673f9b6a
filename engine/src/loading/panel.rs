//! Panels: the pieces of surface on which loads act.

use std::collections::BTreeMap;

use glam::{DVec3, Vec3Swizzles};

use crate::geometry::{Sample, TriangleMesh};

/// A plane piece of a body's surface. Forces act at its centre (thesis 3.5.1).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Panel {
    /// Centre, relative to the body's centre of mass [m].
    pub centre: DVec3,
    /// Outward unit normal.
    pub normal: DVec3,
    /// Area [m²].
    pub area: f64,
}

/// The faces of a box, in the order in which `buried` flags are given.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BoxFace {
    /// The face whose outward normal is −x.
    MinusX,
    /// The face whose outward normal is +x.
    PlusX,
    /// The face whose outward normal is −y.
    MinusY,
    /// The face whose outward normal is +y.
    PlusY,
    /// The face whose outward normal is −z.
    MinusZ,
    /// The face whose outward normal is +z.
    PlusZ,
}

impl BoxFace {
    /// All six, in the order of the `buried` flags.
    pub const ALL: [Self; 6] =
        [Self::MinusX, Self::PlusX, Self::MinusY, Self::PlusY, Self::MinusZ, Self::PlusZ];

    /// Outward unit normal in the box's own axes.
    pub fn normal(self) -> DVec3 {
        match self {
            Self::MinusX => DVec3::NEG_X,
            Self::PlusX => DVec3::X,
            Self::MinusY => DVec3::NEG_Y,
            Self::PlusY => DVec3::Y,
            Self::MinusZ => DVec3::NEG_Z,
            Self::PlusZ => DVec3::Z,
        }
    }
}

/// Panels of a box centred on the origin: each open face cut into four triangles along its diagonals,
/// as the thesis cuts its bricks (3.6).
///
/// A face that is `buried` (it lies against a neighbour or on the ground) carries no load and has none.
pub fn box_panels(size: DVec3, buried: [bool; 6]) -> Vec<Panel> {
    let half = size * 0.5;
    let mut panels = Vec::with_capacity(24);
    for (face, _) in BoxFace::ALL.into_iter().zip(buried).filter(|(_, buried)| !buried) {
        let normal = face.normal();
        let (u, v) = (normal.zxy().abs() * half, normal.yzx().abs() * half);
        let area = u.length() * v.length();
        let middle = normal * half;
        // A triangle from the face's middle to one of its edges has its centroid two thirds of the way out.
        for toward_edge in [u, v, -u, -v] {
            panels.push(Panel { centre: middle + toward_edge * (2.0 / 3.0), normal, area });
        }
    }
    panels
}

/// Panels of a flat piece `thickness` [m] thick about the origin, its faces across z: those of the face toward +z, then
/// as many of the other.
pub fn flat_panels(thickness: f64, samples: &[Sample]) -> Vec<Panel> {
    let face = |normal: DVec3| {
        samples.iter().map(move |sample| Panel {
            centre: sample.centre.extend(0.0) + normal * (0.5 * thickness),
            normal,
            area: sample.area,
        })
    };
    face(DVec3::Z).chain(face(DVec3::NEG_Z)).collect()
}

/// Above this many triangles a mesh is loaded on merged panels.
const MOST_SINGLE_TRIANGLES: usize = 512;

/// Panels of a closed mesh, with centres relative to `centre_of_mass`.
///
/// Up to 512 triangles each triangle is a panel. Beyond, triangles that face alike (within about 20°) and lie
/// in the same eighth of the bounding box are merged; the sum of area × normal is kept exactly, so that a
/// uniform pressure still pushes nowhere.
pub fn mesh_panels(mesh: &TriangleMesh, centre_of_mass: DVec3) -> Vec<Panel> {
    let triangles: Vec<Panel> =
        mesh.corners().filter_map(|corners| triangle_panel(corners, centre_of_mass)).collect();
    if triangles.len() <= MOST_SINGLE_TRIANGLES {
        return triangles;
    }
    let mut cells: BTreeMap<(u8, u8), (DVec3, DVec3, f64)> = BTreeMap::new();
    for panel in &triangles {
        let cell = cells.entry((facing(panel.normal), eighth(panel.centre))).or_default();
        cell.0 += panel.normal * panel.area;
        cell.1 += panel.centre * panel.area;
        cell.2 += panel.area;
    }
    cells.into_values().filter_map(|(vector, moment, area)| merged(vector, moment / area)).collect()
}

fn triangle_panel([a, b, c]: [DVec3; 3], centre_of_mass: DVec3) -> Option<Panel> {
    merged((b - a).cross(c - a) * 0.5, (a + b + c) / 3.0 - centre_of_mass)
}

fn merged(area_vector: DVec3, centre: DVec3) -> Option<Panel> {
    let area = area_vector.length();
    (area > 0.0).then(|| Panel { centre, normal: area_vector / area, area })
}

/// Which of 96 cells (4 × 4 a side of a cube) a direction falls into.
fn facing(n: DVec3) -> u8 {
    let a = n.abs();
    let (side, major, u, v) = if a.x >= a.y && a.x >= a.z {
        (u8::from(n.x < 0.0), a.x, n.y, n.z)
    } else if a.y >= a.z {
        (2 + u8::from(n.y < 0.0), a.y, n.z, n.x)
    } else {
        (4 + u8::from(n.z < 0.0), a.z, n.x, n.y)
    };
    let cell = |w: f64| ((w / major + 1.0) * 2.0).clamp(0.0, 3.0) as u8;
    side * 16 + cell(u) * 4 + cell(v)
}

fn eighth(centre: DVec3) -> u8 {
    u8::from(centre.x > 0.0) | u8::from(centre.y > 0.0) << 1 | u8::from(centre.z > 0.0) << 2
}
