//! Bodies that collide, slide, pile up and come to rest, through Box3D (crate `boxddd`).
//!
//! The physics engine finds contacts and solves them; what drives the bodies comes from outside, as changes of their
//! velocities before each step. Bodies may join late: a piece of a pane is not here until it is free. A body at rest
//! falls asleep and costs nothing until something touches it.
//!
//! The engine works in single precision; places are taken about the middle of the scene. It runs on one thread: with
//! several its results were seen to differ from run to run, and a thousand bodies gained nothing from a second one
//! (`docs/decisions/0001-contacts.md`). So the bits are the same for any number of threads, and Box3D avoids the platform's
//! mathematics library and fused operations.

mod cells;
mod convex;
mod depenetration;
mod energy;
mod hull;
mod mass;
mod mortar;
mod rocking;
mod settling;
mod shape;
mod solids;
mod standstill;
mod studs;

use std::collections::HashMap;

use boxddd::{
    BodyId, BodyMoveEvent, BodyType, BoxHull, Filter, Foundation, FoundationConfig, MotionLocks, Quat,
    ShapeDef, StallThreshold, Vec3, World, WorldTransform,
};
use glam::{DQuat, DVec3};

use super::ground::{BOUNCE_SPEED, Ground, RESTITUTION};
use super::{GRAVITY, RigidBody};
use crate::geometry::box_corners;
use energy::{Change, Energy};
use mass::{gain, mass_data};
use mortar::Bonds;
pub use mortar::{Bond, Mortar, bonds_of_bricks};
use settling::{SLEEP_SPEED, Settling};
pub use shape::CollisionShape;
use solids::Solids;

/// Box3D's tolerances are for bodies of a metre; ours are this much finer: its slop is 0.25 mm, the distance at which
/// contacts begin 1 mm.
const FINENESS: f32 = 0.05;
/// Stiffness of contacts [Hz], their damping ratio, and how fast an overlap is driven apart at most [m/s].
///
/// Bodies that overlap when they are freed gain no more speed than the last.
const CONTACT: (f32, f32, f32) = (146.0, 10.0, 0.4);
/// Faster than any body a blast throws [m/s].
const FASTEST: f32 = 1e4;
/// Longest sub-step of the contacts [s]: Box3D makes contacts no stiffer than an eighth of its rate. With twice that,
/// heavy bodies that hit light ones were seen to gain 5 % of a scene's energy.
const SUBSTEP: f64 = 1.0 / 1920.0;
/// Longest step [s]; with the sub-steps it gives.
pub const LONGEST_STEP: f64 = 2.0 * SUBSTEP;
/// Shortest step for the fastest bodies [s].
const SHORTEST_STEP: f64 = 2.5e-4;
/// The fastest body moves no farther than this in a step, so that bodies do not pass through each other [m].
const TRAVEL: f64 = 0.25;
/// Bodies farther than this from the middle of the scene do not meet others any more [m].
pub const REACH: f64 = 3000.0;
/// A body whose parts are farther from its centre of mass than this does not meet others [m].
const LARGEST: f64 = 1000.0;
/// Fastest turn [rad/s]. Box3D turns the axes of a spinning body by one Newton step a sub-step. That loses energy as long
/// as a body turns by no more than 0.2 rad in a sub-step, and gains some beyond.
const FASTEST_TURN: f64 = 0.2 / SUBSTEP;
/// Half the width of the ground, and its depth [m].
const GROUND: (f32, f32) = (4000.0, 20.0);

/// What a body is to the contact world.
#[derive(Debug, Clone)]
pub struct ContactBody {
    /// Its shape.
    pub shape: CollisionShape,
    /// Coefficient of friction; that of two bodies together is the geometric mean.
    pub friction: f64,
    /// Whether it never moves.
    pub anchored: bool,
    /// What it does not meet.
    pub passes: Passes,
}

/// Bodies that do not meet each other: glass lies in the rebate of its frame, inside the frame's own shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Passes {
    /// It meets everything.
    Nothing,
    /// It holds glass, and does not meet that.
    Glass,
    /// It is glass that stays where it is, and does not meet what lies against it as it comes.
    Neighbours,
    /// It was held by frames, and does not meet those, nor glass that stays in them, until it has left them.
    Frames,
    /// It lies against glass that stays, and does not meet such until it is clear of it.
    Splinters,
}

