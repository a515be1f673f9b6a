//! From a scene to targets: for each body, which loads come, when, and on which panels.

use std::collections::BTreeMap;
use std::ops::ControlFlow;

use glam::{DQuat, DVec3};
use rayon::prelude::*;

use super::queue::{LoadQueue, PanelLoad};
use super::shelter::Shelters;
use crate::blast::{BlastField, BlastPoint, Extension};
use crate::dynamics::RigidBody;
use crate::error::{Error, Result};
use crate::geometry::{Outline, PrincipalAxes, Silhouette, bounds};
use crate::loading::{
    Drag, Face, FaceHistory, HistorySettings, LoadingMode, Panel, Resistance, Wind, box_panels, flat_panels,
    mesh_panels,
};
use crate::occlusion::Shelter;
use crate::recording::BodyFacts;
use crate::scene::{Body, Scene, Shape};

/// A body made ready: its state, its loads and what is already known of it.
pub(super) struct Target {
    pub body: RigidBody,
    pub object_from_principal: DQuat,
    /// Outermost points in principal axes, relative to the centre of mass [m].
    pub corners: Box<[DVec3]>,
    /// Corners of the bounding box in the world [m].
    pub bounds: (DVec3, DVec3),
    pub queue: LoadQueue,
    pub facts: BodyFacts,
    /// Per charge: nearer than the curves reach, farther than they reach.
    pub reach: Vec<Extension>,
    /// Per charge: what it alone does at most.
    pub peaks: Vec<Peaks>,
}

/// The worst that one charge does to one body.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Peaks {
    /// Incident overpressure [Pa].
    pub overpressure: f64,
    /// Pressure on the most loaded panel [Pa].
    pub load: f64,
}

/// A body's geometry in the world, before any load.
struct Geometry {
    body: RigidBody,
    object_from_principal: DQuat,
    /// In principal axes, each with whether it is buried at the start.
    panels: Vec<(Panel, bool)>,
    corners: Box<[DVec3]>,
    world_corners: Vec<DVec3>,
}

/// Bodies made ready between two looks at the observer.
const BATCH: usize = 2048;

/// Outlines of what stands together, by the assembly's number, one a charge.
pub(super) type Outlines = BTreeMap<u32, Vec<Outline>>;

/// Makes every body of a scene ready. The order is that of the scene. `outlines` are those of its assemblies, where
/// they are known already.
pub(super) fn aim(
    scene: &Scene,
    fields: &[BlastField],
    shelters: &Shelters,
    outlines: Option<&Outlines>,
    observer: &mut dyn FnMut() -> ControlFlow<()>,
) -> Result<Vec<Target>> {
    let mut listen = || if observer().is_break() { Err(Error::Cancelled) } else { Ok(()) };
    let mut geometries = Vec::with_capacity(scene.bodies.len());
    for bodies in scene.bodies.chunks(BATCH) {
        geometries.extend(bodies.par_iter().map(Geometry::of).collect::<Result<Vec<_>>>()?);
        listen()?;
    }
    let found;
    let outlines = if let Some(known) = outlines {
        known
    } else {
        found = assembly_outlines(scene, fields, &geometries);
        &found
    };
    let mut targets = Vec::with_capacity(geometries.len());
    let mut rest = geometries.into_iter();
    while targets.len() < scene.bodies.len() {
        let first = targets.len();
        let batch: Vec<Geometry> = rest.by_ref().take(BATCH).collect();
        targets.par_extend(batch.into_par_iter().enumerate().map(|(offset, geometry)| {
            let index = first + offset;
            let assembly = scene.bodies[index].assembly.map(|id| &outlines[&id][..]);
            target(scene, fields, shelters, index, geometry, assembly)
        }));
        listen()?;
    }
    in_time(scene, &targets)?;
    Ok(targets)
}

