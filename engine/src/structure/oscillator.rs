//! A structure as a single mass on a spring that may yield.
//!
//! Thesis §2.7, (2.33) and (2.36). The resistance is elastic–perfectly plastic (Fig. 2.14): it grows with the
//! displacement up to the yield resistance, stays there while the structure flows, and unloads elastically.
//! Integrated by the average-acceleration method (Newmark 1959, β = ¼, γ = ½): implicit, stable for any step,
//! of second order, and without damping of its own.

use super::load::Load;
use crate::error::{Error, Result, finite, not_negative, positive};

/// A mass on a damped spring.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Oscillator {
    /// Mass `M` [kg], above 0.
    pub mass: f64,
    /// Stiffness `k` [N/m], above 0.
    pub stiffness: f64,
    /// Damping `c` [N s/m], 0 or more.
    pub damping: f64,
    /// Resistance [N] at which the structure flows, above 0; infinite: it never does.
    pub yield_resistance: f64,
}

impl Oscillator {
    /// An elastic structure without damping.
    pub fn elastic(mass: f64, stiffness: f64) -> Oscillator {
        Oscillator { mass, stiffness, damping: 0.0, yield_resistance: f64::INFINITY }
    }

    /// Angular frequency `ω` = √(k/M) [rad/s].
    pub fn frequency(&self) -> f64 {
        (self.stiffness / self.mass).sqrt()
    }

    /// Natural period `T` = 2π/ω [s].
    pub fn period(&self) -> f64 {
        2.0 * core::f64::consts::PI / self.frequency()
    }

    /// Largest elastic displacement `x_el` [m]; infinite if it never yields.
    pub fn yield_displacement(&self) -> f64 {
        self.yield_resistance / self.stiffness
    }

    /// Strain energy [J] at displacement `x` [m], reached without turning back: the right side of (2.37).
    pub fn strain_energy(&self, x: f64) -> f64 {
        let elastic = self.yield_displacement();
        if x <= elastic {
            return 0.5 * self.stiffness * x * x;
        }
        self.yield_resistance * (x - 0.5 * elastic)
    }

    /// Checks that mass, stiffness and yield resistance are above 0 and damping is not negative.
    pub fn validate(&self) -> Result<()> {
        positive("mass of the structure [kg]", self.mass)?;
        positive("stiffness of the structure [N/m]", self.stiffness)?;
        not_negative("damping of the structure [N s/m]", self.damping)?;
        if self.yield_resistance != f64::INFINITY {
            positive("yield resistance [N]", self.yield_resistance)?;
        }
        Ok(())
    }
}

/// The structure at a moment.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Motion {
    /// Time [s].
    pub time: f64,
    /// Displacement [m].
    pub displacement: f64,
    /// Velocity [m/s].
    pub velocity: f64,
    /// Acceleration [m/s²].
    pub acceleration: f64,
    /// Resistance of the spring [N].
    pub resistance: f64,
    /// Part of the displacement that would stay if the structure were unloaded [m].
    pub set: f64,
    /// Work that the load has done [J].
    pub work: f64,
    /// Energy that the damper has taken [J].
    pub damped: f64,
    /// Energy that plastic flow has taken [J].
    pub flowed: f64,
}

impl Motion {
    /// Kinetic energy and elastic energy of the spring [J].
    pub fn stored(&self, oscillator: &Oscillator) -> f64 {
        let kinetic = 0.5 * oscillator.mass * self.velocity * self.velocity;
        kinetic + 0.5 * self.resistance * self.resistance / oscillator.stiffness
    }
}

/// What a load did to a structure.
#[derive(Debug, Clone, PartialEq)]
pub struct Response {
    /// Largest displacement in the load's direction [m].
    pub max_displacement: f64,
    /// When [s].
    pub time_of_max: f64,
    /// Displacement that is left when all motion has died away [m].
    pub permanent_set: f64,
    /// The motion at every step, the start first.
    pub history: Vec<Motion>,
}

/// A motion carried forward step by step.
#[derive(Debug, Clone)]
pub(super) struct Integration<'a, L: Load> {
    oscillator: Oscillator,
    load: &'a L,
    pub now: Motion,
}