impl Passes {
    fn filter(self) -> Filter {
        const FRAME: u64 = 2;
        const SPLINTER: u64 = 4;
        let (category_bits, mask_bits) = match self {
            Self::Nothing => (1, u64::MAX),
            Self::Glass => (FRAME, u64::MAX),
            Self::Neighbours => (SPLINTER, u64::MAX),
            Self::Frames => (1, !(FRAME | SPLINTER)),
            Self::Splinters => (1, !SPLINTER),
        };
        Filter { category_bits, mask_bits, group_index: 0 }
    }
}

/// A body that was awake in a step.
#[derive(Debug, Clone, Copy)]
pub struct Moved {
    /// Which body.
    pub index: usize,
    /// Whether it fell asleep in this step.
    pub asleep: bool,
    /// Whether it gets nowhere, however fast it trembles.
    pub still: bool,
}

/// A body after a step.
#[derive(Debug, Clone, Copy)]
struct Step {
    index: usize,
    id: BodyId,
    asleep: bool,
    position: DVec3,
    rotation: DQuat,
    velocity: DVec3,
    spin: DVec3,
    change: Change,
}

/// All bodies that can touch.
pub struct ContactWorld {
    world: World,
    bodies: Vec<ContactBody>,
    ids: Vec<Option<BodyId>>,
    index: HashMap<BodyId, usize>,
    /// Of each body that is here.
    settlings: Vec<Option<Settling>>,
    solids: Solids,
    /// Box3D's masses are this many times ours. Only their ratios matter to motion, and the moments of a splinter of
    /// glass are so small that their product is nothing in single precision: it would turn forever.
    gain: f64,
    bonds: Bonds,
    origin: DVec3,
    energies: Vec<Energy>,
    events: Vec<BodyMoveEvent>,
    /// The bodies that were awake in the last step.
    steps: Vec<Step>,
}

/// What Box3D refuses is a mistake of ours, since scenes are checked before.
const SOUND: &str = "Box3D takes what the scene's checks let through";

/// Box3D with its unit of length; the same for all worlds, and for hulls, of a process.
fn foundation() -> &'static Foundation {
    let config =
        FoundationConfig { length_units_per_meter: FINENESS, stall_threshold: StallThreshold::Disabled };
    Foundation::initialize(config).expect(SOUND)
}

/// The longest step [s] where the fastest body has this speed [m/s].
pub fn step_at(fastest: f64) -> f64 {
    (TRAVEL / fastest).clamp(SHORTEST_STEP, LONGEST_STEP)
}

impl ContactWorld {
    /// A world with the ground alone; `origin` is the middle of the scene [m]. Bodies come by [`join`](Self::join).
    pub fn new(bodies: Vec<ContactBody>, ground: Option<Ground>, origin: DVec3) -> Self {
        let foundation = foundation();
        let (hertz, damping, speed) = CONTACT;
        let settings = foundation
            .world_def_builder()
            .gravity([0.0, -GRAVITY as f32, 0.0])
            .worker_count(1)
            .restitution_threshold(BOUNCE_SPEED as f32)
            .contact_tuning(hertz, damping, speed)
            .maximum_linear_speed(FASTEST);
        let mut world = foundation.create_world(settings.build().expect(SOUND)).expect(SOUND);
        let (half, depth) = GROUND;
        let within_reach = |ground: &Ground| (ground.height - origin.y).abs() < REACH;
        let ground = ground.filter(within_reach).map(|ground| {
            let top = (ground.height - origin.y) as f32;
            let below = foundation.body_def_builder().position([0.0, top - 0.5 * depth, 0.0]);
            let id = world.create_body(below.build().expect(SOUND)).expect(SOUND);
            let slab = BoxHull::new(half, 0.5 * depth, half).expect(SOUND);
            world
                .create_hull_shape(id, &surface(ground.friction, Passes::Nothing.filter()), &slab)
                .expect(SOUND);
            (id, f64::from(0.5 * depth))
        });
        let ids = vec![None; bodies.len()];
        let largest = bodies.iter().filter(|body| !body.anchored).map(|body| body.shape.reach());
        let largest = largest.fold(0.0, f64::max).clamp(1e-4, LARGEST);
        let gain = gain(largest);
        Self {
            world,
            ids,
            index: HashMap::new(),
            settlings: vec![None; bodies.len()],
            solids: Solids::new(bodies.len(), ground),
            energies: vec![Energy::default(); bodies.len()],
            bodies,
            gain,
            bonds: Bonds::new(gain),
            origin,
            events: Vec::new(),
            steps: Vec::new(),
        }
    }

