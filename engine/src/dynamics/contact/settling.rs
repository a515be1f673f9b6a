//! How one body comes to lie still, and not in others: what the library leaves undone, in one place.

use boxddd::World;

use super::depenetration::Depenetration;
use super::rocking::Rocking;
use super::standstill::Standstill;
use super::studs::{self, Studs};
use super::{SOUND, Step};
use crate::dynamics::RigidBody;

/// A body that has been slower than this for some tenths of a second lies on something: what falls is faster [m/s].
pub const SLOW: f64 = 0.3;
/// A body all of which moves slower than this for half a second falls asleep [m/s].
pub const SLEEP_SPEED: f32 = 0.03;
/// The same for a body that gets nowhere, however it trembles [m/s].
const TREMOR: f32 = 1.0;

/// What is watched of a body.
#[derive(Debug, Clone)]
pub struct Settling {
    standstill: Standstill,
    rocking: Rocking,
    depenetration: Depenetration,
    /// Where it is held in others.
    pub studs: Studs,
}

/// What a step has come to.
pub struct Outcome {
    /// By how much the body has been lifted out of another [m].
    pub lift: f64,
    /// Whether it is time to look where it needs studs.
    pub look: bool,
}

impl Settling {
    /// Begins with a body as it is, of whose mass the library can hold so many times.
    pub fn new(state: &RigidBody, room: f64) -> Self {
        Self {
            standstill: Standstill::new(state.position, state.world_from_principal, state.reach),
            rocking: Rocking::default(),
            depenetration: Depenetration::up_to(room),
            studs: Studs::none(),
        }
    }

    /// Whether the body gets nowhere, however fast it trembles.
    pub fn is_still(&self) -> bool {
        self.standstill.holds()
    }

    /// How deep an edge of the body may be in another before it gets a stud [m].
    pub fn depth(&self) -> f64 {
        let rocks = self.rocking.time() > studs::LATER && !self.is_still();
        if rocks { studs::FINE } else { studs::DEPTH }
    }

    /// Takes in a step of `dt` [s].
    pub fn watch(&mut self, world: &mut World, step: &Step, dt: f64) -> Outcome {
        let id = step.id;
        let before = self.is_still();
        self.standstill.watch(step.position, step.rotation, dt);
        let still = self.is_still();
        if still != before {
            let threshold = if still { TREMOR } else { SLEEP_SPEED };
            world.set_body_sleep_threshold(id, threshold).expect(SOUND);
        }
        let speed = step.velocity.length() + step.spin.length() * self.standstill.reach();
        self.rocking.watch(world, id, speed, dt);
        let lift = self.depenetration.watch(world, id, speed, dt);
        let due = self.studs.is_due(world, id, speed, still, dt);
        if self.depenetration.is_locked() {
            self.studs.remove(world, id);
        }
        let look = !self.depenetration.is_locked() && (due || step.asleep);
        Outcome { lift, look }
    }
}
