//! Pressure–impulse diagrams: which loads bring a structure to a given displacement.
//!
//! Thesis §2.8. A long load damages by its pressure, a short one by its impulse; between the two limits the
//! diagram is found by computing the response. Both limits follow from work: a force put on at once and left
//! does the work `F x_max` (2.37), an impulse gives the kinetic energy `I²/2M`, and either must equal the
//! strain energy at `x_max`.

use super::load::Pulse;
use super::oscillator::{Integration, Oscillator, crest};
use crate::error::{Error, Result, positive};
use crate::root::bisect;

/// Steps in which a period, and a pulse, are resolved.
const STEPS: f64 = 400.0;

/// Steps after which a structure that still creeps is taken to have arrived.
const MOST_STEPS: usize = 1_000_000;

/// A load that just brings the structure to the limit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Threshold {
    /// Duration of the pulse [s].
    pub duration: f64,
    /// Its peak force [N].
    pub force: f64,
    /// Its impulse [N s].
    pub impulse: f64,
}

/// The loads that bring a structure to a displacement.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagram {
    /// Quasi-static asymptote [N]: no smaller force reaches the limit, however long it lasts.
    pub force_asymptote: f64,
    /// Impulsive asymptote [N s]: no smaller impulse reaches the limit, however short it is.
    pub impulse_asymptote: f64,
    /// Thresholds from the shortest pulse to the longest.
    pub curve: Vec<Threshold>,
}

/// Force [N] which, put on at once and left, brings the structure to `limit` [m]: (2.37).
pub fn quasi_static_force(oscillator: &Oscillator, limit: f64) -> f64 {
    oscillator.strain_energy(limit) / limit
}

/// Impulse [N s] which, given at once, brings the structure to `limit` [m].
pub fn impulsive_limit(oscillator: &Oscillator, limit: f64) -> f64 {
    (2.0 * oscillator.mass * oscillator.strain_energy(limit)).sqrt()
}

/// The diagram of `oscillator` for pulses of the shape of `pulse` and displacement `limit` [m, above 0].
///
/// `points` (2 or more) durations, evenly spaced in their logarithm, from `shortest` to `longest`, both as parts
/// of the natural period. Damping moves the curve outwards from the asymptotes, which are those without it.
pub fn diagram(
    oscillator: &Oscillator,
    pulse: &Pulse,
    limit: f64,
    (shortest, longest): (f64, f64),
    points: usize,
) -> Result<Diagram> {
    oscillator.validate()?;
    pulse.scaled(1.0, 1.0).validate()?;
    positive("displacement limit [m]", limit)?;
    positive("shortest pulse over the period", shortest)?;
    positive("longest pulse over the shortest, minus 1", longest / shortest - 1.0)?;
    if points < 2 {
        return Err(Error::Malformed(format!("a diagram has {points} points, but must have at least 2")));
    }
    let period = oscillator.period();
    let ratio = libm::log(longest / shortest);
    let curve = (0..points).map(|point| {
        let duration = period * shortest * libm::exp(ratio * point as f64 / (points - 1) as f64);
        threshold(oscillator, pulse, limit, duration)
    });
    Ok(Diagram {
        force_asymptote: quasi_static_force(oscillator, limit),
        impulse_asymptote: impulsive_limit(oscillator, limit),
        curve: curve.collect(),
    })
}

/// The pulse of `duration` [s] that just reaches `limit`.
fn threshold(oscillator: &Oscillator, pulse: &Pulse, limit: f64, duration: f64) -> Threshold {
    let load = |force: f64| pulse.scaled(force, duration);
    let unit = load(1.0).impulse();
    // Neither limit alone is enough; together, with some slack for damping, they are.
    let least = quasi_static_force(oscillator, limit).max(impulsive_limit(oscillator, limit) / unit);
    let mut high = least;
    while first_crest(oscillator, &load(high)) < limit {
        high *= 2.0;
    }
    let low = 0.5 * least.min(high);
    let short = |log: f64| first_crest(oscillator, &load(libm::exp(log))) - limit;
    let force = libm::exp(bisect(libm::log(low), libm::log(high), short));
    Threshold { duration, force, impulse: load(force).impulse() }
}

/// The first, and under a load that only falls the greatest, displacement [m] at which the structure turns.
fn first_crest(oscillator: &Oscillator, pulse: &Pulse) -> f64 {
    let period = oscillator.period();
    let duration = pulse.duration();
    let mut run = Integration::new(*oscillator, pulse);
    let mut within = (period / STEPS).min(duration / STEPS);
    for _ in 0..MOST_STEPS {
        let before = run.now;
        let ended = before.time >= duration;
        if ended {
            within = period / STEPS;
        }
        let next = before.time + within;
        let bends = !ended && next > duration * (1.0 - 1e-9);
        run.step(if bends { duration } else { next });
        if let Some((_, top)) = crest(&before, &run.now) {
            return top;
        }
        // So much damping that the structure creeps and never turns.
        if run.now.velocity * period < 1e-9 * run.now.displacement {
            break;
        }
        if bends {
            run.jump();
        }
    }
    run.now.displacement
}

/// Whether `load` brings the structure to `limit` [m], by computing the response.
pub fn reaches(oscillator: &Oscillator, load: &Pulse, limit: f64) -> Result<bool> {
    oscillator.validate()?;
    load.validate()?;
    positive("displacement limit [m]", limit)?;
    Ok(first_crest(oscillator, load) >= limit)
}
