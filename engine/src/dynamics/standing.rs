//! A body in its place: held by friction until the load exceeds it, then sliding, then free.
//!
//! Friction is Coulomb's, in impulses over a step: what would move the body against what carries it is used up
//! first by up to `μ N dt`. This makes the threshold and the slowing of a sliding body the same for any step. N is
//! the body's own weight and all that stands on it, so low bricks resist more (thesis 3.6, Fig. 3.7). Bricks that
//! are pushed out together do not rub on each other, and what rubs is carried along: the friction acts back on
//! the carrier one step later.

use glam::{DQuat, DVec3};

use super::{Carry, RigidBody};

/// A body tilted by more than this stands no longer: cos 5°.
const TILT: f64 = 0.996_194_698_091_745_5;

/// The place in which a body stands.
#[derive(Debug, Clone, Copy)]
pub struct Place {
    /// Where its centre of mass was when it last stood still [m].
    pub origin: DVec3,
    /// Its rotation then.
    pub world_from_principal: DQuat,
    /// How far it may slide before it has left its support: half its smaller extent seen from above [m].
    pub margin: f64,
    /// Coefficient of friction.
    pub friction: f64,
    /// Lever arm of friction against twisting and tipping: a quarter of that extent [m].
    pub grip: f64,
}

/// What came of a step in place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// It stands still.
    Holds,
    /// It moves, but is still carried.
    Slides,
    /// It has been lifted, tipped or pushed off.
    Leaves,
}

impl Place {
    /// The place in which a body stands now, with its extent seen from above.
    pub fn new(body: &RigidBody, smaller_extent: f64, friction: f64) -> Self {
        Self {
            origin: body.position,
            world_from_principal: body.world_from_principal,
            margin: 0.5 * smaller_extent,
            friction,
            grip: 0.25 * smaller_extent,
        }
    }

    /// Finishes a step of `dt` for a body whose loads have been applied to its velocity and angular momentum;
    /// `before` is its velocity at the start of the step. Returns what came of it and the impulse of friction [N s].
    pub fn resist(&self, body: &mut RigidBody, before: DVec3, carry: &Carry, dt: f64) -> (Outcome, DVec3) {
        let weight = carry.normal_force * dt;
        body.velocity += carry.reaction * body.inverse_mass;
        let upward = body.velocity.y / body.inverse_mass;
        if upward > weight {
            body.velocity.y -= weight * body.inverse_mass;
            return (self.advance(body, before, dt, Outcome::Leaves), DVec3::ZERO);
        }
        body.velocity.y = 0.0;
        let grip = self.friction * (weight - upward);
        let pushed = body.velocity;
        body.velocity = carry.velocity + shortened(pushed - carry.velocity, grip * body.inverse_mass);
        let rubbed = (body.velocity - pushed) / body.inverse_mass;
        body.angular_momentum = shortened(body.angular_momentum, grip * self.grip);
        let turns = body.angular_momentum * body.inverse_moments != DVec3::ZERO;
        let moves = turns || body.velocity != DVec3::ZERO;
        if !moves {
            body.angular_momentum = DVec3::ZERO;
        }
        let outcome = if moves { Outcome::Slides } else { Outcome::Holds };
        (self.advance(body, before, dt, outcome), rubbed)
    }

    fn advance(&self, body: &mut RigidBody, before: DVec3, dt: f64, outcome: Outcome) -> Outcome {
        body.position += (before + body.velocity) * (0.5 * dt);
        if body.angular_momentum != DVec3::ZERO {
            body.turn(dt);
        }
        if self.is_left(body) { Outcome::Leaves } else { outcome }
    }

    /// Whether a body has been pushed off its support or tipped.
    pub fn is_left(&self, body: &RigidBody) -> bool {
        let up = body.world_from_principal * (self.world_from_principal.conjugate() * DVec3::Y);
        body.position.distance_squared(self.origin) > self.margin * self.margin || up.y < TILT
    }
}

/// The vector made shorter by `length`, or zero.
fn shortened(v: DVec3, length: f64) -> DVec3 {
    let size = v.length();
    if size <= length { DVec3::ZERO } else { v * (1.0 - length / size) }
}
