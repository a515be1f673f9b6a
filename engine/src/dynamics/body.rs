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
    #[inline]
    pub fn fly(&mut self, air: Air, dt: f64) {
        let before = self.velocity;
        let half_fall = DVec3::new(0.0, -0.5 * GRAVITY * dt, 0.0);
        let falling = before + half_fall;
        let slowed = self.resistance.carry(
            falling,
            self.world_from_principal,
            self.inverse_mass,
            DVec3::ZERO,
            air.density,
            air.damping,
            dt,
        );
        self.velocity = slowed + half_fall;
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
                self.inverse_mass,
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
    #[inline]
    pub fn turn(&mut self, dt: f64) {
        let mut momentum = self.angular_momentum;
        if momentum == DVec3::ZERO {
            return;
        }
        let rate = self.inverse_moments * (0.5 * dt);
        let mut q = self.world_from_principal;
        let half = rate * 0.5;
        turn_about(0, half.x * momentum.x, &mut momentum, &mut q);
        turn_about(1, half.y * momentum.y, &mut momentum, &mut q);
        turn_about(2, rate.z * momentum.z, &mut momentum, &mut q);
        turn_about(1, half.y * momentum.y, &mut momentum, &mut q);
        turn_about(0, half.x * momentum.x, &mut momentum, &mut q);
        self.angular_momentum = momentum;
        self.world_from_principal = q.normalize();
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
    let (n, d) = tangent(half_angle);
    let scale = 1.0 / (d * d + n * n);
    let (cos, sin) = ((d * d - n * n) * scale, 2.0 * n * d * scale);
    let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
    let (a, b) = (momentum[j], momentum[k]);
    // The body turns one way, so its momentum, fixed in space, turns the other way in its axes.
    momentum[j] = cos * a + sin * b;
    momentum[k] = cos * b - sin * a;
    let v = [q.x, q.y, q.z];
    let mut turned = v;
    turned[axis] = d * v[axis] + n * q.w;
    turned[j] = d * v[j] + n * v[k];
    turned[k] = d * v[k] - n * v[j];
    *q = DQuat::from_xyzw(turned[0], turned[1], turned[2], d * q.w - n * v[axis]);
}

/// tan x as a fraction: a Padé approximant good to 3e-6 for |x| < 1, which is up to 2 rad of turn a step.
#[inline(always)]
fn tangent(x: f64) -> (f64, f64) {
    let square = x * x;
    if square < 1.0 { (x * (1.0 - square / 15.0), 1.0 - 0.4 * square) } else { (libm::sin(x), libm::cos(x)) }
}
