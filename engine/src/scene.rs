//! What a simulation is given: plain structs, checked once.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::{DMat3, DQuat, DVec2, DVec3};

use crate::air::Air;
use crate::blast::PulseShape;
use crate::charge::Charge;
use crate::dynamics::Hold;
use crate::dynamics::contact::Mortar;
use crate::dynamics::ground::Ground;
use crate::error::{Error, Result, finite, not_negative, positive};
use crate::geometry::{MassProperties, Polygon, Sample, TriangleMesh};
use crate::loading::{Clearing, Drag, LoadingMode};
use crate::occlusion;
use crate::window::Window;

/// Everything a run needs to know.
#[derive(Debug, Clone)]
pub struct Scene {
    /// The air before the blast.
    pub air: Air,
    /// A level plane that bodies stand and fall on.
    pub ground: Option<Ground>,
    /// One or more charges.
    pub charges: Vec<Charge>,
    /// The bodies, in the order in which results are given.
    pub bodies: Vec<Body>,
    /// Panes that may break; their pieces follow the bodies in results, pane after pane.
    pub windows: Vec<Window>,
    /// Mortar between the boxes of an assembly, by the assembly's number. It binds where bodies collide.
    pub mortar: BTreeMap<u32, Mortar>,
    /// How long, how finely.
    pub time: Time,
    /// How loads are found.
    pub loading: Loading,
    /// How shelter behind other bodies is found.
    pub occlusion: occlusion::Settings,
    /// Art direction of the motion.
    pub dynamics: Dynamics,
}

/// Duration and resolution of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Time {
    /// Scene time from start to end [s].
    pub duration: f64,
    /// Frames per second of scene time.
    pub frame_rate: f64,
    /// Longest simulation step [s]; chosen from the loads when left out.
    pub step: Option<f64>,
    /// Whether the run ends as soon as all loads are over and all bodies rest, at the latest after `duration`.
    pub until_rest: bool,
}

impl Time {
    /// Frames of the run, with the one at time 0: frame k is at k / frame rate. The last is the one nearest to the
    /// end of the duration.
    pub fn frames(&self) -> usize {
        libm::rint(self.duration * self.frame_rate) as usize + 1
    }
}

/// How loads are found.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Loading {
    /// Which part of the load is counted.
    pub mode: LoadingMode,
    /// From how far the relief of reflected pressure comes.
    pub clearing: Clearing,
    /// How the blast wind acts.
    pub drag: Drag,
    /// The pulse's shape in time.
    pub pulse: PulseShape,
    /// Whether suction follows the positive phase.
    pub negative_phase: bool,
}

/// Art direction of the motion (thesis 6.5). 1 is the physical value of both.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dynamics {
    /// Multiplies air drag where it slows a body down.
    pub damping_factor: f64,
    /// Multiplies the torque of the blast.
    pub rotation_factor: f64,
    /// Whether bodies collide, pile up and come to rest; otherwise they meet the ground alone.
    pub contacts: bool,
}

impl Default for Dynamics {
    fn default() -> Self {
        Self { damping_factor: 1.0, rotation_factor: 1.0, contacts: false }
    }
}

/// A rigid body at the start of a run.
#[derive(Debug, Clone)]
pub struct Body {
    /// Its shape, in its own frame.
    pub shape: Shape,
    /// Where the origin of its frame is in the world [m].
    pub position: DVec3,
    /// Rotation from its frame into the world.
    pub orientation: DQuat,
    /// Mass [kg].
    pub mass: f64,
    /// Bodies of the same assembly stand together: they clear from the outer edge of all and do not shelter each
    /// other. `None`: alone.
    pub assembly: Option<u32>,
    /// An anchored body never moves; its loads are recorded all the same.
    pub anchored: bool,
    /// Whether it shelters what is behind it. It may be sheltered all the same.
    pub occludes: bool,
    /// Whether it may rotate.
    pub can_rotate: bool,
    /// Coefficient of friction.
    pub friction: f64,
    /// Drag coefficient C_D on the projected area.
    pub drag_coefficient: f64,
    /// Lift coefficient C_L; left out, it equals C_D for a plate-like piece and is 0 for a chunky one.
    pub lift_coefficient: Option<f64>,
    /// How far a wall without an opening goes on beyond the outline of its assembly [m]: by so much the relief of
    /// reflected pressure has farther to come ([`Clearing::Assembly`]) while it is in its place.
    pub surround: f64,
    /// What holds it before it may move; `None`: only what it stands on.
    pub hold: Option<Hold>,
}

/// Shape of a body, in its own frame [m].
#[derive(Debug, Clone)]
pub enum Shape {
    /// A box centred on the origin.
    Box {
        /// Edge lengths along x, y, z [m].
        size: DVec3,
        /// Faces −x, +x, −y, +y, −z, +z that lie against a neighbour or the ground and carry no load.
        buried: [bool; 6],
    },
    /// A closed mesh.
    Mesh(Arc<TriangleMesh>),
    /// A flat piece of even thickness.
    Flat(Arc<Flat>),
}

