//! A level plane that bodies fall on, bounce off, slide over and come to rest on.
//!
//! Bodies meet the plane one by one, not each other. The impulses at the touching corners are found by a few
//! sweeps with Coulomb friction, in each of which all corners act at once and share the work: no corner comes
//! first, so that a mirrored body lands as its mirror image.

use glam::DVec3;

use super::RigidBody;

/// The ground: a plane at a height, with its friction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ground {
    /// Height of the plane [m].
    pub height: f64,
    /// Coefficient of friction of the ground.
    pub friction: f64,
}

/// Share of the approach speed that a bounce gives back, for stone on stone.
const RESTITUTION: f64 = 0.2;
/// Below this approach speed nothing bounces [m/s].
const BOUNCE_SPEED: f64 = 0.3;
/// Corners within this height above the plane count as touching when a body comes to rest [m].
const TOUCH: f64 = 2e-3;
const SWEEPS: usize = 16;
/// A body that moves slower than this on three corners is as good as still [m/s].
const CALM_SPEED: f64 = 0.05;
/// How long a body must be calm to be at rest [s].
pub const CALM_TIME: f64 = 0.1;

/// Friction between two surfaces: the geometric mean of their coefficients.
pub fn joint_friction(a: f64, b: f64) -> f64 {
    libm::sqrt(a * b)
}

impl Ground {
    /// Whether a body can touch the ground at all.
    #[inline]
    pub fn is_near(&self, body: &RigidBody) -> bool {
        body.position.y - body.reach < self.height + TOUCH
    }

    /// Resolves the contact of a body that has just moved; `corners` are its outermost points in principal axes
    /// relative to the centre of mass [m]. Returns whether it lies calmly on three corners or more.
    pub fn meet(&self, body: &mut RigidBody, corners: &[DVec3], friction: f64) -> bool {
        let offset = |body: &RigidBody, corner: DVec3| body.world_from_principal * corner;
        let clearance =
            |body: &RigidBody, corner: DVec3| body.position.y + offset(body, corner).y - self.height;
        let lowest = corners.iter().map(|&c| clearance(body, c)).fold(f64::INFINITY, f64::min);
        if lowest > TOUCH {
            return false;
        }
        if lowest < 0.0 {
            let arriving = corners
                .iter()
                .filter(|&&c| clearance(body, c) < 0.0)
                .map(|&c| -body.velocity_at(offset(body, c)).y)
                .fold(0.0, f64::max);
            let bounce = if arriving > BOUNCE_SPEED { RESTITUTION } else { 0.0 };
            let reached = TOUCH.min(-0.5 * lowest);
            for sweep in 0..SWEEPS {
                let restitution = if sweep == 0 { bounce } else { 0.0 };
                let still = *body;
                let approaching = |c: &DVec3| {
                    clearance(&still, *c) < reached && still.velocity_at(offset(&still, *c)).y < 0.0
                };
                let count = corners.iter().filter(|c| approaching(c)).count();
                if count == 0 {
                    break;
                }
                for corner in corners.iter().filter(|c| approaching(c)) {
                    let at = offset(&still, *corner);
                    body.push_at(stopping(&still, at, friction, restitution) / count as f64, at);
                }
            }
            body.position.y -= lowest;
        }
        let touching = corners.iter().filter(|&&c| clearance(body, c) < TOUCH).count();
        let rim = body.angular_velocity().length() * body.reach;
        touching >= 3 && body.velocity.length().max(rim) < CALM_SPEED
    }
}

/// The impulse that stops the approach of one corner, with friction up to the cone [N s].
fn stopping(body: &RigidBody, offset: DVec3, friction: f64, restitution: f64) -> DVec3 {
    let velocity = body.velocity_at(offset);
    let normal = -(1.0 + restitution) * velocity.y / mobility(body, offset, DVec3::Y);
    let sliding = velocity.with_y(0.0);
    let speed = sliding.length();
    if speed == 0.0 {
        return DVec3::Y * normal;
    }
    let along = sliding / speed;
    let stop = speed / mobility(body, offset, along);
    DVec3::Y * normal - along * stop.min(friction * normal)
}

/// Velocity that a unit impulse along `direction` at `offset` gives that point [1/kg].
fn mobility(body: &RigidBody, offset: DVec3, direction: DVec3) -> f64 {
    let arm = body.world_from_principal.conjugate() * offset.cross(direction);
    body.inverse_mass + (arm * arm * body.inverse_moments).element_sum()
}
