//! Mortar: bonds between bricks that hold up to a tensile and a shear strength, and then are gone.
//!
//! A bond keeps two bricks rigid to each other where their faces meet. After each step the force and the moment that it
//! carried are compared with what its face can bear: normal stress from the force and from bending of a rectangular
//! section, and mean shear stress. It breaks when
//!
//! ```text
//! σ > tensile     or     τ > shear + 0.4 p
//! ```
//!
//! with σ the highest tension, τ the shear stress and p the mean pressure on the joint: joints under pressure carry more
//! shear (Mohr–Coulomb, as EN 1996-1-1, 3.6.2 has it).

use boxddd::{BodyId, JointId, Transform, WeldJointDef, World};
use glam::{DQuat, DVec3};

use super::{ContactBody, SOUND, double, pose_of, quaternion, single};

/// What pressure on a joint adds to its shear strength.
const INTERNAL_FRICTION: f64 = 0.4;
/// Two faces this near meet in a joint [m], beside the gap that the wall leaves for its mortar.
const NEAR: f64 = 1e-3;

/// Strength of mortar [Pa].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mortar {
    /// What a joint bears pulled apart [Pa].
    pub tensile: f64,
    /// What it bears sheared without pressure on it [Pa].
    pub shear: f64,
    /// Width of the joints [m].
    pub gap: f64,
}

/// A joint between two bricks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bond {
    /// The two bodies.
    pub bodies: [usize; 2],
    /// Middle of the faces' common part in the world [m].
    pub middle: DVec3,
    /// Rotation into the world of a frame with x across the joint, from the first body to the second.
    pub world_from_joint: DQuat,
    /// Edges of the common part along y and z of that frame [m].
    pub size: [f64; 2],
    /// Its strength.
    pub mortar: Mortar,
}

/// A brick for the search of joints: its number, its place in the frame of the wall [m] and its edges there [m].
pub type Brick = (usize, DVec3, DVec3);

/// The joints of bricks whose edges are parallel to the axes of one frame, `world_from_wall`: wherever two faces lie
/// `mortar.gap` apart and overlap.
pub fn bonds_of_bricks(bricks: &[Brick], world_from_wall: DQuat, mortar: Mortar) -> Vec<Bond> {
    let mut order: Vec<&Brick> = bricks.iter().collect();
    order.sort_by(|a, b| (a.1.y - 0.5 * a.2.y).total_cmp(&(b.1.y - 0.5 * b.2.y)).then(a.0.cmp(&b.0)));
    let tallest = bricks.iter().map(|b| b.2.y).fold(0.0, f64::max);
    let mut bonds = Vec::new();
    for (i, a) in order.iter().enumerate() {
        let top = a.1.y - 0.5 * a.2.y + tallest + mortar.gap + NEAR;
        let near = order[i + 1..].iter().take_while(|b| b.1.y - 0.5 * b.2.y <= top);
        bonds.extend(near.filter_map(|b| joint(a, b, world_from_wall, mortar)));
    }
    bonds
}

fn joint(a: &Brick, b: &Brick, world_from_wall: DQuat, mortar: Mortar) -> Option<Bond> {
    let between = (b.1 - a.1).abs() - 0.5 * (a.2 + b.2);
    let axis = (0..3).find(|&axis| {
        let others = [(axis + 1) % 3, (axis + 2) % 3];
        (between[axis] - mortar.gap).abs() <= NEAR && others.iter().all(|&k| between[k] < -NEAR)
    })?;
    let (low, high) = ((a.1 - 0.5 * a.2).max(b.1 - 0.5 * b.2), (a.1 + 0.5 * a.2).min(b.1 + 0.5 * b.2));
    let toward = DVec3::AXES[axis] * (b.1 - a.1)[axis].signum();
    let wall_from_joint = DQuat::from_rotation_arc(DVec3::X, toward);
    let size = (wall_from_joint.conjugate() * (high - low)).abs();
    Some(Bond {
        bodies: [a.0, b.0],
        middle: world_from_wall * (0.5 * (low + high)),
        world_from_joint: world_from_wall * wall_from_joint,
        size: [size.y, size.z],
        mortar,
    })
}

/// All bonds that hold.
pub struct Bonds {
    held: Vec<Held>,
    /// Box3D's forces are this many times ours.
    gain: f64,
}

