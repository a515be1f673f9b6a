//! An elastic structure under a triangular pulse, in closed form: (2.34) and (2.35).

use super::oscillator::Oscillator;

/// Displacement [m] at `time` [s] of an undamped elastic structure, from rest, under a force that falls evenly
/// from `peak` [N] to nothing in `duration` [s].
///
/// (2.34) while the pulse lasts, (2.35) after it. Damping and yield resistance are not looked at.
pub fn triangle_response(oscillator: &Oscillator, peak: f64, duration: f64, time: f64) -> f64 {
    let omega = oscillator.frequency();
    let still = peak / oscillator.stiffness;
    let phase = omega * time;
    if time <= duration {
        return still * (1.0 - libm::cos(phase)) + still / duration * (libm::sin(phase) / omega - time);
    }
    let swing = libm::sin(phase) - libm::sin(omega * (time - duration));
    still / (omega * duration) * swing - still * libm::cos(phase)
}
