//! From a scene to who is sheltered by what, from each charge.

use std::sync::Arc;

use glam::{DMat3, DVec2, DVec3};
use rayon::prelude::*;

use super::window::standing;
use crate::error::Result;
use crate::geometry::{PieceMeshes, TriangleMesh, Triangulator};
use crate::loading::{box_panels, flat_panels, mesh_panels};
use crate::occlusion::{Form, Shelter, Sheltered, Solid, SurfacePoint, first_seen, shelter};
use crate::scene::{Body, Flat, Scene, Shape};
use crate::window::Window;

/// Bodies that stand alone are numbered from here among the groups.
const ALONE: u32 = 1 << 31;

/// Share of the directions into the open from which on a charge counts as enclosed.
const ENCLOSED: f64 = 0.9;

/// How every body of a scene is sheltered from each of its charges at the start.
#[derive(Debug, Clone, Default)]
pub struct Shelters {
    /// One a charge; none where shelter is switched off.
    charges: Vec<Sheltered>,
    /// Of each pane, whether the blast goes through it.
    open: Vec<bool>,
    /// Bodies before the pieces of panes.
    bodies: usize,
    /// Of each piece of a pane, the whole pane's number among the bodies and the panel of it where the piece is.
    pieces: Vec<(usize, usize)>,
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
        let solids = solids(&standing(scene))?;
        let mut found = Self { bodies: scene.bodies.len(), ..Self::default() };
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
        match self.piece(body) {
            Some((pane, panel)) => self.read(charge, pane, Some(panel)),
            None => self.read(charge, body, None),
        }
    }

    /// Lets the blast through those panes that are `open`, and through those that were before; whether that changed
    /// anything.
    pub(super) fn let_through(&mut self, scene: &Scene, open: impl Iterator<Item = bool>) -> Result<bool> {
        self.open.resize(scene.windows.len(), false);
        let now: Vec<bool> = open.zip(&self.open).map(|(now, &before)| now || before).collect();
        let shelter = |(window, (now, before)): (&Window, (&bool, &bool))| window.occludes && now != before;
        if !scene.occlusion.enabled || !scene.windows.iter().zip(now.iter().zip(&self.open)).any(shelter) {
            return Ok(false);
        }
        let mut broken = scene.clone();
        for (window, open) in broken.windows.iter_mut().zip(&now) {
            window.occludes &= !open;
        }
        *self = Self { open: now, ..Self::find(&broken)? };
        Ok(true)
    }

    /// Puts pieces after the bodies, in place of whole panes; see the field.
    pub(super) fn with_pieces(mut self, bodies: usize, pieces: Vec<(usize, usize)>) -> Self {
        (self.bodies, self.pieces) = (bodies, pieces);
        self
    }

    /// Shelter of a body's panel from a charge: its own, or the body's.
    pub(super) fn panel(&self, charge: usize, body: usize, panel: usize) -> Shelter {
        let (body, panel) = self.piece(body).unwrap_or((body, panel));
        self.read(charge, body, Some(panel))
    }

    fn piece(&self, body: usize) -> Option<(usize, usize)> {
        self.pieces.get(body.checked_sub(self.bodies)?).copied()
    }

    fn read(&self, charge: usize, body: usize, panel: Option<usize>) -> Shelter {
        let Some(seen) = self.charges.get(charge) else { return Shelter::NONE };
        panel.and_then(|panel| seen.panels[body].get(panel).copied()).unwrap_or(seen.bodies[body])
    }
}

/// The nearest body on each pixel of a charge's sphere map, and its distance [m].
///
/// # Errors
/// As [`Shelters::find`].
pub fn seen_from(scene: &Scene, charge: usize) -> Result<Vec<Option<(usize, f64)>>> {
    scene.validate()?;
    first_seen(&solids(&standing(scene))?, scene.charges[charge].position, scene.occlusion.resolution)
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
        Shape::Flat(flat) => {
            let mut mesh = prism(flat)?;
            mesh.vertices.iter_mut().for_each(|v| *v = into_world(*v));
            (Form::Mesh(Arc::new(mesh)), flat_panels(flat.thickness, &flat.samples))
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
    let by_point = matches!(body.shape, Shape::Flat(_));
    Ok(Solid { form, group, occludes: body.occludes, points, by_point })
}

fn prism(flat: &Flat) -> Result<TriangleMesh> {
    let mut triangles = Vec::new();
    Triangulator::default().triangulate(&flat.outline, &mut triangles)?;
    let mut meshes = PieceMeshes::default();
    meshes.push_prism(&flat.outline, &triangles, DVec2::ZERO, flat.thickness);
    Ok(meshes.piece(0).to_mesh())
}