    /// Puts a body where it is; `awake` says whether it moves at once or sleeps until something touches or pushes it.
    ///
    /// Returns whether it is there. A body beyond [`REACH`], or so large that parts of it would be, does not meet others.
    pub fn join(&mut self, index: usize, state: &RigidBody, awake: bool) -> bool {
        let foundation = foundation();
        let body = &self.bodies[index];
        if !self.can_take(body, state) {
            return false;
        }
        let turns = state.inverse_moments != DVec3::ZERO;
        let kind = if body.anchored { BodyType::Static } else { BodyType::Dynamic };
        let at = single(state.position - self.origin);
        let locks =
            MotionLocks { angular_x: !turns, angular_y: !turns, angular_z: !turns, ..MotionLocks::default() };
        let mut def = foundation
            .body_def_builder()
            .body_type(kind)
            .position(at)
            .rotation(quaternion(state.world_from_principal))
            .sleep_threshold(SLEEP_SPEED)
            .motion_locks(locks);
        if !body.anchored {
            def = def
                .linear_velocity(single(capped_velocity(state)))
                .angular_velocity(single(capped_spin(state)))
                .awake(awake);
        }
        let id = self.world.create_body(def.build().expect(SOUND)).expect(SOUND);
        let surface = surface(body.friction, body.passes.filter());
        let mut corners = Vec::new();
        for placed in body.shape.parts().iter().filter_map(|points| hull::hull_of(points)) {
            let (place, scale) = (placed.place, placed.scale);
            self.world.create_transformed_hull_shape(id, &surface, &placed.hull, place, scale).expect(SOUND);
            corners.push(placed.corners);
        }
        if corners.is_empty() {
            let (middle, half) = body.shape.slab();
            corners.push(box_corners(middle - half, middle + half).to_vec());
            let (middle, half) = (single(middle), single(half));
            let slab = BoxHull::offset(half.x, half.y, half.z, middle).expect(SOUND);
            self.world.create_hull_shape(id, &surface, &slab).expect(SOUND);
        }
        self.solids.set(index, corners);
        let mut room = 1.0;
        if !body.anchored {
            let (mass, most) = mass_data(state, body.shape.reach(), self.gain);
            self.world.set_body_mass_data(id, mass).expect(SOUND);
            room = most;
            self.energies[index] = Energy::of(state);
            self.rebase(index, state);
        }
        self.ids[index] = Some(id);
        self.index.insert(id, index);
        self.settlings[index] = Some(Settling::new(state, room));
        true
    }

    /// Whether Box3D can hold a body where it is: it ends the process over what is not finite, and over bounds beyond
    /// 5 km.
    fn can_take(&self, body: &ContactBody, state: &RigidBody) -> bool {
        let near = state.position.distance(self.origin) <= REACH;
        let fits = body.shape.reach() <= LARGEST;
        let moves = state.velocity.is_finite() && state.angular_velocity().is_finite();
        let heavy = state.inverse_mass.is_finite() && state.inverse_mass > 0.0;
        near && fits && state.world_from_principal.is_normalized() && (body.anchored || (moves && heavy))
    }

    /// Takes a body out.
    pub fn leave(&mut self, index: usize) {
        if let Some(id) = self.ids[index].take() {
            self.bonds.forget(index);
            self.settlings[index] = None;
            self.index.remove(&id);
            self.world.destroy_body(id).expect(SOUND);
        }
    }

    /// Puts a body that is not here where it is for good: it never moves, and meets what does not pass it as
    /// [`Passes::Splinters`] says. Returns whether it is there, as [`join`](Self::join).
    pub fn anchor(&mut self, index: usize, state: &RigidBody) -> bool {
        let body = &mut self.bodies[index];
        (body.anchored, body.passes) = (true, Passes::Neighbours);
        self.join(index, state, false)
    }

