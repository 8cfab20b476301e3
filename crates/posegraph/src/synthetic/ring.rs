//! One large loop.

use std::f64::consts::{FRAC_PI_2, TAU};

use pose::Se2;

use super::measure::{Noise, Synthetic, measure};

/// Parameters of a [`ring`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ring {
    /// Number of poses.
    pub poses: usize,
    /// Radius, metres.
    pub radius_m: f64,
    /// Noise of every measurement.
    pub noise: Noise,
    /// Seed of the noise.
    pub seed: u64,
}

impl Default for Ring {
    fn default() -> Self {
        let noise = Noise { translation_m: 0.05, rotation_rad: 0.01 };
        Self { poses: 400, radius_m: 60.0, noise, seed: 1 }
    }
}

/// A circle in the plane, counter-clockwise, closed by one edge from the last pose to the first.
pub fn ring(params: &Ring) -> Synthetic<Se2, 3> {
    let count = params.poses;
    let pose = |k: usize| {
        let turn = TAU * k as f64 / count as f64;
        Se2::new(params.radius_m * turn.cos(), params.radius_m * turn.sin(), turn + FRAC_PI_2)
    };
    let mut pairs: Vec<(usize, usize)> = (1..count).map(|k| (k - 1, k)).collect();
    if count > 2 {
        pairs.push((count - 1, 0));
    }
    measure((0..count).map(pose).collect(), &pairs, &params.noise, params.seed)
}
