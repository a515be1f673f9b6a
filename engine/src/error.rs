//! What can be wrong with a simulation's input, said once.

/// An input the engine refuses. Every message names the quantity, what it was and what would be right.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Error {
    /// A number lies outside the range in which it has a meaning.
    #[error("{what} is {value}, but must be {expected}")]
    OutOfRange {
        /// The quantity, in the user's words, with its unit, for example "charge mass [kg]".
        what: &'static str,
        /// What was given.
        value: f64,
        /// The range that would be right.
        expected: &'static str,
    },
    /// A table or mesh does not have the shape the engine needs.
    #[error("{0}")]
    Malformed(String),
    /// Each number of the scene has a meaning by itself, but what they lead to is beyond what numbers can hold.
    #[error(
        "{whose}: {what} is not finite at {time} s; bring the largest and smallest numbers of the scene nearer to real \
         ones"
    )]
    Overflow {
        /// The body, as "body 3" or "a piece of window 0".
        whose: String,
        /// What of it, in the user's words.
        what: &'static str,
        /// When [s].
        time: f64,
    },
    /// The caller asked the simulation to stop.
    #[error("stopped before the end")]
    Cancelled,
}

impl Error {
    /// The same of one thing among others: `whose` is put before what is wrong.
    pub(crate) fn about(self, whose: &str) -> Self {
        match self {
            Self::Cancelled => self,
            other => Self::Malformed(format!("{whose}: {other}")),
        }
    }
}

/// Shorthand for results of engine calls.
pub type Result<T> = core::result::Result<T, Error>;

/// Checks that `value` is finite and greater than zero.
pub(crate) fn positive(what: &'static str, value: f64) -> Result<f64> {
    if value.is_finite() && value > 0.0 {
        Ok(value)
    } else {
        Err(Error::OutOfRange { what, value, expected: "a finite number greater than 0" })
    }
}

/// Checks that `value` is finite and at least zero.
pub(crate) fn not_negative(what: &'static str, value: f64) -> Result<f64> {
    if value.is_finite() && value >= 0.0 {
        Ok(value)
    } else {
        Err(Error::OutOfRange { what, value, expected: "a finite number, 0 or greater" })
    }
}

/// Checks that `value` is a finite number.
pub(crate) fn finite(what: &'static str, value: f64) -> Result<f64> {
    if value.is_finite() {
        Ok(value)
    } else {
        Err(Error::OutOfRange { what, value, expected: "a finite number" })
    }
}
