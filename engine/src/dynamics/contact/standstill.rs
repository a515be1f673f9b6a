//! Which bodies get nowhere, whatever their speed.
//!
//! Box3D goes by speed, and puts bodies that touch to sleep only together. A single shard that trembles between its
//! neighbours would so keep a heap of thousands awake for good. So a body also counts as still while no part of it gets
//! farther than [`ROOM`] from where it was, for [`TIME`] or longer. A body that drifts, tips over or falls has long left
//! that room.

use glam::{DQuat, DVec3};

/// A body that stays within this of one place is still [m]. What falls asleep by its speed alone may go farther in that
/// time.
const ROOM: f64 = 3e-3;
/// For how long it has to [s].
const TIME: f64 = 0.35;

/// Watches one body.
#[derive(Debug, Clone, Copy)]
pub struct Standstill {
    position: DVec3,
    rotation: DQuat,
    /// Distance of the body's farthest part from its centre of mass [m].
    reach: f64,
    /// For how long the body has been near that place [s].
    time: f64,
}

impl Standstill {
    /// Begins where a body is.
    pub fn new(position: DVec3, rotation: DQuat, reach: f64) -> Self {
        Self { position, rotation, reach, time: 0.0 }
    }

    /// Whether the body has not got anywhere.
    pub fn holds(&self) -> bool {
        self.time >= TIME
    }

    /// Distance of the body's farthest part from its centre of mass [m].
    pub fn reach(&self) -> f64 {
        self.reach
    }

    /// Takes in where the body is after a step of `dt` [s].
    pub fn watch(&mut self, position: DVec3, rotation: DQuat, dt: f64) {
        let turn = self.rotation.conjugate() * rotation;
        // The chord of the farthest part: 2 sin(θ/2) times its distance.
        let turned = 2.0 * self.reach * DVec3::new(turn.x, turn.y, turn.z).length();
        if position.distance(self.position) + turned <= ROOM {
            self.time += dt;
        } else {
            *self = Self::new(position, rotation, self.reach);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DT: f64 = 1.0 / 240.0;

    /// Whether a body of 0.1 m whose place and angle are known for each time counts as still after three seconds.
    fn still(at: impl Fn(f64) -> (f64, f64)) -> bool {
        let mut watch = Standstill::new(DVec3::ZERO, DQuat::IDENTITY, 0.1);
        for k in 0..720 {
            let (place, angle) = at(f64::from(k) * DT);
            watch.watch(DVec3::X * place, DQuat::from_rotation_z(angle), DT);
        }
        watch.holds()
    }

    #[test]
    fn what_trembles_is_still_and_what_creeps_is_not() {
        assert!(still(|_| (0.0, 0.0)));
        // 0.3 m/s to and fro, within a millimetre.
        assert!(still(|t| (4e-4 * (750.0 * t).sin(), 0.0)));
        assert!(still(|t| (0.0, 4e-3 * (750.0 * t).sin())));
        // Three millimetres in less than a third of a second.
        assert!(!still(|t| (12e-3 * t, 0.0)));
        assert!(!still(|t| (0.0, 0.12 * t)));
        // Both together.
        assert!(!still(|t| (6e-3 * t, 0.06 * t)));
        assert!(!still(|t| (6e-2 * (3.0 * t).sin(), 0.0)));
    }

    /// Thrown up, a body hardly moves for a moment at the top.
    #[test]
    fn the_top_of_a_throw_is_not_still() {
        let mut watch = Standstill::new(DVec3::ZERO, DQuat::IDENTITY, 0.1);
        for k in 0..480 {
            let t = f64::from(k) * DT - 1.0;
            watch.watch(DVec3::Y * (-4.9 * t * t), DQuat::IDENTITY, DT);
            assert!(!watch.holds());
        }
    }
}
