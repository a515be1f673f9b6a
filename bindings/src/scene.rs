//! Building and running a scene from Python.

use std::collections::BTreeMap;
use std::sync::Arc;

use engine::air::Air;
use engine::charge::Charge;
use engine::dynamics::contact::Mortar;
use engine::dynamics::ground::Ground;
use engine::geometry::{MassProperties, TriangleMesh};
use engine::loading::Clearing;
use engine::material::GLASS;
use engine::occlusion::{Attenuation, Per, Settings as Occlusion, Shelter};
use engine::scene::{Body, Dynamics, Loading, Scene as EngineScene, Shape, Time};
use engine::simulation::{Shelters, seen_from, standing};
use engine::window::{Release, Window};
use glam::{DQuat, DVec3};
use numpy::{PyArray1, PyArray2, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::{floats, quaternion, quaternions, rows_of_three, same_length, vectors};
use crate::blast::{Source, burst, drag, loading_mode, pulse_shape};
use crate::fracture::{RecipeArgument, polygon};
use crate::recording::Recording;
use crate::{InputError, engine, refused, run};

/// Number of the nearest body, and its distance.
type SeenFrom<'py> = (Bound<'py, PyArray1<i64>>, Bound<'py, PyArray1<f64>>);

/// A length, or the name of a way to find it.
#[derive(FromPyObject)]
pub enum ClearingArgument {
    Length(f64),
    Name(String),
}

/// How shelter is found: whether at all, the map's resolution, for a body or each panel, and the attenuation's
/// offset, slope, exponent and power.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct OcclusionArgument {
    enabled: bool,
    resolution: usize,
    per: String,
    offset: f64,
    slope: f64,
    exponent: f64,
    power: f64,
}

impl OcclusionArgument {
    fn into_engine(self) -> PyResult<Occlusion> {
        let attenuation = Attenuation {
            offset: self.offset,
            slope: self.slope,
            exponent: self.exponent,
            power: self.power,
        };
        let per =
            crate::blast::choose("occlusion per", &self.per, &[("body", Per::Body), ("panel", Per::Panel)])?;
        let settings = Occlusion { enabled: self.enabled, resolution: self.resolution, per, attenuation };
        settings.validate().map_err(refused)?;
        Ok(settings)
    }
}

/// How the pieces of an object behave: what all objects of a scene may say, whatever their shape.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct BehaviourArgument {
    anchored: bool,
    occludes: bool,
    can_rotate: bool,
    friction: f64,
    drag_coefficient: f64,
    lift_coefficient: Option<f64>,
}

impl BehaviourArgument {
    /// A body that behaves so, by itself.
    fn body(&self, shape: Shape, position: DVec3, orientation: DQuat, mass: f64) -> Body {
        Body {
            shape,
            position,
            orientation,
            mass,
            assembly: None,
            anchored: self.anchored,
            occludes: self.occludes,
            can_rotate: self.can_rotate,
            friction: self.friction,
            drag_coefficient: self.drag_coefficient,
            lift_coefficient: self.lift_coefficient,
            surround: 0.0,
            hold: None,
        }
    }
}

/// A scene of charges and rigid bodies, ready to be filled and simulated.
#[pyclass(module = "brisance._engine")]
pub struct Scene {
    scene: EngineScene,
    assemblies: u32,
}

