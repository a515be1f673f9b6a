//! A level plane that bodies fall on, bounce off, slide over and come to rest on.
//!
//! Bodies meet the plane one by one, not each other. The impulses at the touching corners are found by a few
//! sweeps with Coulomb friction, in each of which all corners act at once and share the work: no corner comes
//! first, so that a mirrored body lands as its mirror image.

use glam::{DMat3, DVec3};

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
pub const RESTITUTION: f64 = 0.2;
/// Below this approach speed nothing bounces [m/s].
pub const BOUNCE_SPEED: f64 = 0.3;
/// Corners within this height above the plane count as touching when a body comes to rest [m].
const TOUCH: f64 = 2e-3;
/// A corner that approaches slower than this has stopped [m/s].
const STOPPED: f64 = 1e-3;
const SWEEPS: usize = 6;
/// Most corners a body may touch with.
const MOST_CORNERS: usize = 32;
/// A body that moves slower than this on three corners is as good as still [m/s].
pub const CALM_SPEED: f64 = 0.05;
/// How long a body must be calm to be at rest [s].
pub const CALM_TIME: f64 = 0.1;

/// Friction between two surfaces: the geometric mean of their coefficients.
pub fn joint_friction(a: f64, b: f64) -> f64 {
    libm::sqrt(a * b)
}

impl Ground {
    /// Whether something that reaches down to `lowest` [m] can touch the ground at all.
    #[inline]
    pub fn is_near(&self, lowest: f64) -> bool {
        lowest < self.height + TOUCH
    }

    /// Resolves the contact of a body that has just moved; `corners` are its outermost points in principal axes
    /// relative to the centre of mass [m], at most 32. Returns whether it lies calmly on three corners or more.
    pub fn meet(&self, body: &mut RigidBody, corners: &[DVec3], friction: f64) -> bool {
        let rotation = DMat3::from_quat(body.world_from_principal);
        let mut offsets = [DVec3::ZERO; MOST_CORNERS];
        let offsets = &mut offsets[..corners.len()];
        let mut lowest = f64::INFINITY;
        for (offset, &corner) in offsets.iter_mut().zip(corners) {
            *offset = rotation * corner;
            lowest = lowest.min(offset.y);
        }
        let clearance = body.position.y - self.height;
        lowest += clearance;
        if lowest > TOUCH {
            return false;
        }
        if lowest < 0.0 {
            let reached = TOUCH.min(-0.5 * lowest) - clearance;
            Impact::of(body, rotation, friction).resolve(offsets, reached, body);
            body.position.y -= lowest;
        }
        let floor = self.height + TOUCH - body.position.y;
        let touching = offsets.iter().filter(|offset| offset.y < floor).count();
        let rim = body.angular_velocity().length() * body.reach;
        touching >= 3 && body.velocity.length().max(rim) < CALM_SPEED
    }
}

/// A body while it strikes the ground, all in the world's axes.
#[derive(Clone, Copy)]
struct Impact {
    velocity: DVec3,
    spin: DVec3,
    inverse_mass: f64,
    inverse_inertia: DMat3,
    friction: f64,
}

impl Impact {
    fn of(body: &RigidBody, rotation: DMat3, friction: f64) -> Self {
        Self {
            velocity: body.velocity,
            spin: body.angular_velocity(),
            inverse_mass: body.inverse_mass,
            inverse_inertia: rotation * DMat3::from_diagonal(body.inverse_moments) * rotation.transpose(),
            friction,
        }
    }

    /// Stops the approach of all corners lower than `reached`, and hands the impulses to the body.
    fn resolve(mut self, offsets: &mut [DVec3], reached: f64, body: &mut RigidBody) {
        let mut count = 0;
        for i in 0..offsets.len() {
            if offsets[i].y < reached {
                offsets.swap(count, i);
                count += 1;
            }
        }
        let low = &offsets[..count];
        let arriving = low.iter().map(|&o| -self.velocity_at(o).y).fold(0.0, f64::max);
        let mut restitution = if arriving > BOUNCE_SPEED { RESTITUTION } else { 0.0 };
        let mut total = DVec3::ZERO;
        for _sweep in 0..SWEEPS {
            let (mut impulse, mut angular, mut pushed) = (DVec3::ZERO, DVec3::ZERO, 0.0);
            for &offset in low {
                let velocity = self.velocity_at(offset);
                if velocity.y < -STOPPED {
                    let push = self.stopping(offset, velocity, restitution);
                    impulse += push;
                    angular += offset.cross(push);
                    pushed += 1.0;
                }
            }
            if pushed == 0.0 {
                break;
            }
            self.velocity += impulse * (self.inverse_mass / pushed);
            self.spin += self.inverse_inertia * angular / pushed;
            total += angular / pushed;
            restitution = 0.0;
        }
        body.velocity = self.velocity;
        body.angular_momentum += body.world_from_principal.conjugate() * total;
    }

    fn velocity_at(&self, offset: DVec3) -> DVec3 {
        self.velocity + self.spin.cross(offset)
    }

    /// The impulse that stops the approach of one corner that moves with `velocity`, with friction up to the cone [N s].
    fn stopping(&self, offset: DVec3, velocity: DVec3, restitution: f64) -> DVec3 {
        let normal = -(1.0 + restitution) * velocity.y / self.mobility(offset, DVec3::Y);
        let sliding = velocity.with_y(0.0);
        let speed = sliding.length();
        if speed == 0.0 {
            return DVec3::Y * normal;
        }
        let along = sliding / speed;
        let stop = speed / self.mobility(offset, along);
        DVec3::Y * normal - along * stop.min(self.friction * normal)
    }

    /// Velocity that a unit impulse along `direction` at `offset` gives that point [1/kg].
    fn mobility(&self, offset: DVec3, direction: DVec3) -> f64 {
        let arm = offset.cross(direction);
        self.inverse_mass + arm.dot(self.inverse_inertia * arm)
    }
}
