//! Pairs of true poses to a noisy graph.

use pose::nalgebra::{SMatrix, SVector};
use pose::{Se2, Se3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{RngCore, SeedableRng};

use crate::factors::{Factor, FactorGraph, Manifold};
use crate::initial;

/// Standard deviations of a measured relative pose.
///
/// At most 1e-9 counts as 1e-9, so that information stays finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noise {
    /// Of each axis of the translation, metres.
    pub translation_m: f64,
    /// Of the rotation around each axis, radians.
    pub rotation_rad: f64,
}

/// A made-up graph and the poses behind it.
#[derive(Clone, Debug, PartialEq)]
pub struct Synthetic<P, const D: usize> {
    /// The graph; its start values are the chained odometry.
    pub graph: FactorGraph<P, D>,
    /// `map_from_body` of every vertex, as it truly was.
    pub truth: Vec<P>,
}

/// Seeded random numbers of one purpose.
pub(super) struct Draw(ChaCha8Rng);

impl Draw {
    pub fn new(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    /// A number in 0..1.
    pub fn uniform(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 * (-53_f64).exp2()
    }

    /// One of 0..count.
    pub fn below(&mut self, count: usize) -> usize {
        ((self.uniform() * count as f64) as usize).min(count.saturating_sub(1))
    }

    /// A number of the standard normal distribution (Box and Muller 1958).
    pub fn normal(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.uniform()).ln()).sqrt();
        radius * (std::f64::consts::TAU * self.uniform()).cos()
    }
}

/// What a dimension says about noise.
pub(super) trait Measured<const D: usize>: Manifold<D> {
    /// Standard deviation of each tangent coordinate.
    fn deviations(noise: &Noise) -> SVector<f64, D>;
    /// How much larger a tangent coordinate is than that of g2o's error.
    fn scale() -> SVector<f64, D>;
}

impl Measured<3> for Se2 {
    fn deviations(noise: &Noise) -> SVector<f64, 3> {
        SVector::from([noise.translation_m, noise.translation_m, noise.rotation_rad])
    }

    fn scale() -> SVector<f64, 3> {
        SVector::repeat(1.0)
    }
}

impl Measured<6> for Se3 {
    fn deviations(noise: &Noise) -> SVector<f64, 6> {
        let (t, r) = (noise.translation_m, noise.rotation_rad);
        SVector::from([t, t, t, r, r, r])
    }

    fn scale() -> SVector<f64, 6> {
        // The vector part of a quaternion is half of the angle.
        SVector::from([1.0, 1.0, 1.0, 2.0, 2.0, 2.0])
    }
}

/// Measures each pair; ids count up from 0.
pub(super) fn measure<P: Measured<D>, const D: usize>(
    truth: Vec<P>,
    pairs: &[(usize, usize)],
    noise: &Noise,
    seed: u64,
) -> Synthetic<P, D> {
    const LEAST: f64 = 1e-9;
    let mut draw = Draw::new(seed);
    let deviations = P::deviations(noise).map(|deviation| deviation.max(LEAST));
    let weights = P::scale().component_div(&deviations).map(|weight| weight * weight);
    let information = SMatrix::from_diagonal(&weights);
    let factors = pairs.iter().map(|&(from, to)| {
        let drawn = SVector::<f64, D>::from_fn(|_, _| draw.normal()).component_mul(&deviations);
        let from_from_to = truth[from].between(&truth[to]).retract(&drawn);
        Factor { from, to, from_from_to, information }
    });
    let factors = factors.collect();
    let mut initial = vec![None; truth.len()];
    if let (Some(slot), Some(first)) = (initial.first_mut(), truth.first()) {
        *slot = Some(*first);
    }
    let ids = (0..truth.len() as u64).collect();
    let mut graph = FactorGraph { ids, initial, fixed: Vec::new(), factors };
    graph.initial = initial::odometry(&graph).into_iter().map(Some).collect();
    Synthetic { graph, truth }
}
