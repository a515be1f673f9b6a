//! Drag and lift: the blast wind while it blows, air resistance when the air is still.
//!
//! One formula serves both, because both are the air's flow relative to the body:
//! `F = ½ ρ C_D A |u − v| (u − v)` (thesis 2.32 for v = 0, 2.39 and 3.2 for u = 0). Taking the body's own
//! velocity off the wind cures the over-estimate for small fast pieces that thesis 3.5.3 admits.

use glam::{DQuat, DVec3};

use crate::air::Air;
use crate::blast::pulse::integrate_poly_exp;
use crate::blast::{BlastPoint, Pulse};

/// The wind of one charge at one place: it follows the overpressure's own shape in time.
///
/// With φ(t) the overpressure over its peak, the gas moves with `u_s φ` and has the density
/// `ρ0 + (ρ_s − ρ0) φ`; both are exact at the front and exact for weak waves. In the negative phase the gas
/// flows back with the acoustic velocity `p / (ρ0 a0)`.
#[derive(Debug, Clone, Copy)]
pub struct Wind {
    /// When the front arrives [s].
    pub arrival: f64,
    /// When the air is still again [s].
    pub end: f64,
    /// Factor on every force from this charge.
    pub gain: f64,
    pulse: Pulse,
    direction: DVec3,
    dynamic_pressure: f64,
    density_excess: f64,
    ambient_density: f64,
    /// ρ0 a0 [Pa s/m].
    impedance: f64,
}

impl Wind {
    /// The wind at a point of the field whose overpressure follows `pulse`.
    pub fn new(point: &BlastPoint, pulse: Pulse, air: &Air, gain: f64) -> Self {
        let suction = pulse.negative.map_or(0.0, |phase| phase.duration);
        Self {
            arrival: point.arrival_time,
            end: point.arrival_time + pulse.duration + suction,
            gain,
            pulse,
            direction: point.direction,
            dynamic_pressure: point.dynamic_pressure,
            density_excess: point.density - air.density(),
            ambient_density: air.density(),
            impedance: air.density() * air.sound_speed(),
        }
    }

    /// The next time after `t` at which this wind starts, turns or ends; infinite when it is over.
    pub fn next_change(&self, t: f64) -> f64 {
        [self.arrival, self.arrival + self.pulse.duration, self.end]
            .into_iter()
            .find(|&change| change > t)
            .unwrap_or(f64::INFINITY)
    }

    /// Wind that blows steadily from `t0` to `t1` in place of the true one: velocity [m/s] and density above
    /// the ambient one [kg/m³].
    ///
    /// The velocity is the one whose dynamic pressure has the true impulse over the interval, so that what a
    /// slow body receives does not depend on the step. The interval must not straddle a
    /// [`next_change`](Self::next_change).
    pub fn steady(&self, t0: f64, t1: f64) -> (DVec3, f64) {
        let length = t1 - t0;
        if length <= 0.0 || t0 < self.arrival || t1 > self.end {
            return (DVec3::ZERO, 0.0);
        }
        let (since, until) = (t0 - self.arrival, t1 - self.arrival);
        let duration = self.pulse.duration;
        if t0 >= self.arrival + duration {
            let speed = self.pulse.impulse(since, until) / length / self.impedance;
            return (self.direction * speed, 0.0);
        }
        let (x0, x1) = (since / duration, (until / duration).min(1.0));
        let mean = |moment: f64| moment / (x1 - x0);
        let b = self.pulse.decay;
        let first = mean(integrate_poly_exp([1.0, -1.0], b, x0, x1));
        let second = mean(integrate_poly_exp([1.0, -2.0, 1.0], 2.0 * b, x0, x1));
        let third = mean(integrate_poly_exp([1.0, -3.0, 3.0, -1.0], 3.0 * b, x0, x1));
        let excess = self.density_excess * first;
        let compressed = self.density_excess / (self.density_excess + self.ambient_density);
        let pressure = self.dynamic_pressure * ((1.0 - compressed) * second + compressed * third);
        let speed = libm::sqrt(2.0 * pressure.max(0.0) / (self.ambient_density + excess));
        (self.direction * speed, excess)
    }
}

