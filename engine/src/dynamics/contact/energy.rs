//! What contacts must not do: give energy.
//!
//! Box3D goes over the contacts a fixed number of times and starts with the impulses of the step before. Where a heavy body
//! has struck a light one on the ground, those are far too large by then, and a few passes do not take them back: the heavy
//! one was seen to be thrown up at twice the speed it came with. A box that strikes the ground fast and spinning may gain as
//! well. So the energy of all bodies together is compared with what it was before the step. If it has risen, all that contacts
//! have done to velocities in that step is taken back in part: as much as it takes. What two bodies do to each other stays
//! equal and opposite.

use glam::{DQuat, DVec3};

use crate::dynamics::{GRAVITY, RigidBody};

/// Places and velocities are single numbers: each is off by this part of itself, and energies by about as much.
const ROUNDING: f64 = 1.0 / (1 << 24) as f64;

/// A body's mass and moments of inertia, and what was known of it when it was last looked at.
#[derive(Debug, Clone, Copy, Default)]
pub struct Energy {
    mass: f64,
    moments: DVec3,
    velocity: DVec3,
    /// Angular momentum in the world [kg m²/s].
    turn: DVec3,
    /// Kinetic energy and that of its height [J].
    whole: f64,
}

/// What a step has done to a body.
#[derive(Debug, Clone, Copy)]
pub struct Change {
    /// Energy that it has gained [J]; less than nothing where it lost.
    pub gain: f64,
    /// What rounding alone may make of that [J].
    pub rounding: f64,
    /// By how much contacts have changed its velocity [m/s] and its angular velocity [rad/s]; not by how much a body that
    /// turns freely changes that itself.
    pub push: (DVec3, DVec3),
    /// The kinetic energy of the push alone, and half its product with the body's velocities, weighed with mass and
    /// moments [J]: without the part s of the push the body has s (2 `along` − s `alone`) less.
    pub alone: f64,
    /// See above.
    pub along: f64,
}

impl Energy {
    /// That of a body of this mass and these moments, which has not been looked at.
    pub fn of(state: &RigidBody) -> Self {
        let moment = |inverse: f64| if inverse > 0.0 { 1.0 / inverse } else { 0.0 };
        let moments = DVec3::from_array(state.inverse_moments.to_array().map(moment));
        Self { mass: 1.0 / state.inverse_mass, moments, ..Self::default() }
    }

    /// Takes in how a body is now, after it could fall for `dt` [s]. `place` is about the middle of the scene [m].
    pub fn look(&mut self, place: DVec3, rotation: DQuat, velocity: DVec3, spin: DVec3, dt: f64) -> Change {
        let kinetic = self.product(rotation, (velocity, spin), (velocity, spin));
        let weight = self.mass * GRAVITY;
        let whole = kinetic + weight * place.y;
        let turn = rotation * (self.moments * (rotation.conjugate() * spin));
        let push =
            (velocity - self.velocity + DVec3::Y * GRAVITY * dt, self.spin(rotation, turn - self.turn));
        let change = Change {
            gain: whole - self.whole,
            rounding: ROUNDING * (2.0 * kinetic + weight * place.y.abs()),
            push,
            alone: self.product(rotation, push, push),
            along: self.product(rotation, (velocity, spin), push),
        };
        (self.velocity, self.turn, self.whole) = (velocity, turn, whole);
        change
    }

    /// Takes back a part of what a step has done to a body that is turned like this. Returns the velocities that it has then.
    pub fn take_back(&mut self, rotation: DQuat, change: &Change, part: f64) -> (DVec3, DVec3) {
        let own = rotation.conjugate() * change.push.1;
        self.velocity -= part * change.push.0;
        self.turn -= part * (rotation * (self.moments * own));
        self.whole -= part * (2.0 * change.along - part * change.alone);
        (self.velocity, self.spin(rotation, self.turn))
    }

    /// Takes in that a body was lifted by this much, not by contacts [m].
    pub fn lift(&mut self, height: f64) {
        self.whole += self.mass * GRAVITY * height;
    }

    /// Angular velocity [rad/s] of a body with this angular momentum in the world [kg m²/s].
    fn spin(&self, rotation: DQuat, turn: DVec3) -> DVec3 {
        let own = rotation.conjugate() * turn;
        let along = |i: usize| if self.moments[i] > 0.0 { own[i] / self.moments[i] } else { 0.0 };
        rotation * DVec3::new(along(0), along(1), along(2))
    }

    /// Half the product of two pairs of velocities and angular velocities, weighed with mass and moments: the kinetic
    /// energy where they are the same [J].
    fn product(&self, rotation: DQuat, one: (DVec3, DVec3), other: (DVec3, DVec3)) -> f64 {
        let own = |spin: DVec3| rotation.conjugate() * spin;
        0.5 * (self.mass * one.0.dot(other.0) + own(one.1).dot(self.moments * own(other.1)))
    }
}

