//! Random numbers without a state: each is a pure function of a seed, a stream and an index.
//!
//! Who draws, and in which order, then cannot change what another one gets; results do not depend on the number
//! of threads. The mixing is that of SplitMix64 (Steele, Lea & Flood 2014), applied once a key.

/// The golden ratio in 64 bits: keys that differ by one land far apart.
const GOLDEN: u64 = 0x9E37_79B9_7F4A_7C15;

/// A number from [0, 1), uniform, the `index`-th of a `stream`.
#[inline]
pub fn unit(seed: u64, stream: u64, index: u64) -> f64 {
    (hash(seed, stream, index) >> 11) as f64 * (1.0 / (1u64 << 53) as f64)
}

/// 64 random bits.
#[inline]
pub fn hash(seed: u64, stream: u64, index: u64) -> u64 {
    let keyed = mix(seed.wrapping_add(GOLDEN)) ^ mix(stream.wrapping_mul(GOLDEN).wrapping_add(1));
    mix(keyed.wrapping_add(index.wrapping_mul(GOLDEN)))
}

#[inline]
fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}
