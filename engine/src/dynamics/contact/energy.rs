//! What contacts must not do: give energy.
//!
//! Box3D goes over the contacts a fixed number of times and starts with the impulses of the step before. Where a heavy body
//! has struck a light one on the ground, those are far too large by then, and a few passes do not take them back: the heavy
//! one was seen to be thrown up at twice the speed it came with. A box that strikes the ground fast and spinning may gain as
//! well. So the energy of all bodies together is compared with what it was before the step. If it has risen, those that
//! gained give back in proportion.

use glam::{DQuat, DVec3};

use crate::dynamics::{GRAVITY, RigidBody};

/// All energy may rise by this part of the kinetic energy in a step [1], and by this much a kilogram [J/kg]: places and
/// velocities are single numbers.
const ROUNDING: (f64, f64) = (1e-5, 1e-5);

/// A body's mass and moments of inertia, and its energy when it was last looked at.
#[derive(Debug, Clone, Copy, Default)]
pub struct Energy {
    mass: f64,
    moments: DVec3,
    /// Kinetic energy and that of its height [J].
    whole: f64,
}

/// A body after a step.
#[derive(Debug, Clone, Copy)]
pub struct Change {
    /// What it has gained [J]; less than nothing where it lost.
    pub gain: f64,
    /// Its kinetic energy [J].
    pub kinetic: f64,
    /// Its mass [kg].
    pub mass: f64,
}

impl Energy {
    /// That of a body as it is.
    pub fn of(state: &RigidBody) -> Self {
        let moment = |inverse: f64| if inverse > 0.0 { 1.0 / inverse } else { 0.0 };
        let moments = DVec3::from_array(state.inverse_moments.to_array().map(moment));
        let mut energy = Self { mass: 1.0 / state.inverse_mass, moments, whole: 0.0 };
        energy.look(state.position, state.world_from_principal, state.velocity, state.angular_velocity());
        energy
    }

    /// Takes in how a body is now.
    pub fn look(&mut self, position: DVec3, rotation: DQuat, velocity: DVec3, spin: DVec3) -> Change {
        let own = rotation.conjugate() * spin;
        let kinetic = 0.5 * (self.mass * velocity.length_squared() + own.dot(self.moments * own));
        let whole = kinetic + self.mass * GRAVITY * position.y;
        let gain = whole - self.whole;
        self.whole = whole;
        Change { gain, kinetic, mass: self.mass }
    }

    /// Takes in that a body has given back this much [J].
    pub fn give_back(&mut self, energy: f64) {
        self.whole -= energy;
    }
}

/// Which part of its gain each body that gained gives back, so that all together have no more than before.
pub fn part_to_give_back(changes: impl Iterator<Item = Change>) -> f64 {
    let (mut sum, mut gains, mut rounding) = (0.0, 0.0, 0.0);
    for Change { gain, kinetic, mass } in changes {
        sum += gain;
        gains += gain.max(0.0);
        rounding += ROUNDING.0 * kinetic + ROUNDING.1 * mass;
    }
    if sum > rounding { sum / gains } else { 0.0 }
}

#[cfg(test)]
mod tests {
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
        let change = energy.look(position, state.world_from_principal, fallen, state.angular_velocity());
        assert!(change.gain.abs() < 1e-12, "{change:?}");
        let own = state.angular_momentum * state.inverse_moments;
        let kinetic = fallen.length_squared() + 0.5 * own.dot(state.angular_momentum);
        assert!((change.kinetic - kinetic).abs() < 1e-12, "{change:?} {kinetic}");
    }

    #[test]
    fn gains_are_given_back_in_proportion_until_nothing_is_gained() {
        let change = |gain: f64| Change { gain, kinetic: 10.0, mass: 1.0 };
        // One loses 1 J, two gain 3 J: all together have 2 J too much, two thirds of what was gained.
        let part = part_to_give_back([-1.0, 1.0, 2.0].map(change).into_iter());
        assert!((part - 2.0 / 3.0).abs() < 1e-12);
        assert_eq!(part_to_give_back([-2.0, 1.5].map(change).into_iter()), 0.0);
        // Rounding.
        assert_eq!(part_to_give_back([1e-4, 0.0].map(change).into_iter()), 0.0);
        assert_eq!(part_to_give_back(std::iter::empty()), 0.0);
    }
}