/// Refuses loads that begin before the scene does.
pub(super) fn in_time(scene: &Scene, targets: &[Target]) -> Result<()> {
    let firsts = targets.iter().filter_map(|target| target.queue.first());
    let first = firsts.min_by(|a, b| a.history.arrival().total_cmp(&b.history.arrival()));
    let Some(early) = first.filter(|load| load.history.arrival() < 0.0) else { return Ok(()) };
    let latest = scene.charges[early.charge].time - early.history.arrival();
    Err(Error::Malformed(format!(
        "charge {} goes off so long before the scene begins that its front has reached a body by then; let it go off at \
         {:.4} s or later",
        early.charge,
        libm::ceil(1e4 * latest) * 1e-4
    )))
}

/// Outlines of all assemblies of a scene.
///
/// # Errors
/// As [`aim`].
pub(super) fn outlines(scene: &Scene, fields: &[BlastField]) -> Result<Outlines> {
    let geometries: Vec<Geometry> = scene.bodies.par_iter().map(Geometry::of).collect::<Result<_>>()?;
    Ok(assembly_outlines(scene, fields, &geometries))
}

/// Makes one body of a scene ready.
///
/// # Errors
/// As [`aim`].
pub(super) fn aim_one(
    scene: &Scene,
    fields: &[BlastField],
    shelters: &Shelters,
    outlines: &Outlines,
    index: usize,
) -> Result<Target> {
    let geometry = Geometry::of(&scene.bodies[index])?;
    let assembly = scene.bodies[index].assembly.map(|id| &outlines[&id][..]);
    Ok(target(scene, fields, shelters, index, geometry, assembly))
}

impl Geometry {
    fn of(body: &Body) -> Result<Self> {
        let properties = body.mass_properties()?;
        let axes = PrincipalAxes::of(properties.inertia);
        let into_principal = axes.object_from_principal.conjugate();
        let (open, buried, corners) = match &body.shape {
            Shape::Box { size, buried } => {
                let hidden = box_panels(*size, buried.map(|face| !face));
                (box_panels(*size, *buried), hidden, box_corners(*size))
            }
            Shape::Mesh(mesh) => {
                let centred = mesh.extreme_points().into_iter().map(|p| p - properties.centre).collect();
                (mesh_panels(mesh, properties.centre), Vec::new(), centred)
            }
            Shape::Flat(flat) => {
                let half = 0.5 * flat.thickness;
                let corners = flat.extreme_points().into_iter();
                let both = corners.flat_map(|p| [p.extend(half), p.extend(-half)]).collect();
                (flat_panels(flat.thickness, &flat.samples), Vec::new(), both)
            }
        };
        let principal =
            |p: Panel| Panel { centre: into_principal * p.centre, normal: into_principal * p.normal, ..p };
        let open = open.into_iter().map(|p| (principal(p), false));
        let panels: Vec<(Panel, bool)> =
            open.chain(buried.into_iter().map(|p| (principal(p), true))).collect();
        let corners: Box<[DVec3]> = corners.into_iter().map(|p| into_principal * p).collect();
        let areas = match body.shape {
            Shape::Box { size, .. } => {
                let size = (into_principal * size).abs();
                DVec3::new(size.y * size.z, size.x * size.z, size.x * size.y)
            }
            Shape::Mesh(_) => panels.iter().map(|(p, _)| p.normal.abs() * (0.5 * p.area)).sum(),
            Shape::Flat(ref flat) => {
                let faces = (into_principal * DVec3::Z).abs() * flat.area();
                let edges = flat.outline.sides().map(|(a, b)| {
                    let area = (b - a).perp().extend(0.0) * (0.5 * flat.thickness);
                    (into_principal * area).abs()
                });
                faces + edges.sum::<DVec3>()
            }
        };
        let may_turn = body.can_rotate && !body.anchored;
        let state = RigidBody {
            position: body.position + body.orientation * properties.centre,
            world_from_principal: (body.orientation * axes.object_from_principal).normalize(),
            velocity: DVec3::ZERO,
            angular_momentum: DVec3::ZERO,
            inverse_mass: 1.0 / body.mass,
            inverse_moments: if may_turn { axes.moments.recip() } else { DVec3::ZERO },
            resistance: Resistance::new(areas, body.drag_coefficient, body.lift_coefficient, body.mass),
            reach: corners.iter().map(|c| c.length()).fold(0.0, f64::max),
        };
        Ok(Self {
            body: state,
            object_from_principal: axes.object_from_principal,
            panels,
            world_corners: world_corners(&state, &corners),
            corners,
        })
    }

