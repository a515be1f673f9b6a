//! One rigid body and its flight.

use glam::{DQuat, DVec3};

use super::GRAVITY;
use crate::loading::{Resistance, Wind};

/// State of a rigid body, about its centre of mass and in its principal axes.
///
/// The angular momentum, not the angular velocity, is the state: without torque it stays constant in space,
/// and the integrator keeps it so exactly.
#[derive(Debug, Clone, Copy)]
pub struct RigidBody {
    /// Centre of mass in the world [m].
    pub position: DVec3,
    /// Rotation from principal axes into the world.
    pub world_from_principal: DQuat,
    /// Velocity of the centre of mass [m/s].
    pub velocity: DVec3,
    /// Angular momentum in principal axes [kg m²/s].
    pub angular_momentum: DVec3,
    /// 1 / mass [1/kg].
    pub inverse_mass: f64,
    /// 1 / moments of inertia about the principal axes [1/(kg m²)]; zero for a body that may not rotate.
    pub inverse_moments: DVec3,
    /// How the body resists the air.
    pub resistance: Resistance,
    /// Distance of its farthest point from the centre of mass [m].
    pub reach: f64,
}

/// The winds that reach one body, and the still air they blow through.
#[derive(Debug, Clone, Copy)]
pub struct Winds<'a> {
    /// One a charge; empty where the wind acts on panels instead.
    pub winds: &'a [Wind],
    /// Still air.
    pub air: Air,
}

/// What a flying body feels of the still air.
#[derive(Debug, Clone, Copy)]
pub struct Air {
    /// Density [kg/m³].
    pub density: f64,
    /// Art direction: multiplies drag where it slows a body down (thesis 6.5).
    pub damping: f64,
}

impl RigidBody {
    /// Angular velocity in the world [rad/s].
    pub fn angular_velocity(&self) -> DVec3 {
        self.world_from_principal * (self.angular_momentum * self.inverse_moments)
    }

    /// Kinetic energy of translation and rotation [J].
    pub fn kinetic_energy(&self) -> f64 {
        let spin = self.angular_momentum * self.angular_momentum * self.inverse_moments;
        0.5 * (self.velocity.length_squared() / self.inverse_mass + spin.element_sum())
    }

    /// Takes an impulse [N s] and an angular impulse [N m s], both in principal axes.
    pub fn push(&mut self, impulse: DVec3, angular_impulse: DVec3) {
        self.velocity += self.world_from_principal * impulse * self.inverse_mass;
        self.angular_momentum += angular_impulse;
    }

    /// A free step through still air: gravity, drag, lift, rotation.
    ///
    /// Second order in `dt`: half of gravity, the exact drag, the other half; the position moves with the mean
    /// of the two velocities, as in the thesis (3.5.2).
    pub fn fly(&mut self, air: Air, dt: f64) {
        if self.resistance.lift > 0.0 { self.glide::<true>(air, dt) } else { self.glide::<false>(air, dt) }
    }

    /// The free step with the lift of a plate, or without. The same for one body and for several in a block.
    #[inline(always)]
    pub(super) fn glide<const LIFT: bool>(&mut self, air: Air, dt: f64) {
        let before = self.velocity;
        let half_fall = DVec3::new(0.0, -0.5 * GRAVITY * dt, 0.0);
        let falling = before + half_fall;
        let flow =
            self.resistance.pass::<LIFT>(-falling, self.world_from_principal, air.density * dt, air.damping);
        self.velocity = half_fall - flow;
        self.position += (before + self.velocity) * (0.5 * dt);
        self.turn(dt);
    }