    /// Lets a body meet everything from now on but what it `passes`; what touches it wakes.
    pub fn pass(&mut self, index: usize, passes: Passes) {
        self.bodies[index].passes = passes;
        let (Some(id), Some(settling)) = (self.ids[index], &mut self.settlings[index]) else { return };
        settling.studs.remove(&mut self.world, id);
        for shape in self.world.body_shapes(id).expect(SOUND) {
            self.world.set_shape_filter(shape, passes.filter(), true).expect(SOUND);
        }
    }

    /// Binds bodies that have joined.
    pub fn bind(&mut self, bonds: &[Bond]) {
        let bodies = &self.bodies;
        self.bonds.add(&mut self.world, &self.ids, bodies, bonds, self.origin);
    }

    /// Bonds that hold still.
    pub fn bonds(&self) -> usize {
        self.bonds.len()
    }

    /// Whether a body is here and awake.
    pub fn is_awake(&self, index: usize) -> bool {
        self.ids[index].is_some_and(|id| self.world.body_awake(id).expect(SOUND))
    }

    /// How many bodies are awake.
    pub fn awake(&self) -> usize {
        self.world.awake_body_count().expect(SOUND) as usize
    }

    /// Gives a body the velocities of its state, and wakes it; one whose velocities are not numbers keeps its own.
    pub fn drive(&mut self, index: usize, state: &RigidBody) {
        let Some(id) = self.ids[index] else { return };
        if !state.velocity.is_finite() || !state.angular_velocity().is_finite() {
            return;
        }
        let (velocity, spin) = (capped_velocity(state), capped_spin(state));
        self.world.set_body_linear_velocity(id, single(velocity)).expect(SOUND);
        self.world.set_body_angular_velocity(id, single(spin)).expect(SOUND);
        self.rebase(index, state);
    }

    /// Takes in the energy of a body that has got its velocities from outside.
    fn rebase(&mut self, index: usize, state: &RigidBody) {
        let place = state.position - self.origin;
        let (velocity, spin) = (capped_velocity(state), capped_spin(state));
        self.energies[index].look(place, state.world_from_principal, velocity, spin, 0.0);
    }

    /// A step of `dt` [s], at most [`LONGEST_STEP`]. Then `update` hears of every body that was awake in it: which one,
    /// whether it rests, its position [m], rotation, velocity [m/s] and angular velocity [rad/s]. Where one of these is not
    /// finite, Box3D could not solve the step, and this world must not be stepped again.
    pub fn step(&mut self, dt: f64, mut update: impl FnMut(Moved, DVec3, DQuat, DVec3, DVec3)) {
        let substeps = libm::ceil(dt / SUBSTEP - 1e-9).max(1.0) as i32;
        self.world.step(dt as f32, substeps).expect(SOUND);
        self.bonds.yield_where_overloaded(&mut self.world);
        self.hear(dt);
        self.take_energy_back();
        let steps = std::mem::take(&mut self.steps);
        for step in &steps {
            let still = self.settle(step, dt);
            let Step { index, asleep, position, rotation, velocity, spin, .. } = *step;
            // One that has just got a stud is awake again.
            let moved = Moved { index, asleep: asleep && !self.is_awake(index), still };
            update(moved, position, rotation, velocity, spin);
        }
        self.steps = steps;
    }

    /// Takes in what has become of the bodies that were awake in a step.
    fn hear(&mut self, dt: f64) {
        self.world.body_events_into(&mut self.events).expect(SOUND);
        self.steps.clear();
        for event in &self.events {
            let id = event.body_id;
            let Some(&index) = self.index.get(&id) else { continue };
            let (place, rotation) = pose(&event.transform);
            let rotation = rotation.normalize();
            let position = place + self.origin;
            let velocity = double(self.world.body_linear_velocity(id).expect(SOUND));
            let mut spin = double(self.world.body_angular_velocity(id).expect(SOUND));
            if spin.is_finite() && spin.length_squared() > FASTEST_TURN * FASTEST_TURN {
                spin = spin.clamp_length_max(FASTEST_TURN);
                self.world.set_body_angular_velocity(id, single(spin)).expect(SOUND);
            }
            let change = self.energies[index].look(place, rotation, velocity, spin, dt);
            let asleep = event.fell_asleep;
            self.steps.push(Step { index, id, asleep, position, rotation, velocity, spin, change });
        }
    }