    fn bounds(&self) -> (DVec3, DVec3) {
        bounds(self.world_corners.iter().copied())
    }
}

fn world_corners(body: &RigidBody, corners: &[DVec3]) -> Vec<DVec3> {
    corners.iter().map(|&c| body.position + body.world_from_principal * c).collect()
}

fn box_corners(size: DVec3) -> Vec<DVec3> {
    let half = size * 0.5;
    (0..8)
        .map(|code| {
            let sign = |bit: u32| if code & bit == 0 { -1.0 } else { 1.0 };
            half * DVec3::new(sign(1), sign(2), sign(4))
        })
        .collect()
}

/// Outline of bodies about `middle` as seen from a place; edges on the ground are closed to the flow.
fn outline(members: &[&Geometry], middle: DVec3, eye: DVec3, ground: Option<f64>) -> Outline {
    let on_ground = |p: DVec3| ground.is_some_and(|height| p.y < height + 0.01);
    let points = members.iter().map(|geometry| &geometry.world_corners[..]);
    Outline::new(points, line_of_sight(middle, eye), on_ground)
}

fn line_of_sight(middle: DVec3, eye: DVec3) -> DVec3 {
    (middle - eye).try_normalize().unwrap_or(DVec3::Z)
}

/// Outlines of every assembly, one a charge.
fn assembly_outlines(scene: &Scene, fields: &[BlastField], geometries: &[Geometry]) -> Outlines {
    let mut members: BTreeMap<u32, Vec<&Geometry>> = BTreeMap::new();
    for (body, geometry) in scene.bodies.iter().zip(geometries) {
        if let Some(id) = body.assembly {
            members.entry(id).or_default().push(geometry);
        }
    }
    let ground = scene.ground.map(|g| g.height);
    members
        .into_iter()
        .map(|(id, members)| {
            let points = || members.iter().flat_map(|geometry| &geometry.world_corners);
            let middle = points().sum::<DVec3>() / points().count() as f64;
            (id, fields.iter().map(|f| outline(&members, middle, f.position(), ground)).collect())
        })
        .collect()
}

fn target(
    scene: &Scene,
    fields: &[BlastField],
    shelters: &Shelters,
    index: usize,
    geometry: Geometry,
    assembly: Option<&[Outline]>,
) -> Target {
    let shots: Vec<Shot> = (0..fields.len())
        .map(|charge| {
            shot(
                scene,
                fields,
                shelters,
                charge,
                index,
                &geometry,
                assembly.map(|outlines| &outlines[charge]),
            )
        })
        .collect();
    let mut facts = BodyFacts {
        mass: scene.bodies[index].mass,
        distance: f64::INFINITY,
        arrival_time: f64::INFINITY,
        attenuation: 1.0,
        free_time: f64::NAN,
        ..BodyFacts::default()
    };
    let mut share = Share::default();
    for shot in &shots {
        if shot.distance < facts.distance {
            facts.distance = shot.distance;
            facts.frontal_area = shot.frontal_area;
            facts.attenuation = shot.attenuation;
        }
        share.open += shot.share.open;
        share.received += shot.share.received;
        facts.arrival_time = facts.arrival_time.min(shot.arrival);
        facts.peak_overpressure = facts.peak_overpressure.max(shot.peaks.overpressure);
        facts.peak_load = facts.peak_load.max(shot.peaks.load);
    }
    facts.attenuation = share.of_open().unwrap_or(facts.attenuation);
    Target {
        object_from_principal: geometry.object_from_principal,
        bounds: geometry.bounds(),
        corners: geometry.corners,
        body: geometry.body,
        facts,
        reach: shots.iter().map(|shot| shot.extension).collect(),
        peaks: shots.iter().map(|shot| shot.peaks).collect(),
        queue: LoadQueue::new(shots.into_iter()),
    }
}