impl<'a, L: Load> Integration<'a, L> {
    pub fn new(oscillator: Oscillator, load: &'a L) -> Integration<'a, L> {
        let acceleration = load.force(0.0) / oscillator.mass;
        Integration { oscillator, load, now: Motion { acceleration, ..Motion::default() } }
    }

    /// One step to `time`. The equation of motion at its end is piecewise linear in the new displacement: it is
    /// solved for an elastic step first, and for a flowing one where that would exceed the yield resistance.
    pub fn step(&mut self, time: f64) {
        let Oscillator { mass, stiffness, damping, yield_resistance } = self.oscillator;
        let before = self.now;
        let step = time - before.time;
        let force = self.load.force_before(time);
        let start = self.load.force(before.time);
        // x₁ = x₀ + h v₀ + h²/4 (a₀ + a₁), v₁ = v₀ + h/2 (a₀ + a₁).
        let velocity = before.velocity + 0.5 * step * before.acceleration;
        let drift = step * before.velocity + 0.25 * step * step * before.acceleration;
        let inertia = mass + 0.5 * step * damping;
        let elastic = force - damping * velocity - before.resistance - stiffness * drift;
        let mut acceleration = elastic / (inertia + 0.25 * step * step * stiffness);
        let mut resistance = before.resistance + stiffness * (drift + 0.25 * step * step * acceleration);
        if resistance.abs() > yield_resistance {
            resistance = yield_resistance.copysign(resistance);
            acceleration = (force - damping * velocity - resistance) / inertia;
        }
        let displacement = before.displacement + drift + 0.25 * step * step * acceleration;
        let velocity = velocity + 0.5 * step * acceleration;
        let way = displacement - before.displacement;
        let set = displacement - resistance / stiffness;
        self.now = Motion {
            time,
            displacement,
            velocity,
            acceleration,
            resistance,
            set,
            work: before.work + 0.5 * (start + force) * way,
            damped: before.damped + 0.5 * damping * (before.velocity + velocity) * way,
            flowed: before.flowed + 0.5 * (before.resistance + resistance) * (set - before.set),
        };
    }

    /// Takes up the force from here on, where it jumps.
    pub fn jump(&mut self) {
        let Oscillator { mass, damping, .. } = self.oscillator;
        let now = &mut self.now;
        let force = self.load.force(now.time);
        now.acceleration = (force - damping * now.velocity - now.resistance) / mass;
    }
}

/// The top of the displacement between two moments if the velocity changes sign there: time [s] and
/// displacement [m].
pub(super) fn crest(before: &Motion, after: &Motion) -> Option<(f64, f64)> {
    if !(before.velocity > 0.0 && after.velocity <= 0.0) {
        return None;
    }
    let step = after.time - before.time;
    let part = before.velocity / (before.velocity - after.velocity);
    // The top of the cubic through both ends' displacements and velocities.
    let (x0, v0, v1) = (before.displacement, before.velocity * step, after.velocity * step);
    let rise = after.displacement - x0;
    let (c2, c3) = (3.0 * rise - 2.0 * v0 - v1, v0 + v1 - 2.0 * rise);
    let slope = |s: f64| v0 + s * (2.0 * c2 + 3.0 * c3 * s);
    let curve = |s: f64| 2.0 * c2 + 6.0 * c3 * s;
    let mut place = part;
    for _ in 0..4 {
        let bend = curve(place);
        if bend == 0.0 {
            break;
        }
        place = (place - slope(place) / bend).clamp(0.0, 1.0);
    }
    Some((before.time + place * step, x0 + place * (v0 + place * (c2 + c3 * place))))
}

/// Steps in which the duration of a load is resolved at least.
const LOADED_STEPS: f64 = 200.0;

/// Most steps that a run may take.
const MOST_STEPS: f64 = 2e7;

/// The response of `oscillator` to `load` from rest, until `end` [s], in steps of at most `step` [s].
///
/// While the load lasts, a step is also at most a two-hundredth of its duration, so that a short pulse is not lost
/// in one of them; and steps end where the load bends. The permanent set is that of the last moment: it
/// is final once the structure only swings elastically, for which `end` should leave two periods after the
/// load.
pub fn respond(oscillator: &Oscillator, load: &impl Load, step: f64, end: f64) -> Result<Response> {
    oscillator.validate()?;
    positive("time step [s]", step)?;
    positive("final time [s]", end)?;
    if end / step > MOST_STEPS {
        return Err(Error::Malformed(format!(
            "a step of {step} s takes {:.1e} steps to {end} s, but at most {MOST_STEPS:.0e} are allowed",
            end / step
        )));
    }
    let mut run = Integration::new(*oscillator, load);
    let mut history = Vec::with_capacity((end / step) as usize + 16);
    history.push(run.now);
    let (mut highest, mut when) = (0.0, 0.0);
    let breaks = load.breaks();
    let loaded = if load.end() > 0.0 { step.min(load.end() / LOADED_STEPS) } else { step };
    let bounds = breaks.iter().copied().filter(|at| *at > 0.0 && *at < end).chain([end]);
    for bound in bounds {
        finite("time at which the load bends [s]", bound)?;
        let start = run.now.time;
        let longest = if bound <= load.end() { loaded } else { step };
        let steps = libm::ceil((bound - start) / longest * (1.0 - 1e-12)).max(1.0) as usize;
        for index in 1..=steps {
            let time =
                if index == steps { bound } else { start + (bound - start) * index as f64 / steps as f64 };
            let before = run.now;
            run.step(time);
            history.push(run.now);
            let last = (time == end).then_some((time, run.now.displacement));
            if let Some(top) = crest(&before, &run.now).or(last)
                && exceeds(top.1, highest)
            {
                (when, highest) = top;
            }
        }
        run.jump();
    }
    let permanent_set = settled(run.now.set, oscillator);
    Ok(Response { max_displacement: highest, time_of_max: when, permanent_set, history })
}

/// Whether a crest is higher by more than rounding: of equal crests the first counts.
fn exceeds(top: f64, highest: f64) -> bool {
    top > highest * (1.0 + 1e-9)
}

/// The set without the rounding that is left of it in an elastic structure.
fn settled(set: f64, oscillator: &Oscillator) -> f64 {
    if oscillator.yield_resistance == f64::INFINITY { 0.0 } else { set }
}
