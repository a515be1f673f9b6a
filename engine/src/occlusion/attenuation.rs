//! From how well a body is hidden to how much of the blast it receives (thesis 4.1, Fig. 4.5).

use crate::error::{Result, not_negative, positive};

/// The attenuation f of blocking factor b and separation k,
///
/// `f = (1 − x^exponent)^power` with `x = b / (offset + slope k)`, and 0 for x ≥ 1.
///
/// The thesis's (4.1), `x³ − 2 x^1.5 + 1`, is this with exponent 1.5 and power 2. f is 1 with nothing in front. It
/// falls as b grows and rises as k grows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Attenuation {
    /// Blocking factor, in the thesis's pixels, that keeps everything off a body that touches its occluder; above
    /// 0, the thesis's is 1. More shelters less.
    pub offset: f64,
    /// By how much that blocking factor grows with the separation; 0 or more, the thesis's is 7. More lets the wave
    /// close sooner behind an occluder.
    pub slope: f64,
    /// Above 0, the thesis's is 1.5. More shelters less near the occluder's edge.
    pub exponent: f64,
    /// Above 0, the thesis's is 2. More shelters more.
    pub power: f64,
}

impl Attenuation {
    /// The thesis's own constants.
    pub const THESIS: Self = Self { offset: 1.0, slope: 7.0, exponent: 1.5, power: 2.0 };

    /// Share of the load that a body receives whose blocking factor is `blocking` and whose separation is
    /// `separation`, both 0 or more.
    pub fn factor(&self, blocking: f64, separation: f64) -> f64 {
        let x = blocking / (self.offset + self.slope * separation);
        if x >= 1.0 {
            return 0.0;
        }
        libm::pow(1.0 - libm::pow(x, self.exponent), self.power)
    }

    /// Checks the four numbers.
    ///
    /// # Errors
    /// [`Error::OutOfRange`](crate::Error::OutOfRange) for the first that has no meaning.
    pub fn validate(&self) -> Result<()> {
        positive("attenuation offset", self.offset)?;
        not_negative("attenuation slope", self.slope)?;
        positive("attenuation exponent", self.exponent)?;
        positive("attenuation power", self.power)?;
        Ok(())
    }
}

impl Default for Attenuation {
    fn default() -> Self {
        Self::THESIS
    }
}