/// A charge aimed at a body that has left its place: where it is now, turned as it is, alone and with all faces bare,
/// as sheltered as it was in its place.
pub(super) fn aim_anew(
    scene: &Scene,
    fields: &[BlastField],
    shelters: &Shelters,
    charge: usize,
    index: usize,
    body: RigidBody,
) -> Shot {
    let mut geometry = Geometry::of(&scene.bodies[index]).expect("it was aimed at before");
    geometry.body = body;
    geometry.world_corners = world_corners(&body, &geometry.corners);
    geometry.panels.iter_mut().for_each(|(_, buried)| *buried = false);
    shot(scene, fields, shelters, charge, index, &geometry, None)
}

/// What one charge does to one body.
pub(super) struct Shot {
    pub charge: usize,
    pub panels: Vec<PanelLoad>,
    pub wind: Option<Wind>,
    /// Open area projected toward the charge [m²].
    frontal_area: f64,
    /// From the charge to the centre of mass [m].
    distance: f64,
    /// When the front comes [s].
    arrival: f64,
    /// Share of the load that its shelter as a whole leaves it.
    attenuation: f64,
    /// The same of the panels that face the charge.
    share: Share,
    pub peaks: Peaks,
    /// How far the curves were stretched for it.
    extension: Extension,
}

fn shot(
    scene: &Scene,
    fields: &[BlastField],
    shelters: &Shelters,
    charge: usize,
    index: usize,
    geometry: &Geometry,
    assembly: Option<&Outline>,
) -> Shot {
    let field = &fields[charge];
    let (middle, eye) = (geometry.body.position, field.position());
    let alone;
    let around = if let Some(outline) = assembly {
        outline
    } else {
        alone = outline(&[geometry], middle, eye, scene.ground.map(|g| g.height));
        &alone
    };
    let seen = Silhouette::new(&geometry.world_corners, line_of_sight(middle, eye), |_| false);
    let aim = Aim {
        scene,
        field,
        shelters,
        charge,
        index,
        body: &scene.bodies[index],
        geometry,
        half_width: 0.5 * seen.least_width(),
        around,
        surround: if assembly.is_some() { scene.bodies[index].surround } else { 0.0 },
    };
    let shelter = shelters.body(charge, index);
    let centre = aim.at(middle, &shelter);
    let mut shot = aim.load_panels();
    let blows = shelter.attenuation > 0.0 && shot.panels.iter().any(|load| !load.buried);
    shot.wind =
        (blows && scene.loading.drag == Drag::FlowRelative).then(|| aim.wind(&centre, shelter.attenuation));
    shot.distance = centre.distance;
    shot.arrival = shot.arrival.min(centre.arrival_time);
    shot.attenuation = shelter.attenuation;
    shot
}

/// What a body's panels receive of the loads they would have in the open.
#[derive(Debug, Default)]
struct Share {
    /// Reflected impulses toward the body, were they all received, and those received [N s].
    open: f64,
    received: f64,
}

impl Share {
    /// The share; `None` for a body that no panel of which faces a charge.
    fn of_open(&self) -> Option<f64> {
        (self.open > 0.0).then(|| self.received / self.open)
    }
}

/// One charge aimed at one body.
struct Aim<'a> {
    scene: &'a Scene,
    field: &'a BlastField,
    shelters: &'a Shelters,
    charge: usize,
    index: usize,
    body: &'a Body,
    geometry: &'a Geometry,
    /// Half the smaller extent of the piece as the charge sees it [m].
    half_width: f64,
    around: &'a Outline,
    /// How far a wall around that goes on [m].
    surround: f64,
}

