//! What flows through each face: the approximate Riemann solver of Harten, Lax and van Leer with the contact
//! put back (HLLC), on faces that stand, move, or go with the gas.
//!
//! E. F. Toro, M. Spruce, W. Speares, Shock Waves 4 (1994); wave speeds by Einfeldt's bounds, which need no
//! equation of state beyond the speed of sound. The flux through a face that moves at `w` is that of the state
//! found at the ray `x/t = w`.

use super::columns::{BLOCK, Columns, Row};

/// The waves that leave a face: outer speeds, speed of the contact, pressure beside it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Waves {
    pub left: f64,
    pub right: f64,
    pub contact: f64,
    pub pressure: f64,
}

/// Waves between `left` and `right`, whose `ρ c²/p` are `stiffness`.
#[inline(always)]
pub(super) fn waves(left: Row, right: Row, stiffness: (f64, f64)) -> Waves {
    let square_left = stiffness.0 * left.pressure / left.density;
    let square_right = stiffness.1 * right.pressure / right.density;
    let (root_left, root_right) = (left.density.sqrt(), right.density.sqrt());
    let share = 1.0 / (root_left + root_right);
    let mean = (root_left * left.velocity + root_right * right.velocity) * share;
    let jump = right.velocity - left.velocity;
    let spread = 0.5 * root_left * root_right * share * share * jump * jump;
    let sound = ((root_left * square_left + root_right * square_right) * share + spread).sqrt();
    let (own_left, own_right) = (left.velocity - square_left.sqrt(), right.velocity + square_right.sqrt());
    let (mean_left, mean_right) = (mean - sound, mean + sound);
    let slowest = if own_left < mean_left { own_left } else { mean_left };
    let fastest = if own_right > mean_right { own_right } else { mean_right };
    let flux_left = left.density * (left.velocity - slowest);
    let flux_right = right.density * (fastest - right.velocity);
    let contact = (flux_left * left.velocity + flux_right * right.velocity + left.pressure - right.pressure)
        / (flux_left + flux_right);
    let pressure = left.pressure + flux_left * (left.velocity - contact);
    Waves { left: slowest, right: fastest, contact, pressure }
}

/// Mass, momentum and energy through one face that moves at `face_velocity`.
#[inline(always)]
fn hllc(left: Row, right: Row, stiffness: (f64, f64), face_velocity: f64) -> (f64, f64, f64) {
    let waves = waves(left, right, stiffness);
    let from_left = waves.contact >= face_velocity;
    let pick = |a: f64, b: f64| if from_left { a } else { b };
    let density = pick(left.density, right.density);
    let velocity = pick(left.velocity, right.velocity);
    let pressure = pick(left.pressure, right.pressure);
    let internal = pick(left.energy, right.energy);
    let outer = pick(waves.left, waves.right);
    let energy = internal + 0.5 * density * velocity * velocity;
    let away = outer - velocity;
    let squeeze = away / (outer - waves.contact);
    let work = (waves.contact - velocity) * (density * waves.contact + pressure / away);
    // Outside the outer wave the state is the cell's own.
    let outside = if from_left { outer >= face_velocity } else { outer <= face_velocity };
    let star = |own: f64, between: f64| if outside { own } else { between };
    let density_there = star(density, density * squeeze);
    let velocity_there = star(velocity, waves.contact);
    let pressure_there = star(pressure, waves.pressure);
    let energy_there = star(energy, squeeze * (energy + work));
    let through = velocity_there - face_velocity;
    let mass = density_there * through;
    (mass, mass * velocity_there + pressure_there, energy_there * through + pressure_there * velocity_there)
}

/// Flux of mass, momentum and energy through every face.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Fluxes {
    pub mass: Vec<f64>,
    pub momentum: Vec<f64>,
    pub energy: Vec<f64>,
}

impl Fluxes {
    pub fn zeros(faces: usize) -> Fluxes {
        Fluxes { mass: vec![0.0; faces], momentum: vec![0.0; faces], energy: vec![0.0; faces] }
    }

    pub fn set(&mut self, face: usize, mass: f64, momentum: f64, energy: f64) {
        self.mass[face] = mass;
        self.momentum[face] = momentum;
        self.energy[face] = energy;
    }
}

/// [`hllc`] through every face, from the states at the cells' upper and lower faces.
pub(super) fn through_faces(
    low: &Columns,
    high: &Columns,
    stiffness: &[f64],
    face_velocity: &[f64],
    fluxes: &mut Fluxes,
) {
    let count = face_velocity.len();
    let mut from = 0;
    while from < count {
        let rows = BLOCK.min(count - from);
        let (mut mass, mut momentum, mut energy) = ([0.0; BLOCK], [0.0; BLOCK], [0.0; BLOCK]);
        let (left, right) = (high.stretch(from, from + rows), low.stretch(from + 1, from + 1 + rows));
        let (stiff, velocity) = (&stiffness[from..from + rows + 1], &face_velocity[from..from + rows]);
        for row in 0..rows {
            (mass[row], momentum[row], energy[row]) =
                hllc(left.row(row), right.row(row), (stiff[row], stiff[row + 1]), velocity[row]);
        }
        fluxes.mass[from..from + rows].copy_from_slice(&mass[..rows]);
        fluxes.momentum[from..from + rows].copy_from_slice(&momentum[..rows]);
        fluxes.energy[from..from + rows].copy_from_slice(&energy[..rows]);
        from += rows;
    }
}

/// Faces that go with the gas: nothing flows through them, and they push. Sets their velocities too.
pub(super) fn with_the_gas(
    low: &Columns,
    high: &Columns,
    stiffness: &[f64],
    face_velocity: &mut [f64],
    fluxes: &mut Fluxes,
) {
    let count = face_velocity.len();
    let mut from = 0;
    while from < count {
        let rows = BLOCK.min(count - from);
        let (mut speed, mut push) = ([0.0; BLOCK], [0.0; BLOCK]);
        let (left, right) = (high.stretch(from, from + rows), low.stretch(from + 1, from + 1 + rows));
        let stiff = &stiffness[from..from + rows + 1];
        for row in 0..rows {
            let waves = waves(left.row(row), right.row(row), (stiff[row], stiff[row + 1]));
            (speed[row], push[row]) = (waves.contact, waves.pressure);
        }
        for row in 0..rows {
            face_velocity[from + row] = speed[row];
            fluxes.set(from + row, 0.0, push[row], push[row] * speed[row]);
        }
        from += rows;
    }
}
