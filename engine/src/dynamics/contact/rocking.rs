//! Angular damping of what lies on something.
//!
//! A shard that stands on a rim of many corners rocks on it like a rocking chair, and the library takes nothing from that:
//! it was seen to go on for ten seconds. What has been slow for a while lies on something, since it does not fall, and its
//! turn is damped until it is faster again.

use boxddd::{BodyId, World};

use super::SOUND;
use super::settling::SLOW;

/// For how long a body has to be slower than [`SLOW`] [s].
const DELAY: f64 = 0.4;
/// Rate at which it loses its turn [1/s]: the swing of what rocks halves in half a second. What tips over from standstill is
/// slow at first, too: it takes up to half as long again.
const DAMPING: f32 = 3.0;

/// For how long one body has been slow, and whether its turn is damped.
#[derive(Debug, Clone, Copy, Default)]
pub struct Rocking {
    time: f64,
    damped: bool,
}

impl Rocking {
    /// For how long the body has been slow [s].
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Takes in a step of `dt` [s] after which no part of the body is faster than `speed` [m/s].
    pub fn watch(&mut self, world: &mut World, id: BodyId, speed: f64, dt: f64) {
        self.time = if speed > SLOW { 0.0 } else { self.time + dt };
        let damped = self.time >= DELAY;
        if damped != self.damped {
            self.damped = damped;
            world.set_body_angular_damping(id, if damped { DAMPING } else { 0.0 }).expect(SOUND);
        }
    }
}