struct Held {
    bond: Bond,
    joint: JointId,
    /// The first body of Box3D's joint, and the frame of the joint in it.
    first: BodyId,
    first_from_joint: DQuat,
    /// 1 where that is the bond's first body, -1 where it is its second.
    sign: f64,
}

impl Bonds {
    /// None yet, in a world whose masses and forces are `gain` times ours.
    pub fn new(gain: f64) -> Self {
        Self { held: Vec::new(), gain }
    }

    /// Whether a bond holds two bodies together.
    pub fn bind(&self, one: usize, other: usize) -> bool {
        self.held.iter().any(|held| held.bond.bodies == [one, other] || held.bond.bodies == [other, one])
    }

    pub fn len(&self) -> usize {
        self.held.len()
    }

    /// Binds bodies that are there, where the joint is at both of them. On a long lever a light body comes to turn ever
    /// faster, until its velocity is no number.
    pub fn add(
        &mut self,
        world: &mut World,
        ids: &[Option<BodyId>],
        bodies: &[ContactBody],
        bonds: &[Bond],
        origin: DVec3,
    ) {
        for bond in bonds {
            let [one, other] = bond.bodies;
            let (Some(a), Some(b)) = (ids[one], ids[other]) else { continue };
            let at_both = [(one, a), (other, b)].into_iter().all(|(index, id)| {
                let lever = (bond.middle - origin).distance(pose_of(world, id).0);
                lever <= bodies[index].shape.reach() + bond.mortar.gap + NEAR
            });
            if !at_both {
                continue;
            }
            // Box3D wants a body that never moves first.
            let (first, second, sign) = match (bodies[one].anchored, bodies[other].anchored) {
                (true, true) => continue,
                (false, true) => (b, a, -1.0),
                _ => (a, b, 1.0),
            };
            let [at_first, at_second] = [first, second].map(|id| {
                let (position, rotation) = pose_of(world, id);
                let inverse = rotation.conjugate();
                (inverse * (bond.middle - origin - position), inverse * bond.world_from_joint)
            });
            let frame = |(p, q): (DVec3, DQuat)| Transform::new(single(p), quaternion(q));
            let def = WeldJointDef::new(first, second)
                .local_frame_a(frame(at_first))
                .local_frame_b(frame(at_second))
                .collide_connected(false);
            let joint = world.create_weld_joint(def).expect(SOUND);
            self.held.push(Held { bond: *bond, joint, first, first_from_joint: at_first.1, sign });
        }
    }

    /// Drops the bonds of a body that is taken out; Box3D takes its joints with it.
    pub fn forget(&mut self, index: usize) {
        self.held.retain(|held| !held.bond.bodies.contains(&index));
    }

    /// Breaks the bonds that carried more than they bear in the last step.
    pub fn yield_where_overloaded(&mut self, world: &mut World) {
        if world.awake_body_count().expect(SOUND) == 0 {
            return;
        }
        self.held.retain(|held| {
            let ours = held.sign / self.gain;
            let force = double(world.joint_constraint_force(held.joint).expect(SOUND)) * ours;
            let torque = double(world.joint_constraint_torque(held.joint).expect(SOUND)) * ours;
            let (_, world_from_first) = pose_of(world, held.first);
            let into_joint = (world_from_first * held.first_from_joint).conjugate();
            let holds = held.bond.bears(into_joint * force, into_joint * torque);
            if !holds {
                world.destroy_joint(held.joint, true).expect(SOUND);
            }
            holds
        });
    }
}

impl Bond {
    /// Whether the joint bears a force [N] and a moment [N m] on its second body, in its own frame: x > 0 presses the
    /// two together, so that x < 0 pulls them.
    pub fn bears(&self, force: DVec3, moment: DVec3) -> bool {
        let [y, z] = self.size;
        let area = y * z;
        // A rectangular section of height h and width b yields M = σ b h²/6.
        let bending = 6.0 * (moment.z.abs() / (z * y * y) + moment.y.abs() / (y * z * z));
        let pull = -force.x / area;
        let shear = libm::hypot(force.y, force.z) / area;
        let pressure = (-pull).max(0.0);
        pull + bending <= self.mortar.tensile && shear <= self.mortar.shear + INTERNAL_FRICTION * pressure
    }
}
