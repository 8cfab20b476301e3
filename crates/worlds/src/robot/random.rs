//! Random numbers that depend on what they are for and on nothing else.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{RngCore, SeedableRng};

/// What a random number is for: each purpose has a stream of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Purpose {
    Odometry,
    Range,
    Recall,
    FalsePositive,
    RelativePose,
    Repeat,
    Yaw,
    Depth,
}

/// The seed of a run, from which every draw follows.
///
/// A draw is named by its purpose, a count (forward motions, marks, scans, repeated legs) and an
/// item within the count. ChaCha can be entered anywhere, so a draw costs the same whatever came
/// before, and two robots that differ in all else meet the same noise at the same count.
#[derive(Clone, Debug)]
pub(crate) struct Streams {
    root: ChaCha8Rng,
}

impl Streams {
    pub(crate) fn new(seed: u64) -> Self {
        Self { root: ChaCha8Rng::seed_from_u64(seed) }
    }

    /// The draw for one purpose, count and item (both below 2³²).
    pub(crate) fn draw(&self, purpose: Purpose, count: u64, item: u64) -> Draw {
        let mut rng = self.root.clone();
        rng.set_stream(1 + purpose as u64);
        // Positions count 32-bit words and have 68 bits: 2³² counts of 2³² items of 16 words,
        // which is one ChaCha block and serves two calls of `normals3`.
        let count = u128::from(count & 0xffff_ffff);
        let item = u128::from(item & 0xffff_ffff);
        rng.set_word_pos((count << 36) | (item << 4));
        Draw { rng }
    }
}

/// The numbers of one draw.
pub(crate) struct Draw {
    rng: ChaCha8Rng,
}

impl Draw {
    /// Uniform in [0, 1), with 53 random bits.
    pub(crate) fn uniform(&mut self) -> f64 {
        (self.rng.next_u64() >> 11) as f64 * (1.0 / (1u64 << 53) as f64)
    }

    /// Two independent standard normals (Box and Muller's transform).
    pub(crate) fn normals2(&mut self) -> [f64; 2] {
        // 1 - u lies in (0, 1], so the logarithm is finite.
        let radius = (-2.0 * (1.0 - self.uniform()).ln()).sqrt();
        let (sin, cos) = (std::f64::consts::TAU * self.uniform()).sin_cos();
        [radius * cos, radius * sin]
    }

    /// Three independent standard normals.
    pub(crate) fn normals3(&mut self) -> [f64; 3] {
        let [a, b] = self.normals2();
        let [c, _] = self.normals2();
        [a, b, c]
    }
}
