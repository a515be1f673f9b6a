//! How the pressure passes a point: its history in time and its impulse over any interval.
//!
//! Thesis §2.5. The pulse starts at time 0 with its peak. Positive phase: modified Friedlander, `p (1 − t/T)
//! e^(−b t/T)`, of which the triangles I and II of Fig. 2.9 are the case `b = 0`. Negative phase, if there
//! is one: Granström's cubic. Impulses are closed forms, so what a body receives does not depend on the time
//! step.

/// Largest Friedlander decay: beyond it the pulse is shorter than a thousandth of its duration.
pub const MAX_DECAY: f64 = 1000.0;

/// How the positive phase is drawn through a peak, a duration and an impulse.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum PulseShape {
    /// Modified Friedlander: keeps all three.
    #[default]
    Friedlander,
    /// Triangle I: keeps the duration, not the impulse.
    TriangleDuration,
    /// Triangle II: keeps the impulse, not the duration.
    TriangleImpulse,
}

/// Suction after the positive phase: `−peak · 6.75 x (1 − x)²`, `x` from 0 to 1 over `duration` (Granström
/// 1956).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NegativePhase {
    /// Deepest underpressure [Pa], as a magnitude.
    pub peak: f64,
    /// Duration [s], above 0.
    pub duration: f64,
}

impl NegativePhase {
    /// Impulse of the whole phase [Pa s], as a magnitude: 9/16 of peak times duration.
    pub fn impulse(&self) -> f64 {
        9.0 / 16.0 * self.peak * self.duration
    }

    /// Pressure [Pa], 0 or less, at `time` [s] after the phase began.
    fn value(&self, time: f64) -> f64 {
        let x = time / self.duration;
        if (0.0..=1.0).contains(&x) { -6.75 * self.peak * x * (1.0 - x) * (1.0 - x) } else { 0.0 }
    }

    /// Impulse [Pa s] between two times after the phase began.
    fn impulse_between(&self, start: f64, end: f64) -> f64 {
        let (x0, x1) = (clamp01(start / self.duration), clamp01(end / self.duration));
        // ∫ x(1−x)² dx = y²(6 − 8y + 3y²)/12, with y measured from x0 to keep short intervals exact.
        -6.75 * self.peak * self.duration * integrate_poly_exp([0.0, 1.0, -2.0, 1.0], 0.0, x0, x1)
    }
}

/// The overpressure at a point as a function of time since the front arrived.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pulse {
    /// Overpressure at time 0 [Pa].
    pub peak: f64,
    /// Duration of the positive phase [s], above 0.
    pub duration: f64,
    /// Friedlander decay `b`, 0 to [`MAX_DECAY`]; 0 for triangles.
    pub decay: f64,
    /// Suction that follows, if it is modelled.
    pub negative: Option<NegativePhase>,
}

impl Pulse {
    /// A positive phase of `shape` through `peak` [Pa], `duration` [s] and `impulse` [Pa s], all above 0.
    ///
    /// See [`friedlander_fit`] for a duration and an impulse that do not go together.
    pub fn new(shape: PulseShape, peak: f64, duration: f64, impulse: f64) -> Pulse {
        let (duration, decay) = match shape {
            PulseShape::TriangleDuration => (duration, 0.0),
            PulseShape::TriangleImpulse => (2.0 * impulse / peak, 0.0),
            PulseShape::Friedlander => friedlander_fit(peak, duration, impulse),
        };
        Pulse { peak, duration, decay, negative: None }
    }

    /// Overpressure [Pa] at `time` [s] after arrival; 0 before it and after the last phase.
    pub fn value(&self, time: f64) -> f64 {
        if time < 0.0 {
            return 0.0;
        }
        let x = time / self.duration;
        if x <= 1.0 {
            return self.peak * (1.0 - x) * libm::exp(-self.decay * x);
        }
        self.negative.map_or(0.0, |phase| phase.value(time - self.duration))
    }

    /// Impulse `∫ p dt` [Pa s] from `start` to `end` [s after arrival], in closed form; any interval, also
    /// one that reaches outside the pulse; negative if `end` is before `start`.
    pub fn impulse(&self, start: f64, end: f64) -> f64 {
        let (x0, x1) = (clamp01(start / self.duration), clamp01(end / self.duration));
        let positive = self.peak * self.duration * integrate_poly_exp([1.0, -1.0], self.decay, x0, x1);
        let negative = self
            .negative
            .map_or(0.0, |phase| phase.impulse_between(start - self.duration, end - self.duration));
        positive + negative
    }
}

/// A solved Friedlander decay.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Decay {
    /// `b`, 0 to [`MAX_DECAY`].
    pub decay: f64,
    /// No decay within the bounds gives the impulse; `decay` is the nearest bound.
    pub clamped: bool,
}