#[pymethods]
impl Scene {
    #[new]
    #[pyo3(signature = (*, pressure, temperature, ground, duration, frame_rate, step, mode, clearing, drag, pulse,
        negative_phase, occlusion, damping_factor, rotation_factor, contacts, until_rest))]
    #[allow(clippy::too_many_arguments)]
    fn new(
        pressure: f64,
        temperature: f64,
        ground: Option<(f64, f64)>,
        duration: f64,
        frame_rate: f64,
        step: Option<f64>,
        mode: &str,
        clearing: ClearingArgument,
        drag: &str,
        pulse: &str,
        negative_phase: bool,
        occlusion: OcclusionArgument,
        damping_factor: f64,
        rotation_factor: f64,
        contacts: bool,
        until_rest: bool,
    ) -> PyResult<Self> {
        let clearing = match clearing {
            ClearingArgument::Length(length) => Clearing::Length(length),
            ClearingArgument::Name(name) => crate::blast::choose(
                "clearing",
                &name,
                &[("assembly", Clearing::Assembly), ("piece", Clearing::Piece)],
            )?,
        };
        let scene = EngineScene {
            air: Air { pressure, temperature, ..Air::default() },
            ground: ground.map(|(height, friction)| Ground { height, friction }),
            charges: Vec::new(),
            bodies: Vec::new(),
            windows: Vec::new(),
            mortar: BTreeMap::new(),
            time: Time { duration, frame_rate, step, until_rest },
            loading: Loading {
                mode: loading_mode(mode)?,
                clearing,
                drag: self::drag(drag)?,
                pulse: pulse_shape(pulse)?,
                negative_phase,
            },
            occlusion: occlusion.into_engine()?,
            dynamics: Dynamics { damping_factor, rotation_factor, contacts },
        };
        Ok(Self { scene, assemblies: 0 })
    }

    /// Adds a charge. `source` is a name or a table of curves.
    #[pyo3(signature = (*, mass, tnt_equivalence, position, burst, time, gain, source))]
    #[allow(clippy::too_many_arguments)]
    fn add_charge(
        &mut self,
        mass: f64,
        tnt_equivalence: f64,
        position: [f64; 3],
        burst: &str,
        time: f64,
        gain: f64,
        source: Source,
    ) -> PyResult<()> {
        let charge = Charge {
            mass,
            tnt_equivalence,
            position: DVec3::from_array(position),
            burst: self::burst(burst)?,
            time,
            gain,
            curves: source.into_engine()?,
        };
        charge.validate().map_err(refused)?;
        self.scene.charges.push(charge);
        Ok(())
    }

    /// Adds n boxes and returns the number of their assembly, if they are one: sizes (n, 3), positions (n, 3),
    /// orientations (n, 4) w first, masses (n,), buried faces (n, 6). `mortar` binds those of an assembly: tensile and
    /// shear strength [Pa] and the width of the joints [m].
    #[pyo3(signature = (*, size, position, orientation, mass, buried, assembly, behaviour, mortar=None))]
    #[allow(clippy::too_many_arguments)]
    fn add_boxes(
        &mut self,
        size: PyReadonlyArray2<'_, f64>,
        position: PyReadonlyArray2<'_, f64>,
        orientation: PyReadonlyArray2<'_, f64>,
        mass: PyReadonlyArray1<'_, f64>,
        buried: PyReadonlyArray2<'_, bool>,
        assembly: bool,
        behaviour: BehaviourArgument,
        mortar: Option<(f64, f64, f64)>,
    ) -> PyResult<Option<u32>> {
        let sizes = vectors(&size, "size")?;
        let positions = vectors(&position, "position")?;
        let orientations = quaternions(&orientation, "orientation")?;
        let masses = floats(&mass);
        same_length("position", positions.len(), sizes.len())?;
        same_length("orientation", orientations.len(), sizes.len())?;
        same_length("mass", masses.len(), sizes.len())?;
        if buried.shape() != [sizes.len(), 6] {
            return Err(InputError::new_err("buried must have the shape (n, 6)"));
        }
        let group = assembly.then_some(self.assemblies);
        self.assemblies += u32::from(assembly);
        if let (Some(group), Some((tensile, shear, gap))) = (group, mortar) {
            self.scene.mortar.insert(group, Mortar { tensile, shear, gap });
        }
        let buried = buried.as_array();
        for i in 0..sizes.len() {
            let flags = std::array::from_fn(|face| buried[[i, face]]);
            let shape = Shape::Box { size: sizes[i], buried: flags };
            let body = behaviour.body(shape, positions[i], orientations[i], masses[i]);
            self.scene.bodies.push(Body { assembly: group, ..body });
        }
        Ok(group)
    }

    /// Adds one body with the shape of a closed mesh: vertices (v, 3) in its own frame, triangles (t, 3).
    #[pyo3(signature = (*, vertices, triangles, position, orientation, mass, behaviour))]
    #[allow(clippy::too_many_arguments)]
    fn add_mesh(
        &mut self,
        vertices: PyReadonlyArray2<'_, f64>,
        triangles: PyReadonlyArray2<'_, i64>,
        position: [f64; 3],
        orientation: [f64; 4],
        mass: f64,
        behaviour: BehaviourArgument,
    ) -> PyResult<()> {
        let shape = Shape::Mesh(Arc::new(mesh(&vertices, &triangles)?));
        let (position, orientation) = (DVec3::from_array(position), quaternion(orientation));
        self.scene.bodies.push(behaviour.body(shape, position, orientation, mass));
        Ok(())
    }

    /// Adds a pane, which breaks unless it is anchored. `outline` is a list of rings (n, 2) in its own frame [m];
    /// `recipe` says how it breaks, and where it gives neither `pieces` nor `critical_length` the load does. `assembly`:
    /// the number of what it stands together with; left out, it stands alone.
    #[pyo3(signature = (*, outline, thickness, position, orientation, strength, recipe, release, bite, facade, assembly,
        behaviour))]
    #[allow(clippy::too_many_arguments)]
    fn add_window(
        &mut self,
        outline: Vec<PyReadonlyArray2<'_, f64>>,
        thickness: f64,
        position: [f64; 3],
        orientation: [f64; 4],
        strength: f64,
        recipe: RecipeArgument<'_>,
        release: &str,
        bite: Option<f64>,
        facade: f64,
        assembly: Option<u32>,
        behaviour: BehaviourArgument,
    ) -> PyResult<()> {
        let releases = [("as it cracks", Release::AsItCracks), ("all at once", Release::AllAtOnce)];
        let (recipe, fine) = recipe.into_engine()?;
        let assembly = assembly.unwrap_or(self.assemblies);
        self.assemblies = self.assemblies.max(assembly + 1);
        let window = Window {
            outline: polygon(&outline)?,
            thickness,
            position: DVec3::from_array(position),
            orientation: quaternion(orientation),
            material: GLASS,
            strength,
            may_break: !behaviour.anchored,
            recipe,
            by_load: !fine,
            release: crate::blast::choose("release", release, &releases)?,
            bite,
            facade,
            assembly: Some(assembly),
            occludes: behaviour.occludes,
            can_rotate: behaviour.can_rotate,
            friction: behaviour.friction,
            drag_coefficient: behaviour.drag_coefficient,
            lift_coefficient: behaviour.lift_coefficient,
        };
        window.validate().map_err(refused)?;
        self.scene.windows.push(window);
        Ok(())
    }

    /// Centres of mass in the bodies' own frames, (bodies, 3) [m].
    fn centres_of_mass<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let centres: Vec<DVec3> = (self.scene.bodies.iter())
            .map(|body| body.mass_properties().map(|m| m.centre).map_err(refused))
            .collect::<PyResult<_>>()?;
        Ok(rows_of_three(py, centres.into_iter()))
    }

    /// How bodies stand at the start, whole panes last: centres of mass (n, 3) [m], orientations (n, 4) w first and
    /// masses (n,) [kg].
    fn standing<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let standing = standing(&self.scene);
        let middle = |body: &Body| {
            let own = body.mass_properties().map_err(refused)?.centre;
            Ok(body.position + body.orientation * own)
        };
        let middles: Vec<DVec3> = standing.bodies.iter().map(middle).collect::<PyResult<_>>()?;
        let turns = standing.bodies.iter().map(|body| body.orientation);
        let turns: Vec<f64> = turns.flat_map(|q| [q.w, q.x, q.y, q.z]).collect();
        let result = PyDict::new(py);
        result.set_item("centre_m", rows_of_three(py, middles.into_iter()))?;
        result.set_item("orientation", PyArray1::from_vec(py, turns).call_method1("reshape", ((-1, 4),))?)?;
        result.set_item("mass_kg", PyArray1::from_iter(py, standing.bodies.iter().map(|body| body.mass)))?;
        Ok(result)
    }

    /// What a charge sees: number of the nearest body on each pixel of its sphere map, -1 where there is none, and
    /// its distance [m], not a number where there is none, (pixels,) each.
    fn seen_from<'py>(&self, py: Python<'py>, charge: usize) -> PyResult<SeenFrom<'py>> {
        if charge >= self.scene.charges.len() {
            return Err(InputError::new_err(format!(
                "there is no charge {charge}; the scene has {}, numbered from 0",
                self.scene.charges.len()
            )));
        }
        let seen = py.detach(|| seen_from(&self.scene, charge)).map_err(refused)?;
        let bodies = seen.iter().map(|first| first.map_or(-1, |(body, _)| body as i64));
        let distances = seen.iter().map(|first| first.map_or(f64::NAN, |(_, distance)| distance));
        Ok((PyArray1::from_iter(py, bodies), PyArray1::from_iter(py, distances)))
    }

    /// How each body is sheltered from a charge: blocking factor, separation, hidden share, attenuation and detour
    /// [m], (bodies + panes,) each, those of whole panes last.
    fn shelter<'py>(&self, py: Python<'py>, charge: usize) -> PyResult<Bound<'py, PyDict>> {
        let shelters = py.detach(|| Shelters::find(&self.scene)).map_err(refused)?;
        let count = self.scene.bodies.len() + self.scene.windows.len();
        let all: Vec<_> = (0..count).map(|body| shelters.body(charge, body)).collect();
        let result = PyDict::new(py);
        let column = |value: fn(&Shelter) -> f64| PyArray1::from_iter(py, all.iter().map(value));
        result.set_item("hidden", column(|s| s.hidden))?;
        result.set_item("blocking_px", column(|s| s.blocking))?;
        result.set_item("separation", column(|s| s.separation))?;
        result.set_item("attenuation", column(|s| s.attenuation))?;
        result.set_item("detour_m", column(|s| s.detour))?;
        Ok(result)
    }

    /// Runs the scene. `progress(done, total)` hears of frames; `threads` bounds the threads used, `most_pieces` how
    /// many pieces panes may break into.
    #[pyo3(signature = (*, threads=None, most_pieces=None, progress=None))]
    fn simulate(
        &self,
        py: Python<'_>,
        threads: Option<usize>,
        most_pieces: Option<usize>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Recording> {
        py.detach(|| run::watched(&self.scene, threads, most_pieces.unwrap_or(usize::MAX), progress.as_ref()))
    }
}

