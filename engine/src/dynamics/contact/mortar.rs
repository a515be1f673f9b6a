//! Mortar: bonds between bricks that hold up to a tensile and a shear strength, and then are gone.
//!
//! A bond keeps two bricks rigid to each other where their faces meet. After each step the force and the moment that it
//! carried are compared with what its face can bear: normal stress from the force and from bending of a rectangular
//! section, and mean shear stress. It breaks when
//!
//! ```text
//! σ > tensile + 0        or     τ > shear + 0.4 max(−σ, 0)
//! ```
//!
//! with σ the highest normal stress, positive in tension: joints under pressure carry more shear (Mohr–Coulomb, as
//! Eurocode 6 has it, EN 1996-1-1, 3.6.2).

use boxddd::{BodyId, JointId, Transform, WeldJointDef, World};
use glam::{DQuat, DVec3};

use super::{SOUND, double, quaternion, single};

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
#[derive(Default)]
pub struct Bonds {
    held: Vec<(Bond, JointId, BodyId)>,
}

impl Bonds {
    pub fn len(&self) -> usize {
        self.held.len()
    }

    pub fn add(&mut self, world: &mut World, ids: &[Option<BodyId>], bonds: &[Bond], origin: DVec3) {
        for bond in bonds {
            let [Some(a), Some(b)] = bond.bodies.map(|index| ids[index]) else { continue };
            let frame = |id: BodyId| {
                let at = world.body_transform(id).expect(SOUND);
                let rotation =
                    DQuat::from_xyzw(at.q.v.x.into(), at.q.v.y.into(), at.q.v.z.into(), at.q.s.into());
                let position = DVec3::new(at.p.x.into(), at.p.y.into(), at.p.z.into());
                let inverse = rotation.conjugate();
                let local = inverse * (bond.middle - origin - position);
                Transform::new(single(local), quaternion(inverse * bond.world_from_joint))
            };
            let def = WeldJointDef::new(a, b).local_frame_a(frame(a)).local_frame_b(frame(b));
            let joint = world.create_weld_joint(def.collide_connected(false)).expect(SOUND);
            self.held.push((*bond, joint, a));
        }
    }

    /// Drops the bonds of a body that is taken out; Box3D takes its joints with it.
    pub fn forget(&mut self, index: usize) {
        self.held.retain(|(bond, _, _)| !bond.bodies.contains(&index));
    }

    /// Breaks the bonds that carried more than they bear in the last step.
    pub fn yield_where_overloaded(&mut self, world: &mut World) {
        self.held.retain(|(bond, joint, a)| {
            if !world.body_awake(*a).expect(SOUND) {
                return true;
            }
            let force = double(world.joint_constraint_force(*joint).expect(SOUND));
            let torque = double(world.joint_constraint_torque(*joint).expect(SOUND));
            let at = world.body_rotation(*a).expect(SOUND);
            let world_from_a = DQuat::from_xyzw(at.v.x.into(), at.v.y.into(), at.v.z.into(), at.s.into());
            let frame = world.joint_local_frame_a(*joint).expect(SOUND).q;
            let joint_in_a =
                DQuat::from_xyzw(frame.v.x.into(), frame.v.y.into(), frame.v.z.into(), frame.s.into());
            let into_joint = (world_from_a * joint_in_a).conjugate();
            let holds = bond.bears(into_joint * force, into_joint * torque);
            if !holds {
                world.destroy_joint(*joint, true).expect(SOUND);
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