impl Aim<'_> {
    /// The load of every panel that has one, and what can be told of them together.
    fn load_panels(&self) -> Shot {
        let mut shot = Shot {
            charge: self.charge,
            panels: Vec::new(),
            wind: None,
            frontal_area: 0.0,
            distance: f64::INFINITY,
            arrival: f64::INFINITY,
            attenuation: 1.0,
            share: Share::default(),
            peaks: Peaks::default(),
            extension: Extension::Inside,
        };
        let state = &self.geometry.body;
        let lowest = self.scene.ground.map_or(f64::NEG_INFINITY, |g| g.height);
        let settings = HistorySettings {
            mode: self.scene.loading.mode,
            drag: self.scene.loading.drag,
            shape: self.scene.loading.pulse,
            negative_phase: self.scene.loading.negative_phase,
            gain: self.gain(),
        };
        let surface = settings.mode == LoadingMode::Surface;
        let open_only = |(_, (_, buried)): &(usize, &(Panel, bool))| surface || !buried;
        for (number, &(panel, buried)) in self.geometry.panels.iter().enumerate().filter(open_only) {
            let centre = state.position + state.world_from_principal * panel.centre;
            let shelter = self.shelters.panel(self.charge, self.index, number);
            let point = self.at(centre, &shelter);
            let cos_alpha = -(state.world_from_principal * panel.normal).dot(point.direction);
            let faces = cos_alpha > 0.0 && !buried;
            if faces {
                shot.frontal_area += panel.area * cos_alpha;
            }
            if (centre.y < lowest && !buried) || !(faces || surface) {
                continue;
            }
            let open = self.gain() * point.reflected_impulse * panel.area * cos_alpha.max(0.0);
            if faces {
                shot.share.open += open;
                shot.share.received += open * shelter.attenuation;
            }
            shot.arrival = shot.arrival.min(point.arrival_time);
            shot.peaks.overpressure = shot.peaks.overpressure.max(point.overpressure);
            if point.extension != Extension::Inside {
                shot.extension = point.extension;
            }
            if shelter.attenuation == 0.0 {
                continue;
            }
            let clearing_length =
                self.scene.loading.clearing.length(centre, self.half_width, self.around, self.surround);
            let face = match (faces, buried) {
                (true, _) => Face::Front { clearing_length },
                (false, false) => Face::Rear { clearing_length },
                // No shock strikes a face that is laid bare while the wave is passing: it feels what is there.
                (false, true) => Face::Rear { clearing_length: 0.0 },
            };
            let drag_coefficient = self.body.drag_coefficient;
            let settings = HistorySettings { gain: settings.gain * shelter.attenuation, ..settings };
            let history = FaceHistory::new(self.field, &point, cos_alpha, face, drag_coefficient, settings);
            if !buried {
                shot.peaks.load = shot.peaks.load.max(history.peak());
            }
            let push = -panel.normal * panel.area;
            let twist = panel.centre.cross(push) * self.scene.dynamics.rotation_factor;
            shot.panels.push(PanelLoad { charge: self.charge, panel: number, history, push, twist, buried });
        }
        shot
    }

    fn gain(&self) -> f64 {
        self.scene.charges[self.charge].gain
    }

    /// The field at a point, which the front reaches by a detour round what is before it.
    fn at(&self, place: DVec3, shelter: &Shelter) -> BlastPoint {
        let mut point = self.field.at(place);
        if shelter.detour > 0.0 {
            point.arrival_time = self.field.arrival_time(point.distance + shelter.detour);
        }
        point
    }

    fn wind(&self, centre: &BlastPoint, attenuation: f64) -> Wind {
        let loading = &self.scene.loading;
        let mut pulse = centre.pulse(loading.pulse);
        pulse.negative = loading.negative_phase.then(|| self.field.negative_phase(centre.distance));
        Wind::new(centre, pulse, &self.scene.air, self.gain() * attenuation)
    }
}
