//! When a crack comes by: from growth to time.

/// The speed of running cracks (5.6): v = v_max (1 − a_c / a), with a the length of the crack.
///
/// A crack of exactly the critical length a_c would never get away, so a nucleus is taken to be a little longer,
/// (1 + [`HEAD_START`]) a_c; v_max is 0.38 times the elastic wave speed, or a measured terminal speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CrackClock {
    /// Terminal speed [m/s], above 0.
    pub terminal_speed: f64,
    /// Critical length a_c [m]; 0 for cracks that run at their terminal speed from the start.
    pub critical_length: f64,
}

/// By how much of a_c a nucleus exceeds it.
pub const HEAD_START: f64 = 0.1;

impl CrackClock {
    /// Time that a crack needs to grow by `growth` [m] from its nucleus [s]: the integral of ds / v(s).
    pub fn time(&self, growth: f64) -> f64 {
        let critical = self.critical_length;
        if critical == 0.0 || growth <= 0.0 {
            return growth.max(0.0) / self.terminal_speed;
        }
        let start = HEAD_START * critical;
        (growth + critical * libm::log1p(growth / start)) / self.terminal_speed
    }

    /// Speed of a crack that has grown by `growth` [m] [m/s] (5.6).
    pub fn speed(&self, growth: f64) -> f64 {
        let length = self.critical_length * (1.0 + HEAD_START) + growth;
        if length == 0.0 {
            self.terminal_speed
        } else {
            self.terminal_speed * (1.0 - self.critical_length / length)
        }
    }
}
