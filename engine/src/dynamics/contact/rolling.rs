//! Rolling resistance of what lies on something.
//!
//! A shard that stands on a rim of many corners rocks on it like a rocking chair, and the library takes nothing from that:
//! it was seen to go on for ten seconds. What has been slow for a while lies on something, since it does not fall, and its
//! turn is damped until it is faster again.

use boxddd::{BodyId, World};

use super::SOUND;

/// A body that has been slower than this [m/s] for [`DELAY`] lies on something.
const SLOW: f64 = 0.3;
/// See [`SLOW`] [s].
const DELAY: f64 = 0.2;
/// The part of its turn that it loses in a second, as a rate [1/s]: what rocks has half its swing after half a second. What
/// begins to tip over does so later by a few tenths of a second.
const DAMPING: f32 = 3.0;

/// Whether one body's turn is damped.
#[derive(Debug, Clone, Copy, Default)]
pub struct Rolling {
    /// For how long it has been slow [s].
    time: f64,
    damped: bool,
}

impl Rolling {
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
