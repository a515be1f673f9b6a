//! Studs: tiny balls on a body's edges that hold it where the library's contacts let it sink.
//!
//! Box3D keeps four points of the faces with which two shapes touch, chosen by the area between them. A face of more
//! corners that stands steeply on another dips in beside those four. So where a body that lies or slides is deep in another,
//! the deepest point of its edges gets a stud, which is a contact of its own. They go when the body flies: there
//! they are of no use, and where its mass is set anew, they make it count as so thin that its motion is followed
//! continuously at every step.

use boxddd::{BodyId, Filter, QueryFilter, ShapeDef, ShapeId, Sphere, World};
use glam::DVec3;

use super::{SOUND, single};

/// How deep an edge may be in another body before it gets a stud [m]: the rule is 2 mm, and contacts give way by a quarter of
/// a millimetre anyway. With half a millimetre a heap takes a tenth more time.
pub const DEPTH: f64 = 8e-4;
/// The same where a body has been slow for [`LATER`] and still gets about [m]: it rocks on points that change.
pub const FINE: f64 = 1e-4;
/// See [`FINE`] [s].
pub const LATER: f64 = 0.9;
/// A body faster than this loses its studs [m/s]: it flies or tumbles.
const FAST: f64 = 2.0;
/// One that has been slower for so long is looked at [s].
const DELAY: f64 = 0.1;
/// Time between two looks at a body, and at one that is still [s].
const PERIOD: f64 = 0.04;
const STILL_PERIOD: f64 = 0.15;
/// A stud's radius [m]: less than contacts give way by, so that no gap shows.
const RADIUS: f32 = 1e-4;
/// No two studs are nearer than this [m]: a body that turns as it comes out would get a row of them.
const APART: f64 = 2e-3;
/// Most studs of a body, for time's sake: few have more than three.
const MOST: usize = 8;
/// What studs are to other shapes: they meet each other nowhere.
const CATEGORY: u64 = 8;

/// The studs of one body: where they are, in its principal axes [m], and their shapes.
#[derive(Debug, Clone)]
pub struct Studs {
    all: Vec<(DVec3, ShapeId)>,
    /// Time until the next look [s].
    wait: f64,
}

impl Studs {
    /// A body without studs.
    pub fn none() -> Self {
        Self { all: Vec::new(), wait: DELAY }
    }

    /// Takes in a step of `dt` [s] after which no part of the body is faster than `speed` [m/s]. Returns whether it is time
    /// to look where it is deep in others: less often for one that is `still`.
    pub fn is_due(&mut self, world: &mut World, id: BodyId, speed: f64, still: bool, dt: f64) -> bool {
        if speed > FAST {
            self.wait = DELAY;
            self.remove(world, id);
            return false;
        }
        self.wait -= dt;
        let due = self.wait <= 0.0;
        if due {
            self.wait = if still { STILL_PERIOD } else { PERIOD };
        }
        due
    }

    /// Puts a stud on a body, unless there is one already, and wakes it.
    pub fn add(&mut self, world: &mut World, id: BodyId, point: DVec3, surface: &ShapeDef) {
        if self.all.len() < MOST && self.all.iter().all(|(other, _)| other.distance(point) >= APART) {
            let ball = Sphere::new(single(point), RADIUS);
            self.all.push((point, world.create_sphere_shape(id, surface, &ball).expect(SOUND)));
            world.set_body_awake(id, true).expect(SOUND);
        }
    }

    /// Takes those off that touch nothing.
    pub fn prune(&mut self, world: &mut World, id: BodyId) {
        if self.all.is_empty() {
            return;
        }
        let contacts = world.body_contacts(id).expect(SOUND);
        self.all.retain(|&(_, stud)| {
            let touches =
                contacts.iter().any(|contact| contact.shape_id_a == stud || contact.shape_id_b == stud);
            if !touches {
                world.destroy_shape(stud, false).expect(SOUND);
            }
            touches
        });
    }

    /// Takes all of them off.
    pub fn remove(&mut self, world: &mut World, id: BodyId) {
        if self.all.is_empty() {
            return;
        }
        for (_, shape) in self.all.drain(..) {
            world.destroy_shape(shape, false).expect(SOUND);
        }
        // So the library learns that the body is as thick as it was.
        let mass = world.body_mass_data(id).expect(SOUND);
        world.set_body_mass_data(id, mass).expect(SOUND);
    }
}

/// What the studs of a body meet that meets others by this filter.
pub fn filter(Filter { mask_bits, .. }: Filter) -> Filter {
    Filter { category_bits: CATEGORY, mask_bits: mask_bits & !CATEGORY, group_index: 0 }
}

/// The bodies whose bounds meet those of a body that meets others by this filter, each once.
///
/// Not those that it touches: the library finds no contact between some shapes that overlap.
pub fn near(world: &World, id: BodyId, Filter { category_bits, mask_bits, .. }: Filter) -> Vec<BodyId> {
    let mut others = Vec::new();
    let bounds = world.body_aabb(id).expect(SOUND);
    let filter = QueryFilter::default().category_bits(category_bits).mask_bits(mask_bits);
    for hit in world.overlap_aabb(bounds, filter).expect(SOUND) {
        let body = world.shape_body(hit.shape_id).expect(SOUND);
        if body != id && !others.contains(&body) {
            others.push(body);
        }
    }
    others
}
