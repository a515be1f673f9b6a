//! A whole pane under its load: how far it bends, until it fails or the load is over.
//!
//! The pane is one mass on one spring (see [`Plate`]). In units of the pressure that would bend it as far at rest, its
//! amplitude u obeys `u'' + 2ζω u' + ω² u = ω² p(t)`, with p the pressure on it, weighted with how far each place bends.
//! Each step is exact for a pressure that is even over it and has the true impulse, so that a pulse much shorter than
//! a step still gives its impulse.

use std::sync::Arc;

use glam::DVec3;

use super::super::queue::LoadQueue;
use crate::dynamics::Bowing;
use crate::geometry::Sample;
use crate::structure::Plate;

/// Damping of a pane in its frame, as a part of the critical one: it only makes a pane that holds come to rest.
pub(super) const DAMPING: f64 = 0.01;
/// Steps a period is resolved with.
const STEPS_A_PERIOD: f64 = 200.0;
/// Periods that a pane is followed for once its load is over.
const PERIODS_AFTER: f64 = 4.0;
/// Periods after the arrival of a load for which steps are so fine; later a pane only follows its load.
const FRESH: f64 = 12.0;
/// Steps in which the whole of the load is taken at least.
const LEAST_STEPS: f64 = 1000.0;

/// The load on a whole pane.
pub(super) struct Load<'a> {
    queue: &'a LoadQueue,
    /// The pane's own +z in the axes of the queue.
    axis: DVec3,
    /// Deflection at each panel's place [m/Pa].
    deflections: Vec<f64>,
    /// Σ area × deflection [m³/Pa], and Σ area [m²], of one face.
    bent: f64,
    area: f64,
}

/// How a pane has fared so far.
pub(super) struct Response {
    pub bowing: Arc<Bowing>,
    /// Greatest amplitude [Pa], either way.
    pub peak: f64,
    /// When it failed [s].
    pub failure: Option<f64>,
    /// Times [s] with amplitude [Pa] and rate [Pa/s], the last at the failure if there was one.
    pub record: Vec<(f64, [f64; 2])>,
}

impl<'a> Load<'a> {
    pub fn new(queue: &'a LoadQueue, axis: DVec3, plate: &Plate, samples: &[Sample]) -> Self {
        let one_face: Vec<f64> = samples.iter().map(|sample| plate.deflection(sample.centre)).collect();
        Self {
            queue,
            axis,
            bent: one_face.iter().zip(samples).map(|(w, sample)| w * sample.area).sum(),
            area: samples.iter().map(|sample| sample.area).sum(),
            deflections: [&one_face[..], &one_face[..]].concat(),
        }
    }

    /// Mean pressure along +z from `t0` to `t1` [Pa], each place weighted with how far it bends.
    pub fn bending(&self, t0: f64, t1: f64) -> f64 {
        self.queue.weighted(t0, t1, self.axis, |panel| self.deflections[panel]) / (self.bent * (t1 - t0))
    }

    /// Impulse of the mean pressure along +z from `t0` to `t1` [Pa s].
    pub fn impulse(&self, t0: f64, t1: f64) -> f64 {
        self.queue.weighted(t0, t1, self.axis, |_| 1.0) / self.area
    }

    /// When the load begins and ends [s]; `None` without any.
    pub fn span(&self) -> Option<(f64, f64)> {
        (self.queue.start < self.queue.end).then_some((self.queue.start, self.queue.end))
    }

    /// When the load that acts at a time [s] ends, before the next one comes [s].
    pub fn end_of(&self, t: f64) -> f64 {
        self.queue.end_of(t)
    }
}

impl Response {
    /// That of a pane that nothing bends.
    pub fn none() -> Self {
        Self { bowing: Arc::default(), peak: 0.0, failure: None, record: Vec::new() }
    }

    /// Bends a pane until its stress reaches its strength [Pa], where it may fail at all, or until it comes to rest.
    pub fn until_failure(plate: &Plate, load: &Load, strength: f64, may_fail: bool) -> Self {
        let Some((start, load_end)) = load.span() else { return Self::none() };
        let frequency = plate.frequency();
        let period = 2.0 * core::f64::consts::PI / frequency;
        let end = load_end + PERIODS_AFTER * period;
        let fine = period / STEPS_A_PERIOD;
        let coarse = fine.max((end - start) / LEAST_STEPS);
        let limit = if may_fail { strength / plate.strongest() } else { f64::INFINITY };
        let springs = [fine, coarse].map(|step| (step, Spring::new(frequency, DAMPING, step)));
        let mut record = vec![(start, [0.0; 2])];
        let (mut peak, mut failure) = (0.0_f64, None);
        let (mut t, mut now) = (start, [0.0; 2]);
        while t < end {
            let fresh = t - load.queue.latest_arrival(t) < FRESH * period;
            let (step, spring) = &springs[usize::from(!fresh)];
            let pressure = load.bending(t, t + step);
            let next = spring.step(now, pressure);
            if next[0].abs() >= limit {
                let (part, at) = reaching(now, pressure, frequency, *step, limit);
                failure = Some(t + part);
                record.push((t + part, at));
                peak = limit;
                break;
            }
            peak = peak.max(next[0].abs());
            t += step;
            now = next;
            record.push((t, now));
        }
        Self { bowing: Arc::new(Bowing::new(record.clone())), peak, failure, record }
    }
}

/// When within a step the amplitude reaches `limit` [Pa] either way, since the step's begin [s], and the state then.
fn reaching(from: [f64; 2], pressure: f64, frequency: f64, step: f64, limit: f64) -> (f64, [f64; 2]) {
    let at = |part: f64| Spring::new(frequency, DAMPING, part).step(from, pressure);
    let (mut low, mut high) = (0.0, step);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if at(middle)[0].abs() >= limit { high = middle } else { low = middle }
    }
    (high, at(high))
}

/// One step of a damped oscillator under an even load, exactly.
struct Spring {
    /// Rows of the matrix that carries (u − p, u') over a step.
    carry: [[f64; 2]; 2],
}

impl Spring {
    fn new(frequency: f64, damping: f64, step: f64) -> Self {
        let decay = damping * frequency;
        let damped = frequency * libm::sqrt(1.0 - damping * damping);
        let (sin, cos) = (libm::sin(damped * step), libm::cos(damped * step));
        let fade = libm::exp(-decay * step);
        Self {
            carry: [
                [fade * (cos + decay / damped * sin), fade * sin / damped],
                [-fade * frequency * frequency / damped * sin, fade * (cos - decay / damped * sin)],
            ],
        }
    }

    fn step(&self, [amplitude, rate]: [f64; 2], pressure: f64) -> [f64; 2] {
        let off = amplitude - pressure;
        let [a, b] = self.carry;
        [pressure + a[0] * off + a[1] * rate, b[0] * off + b[1] * rate]
    }
}

/// One step of an undamped oscillator, exactly: amplitude [Pa] and rate [Pa/s] after `step` [s] under an even pressure.
pub(super) fn swing(frequency: f64, step: f64, now: [f64; 2], pressure: f64) -> [f64; 2] {
    Spring::new(frequency, 0.0, step).step(now, pressure)
}
