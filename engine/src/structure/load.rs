//! Forces that act on a structure over time.

use crate::error::{Error, Result, finite, positive};

/// A force as a function of time [s], from 0 on.
pub trait Load {
    /// Force [N] at `time` [s]; where it jumps, the value from then on.
    fn force(&self, time: f64) -> f64;

    /// Force [N] just before `time` [s]: differs from [`Load::force`] only where the load jumps.
    fn force_before(&self, time: f64) -> f64 {
        self.force(time)
    }

    /// Times [s], rising, at which the force jumps or bends; steps of the integration end there.
    fn breaks(&self) -> Vec<f64> {
        Vec::new()
    }

    /// Time [s] after which the force no longer changes.
    fn end(&self) -> f64;
}

/// The usual idealised pulses, with their peak at time 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Pulse {
    /// `F` for `duration`, then nothing; an infinite duration is a load put on and left.
    Step {
        /// Force [N].
        peak: f64,
        /// Duration [s], above 0.
        duration: f64,
    },
    /// Falls evenly from `F` to nothing.
    Triangle {
        /// Peak force [N].
        peak: f64,
        /// Duration [s], above 0.
        duration: f64,
    },
    /// `F (1 − t/T) e^(−b t/T)`: the shape of a blast, without its suction.
    Friedlander {
        /// Peak force [N].
        peak: f64,
        /// Duration `T` [s], above 0.
        duration: f64,
        /// Decay `b`, 0 or more.
        decay: f64,
    },
}

impl Pulse {
    /// Peak force [N].
    pub fn peak(&self) -> f64 {
        match *self {
            Pulse::Step { peak, .. } | Pulse::Triangle { peak, .. } | Pulse::Friedlander { peak, .. } => peak,
        }
    }

    /// Duration [s].
    pub fn duration(&self) -> f64 {
        match *self {
            Pulse::Step { duration, .. }
            | Pulse::Triangle { duration, .. }
            | Pulse::Friedlander { duration, .. } => duration,
        }
    }

    /// The same shape with another peak [N] and duration [s].
    pub fn scaled(&self, peak: f64, duration: f64) -> Pulse {
        match *self {
            Pulse::Step { .. } => Pulse::Step { peak, duration },
            Pulse::Triangle { .. } => Pulse::Triangle { peak, duration },
            Pulse::Friedlander { decay, .. } => Pulse::Friedlander { peak, duration, decay },
        }
    }

    /// Impulse [N s] of the whole pulse.
    pub fn impulse(&self) -> f64 {
        let area = match *self {
            Pulse::Step { .. } => 1.0,
            Pulse::Triangle { .. } => 0.5,
            Pulse::Friedlander { decay, .. } if decay < 1e-4 => 0.5 - decay / 6.0,
            Pulse::Friedlander { decay, .. } => (decay - 1.0 + libm::exp(-decay)) / (decay * decay),
        };
        area * self.peak() * self.duration()
    }

    /// Checks that the peak is finite, the duration above 0 (infinite only for a step) and the decay not
    /// negative.
    pub fn validate(&self) -> Result<()> {
        finite("peak force [N]", self.peak())?;
        let endless = matches!(self, Pulse::Step { .. }) && self.duration() == f64::INFINITY;
        if !endless {
            positive("duration of the pulse [s]", self.duration())?;
        }
        if let Pulse::Friedlander { decay, .. } = *self {
            crate::error::not_negative("decay of the pulse", decay)?;
        }
        Ok(())
    }
}

impl Load for Pulse {
    fn force(&self, time: f64) -> f64 {
        if time >= self.duration() { 0.0 } else { self.force_before(time) }
    }

    fn force_before(&self, time: f64) -> f64 {
        if time > self.duration() {
            return 0.0;
        }
        match *self {
            Pulse::Step { peak, .. } => peak,
            Pulse::Triangle { peak, duration } => peak * (1.0 - time / duration),
            Pulse::Friedlander { peak, duration, decay } => {
                peak * (1.0 - time / duration) * libm::exp(-decay * time / duration)
            }
        }
    }

    fn breaks(&self) -> Vec<f64> {
        if self.duration().is_finite() { vec![self.duration()] } else { Vec::new() }
    }

    fn end(&self) -> f64 {
        if self.duration().is_finite() { self.duration() } else { 0.0 }
    }
}

/// Forces at given times, straight lines between them; nothing before the first and after the last.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadTable {
    time: Vec<f64>,
    force: Vec<f64>,
}

impl LoadTable {
    /// Times [s], from 0 on and rising, and forces [N]; two rows or more.
    pub fn new(time: Vec<f64>, force: Vec<f64>) -> Result<LoadTable> {
        if time.len() < 2 || time.len() != force.len() {
            return Err(Error::Malformed(format!(
                "the load has {} times and {} forces, but must have two or more and as many of each",
                time.len(),
                force.len()
            )));
        }
        for value in time.iter().chain(&force) {
            finite("a number of the load's table", *value)?;
        }
        if time[0] < 0.0 || time.windows(2).any(|pair| pair[1] <= pair[0]) {
            return Err(Error::Malformed("the times of the load must rise from 0 on".into()));
        }
        Ok(LoadTable { time, force })
    }
}

impl Load for LoadTable {
    fn force(&self, time: f64) -> f64 {
        let last = self.time.len() - 1;
        if time < self.time[0] || time >= self.time[last] { 0.0 } else { self.force_before(time) }
    }

    fn force_before(&self, time: f64) -> f64 {
        let last = self.time.len() - 1;
        if time < self.time[0] || time > self.time[last] || (time == self.time[0] && time > 0.0) {
            return 0.0;
        }
        let upper = self.time.partition_point(|at| *at <= time).clamp(1, last);
        let (start, end) = (self.time[upper - 1], self.time[upper]);
        let part = (time - start) / (end - start);
        self.force[upper - 1] + part * (self.force[upper] - self.force[upper - 1])
    }

    fn breaks(&self) -> Vec<f64> {
        self.time.clone()
    }

    fn end(&self) -> f64 {
        self.time[self.time.len() - 1]
    }
}