    /// Lets winds and still air act on the velocity from `t0` to `t1`; returns the impulse received while any
    /// wind blows [N s].
    pub fn blow(&mut self, winds: Winds, t0: f64, t1: f64) -> DVec3 {
        let mut impulse = DVec3::ZERO;
        let mut t = t0;
        while t < t1 {
            let next = winds.winds.iter().map(|w| w.next_change(t)).fold(t1, f64::min);
            let (flow, density, gain) = mixed(winds, t, next);
            let before = self.velocity;
            self.velocity = self.resistance.carry(
                before,
                self.world_from_principal,
                flow,
                density * gain,
                winds.air.damping,
                next - t,
            );
            if flow != DVec3::ZERO {
                impulse += (self.velocity - before) / self.inverse_mass;
            }
            t = next;
        }
        impulse
    }

    /// Turns the body for `dt` without torque.
    ///
    /// The free rigid body's Hamiltonian is split into its three axes, each of which only rotates the momentum
    /// about that axis (McLachlan 1993; Reich 1994): the step is symmetric and symplectic, so |L| stays to
    /// rounding and the kinetic energy does not drift.
    #[inline(always)]
    pub fn turn(&mut self, dt: f64) {
        let mut momentum = self.angular_momentum;
        let mut q = self.world_from_principal;
        let quarter = self.inverse_moments * (0.25 * dt);
        turn_about(0, quarter.x * momentum.x, &mut momentum, &mut q);
        turn_about(1, quarter.y * momentum.y, &mut momentum, &mut q);
        turn_about(2, 2.0 * quarter.z * momentum.z, &mut momentum, &mut q);
        turn_about(1, quarter.y * momentum.y, &mut momentum, &mut q);
        turn_about(0, quarter.x * momentum.x, &mut momentum, &mut q);
        self.angular_momentum = momentum;
        self.world_from_principal = q * (1.0 / q.length_squared().sqrt());
    }
}

/// The flow of several winds together from `t0` to `t1`: velocity, density and the gain of its force.
fn mixed(winds: Winds, t0: f64, t1: f64) -> (DVec3, f64, f64) {
    let mut flow = DVec3::ZERO;
    let mut density = winds.air.density;
    let (mut weighted_gain, mut weight) = (0.0, 0.0);
    for wind in winds.winds {
        let (velocity, excess) = wind.steady(t0, t1);
        flow += velocity;
        density += excess;
        let speed = velocity.length();
        weighted_gain += wind.gain * speed;
        weight += speed;
    }
    (flow, density, if weight > 0.0 { weighted_gain / weight } else { 1.0 })
}

/// Rotates body and momentum by twice `half_angle` about a principal axis; the quaternion is left unnormalised.
#[inline(always)]
fn turn_about(axis: usize, half_angle: f64, momentum: &mut DVec3, q: &mut DQuat) {
    let tan = tangent(half_angle);
    let sin = (tan + tan) / (1.0 + tan * tan);
    let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
    // The body turns one way, so its momentum, fixed in space, turns the other way in its axes. Three shears make
    // the rotation, with fewer operations than its sine and cosine.
    momentum[j] += tan * momentum[k];
    momentum[k] -= sin * momentum[j];
    momentum[j] += tan * momentum[k];
    let v = [q.x, q.y, q.z];
    let mut turned = v;
    turned[axis] = v[axis] + tan * q.w;
    turned[j] = v[j] + tan * v[k];
    turned[k] = v[k] - tan * v[j];
    *q = DQuat::from_xyzw(turned[0], turned[1], turned[2], q.w - tan * v[axis]);
}

/// tan x by its series, up to 2: good to 1e-5 for half a radian of turn a step, to 1e-3 for one and to 3 % for two.
///
/// Whatever it gives, the step is a rotation and keeps |L|. A body that spins faster still is blurred in any picture;
/// it turns less than it should. The bound keeps the shears from losing digits.
#[inline(always)]
fn tangent(x: f64) -> f64 {
    let square = x * x;
    let series = x * (1.0 + square * (1.0 / 3.0 + square * (2.0 / 15.0)));
    let below = if series < 2.0 { series } else { 2.0 };
    if below > -2.0 { below } else { -2.0 }
}
