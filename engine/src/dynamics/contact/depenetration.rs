//! Bodies that hardly move and yet are deep in another.
//!
//! A light one may carry a heavy one. The stiffness of a contact goes with the lighter of its two bodies, so a shard
//! under a crate is pressed into it and into the ground by W/(m ω²). It gets a larger mass in the physics engine, doubled
//! until it carries what lies on it. Its mass plays no part in how it is driven, and it has its own again as soon as it
//! moves.
//!
//! Or two shards that met edge on have locked: parts of the one press the other from both sides, and neither gets away.
//! They are moved apart along the line between their centres, across the direction in which they hold each other.

use boxddd::{BodyId, ContactData, Manifold, World};
use glam::DVec3;

use super::mass::scaled;
use super::settling::SLOW;
use super::{SOUND, double, pose_of, single};

/// How deep a body may be in another before something is done about it [m].
const DEPTH: f64 = 1e-3;
/// For how long a body has to be slower than [`SLOW`] [s]. Pieces that are let go overlap a little, and come apart by
/// themselves.
const DELAY: f64 = 0.2;
/// One faster than this has its own mass [m/s].
const FAST: f64 = 0.6;
/// Time between two looks at a body's contacts [s]; a contact gives way within a few hundredths of a second.
const PERIOD: f64 = 0.02;
/// The largest mass, in its own [1].
const MOST: f64 = 4096.0;
/// By so much two bodies that have locked are moved apart at the first look [m], at the second by twice that, and so on.
const PART: f64 = 1e-3;
/// At most by this many times that.
const MOST_PARTS: u32 = 10;

/// How much more mass a body has than its own, and when its contacts are looked at next.
#[derive(Debug, Clone, Copy)]
pub struct Depenetration {
    /// Times its own mass, and how much that may be [1].
    factor: f32,
    most: f32,
    /// Time until the next look [s].
    wait: f64,
    /// Whether it had locked at the last look. It must not sleep then: it has no speed, since it is shifted.
    locked: bool,
    /// How often it has been shifted since it was last deep in nothing, up to [`MOST_PARTS`].
    shifts: u32,
}

/// What holds a body that is deep in others.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Grip {
    /// It is not deep in anything.
    None,
    /// It is pressed into something heavier.
    Pressed,
    /// It has locked with another, and gets out by this shift [m].
    Locked(DVec3),
}

impl Depenetration {
    /// A body with its own mass, of which Box3D can hold so many times.
    pub fn up_to(most: f64) -> Self {
        Self { factor: 1.0, most: most.min(MOST) as f32, wait: DELAY, locked: false, shifts: 0 }
    }

    /// Takes in a step of `dt` [s] after which no part of the body is faster than `speed` [m/s]. Returns by how
    /// much it has lifted the body [m].
    pub fn watch(&mut self, world: &mut World, id: BodyId, speed: f64, dt: f64) -> f64 {
        if speed > FAST && self.factor > 1.0 {
            change_mass(world, id, 1.0 / self.factor);
            self.factor = 1.0;
        }
        if !self.is_due(speed, dt) {
            return 0.0;
        }
        let grip = grip(world, id);
        let locked = matches!(grip, Grip::Locked(_));
        if locked != self.locked {
            world.enable_body_sleep(id, !locked).expect(SOUND);
            self.locked = locked;
        }
        match grip {
            Grip::None => self.shifts = 0,
            Grip::Pressed => {
                if 2.0 * self.factor <= self.most {
                    change_mass(world, id, 2.0);
                    self.factor *= 2.0;
                }
            }
            Grip::Locked(shift) => {
                self.shifts = (self.shifts + 1).min(MOST_PARTS);
                // Never down: there may be the ground, and the other one goes up.
                let shift = f64::from(self.shifts) * DVec3::new(shift.x, shift.y.max(0.0), shift.z);
                let at = pose_of(world, id).0 + shift;
                let rotation = world.body_rotation(id).expect(SOUND);
                world.set_body_transform(id, single(at), rotation).expect(SOUND);
                return shift.y;
            }
        }
        0.0
    }

    /// Whether the body had locked with another at the last look.
    pub fn is_locked(&self) -> bool {
        self.locked
    }

    /// Whether it is time to look at the contacts of a body that hardly moves.
    fn is_due(&mut self, speed: f64, dt: f64) -> bool {
        self.wait = if speed > if self.locked { FAST } else { SLOW } { DELAY } else { self.wait - dt };
        let due = self.wait <= 0.0;
        if due {
            self.wait = PERIOD;
        }
        due
    }
}

fn change_mass(world: &mut World, id: BodyId, factor: f32) {
    let data = world.body_mass_data(id).expect(SOUND);
    world.set_body_mass_data(id, scaled(&data, factor)).expect(SOUND);
}

fn grip(world: &World, id: BodyId) -> Grip {
    let mass = |id: BodyId| f64::from(world.body_mass(id).expect(SOUND));
    let body_of = |shape| world.shape_body(shape).expect(SOUND);
    let own = mass(id);
    let mut pressed = false;
    // The other body, and the direction from it.
    let mut held: Vec<(BodyId, DVec3)> = Vec::new();
    for contact in world.body_contacts(id).expect(SOUND) {
        let (a, b) = (body_of(contact.shape_id_a), body_of(contact.shape_id_b));
        let (other, sense) = if a == id { (b, -1.0) } else { (a, 1.0) };
        let heavy = mass(other);
        for normal in deep_normals(&contact) {
            let normal = sense * normal;
            // What does not move has no mass.
            pressed |= heavy == 0.0 || heavy > own;
            if held.iter().any(|&(body, from)| body == other && from.dot(normal) < -0.5) {
                let apart = pose_of(world, id).0 - pose_of(world, other).0;
                let out = apart.reject_from(normal).normalize_or_zero();
                let share = if heavy == 0.0 { 1.0 } else { heavy / (heavy + own) };
                return Grip::Locked(PART * share * out);
            }
            held.push((other, normal));
        }
    }
    if pressed { Grip::Pressed } else { Grip::None }
}

/// Normals from the first shape to the second where the two are deep in each other.
fn deep_normals(contact: &ContactData) -> impl Iterator<Item = DVec3> + '_ {
    let deep =
        |manifold: &&Manifold| manifold.points().iter().any(|point| f64::from(point.separation) < -DEPTH);
    contact.manifolds.iter().filter(deep).map(|manifold| double(manifold.normal))
}
