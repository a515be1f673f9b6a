//! Light bodies that carry heavy ones.
//!
//! The stiffness of a contact goes with the lighter of its two bodies, so a shard under a crate is pressed into it and
//! into the ground by W/(m ω²). A body that hardly moves and is deeper in another than [`DEPTH`] therefore gets a larger
//! mass in the physics engine, doubled until it carries what lies on it. Its mass plays no part in how it is driven, and
//! it has its own again as soon as it moves.

use boxddd::{BodyId, MassData, Matrix3, Vec3, World};

use super::SOUND;

/// How deep a body may be pressed in before it is made to bear more [m].
const DEPTH: f64 = 1e-3;
/// A body slower than this may lie under another [m/s].
const SLOW: f64 = 0.3;
/// One faster than this has its own mass [m/s].
const FAST: f64 = 0.6;
/// Time between two looks at a body's contacts [s]; a contact gives way within a few hundredths of a second.
const PERIOD: f64 = 0.02;
/// The largest mass, in its own [1].
const MOST: f32 = 4096.0;
/// Box3D multiplies the three moments of a body, in single precision [in its units].
const LARGEST_MOMENT: f32 = 1e12;

/// How much more mass a body has than its own, and when its contacts are looked at next.
#[derive(Debug, Clone, Copy)]
pub struct Bearing {
    /// Times its own mass [1].
    factor: f32,
    /// Time until the next look [s].
    wait: f64,
}

impl Bearing {
    /// A body with its own mass.
    pub const NONE: Self = Self { factor: 1.0, wait: PERIOD };

    /// Takes in a step of `dt` [s] after which no part of the body is faster than `speed` [m/s].
    pub fn watch(&mut self, world: &mut World, id: BodyId, speed: f64, dt: f64) {
        let before = self.factor;
        self.adapt(speed, dt, || is_pressed_in(world, id));
        let change = self.factor / before;
        if change == 1.0 {
            return;
        }
        // A factor of two changes no digit, so that a body gets back the very mass it had.
        let MassData { mass, center, inertia } = world.body_mass_data(id).expect(SOUND);
        let [x, y, z] = [inertia.cx.x, inertia.cy.y, inertia.cz.z].map(|moment| change * moment);
        if x.max(y).max(z) > LARGEST_MOMENT {
            self.factor = before;
            return;
        }
        let inertia =
            Matrix3 { cx: Vec3::new(x, 0.0, 0.0), cy: Vec3::new(0.0, y, 0.0), cz: Vec3::new(0.0, 0.0, z) };
        world.set_body_mass_data(id, MassData { mass: change * mass, center, inertia }).expect(SOUND);
    }

    fn adapt(&mut self, speed: f64, dt: f64, is_pressed_in: impl FnOnce() -> bool) {
        if speed > FAST {
            *self = Self::NONE;
            return;
        }
        self.wait -= dt;
        if self.wait > 0.0 || speed > SLOW {
            return;
        }
        self.wait = PERIOD;
        if self.factor < MOST && is_pressed_in() {
            self.factor *= 2.0;
        }
    }
}

/// Whether a body is deep in a heavier one.
fn is_pressed_in(world: &World, id: BodyId) -> bool {
    let mass = |id: BodyId| world.body_mass(id).expect(SOUND);
    let own = mass(id);
    world.body_contacts(id).expect(SOUND).iter().any(|contact| {
        let points = contact.manifolds.iter().flat_map(|manifold| manifold.points());
        let separation = points.map(|point| point.separation).fold(0.0, f32::min);
        f64::from(separation) < -DEPTH && {
            let bodies = [contact.shape_id_a, contact.shape_id_b].map(|shape| world.shape_body(shape));
            // What does not move has no mass.
            bodies.into_iter().all(|body| {
                let body = body.expect(SOUND);
                body == id || mass(body) == 0.0 || mass(body) > own
            })
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_body_bears_more_while_it_is_pressed_in_and_has_its_own_mass_once_it_moves() {
        let mut bearing = Bearing::NONE;
        let mut after = |speed: f64, dt: f64, deep: Option<bool>| {
            bearing.adapt(speed, dt, || deep.expect("its contacts are not looked at"));
            bearing.factor
        };
        assert_eq!(after(0.0, 0.5 * PERIOD, None), 1.0);
        assert_eq!(after(0.0, PERIOD, Some(true)), 2.0);
        assert_eq!(after(0.0, 0.5 * PERIOD, None), 2.0);
        assert_eq!(after(0.0, PERIOD, Some(true)), 4.0);
        assert_eq!(after(0.0, PERIOD, Some(false)), 4.0);
        // Too fast to lie under anything, and so fast that it has come free.
        assert_eq!(after(0.9 * FAST, PERIOD, None), 4.0);
        assert_eq!(after(1.1 * FAST, PERIOD, None), 1.0);
        for _ in 0..30 {
            after(0.0, PERIOD, Some(true));
        }
        assert_eq!(bearing.factor, MOST);
    }
}
