//! Random choices from a seed.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{RngCore, SeedableRng};

/// One sequence of random choices, the same for the same seed on every machine.
pub(crate) struct Draw {
    rng: ChaCha8Rng,
}

impl Draw {
    /// A sequence for a seed; generators differ in their stream, so that they share no choices.
    pub(crate) fn new(seed: u64, stream: Stream) -> Self {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        rng.set_stream(stream as u64);
        Self { rng }
    }

    /// A whole number from 0 to `count - 1`; 0 for counts of 0 and 1.
    pub(crate) fn below(&mut self, count: usize) -> usize {
        // The bias of the product against a modulus is below count / 2^64.
        ((u128::from(self.rng.next_u64()) * count as u128) >> 64) as usize
    }

    /// A whole number from `low` to `high`, both included.
    pub(crate) fn between(&mut self, low: usize, high: usize) -> usize {
        low + self.below(high.saturating_sub(low) + 1)
    }

    /// A number from 0 to below 1, with 53 random bits.
    pub(crate) fn uniform(&mut self) -> f64 {
        (self.rng.next_u64() >> 11) as f64 * (1.0 / (1_u64 << 53) as f64)
    }

    /// A number from `low` to below `high`.
    pub(crate) fn uniform_between(&mut self, low: f64, high: f64) -> f64 {
        low + self.uniform() * (high - low)
    }
}

/// The sequences of a seed, one per generator; far from the streams that robots draw from.
#[derive(Clone, Copy)]
pub(crate) enum Stream {
    Rooms = 0x1000,
    Maze,
    Pillars,
    Caves,
    Rooms3d,
    Office3d,
    Pillars3d,
    Cave3d,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn choices_stay_in_range_and_reach_its_ends() {
        let mut draw = Draw::new(3, Stream::Rooms);
        let drawn: Vec<usize> = (0..1000).map(|_| draw.between(5, 9)).collect();
        assert_eq!(drawn.iter().min(), Some(&5));
        assert_eq!(drawn.iter().max(), Some(&9));
        assert_eq!((draw.below(1), draw.below(0)), (0, 0));
        assert!((0..1000).map(|_| draw.uniform()).all(|u| (0.0..1.0).contains(&u)));
    }
}
