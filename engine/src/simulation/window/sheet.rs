//! The load on a piece that has left its pane and turns.

use glam::DVec3;

use super::super::targets::Target;
use crate::dynamics::RigidBody;

/// How the load on a piece follows it as it turns.
///
/// Its load is the difference of the pressures before and behind the sheet of pieces that it has just left. That
/// difference pushes across the sheet whichever way the piece lies, and on no more of it than it shows: the cosine of its
/// turn. A load that turned with the piece would throw a tumbling shard sideways.
#[derive(Debug, Clone, Copy)]
pub(in super::super) struct Sheet {
    /// Normal of the piece's face in its principal axes.
    face: DVec3,
    /// The same in the world when it lay in its pane.
    across: DVec3,
}

impl Sheet {
    pub fn new(target: &Target) -> Self {
        let face = target.object_from_principal.conjugate() * DVec3::Z;
        Self { face, across: target.body.world_from_principal * face }
    }

    /// Impulse [N s] and angular impulse [N m s] in principal axes of loads that would be these in the pane, over a step
    /// of `dt` [s] in which the body turns on.
    pub fn turn(&self, body: &RigidBody, impulse: DVec3, angular: DVec3, dt: f64) -> (DVec3, DVec3) {
        let now = body.world_from_principal * self.face;
        let halfway = (now + body.angular_velocity().cross(now) * (0.5 * dt)).normalize();
        let shown = halfway.dot(self.across).abs();
        let direction = body.world_from_principal.conjugate() * self.across;
        // The moment about the centre is Σ arm × load; with all loads along the face, Σ load · arm lies across it.
        let lever = self.face.cross(angular);
        (direction * (impulse.dot(self.face) * shown), lever.cross(direction) * shown)
    }
}
