//! A robot that winds around a sphere or a torus and sees the round before.

use std::f64::consts::{PI, TAU};

use pose::Se3;
use pose::nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};

use super::measure::{Noise, Synthetic, measure};

/// Parameters of a [`sphere`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// How often the robot goes round on its way from pole to pole.
    pub rounds: usize,
    /// Poses in each round.
    pub poses_per_round: usize,
    /// Radius, metres.
    pub radius_m: f64,
    /// Noise of every measurement.
    pub noise: Noise,
    /// Seed of the noise.
    pub seed: u64,
}

impl Default for Sphere {
    /// As large and as connected as the public sphere2500.
    fn default() -> Self {
        let noise = Noise { translation_m: 0.1, rotation_rad: 0.05 };
        Self { rounds: 50, poses_per_round: 50, radius_m: 50.0, noise, seed: 1 }
    }
}

/// A spiral from pole to pole, each pose measured from the one before and, one round later, from
/// the one beneath: `n - 1` odometry edges and `n - poses_per_round` closures.
pub fn sphere(params: &Sphere) -> Synthetic<Se3, 6> {
    let count = params.rounds * params.poses_per_round;
    let position = |k: f64| {
        // Half a step away from the poles, where directions end.
        let polar = PI * (k + 0.5) / count.max(1) as f64;
        let turn = TAU * k / params.poses_per_round.max(1) as f64;
        let (ring, height) = polar.sin_cos();
        (params.radius_m * Vector3::new(ring * turn.cos(), ring * turn.sin(), -height), turn)
    };
    let truth = along(count, |k| position(k).0, |k| position(k).0);
    measure(truth, &with_round_before(count, params.poses_per_round), &params.noise, params.seed)
}

/// Parameters of a [`torus`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Torus {
    /// How often the robot goes round the tube on its way round the hole.
    pub rounds: usize,
    /// Poses in each round.
    pub poses_per_round: usize,
    /// From the middle of the hole to the middle of the tube, metres.
    pub radius_m: f64,
    /// Radius of the tube, metres.
    pub tube_radius_m: f64,
    /// Noise of every measurement.
    pub noise: Noise,
    /// Seed of the noise.
    pub seed: u64,
}

impl Default for Torus {
    /// About as large as the public torus3D.
    fn default() -> Self {
        Self {
            rounds: 100,
            poses_per_round: 50,
            radius_m: 30.0,
            tube_radius_m: 10.0,
            noise: Noise { translation_m: 0.1, rotation_rad: 0.05 },
            seed: 1,
        }
    }
}

/// A spiral around the tube of a torus that comes back to where it started, each pose measured from
/// the one before and from the one beside it a round earlier; the last round from the first, too.
pub fn torus(params: &Torus) -> Synthetic<Se3, 6> {
    let count = params.rounds * params.poses_per_round;
    let angles =
        |k: f64| (TAU * k / count.max(1) as f64, TAU * k / params.poses_per_round.max(1) as f64);
    let normal = |k: f64| {
        let (around, tube) = angles(k);
        let ring = tube.cos();
        Vector3::new(ring * around.cos(), ring * around.sin(), tube.sin())
    };
    let position = |k: f64| {
        let around = angles(k).0;
        let middle = Vector3::new(around.cos(), around.sin(), 0.0) * params.radius_m;
        middle + normal(k) * params.tube_radius_m
    };
    let truth = along(count, position, normal);
    let mut pairs = with_round_before(count, params.poses_per_round);
    if params.rounds > 2 {
        let first_of_last = count - params.poses_per_round;
        pairs.extend((0..params.poses_per_round).map(|k| (k, first_of_last + k)));
    }
    measure(truth, &pairs, &params.noise, params.seed)
}

/// Poses on a curve: x along it, z along `outward` as far as x allows.
fn along(
    count: usize,
    position: impl Fn(f64) -> Vector3<f64>,
    outward: impl Fn(f64) -> Vector3<f64>,
) -> Vec<Se3> {
    const STEP: f64 = 1e-4;
    let pose = |k: usize| {
        let k = k as f64;
        let ahead = (position(k + STEP) - position(k - STEP)).normalize();
        let up = outward(k);
        let up = (up - ahead * ahead.dot(&up)).normalize();
        let axes = Matrix3::from_columns(&[ahead, up.cross(&ahead), up]);
        let rotation = Rotation3::from_matrix_unchecked(axes);
        let rotation = UnitQuaternion::from_rotation_matrix(&rotation);
        Se3::new(position(k), UnitQuaternion::new_normalize(rotation.into_inner()))
    };
    (0..count).map(pose).collect()
}

/// Each pose from the one before, then from the one a round earlier.
fn with_round_before(count: usize, round: usize) -> Vec<(usize, usize)> {
    let pairs = (1..count).flat_map(|k| {
        let below = k.checked_sub(round).filter(|_| round > 1);
        std::iter::once((k - 1, k)).chain(below.map(|below| (below, k)))
    });
    pairs.collect()
}
