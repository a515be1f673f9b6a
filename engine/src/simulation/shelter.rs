//! From a scene to who is sheltered by what, from each charge.

use std::sync::Arc;

use glam::{DMat3, DVec3};
use rayon::prelude::*;

use crate::error::Result;
use crate::geometry::TriangleMesh;
use crate::loading::{box_panels, mesh_panels};
use crate::occlusion::{Form, Shelter, Sheltered, Solid, SurfacePoint, first_seen, shelter};
use crate::scene::{Body, Scene, Shape};

/// Bodies that stand alone are numbered from here among the groups.
const ALONE: u32 = 1 << 31;

/// Share of the directions into the open from which on a charge counts as enclosed.
const ENCLOSED: f64 = 0.9;

/// How every body of a scene is sheltered from each of its charges at the start.
#[derive(Debug, Clone, Default)]
pub struct Shelters {
    /// One a charge; none where shelter is switched off.
    charges: Vec<Sheltered>,
    pub(super) warnings: Vec<String>,
}

impl Shelters {
    /// Finds what shelters behind what.
    ///
    /// # Errors
    /// What [`Scene::validate`] and [`shelter`] refuse.
    pub fn find(scene: &Scene) -> Result<Self> {
        scene.validate()?;
        if !scene.occlusion.enabled {
            return Ok(Self::default());
        }
        let solids = solids(scene)?;
        let mut found = Self::default();
        for (index, charge) in scene.charges.iter().enumerate() {
            let ground = scene.ground.map(|ground| ground.height);
            let seen = shelter(&solids, charge.position, ground, &scene.occlusion)?;
            if seen.enclosed > ENCLOSED {
                found.warnings.push(format!(
                    "charge {index} is enclosed: bodies stand in {:.0} % of the directions around it; reflections \
                     are not modelled, so the loads in a closed room would be higher and last longer",
                    100.0 * seen.enclosed
                ));
            }
            found.charges.push(seen);
        }
        Ok(found)
    }

    /// Shelter of a body from a charge.
    pub fn body(&self, charge: usize, body: usize) -> Shelter {
        self.charges.get(charge).map_or(Shelter::NONE, |seen| seen.bodies[body])
    }

    /// Shelter of a body's panel from a charge: its own, or the body's.
    pub(super) fn panel(&self, charge: usize, body: usize, panel: usize) -> Shelter {
        let own = self.charges.get(charge).and_then(|seen| seen.panels[body].get(panel).copied());
        own.unwrap_or_else(|| self.body(charge, body))
    }
}

/// The nearest body on each pixel of a charge's sphere map, and its distance [m].
///
/// # Errors
/// As [`Shelters::find`].
pub fn seen_from(scene: &Scene, charge: usize) -> Result<Vec<Option<(usize, f64)>>> {
    scene.validate()?;
    first_seen(&solids(scene)?, scene.charges[charge].position, scene.occlusion.resolution)
}

fn solids(scene: &Scene) -> Result<Vec<Solid>> {
    scene.bodies.par_iter().enumerate().map(|(index, body)| solid(body, index)).collect()
}

fn solid(body: &Body, index: usize) -> Result<Solid> {
    let into_world = |p: DVec3| body.position + body.orientation * p;
    let (form, panels) = match &body.shape {
        Shape::Box { size, buried } => {
            let world_from_box = DMat3::from_quat(body.orientation);
            let form = Form::Box { centre: body.position, half: *size * 0.5, world_from_box };
            (form, box_panels(*size, *buried))
        }
        Shape::Mesh(mesh) => {
            let vertices = mesh.vertices.iter().map(|&v| into_world(v)).collect();
            let moved = TriangleMesh { vertices, triangles: mesh.triangles.clone() };
            let centre = body.mass_properties()?.centre;
            let mut panels = mesh_panels(mesh, centre);
            panels.iter_mut().for_each(|panel| panel.centre += centre);
            (Form::Mesh(Arc::new(moved)), panels)
        }
    };
    let points = panels
        .iter()
        .map(|panel| SurfacePoint {
            position: into_world(panel.centre),
            area: body.orientation * panel.normal * panel.area,
        })
        .collect();
    let group = body.assembly.unwrap_or(ALONE + index as u32);
    Ok(Solid { form, group, occludes: body.occludes, points })
}
