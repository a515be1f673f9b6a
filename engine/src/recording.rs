//! What a simulation gives back.

use glam::{DVec3, Quat, Vec3};

/// Poses of every body at every frame, and the facts of each body.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Recording {
    /// Time of each frame [s].
    pub times: Vec<f64>,
    /// Positions of the centres of mass in the world [m]: all bodies of frame 0, then of frame 1, …
    pub positions: Vec<Vec3>,
    /// Rotations from the bodies' own frames into the world, laid out as the positions. The sign of each follows
    /// the frame before, so that interpolating between frames takes the short way.
    pub orientations: Vec<Quat>,
    /// Facts, one a body.
    pub facts: Vec<BodyFacts>,
    /// The simulation step [s].
    pub step: f64,
    /// What was approximated, in sentences for the user.
    pub warnings: Vec<String>,
}

/// What happened to one body.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BodyFacts {
    /// Mass [kg].
    pub mass: f64,
    /// Open area projected toward the nearest charge [m²].
    pub frontal_area: f64,
    /// Distance of the centre of mass from the nearest charge [m].
    pub distance: f64,
    /// When the first front reaches it [s]; infinite if none ever does.
    pub arrival_time: f64,
    /// Highest incident overpressure [Pa].
    pub peak_overpressure: f64,
    /// Highest pressure on its most loaded panel [Pa].
    pub peak_load: f64,
    /// Impulse received from all charges, panels and wind together [N s].
    pub impulse: DVec3,
    /// Of a piece of a pane, the part of that impulse which its pane and the frame took before it was free [N s]; of one
    /// that stays, all of it.
    pub held_back: DVec3,
    /// When a piece of a pane was free [s]; not a number for one that stays, and for other bodies.
    pub free_time: f64,
    /// Share of the unsheltered load that it receives.
    pub attenuation: f64,
    /// Speed at the end of its loading [m/s]; at the end of the run if that comes first; the highest of them where
    /// charges load it one after the other.
    pub launch_speed: f64,
    /// Velocity at the end of the run [m/s].
    pub final_velocity: DVec3,
    /// When it came to rest for good [s]; 0 if it never moved, not a number if it still moves.
    pub rest_time: f64,
}

impl BodyFacts {
    /// Whether all are finite that cannot be otherwise: a front may never come, and a piece never be free or at rest.
    pub fn is_finite(&self) -> bool {
        let numbers = [
            self.mass,
            self.frontal_area,
            self.distance,
            self.peak_overpressure,
            self.peak_load,
            self.attenuation,
            self.launch_speed,
        ];
        let vectors = [self.impulse, self.held_back, self.final_velocity];
        numbers.into_iter().all(f64::is_finite) && vectors.into_iter().all(DVec3::is_finite)
    }
}
