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

/// All energy may rise by this part of the kinetic energy in a step [1], and by this much a kilogram [J/kg]: places and
/// velocities are single numbers.
const ROUNDING: (f64, f64) = (1e-6, 1e-7);

/// A body's mass and moments of inertia, and what was known of it when it was last looked at.
#[derive(Debug, Clone, Copy, Default)]
pub struct Energy {
    mass: f64,
    moments: DVec3,
    velocity: DVec3,
    spin: DVec3,
    /// Kinetic energy and that of its height [J].
    whole: f64,
}

/// What a step has done to a body.
#[derive(Debug, Clone, Copy)]
pub struct Change {
    /// Energy that it has gained [J]; less than nothing where it lost.
    pub gain: f64,
    /// Its kinetic energy now [J].
    pub kinetic: f64,
    /// Its mass [kg].
    pub mass: f64,
    /// By how much contacts have changed its velocity [m/s] and its angular velocity [rad/s].
    pub push: (DVec3, DVec3),
    /// The kinetic energy of the push alone, and half its product with the body's velocities, weighed with mass and
    /// moments [J]: without the part s of the push the body has s (2 `along` − s `alone`) less.
    pub alone: f64,
    /// See above.
    pub along: f64,
}

impl Energy {
    /// That of a body as it is.
    pub fn of(state: &RigidBody) -> Self {
        let moment = |inverse: f64| if inverse > 0.0 { 1.0 / inverse } else { 0.0 };
        let moments = DVec3::from_array(state.inverse_moments.to_array().map(moment));
        let mut energy = Self { mass: 1.0 / state.inverse_mass, moments, ..Self::default() };
        energy.look(
            state.position,
            state.world_from_principal,
            state.velocity,
            state.angular_velocity(),
            0.0,
        );
        energy
    }

    /// Takes in how a body is now, after it could fall for `dt` [s].
    pub fn look(
        &mut self,
        position: DVec3,
        rotation: DQuat,
        velocity: DVec3,
        spin: DVec3,
        dt: f64,
    ) -> Change {
        let kinetic = self.product(rotation, (velocity, spin), (velocity, spin));
        let whole = kinetic + self.mass * GRAVITY * position.y;
        let gain = whole - self.whole;
        let push = (velocity - self.velocity + DVec3::Y * GRAVITY * dt, spin - self.spin);
        (self.velocity, self.spin, self.whole) = (velocity, spin, whole);
        let along = self.product(rotation, (velocity, spin), push);
        Change { gain, kinetic, mass: self.mass, push, alone: self.product(rotation, push, push), along }
    }

    /// Takes back a part of what a step has done to a body. Returns the velocities that it has then.
    pub fn take_back(&mut self, change: &Change, part: f64) -> (DVec3, DVec3) {
        self.velocity -= part * change.push.0;
        self.spin -= part * change.push.1;
        self.whole -= part * (2.0 * change.along - part * change.alone);
        (self.velocity, self.spin)
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
        rounding += ROUNDING.0 * change.kinetic + ROUNDING.1 * change.mass;
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
    use crate::loading::Resistance;

    #[test]
    fn what_falls_or_spins_freely_gains_nothing() {
        let state = RigidBody {
            position: DVec3::Y,
            world_from_principal: DQuat::from_rotation_x(0.3),
            velocity: DVec3::new(1.0, -2.0, 0.0),
            angular_momentum: DVec3::new(0.1, 0.2, 0.3),
            inverse_mass: 0.5,
            inverse_moments: DVec3::new(10.0, 20.0, 0.0),
            resistance: Resistance::new(DVec3::ONE, 1.0, None, 2.0),
            reach: 1.0,
        };
        let mut energy = Energy::of(&state);
        // 0.1 s later in free fall, turned about its own axis by any angle.
        let (v, t) = (state.velocity, 0.1);
        let position = state.position + v * t - DVec3::Y * 0.5 * GRAVITY * t * t;
        let fallen = v - DVec3::Y * GRAVITY * t;
        let change = energy.look(position, state.world_from_principal, fallen, state.angular_velocity(), t);
        assert!(change.gain.abs() < 1e-12 && change.push.0.length() < 1e-12, "{change:?}");
        let own = state.angular_momentum * state.inverse_moments;
        let kinetic = fallen.length_squared() + 0.5 * own.dot(state.angular_momentum);
        assert!((change.kinetic - kinetic).abs() < 1e-12, "{change:?} {kinetic}");
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
        let (velocity, spin) = energy.take_back(&change, part_to_take_back([change].into_iter()));
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
            let blows = [DVec3::from(blow), -DVec3::from(blow)];
            let changes: Vec<Change> = (0..2).map(|k| {
                let (turn, spin) = (DQuat::from_rotation_x(1.0), DVec3::from(spins[k]));
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
            let after: Vec<DVec3> = (0..2).map(|k| bodies[k].take_back(&changes[k], part).0).collect();
            let momentum = |velocities: &[DVec3]| masses[0] * velocities[0] + masses[1] * velocities[1];
            prop_assert!(momentum(&after).distance(momentum(&before)) < 1e-9);
            prop_assert!((wholes(&bodies) - start).abs() < 1e-6 * start.abs().max(1.0));
        }
    }
}