/// A flat piece of even thickness, such as a shard of glass: its faces across z, its origin the centre of mass.
///
/// The blast acts on its faces; its edges are too narrow to matter to it, and only add to its drag.
#[derive(Debug, Clone)]
pub struct Flat {
    /// Outline in the plane z = 0 [m], counter-clockwise, holes clockwise.
    pub outline: Polygon,
    /// Thickness [m].
    pub thickness: f64,
    /// Panels of either face.
    pub samples: Vec<Sample>,
    /// Inertia about the centre of mass for a mass of 1 kg [m²].
    pub inertia: DMat3,
}

impl Flat {
    /// Area of either face [m²].
    pub fn area(&self) -> f64 {
        self.samples.iter().map(|sample| sample.area).sum()
    }

    /// The corners farthest out along 16 directions of the plane [m], each once: they stand for its convex outline.
    pub fn extreme_points(&self) -> Vec<DVec2> {
        let points = self.outline.points();
        let mut chosen: Vec<usize> = Vec::with_capacity(16);
        for (x, y) in DIRECTIONS {
            let along = |i: &usize| points[*i].x * x + points[*i].y * y;
            let farthest = (0..points.len()).max_by(|a, b| along(a).total_cmp(&along(b)));
            let farthest = farthest.expect("an outline has points");
            if !chosen.contains(&farthest) {
                chosen.push(farthest);
            }
        }
        chosen.into_iter().map(|i| points[i]).collect()
    }
}

/// Sixteen directions around, about evenly.
const DIRECTIONS: [(f64, f64); 16] = {
    const EIGHTH: [(f64, f64); 4] = [(1.0, 0.0), (1.0, 0.4), (1.0, 1.0), (0.4, 1.0)];
    let mut all = [(0.0, 0.0); 16];
    let mut i = 0;
    while i < 4 {
        let (x, y) = EIGHTH[i];
        all[i] = (x, y);
        all[i + 4] = (-y, x);
        all[i + 8] = (-x, -y);
        all[i + 12] = (y, -x);
        i += 1;
    }
    all
};

impl Body {
    /// Mass, centre of mass and inertia, in the body's own frame.
    ///
    /// # Errors
    /// [`Error::Malformed`] when a mesh encloses no volume.
    pub fn mass_properties(&self) -> Result<MassProperties> {
        match &self.shape {
            Shape::Box { size, .. } => Ok(MassProperties::of_box(*size, self.mass)),
            Shape::Mesh(mesh) => Ok(MassProperties::of_mesh(mesh, 1.0)?.with_mass(self.mass)),
            Shape::Flat(flat) => {
                Ok(MassProperties { mass: self.mass, centre: DVec3::ZERO, inertia: flat.inertia * self.mass })
            }
        }
    }
}

/// More steps than any machine finishes.
const MOST_STEPS: f64 = 1e10;

impl Scene {
    /// Checks every number of the scene.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] or [`Error::Malformed`] for the first value without a meaning.
    pub fn validate(&self) -> Result<()> {
        self.air.validate()?;
        if self.charges.is_empty() {
            return Err(Error::Malformed("the scene has no charge".into()));
        }
        for charge in &self.charges {
            charge.validate()?;
        }
        if let Some(ground) = self.ground {
            finite("ground height [m]", ground.height)?;
            not_negative("ground friction", ground.friction)?;
        }
        positive("duration [s]", self.time.duration)?;
        positive("frame rate [1/s]", self.time.frame_rate)?;
        if let Some(step) = self.time.step {
            positive("step [s]", step)?;
            if self.time.duration / step > MOST_STEPS {
                let expected = "long enough for the duration to have at most 1e10 steps";
                return Err(Error::OutOfRange { what: "step [s]", value: step, expected });
            }
        }
        if let Clearing::Length(length) = self.loading.clearing {
            not_negative("clearing length [m]", length)?;
        }
        self.occlusion.validate()?;
        not_negative("damping factor", self.dynamics.damping_factor)?;
        not_negative("rotation factor", self.dynamics.rotation_factor)?;
        for mortar in self.mortar.values() {
            not_negative("tensile strength of mortar [Pa]", mortar.tensile)?;
            not_negative("shear strength of mortar [Pa]", mortar.shear)?;
        }
        self.bodies.iter().try_for_each(Body::validate)?;
        self.windows.iter().try_for_each(Window::validate)
    }
}

impl Body {
    fn validate(&self) -> Result<()> {
        positive("body mass [kg]", self.mass)?;
        not_negative("friction", self.friction)?;
        not_negative("drag coefficient", self.drag_coefficient)?;
        not_negative("wall around the body [m]", self.surround)?;
        if let Some(lift) = self.lift_coefficient {
            not_negative("lift coefficient", lift)?;
        }
        if !self.position.is_finite() || !self.orientation.is_finite() || !self.orientation.is_normalized() {
            return Err(Error::Malformed("a body's position and unit quaternion must be finite".into()));
        }
        if let Shape::Box { size, .. } = self.shape {
            for edge in size.to_array() {
                positive("box edge [m]", edge)?;
            }
        }
        Ok(())
    }
}