/// The decay `b` with which `peak` [Pa] and `duration` [s] carry `impulse` [Pa s].
///
/// Solves `impulse / (peak · duration) = (b − 1 + e^(−b)) / b²`, which falls from 1/2 at `b` = 0 towards
/// `1/b`, to rounding. Unbounded solutions turn into false suction or into nothing: `b` stays in
/// `[0, MAX_DECAY]`, and the clamped flag says when that was needed.
pub fn friedlander_decay(peak: f64, duration: f64, impulse: f64) -> Decay {
    let target = peak * duration / impulse;
    if target <= 2.0 {
        return Decay { decay: 0.0, clamped: target < 2.0 };
    }
    if target >= 1.0 / unit_impulse(MAX_DECAY).0 {
        return Decay { decay: MAX_DECAY, clamped: true };
    }
    // 1/impulse is nearly straight in b, with slope 2/3 at 0 and 1 far out: Newton settles in a few steps.
    let excess = target - 2.0;
    let mut decay = excess * (3.0 + excess) / (2.0 + excess);
    for _ in 0..12 {
        let (value, slope) = unit_impulse(decay);
        let correction = (1.0 / value - target) * value * value / slope;
        decay = (decay + correction).clamp(0.0, MAX_DECAY);
        if correction.abs() <= 1e-14 * decay {
            break;
        }
    }
    Decay { decay, clamped: false }
}

/// Duration [s] and decay of the Friedlander pulse with this `peak` [Pa] that carries this `impulse` [Pa s].
///
/// The duration is the given one [s] wherever a decay in `[0, MAX_DECAY]` can be found for it. A pulse
/// carries at most `peak · duration / 2`: where the impulse is more, the decay is 0 and the duration is
/// stretched. Where even the largest decay carries too much, the duration is cut.
pub fn friedlander_fit(peak: f64, duration: f64, impulse: f64) -> (f64, f64) {
    let Decay { decay, clamped } = friedlander_decay(peak, duration, impulse);
    if clamped { (impulse / (peak * unit_impulse(decay).0), decay) } else { (duration, decay) }
}

/// `g(b) = ∫ (1 − x) e^(−b x) dx` over 0 to 1, and `dg/db`.
fn unit_impulse(decay: f64) -> (f64, f64) {
    let [m0, m1, m2] = moments::<3>(decay);
    (m0 - m1, m2 - m1)
}

/// `∫ (Σ c_k x^k) e^(−b x) dx` from `x0` to `x1` in closed form, for `b` ≥ 0 and up to eight coefficients.
///
/// Accurate to rounding relative to the integral of the terms' magnitudes, for any `b` including 0: the
/// polynomial is shifted to start at `x0`, and the moments `∫ s^k e^(−z s) ds` over 0 to 1 come from a
/// series of positive terms for small `z = b (x1 − x0)` and from the recursion for large ones. Negative if
/// `x1 < x0`.
pub fn integrate_poly_exp<const N: usize>(c: [f64; N], b: f64, x0: f64, x1: f64) -> f64 {
    if x1 < x0 {
        return -integrate_poly_exp(c, b, x1, x0);
    }
    let width = x1 - x0;
    let moments = moments::<N>(b * width);
    let mut shifted = c;
    let mut sum = 0.0;
    let mut power = width;
    for k in 0..N {
        for j in (k..N - 1).rev() {
            shifted[j] += x0 * shifted[j + 1];
        }
        sum += shifted[k] * power * moments[k];
        power *= width;
    }
    sum * if b == 0.0 { 1.0 } else { libm::exp(-b * x0) }
}

/// `∫ s^k e^(−z s) ds` over 0 to 1 for `k` from 0 to `N − 1` and `z` ≥ 0.
fn moments<const N: usize>(z: f64) -> [f64; N] {
    let mut moments = [0.0; N];
    if N == 0 {
        return moments;
    }
    let end = if z == 0.0 { 1.0 } else { libm::exp(-z) };
    if z > 20.0 {
        moments[0] = (1.0 - end) / z;
        for k in 1..N {
            moments[k] = (k as f64 * moments[k - 1] - end) / z;
        }
        return moments;
    }
    // Kummer's form of the highest moment, e^(−z) Σ z^j / ((N)(N + 1)…(N + j)), has positive terms only, and
    // so has the recursion downwards.
    let mut term = 1.0 / N as f64;
    let mut sum = term;
    let mut next = (N + 1) as f64;
    while term > 1e-17 * sum {
        term *= z / next;
        sum += term;
        next += 1.0;
    }
    moments[N - 1] = end * sum;
    for k in (1..N).rev() {
        moments[k - 1] = (z * moments[k] + end) / k as f64;
    }
    moments
}

fn clamp01(x: f64) -> f64 {
    x.clamp(0.0, 1.0)
}