fn mesh(
    vertices: &PyReadonlyArray2<'_, f64>,
    triangles: &PyReadonlyArray2<'_, i64>,
) -> PyResult<TriangleMesh> {
    if triangles.shape()[1] != 3 {
        return Err(InputError::new_err("triangles must have the shape (t, 3)"));
    }
    let indices = triangles
        .as_array()
        .rows()
        .into_iter()
        .map(|row| Ok([index(row[0])?, index(row[1])?, index(row[2])?]))
        .collect::<PyResult<_>>()?;
    TriangleMesh::new(vectors(vertices, "vertices")?, indices).map_err(refused)
}

fn index(value: i64) -> PyResult<u32> {
    u32::try_from(value).map_err(|_| InputError::new_err(format!("{value} is no index of a vertex")))
}

/// Volume [m³], centre [m] and inertia about it for a density of 1 [m⁵] of the solid inside a closed mesh.
#[pyfunction]
#[pyo3(signature = (*, vertices, triangles))]
pub fn mass_properties<'py>(
    py: Python<'py>,
    vertices: PyReadonlyArray2<'py, f64>,
    triangles: PyReadonlyArray2<'py, i64>,
) -> PyResult<Bound<'py, PyDict>> {
    let solid = MassProperties::of_mesh(&mesh(&vertices, &triangles)?, 1.0).map_err(refused)?;
    let result = PyDict::new(py);
    result.set_item("volume_m3", solid.mass)?;
    result
        .set_item("centre_m", rows_of_three(py, [solid.centre].into_iter()).call_method1("reshape", (3,))?)?;
    let inertia = solid.inertia;
    let rows = [inertia.x_axis, inertia.y_axis, inertia.z_axis];
    result.set_item("inertia_per_density", rows_of_three(py, rows.into_iter()))?;
    Ok(result)
}