    /// Takes back a part of what contacts have done in a step that made energy.
    fn take_energy_back(&mut self) {
        let part = energy::part_to_take_back(self.steps.iter().map(|step| step.change));
        if part <= 0.0 {
            return;
        }
        for step in self.steps.iter_mut().filter(|step| !step.asleep) {
            let (velocity, spin) = self.energies[step.index].take_back(step.rotation, &step.change, part);
            if !velocity.is_finite() || !spin.is_finite() {
                continue;
            }
            step.velocity = velocity.clamp_length_max(f64::from(FASTEST));
            step.spin = spin.clamp_length_max(FASTEST_TURN);
            self.world.set_body_linear_velocity(step.id, single(step.velocity)).expect(SOUND);
            self.world.set_body_angular_velocity(step.id, single(step.spin)).expect(SOUND);
        }
    }

    /// Helps a body to lie still, and not in others. Returns whether it gets nowhere.
    fn settle(&mut self, step: &Step, dt: f64) -> bool {
        let &Step { index, id, .. } = step;
        let Some(settling) = &mut self.settlings[index] else { return false };
        let outcome = settling.watch(&mut self.world, step, dt);
        let still = settling.is_still();
        self.energies[index].lift(outcome.lift);
        if outcome.look {
            self.put_studs(index, id);
        }
        still
    }

    /// Puts studs on a body where it is deepest in each of those about it.
    fn put_studs(&mut self, index: usize, id: BodyId) {
        let Some(settling) = &mut self.settlings[index] else { return };
        settling.studs.prune(&mut self.world, id);
        let (place, turn) = pose_of(&self.world, id);
        let body = &self.bodies[index];
        let surface = surface(body.friction, studs::filter(body.passes.filter()));
        let least = settling.depth();
        for other in studs::near(&self.world, id, body.passes.filter()) {
            let number = self.index.get(&other).copied();
            if number.is_some_and(|number| self.bonds.bind(index, number)) {
                // Mortar holds them, and they do not meet.
                continue;
            }
            let others = number.map(|number| self.solids.of(number)).or_else(|| self.solids.of_ground(other));
            let (there, turned) = pose_of(&self.world, other);
            let (relative, shift) = (turn.conjugate() * turned, turn.conjugate() * (there - place));
            let deepest = self.solids.of(index).iter().flat_map(|part| {
                let others = others.into_iter().flatten();
                others.filter_map(|other| part.deepest_in(other, relative, shift, least))
            });
            if let Some((point, _)) = deepest.max_by(|a, b| a.1.total_cmp(&b.1)) {
                settling.studs.add(&mut self.world, id, point, &surface);
            }
        }
    }
}

fn surface(friction: f64, filter: Filter) -> ShapeDef {
    let surface = foundation().shape_def_builder().friction(friction as f32).restitution(RESTITUTION as f32);
    surface.density(1.0).update_body_mass(false).filter(filter).build().expect(SOUND)
}

/// A body's velocity as Box3D may have it [m/s].
fn capped_velocity(state: &RigidBody) -> DVec3 {
    state.velocity.clamp_length_max(f64::from(FASTEST))
}

/// The same for how it turns [rad/s].
fn capped_spin(state: &RigidBody) -> DVec3 {
    state.angular_velocity().clamp_length_max(FASTEST_TURN)
}

/// Place about the middle of the scene [m], and rotation.
fn pose(transform: &WorldTransform) -> (DVec3, DQuat) {
    let WorldTransform { p, q } = transform;
    let rotation = DQuat::from_xyzw(q.v.x.into(), q.v.y.into(), q.v.z.into(), q.s.into());
    (DVec3::new(p.x.into(), p.y.into(), p.z.into()), rotation)
}

fn pose_of(world: &World, id: BodyId) -> (DVec3, DQuat) {
    pose(&world.body_transform(id).expect(SOUND))
}

fn single(v: DVec3) -> Vec3 {
    Vec3::new(v.x as f32, v.y as f32, v.z as f32)
}

fn double(v: Vec3) -> DVec3 {
    DVec3::new(v.x.into(), v.y.into(), v.z.into())
}

fn quaternion(q: DQuat) -> Quat {
    Quat { v: Vec3::new(q.x as f32, q.y as f32, q.z as f32), s: q.w as f32 }
}
