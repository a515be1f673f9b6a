//! How many cases to try, and numbers to draw them from.
#![allow(dead_code)] // each test program uses its own part

use brisance_engine::random;

/// How many cases to try: `BRISANCE_CASES`, or `usual` where that is not set.
pub fn cases(usual: u64) -> u64 {
    std::env::var("BRISANCE_CASES").ok().map_or(usual, |count| count.parse().expect("a number of cases"))
}

/// Numbers drawn one after the other.
pub struct Draws {
    pub seed: u64,
    stream: u64,
    pub next: u64,
}

impl Draws {
    /// Each stream of a seed has numbers of its own.
    pub fn new(seed: u64, stream: u64) -> Self {
        Self { seed, stream, next: 0 }
    }

    pub fn unit(&mut self) -> f64 {
        self.next += 1;
        random::unit(self.seed, self.stream, self.next)
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Evenly on a logarithmic scale.
    pub fn scale(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.unit())
    }

    pub fn chance(&mut self, probability: f64) -> bool {
        self.unit() < probability
    }

    pub fn whole(&mut self, low: usize, high: usize) -> usize {
        low + (self.unit() * (high - low + 1) as f64) as usize
    }
}