/// How a body resists flow: its drag and, for plate-like pieces, its lift.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resistance {
    /// ½ C_D A_i / m along the body's three principal axes [m²/kg], with A_i its area projected along the axis.
    ///
    /// Along any other direction ŵ the projected area is that of the ellipsoid with the same three,
    /// `√Σ(A_i ŵ_i)²`: exact along the axes; a box seen corner-on has up to 1.7 times as much, but its
    /// drag coefficient is then about 0.8 instead of 1.05, which takes back part of it.
    pub drag: DVec3,
    /// ½ C_L A_3 / m of a plate across the third principal axis, the one about which the body turns most sluggishly
    /// [m²/kg]; 0 without lift.
    ///
    /// Lift (thesis 2.38) is normal to the flow, in the plane of flow and plate normal:
    /// `F_L = ½ ρ |w|² C_L A sin α cos α` at the angle of attack α. It is the part across the flow of a pressure force
    /// along the plate's normal, as on a flat plate with separated flow.
    pub lift: f64,
}

/// A piece whose projected area along its third axis is this many times the others is a plate: "a diameter several
/// times greater than their thickness" (thesis 2.9).
const PLATE_RATIO: f64 = 4.0;

impl Resistance {
    /// Resistance of a body of `mass` [kg] with the given areas [m²], projected along its principal axes.
    ///
    /// `lift_coefficient` left out means C_L = C_D for a plate and none for a chunky piece; a given coefficient applies
    /// to either.
    pub fn new(areas: DVec3, drag_coefficient: f64, lift_coefficient: Option<f64>, mass: f64) -> Self {
        let plate = areas.z >= PLATE_RATIO * areas.x.max(areas.y);
        let lift_coefficient = lift_coefficient.unwrap_or(if plate { drag_coefficient } else { 0.0 });
        let per_area = 0.5 / mass;
        Self { drag: areas * (drag_coefficient * per_area), lift: areas.z * lift_coefficient * per_area }
    }

    /// Velocity after `dt` in a steady flow `wind` of density `density`, from `velocity`.
    ///
    /// `damping` multiplies drag where it slows the body down (thesis 6.5).
    pub fn carry(
        &self,
        velocity: DVec3,
        world_from_principal: DQuat,
        wind: DVec3,
        density: f64,
        damping: f64,
        dt: f64,
    ) -> DVec3 {
        let relative = wind - velocity;
        let slowing = if relative.dot(velocity) < 0.0 { damping } else { 1.0 };
        wind - self.pass::<true>(relative, world_from_principal, density * dt, slowing)
    }

    /// What is left of the relative flow `w` [m/s] once the air has passed for a while: `exposure` is its density
    /// times that while [kg s/m³], `slowing` multiplies the drag.
    ///
    /// The drag is solved exactly, `w(t) = w0 / (1 + k |w0| t)`, so that no step is too long for a light shard; the
    /// lift turns w without changing its length. `LIFT` may be false where no body has any: the result is the same to
    /// the last bit. No branch depends on the body, so that a compiler can do several at once.
    #[inline(always)]
    pub fn pass<const LIFT: bool>(
        &self,
        w: DVec3,
        world_from_principal: DQuat,
        exposure: f64,
        slowing: f64,
    ) -> DVec3 {
        let rate = (self.drag * into_body(world_from_principal, w)).length_squared().sqrt();
        let slowed = w * (1.0 / (1.0 + exposure * slowing * rate));
        if LIFT { self.lifted(slowed, world_from_principal, exposure) } else { slowed }
    }

    /// Turns the relative flow `w` by one step of lift.
    #[inline(always)]
    fn lifted(&self, w: DVec3, world_from_principal: DQuat, exposure: f64) -> DVec3 {
        let normal = third_axis(world_from_principal);
        let across = w.dot(normal);
        let squared = w.length_squared();
        // Still air has no direction; the smallest number keeps it from dividing zero by zero.
        let inverse = 1.0 / (squared + f64::MIN_POSITIVE).sqrt();
        let sin = across * inverse;
        let push = exposure * self.lift * across;
        let sideways = if sin * sin < 1.0 { 1.0 - sin * sin } else { 0.0 };
        let turned = w * (1.0 + push * sin) - normal * (push * squared * inverse);
        let kept = turned * (1.0 / (1.0 + push * push * sideways).sqrt());
        if self.lift > 0.0 { kept } else { w }
    }
}

/// A vector of the world in the body's axes.
#[inline(always)]
fn into_body(world_from_principal: DQuat, v: DVec3) -> DVec3 {
    let q = world_from_principal;
    let axis = DVec3::new(q.x, q.y, q.z);
    let twice = v.cross(axis) * 2.0;
    v + twice * q.w + twice.cross(axis)
}

/// The body's third axis in the world.
#[inline(always)]
fn third_axis(world_from_principal: DQuat) -> DVec3 {
    let q = world_from_principal;
    DVec3::new(
        2.0 * (q.x * q.z + q.w * q.y),
        2.0 * (q.y * q.z - q.w * q.x),
        1.0 - 2.0 * (q.x * q.x + q.y * q.y),
    )
}