/// Which part of all pushes of a step is to be taken back so that all bodies together have no more energy than before, or
/// as little as that leaves.
pub fn part_to_take_back(changes: impl Iterator<Item = Change>) -> f64 {
    let (mut gain, mut along, mut alone, mut rounding) = (0.0, 0.0, 0.0, 0.0);
    for change in changes {
        gain += change.gain;
        along += change.along;
        alone += change.alone;
        rounding += change.rounding;
    }
    if gain.is_nan() || gain <= rounding {
        return 0.0;
    }
    let square = along * along - alone * gain;
    let part = if square > 0.0 { gain / (along + libm::sqrt(square)) } else { along / alone };
    if part.is_finite() { part.clamp(0.0, 1.0) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// A top without contacts, 0.1 s later: it has fallen, and precessed by Euler's equations in small steps.
    #[test]
    fn what_falls_and_turns_freely_gains_nothing_and_is_not_pushed() {
        let moments = DVec3::new(0.1, 0.2, 0.25);
        let mut energy = Energy { mass: 2.0, moments, ..Energy::default() };
        let (mut rotation, mut own) = (DQuat::from_rotation_x(0.3), DVec3::new(8.0, 9.0, 10.0));
        let (v, t) = (DVec3::new(1.0, -2.0, 0.0), 0.1);
        energy.look(DVec3::Y, rotation, v, rotation * own, 0.0);
        for _ in 0..100_000 {
            let h = t / 1e5;
            let rate = |w: DVec3| (moments * w).cross(w) / moments;
            let middle = own + 0.5 * h * rate(own);
            own += h * rate(middle);
            rotation = (rotation * DQuat::from_scaled_axis(h * middle)).normalize();
        }
        let position = DVec3::Y + v * t - DVec3::Y * 0.5 * GRAVITY * t * t;
        let fallen = v - DVec3::Y * GRAVITY * t;
        let change = energy.look(position, rotation, fallen, rotation * own, t);
        // Beside 30 J and 10 rad/s; the small steps are of second order.
        assert!(change.gain.abs() < 1e-6, "{change:?}");
        assert!(change.push.0.length() < 1e-12 && change.push.1.length() < 1e-6, "{change:?}");
        let kinetic = fallen.length_squared() + 0.5 * own.dot(moments * own);
        assert!((energy.whole - kinetic - 2.0 * GRAVITY * position.y).abs() < 1e-9, "{energy:?} {kinetic}");
    }

    /// A ball that comes down at 1 m/s and is thrown up at 2 comes up at 1; how it moves across does not matter.
    #[test]
    fn a_ball_goes_up_as_fast_as_it_came_down() {
        let mut energy = Energy { mass: 2.0, moments: DVec3::splat(0.1), ..Energy::default() };
        let turn = DQuat::IDENTITY;
        let across = DVec3::X * 3.0;
        energy.look(DVec3::ZERO, turn, across - DVec3::Y, DVec3::ZERO, 0.0);
        let change = energy.look(DVec3::ZERO, turn, across + DVec3::Y * 2.0, DVec3::ZERO, 0.0);
        assert!((change.gain - 3.0).abs() < 1e-12, "{change:?}");
        let (velocity, spin) = energy.take_back(turn, &change, part_to_take_back([change].into_iter()));
        assert!(velocity.distance(across + DVec3::Y) < 1e-12 && spin == DVec3::ZERO, "{velocity}");
        let next = energy.look(DVec3::ZERO, turn, velocity, spin, 0.0);
        assert!(next.gain.abs() < 1e-12, "{next:?}");
        assert_eq!(part_to_take_back([next].into_iter()), 0.0);
        assert_eq!(part_to_take_back(std::iter::empty()), 0.0);
    }

    proptest! {
        /// Two bodies that push each other, with a gain: after it none is left, and their momentum is what it was.
        #[test]
        fn a_collision_that_gains_loses_its_gain_and_no_momentum(
            masses in prop::array::uniform2(0.01..100.0_f64),
            velocities in prop::array::uniform2(prop::array::uniform3(-5.0..5.0_f64)),
            spins in prop::array::uniform2(prop::array::uniform3(-5.0..5.0_f64)),
            blow in prop::array::uniform3(-50.0..50.0_f64),
        ) {
            let before: Vec<DVec3> = velocities.into_iter().map(DVec3::from).collect();
            let mut bodies =
                masses.map(|mass| Energy { mass, moments: DVec3::new(0.1, 0.2, 0.3) * mass, ..Energy::default() });
            let turn = DQuat::from_rotation_x(1.0);
            let blows = [DVec3::from(blow), -DVec3::from(blow)];
            let changes: Vec<Change> = (0..2).map(|k| {
                let spin = DVec3::from(spins[k]);
                bodies[k].look(DVec3::ZERO, turn, before[k], spin, 0.0);
                bodies[k].look(DVec3::ZERO, turn, before[k] + blows[k] / masses[k], 1.1 * spin, 0.0)
            }).collect();
            let gain: f64 = changes.iter().map(|change| change.gain).sum();
            let part = part_to_take_back(changes.iter().copied());
            if gain <= 0.0 {
                prop_assert_eq!(part, 0.0);
            }
            prop_assume!(part > 0.0);
            let wholes = |bodies: &[Energy]| bodies.iter().map(|body| body.whole).sum::<f64>();
            let start = wholes(&bodies) - gain;
            let after: Vec<DVec3> = (0..2).map(|k| bodies[k].take_back(turn, &changes[k], part).0).collect();
            let momentum = |velocities: &[DVec3]| masses[0] * velocities[0] + masses[1] * velocities[1];
            prop_assert!(momentum(&after).distance(momentum(&before)) < 1e-9);
            prop_assert!((wholes(&bodies) - start).abs() < 1e-6 * start.abs().max(1.0));
        }
    }
}
