//! Graphs that several tests use.

use pose::nalgebra::{Matrix3, Matrix6, UnitQuaternion, Vector3};
use pose::{Se2, Se3};
use posegraph::{Factor, FactorGraph, FactorGraph2, FactorGraph3};

pub fn graph<P: Copy, const D: usize>(
    count: usize,
    factors: Vec<Factor<P, D>>,
) -> FactorGraph<P, D> {
    FactorGraph {
        ids: (0..count as u64).collect(),
        initial: vec![None; count],
        fixed: Vec::new(),
        factors,
    }
}

/// Numbers in (-1, 1) that a seed fixes.
pub struct Numbers(pub u64);

impl Numbers {
    pub fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 11) as f64 / (1u64 << 52) as f64) - 1.0
    }
}

/// A ring whose poses turn once on the way round, measured without noise; translations weigh little.
pub fn ring2(count: usize) -> FactorGraph2 {
    let step = Se2::new(1.0, 0.0, std::f64::consts::TAU / count as f64);
    let information = Matrix3::from_diagonal(&Vector3::new(1e-3, 1e-3, 50.0));
    let factors = (0..count)
        .map(|k| Factor { from: k, to: (k + 1) % count, from_from_to: step, information })
        .collect();
    graph(count, factors)
}

/// The same in space.
pub fn ring3(count: usize) -> FactorGraph3 {
    let turn = UnitQuaternion::from_euler_angles(0.0, 0.0, std::f64::consts::TAU / count as f64);
    let step = Se3::new(Vector3::new(1.0, 0.0, 0.0), turn);
    let information = Matrix6::from_diagonal(&[1e-3, 1e-3, 1e-3, 50.0, 50.0, 50.0].into());
    let factors = (0..count)
        .map(|k| Factor { from: k, to: (k + 1) % count, from_from_to: step, information })
        .collect();
    graph(count, factors)
}

/// A small noisy graph of the plane, full information matrices, and its true poses.
pub fn noisy2(count: usize, closures: usize, noise: f64, seed: u64) -> (FactorGraph2, Vec<Se2>) {
    let mut numbers = Numbers(seed);
    let truth: Vec<Se2> = (0..count)
        .map(|_| Se2::new(4.0 * numbers.next(), 4.0 * numbers.next(), 3.0 * numbers.next()))
        .collect();
    let mut pairs: Vec<(usize, usize)> = (1..count).map(|k| (k - 1, k)).collect();
    for _ in 0..closures {
        let a = (numbers.next().abs() * count as f64) as usize;
        let b = (numbers.next().abs() * count as f64) as usize;
        if a != b {
            pairs.push((a, b));
        }
    }
    let factors = pairs
        .into_iter()
        .map(|(from, to)| {
            let error = Vector3::from_fn(|_, _| noise * numbers.next());
            let root = Matrix3::from_fn(|row, column| {
                (if row == column { 2.0 } else { 0.0 }) + 0.5 * numbers.next()
            });
            let from_from_to = truth[from].inverse_mul(&truth[to]).boxplus(&error);
            Factor { from, to, from_from_to, information: root.transpose() * root }
        })
        .collect();
    (graph(count, factors), truth)
}

/// A small noisy graph of space and its true poses.
pub fn noisy3(count: usize, closures: usize, noise: f64, seed: u64) -> (FactorGraph3, Vec<Se3>) {
    let mut numbers = Numbers(seed);
    let truth: Vec<Se3> = (0..count).map(|_| anywhere(&mut numbers)).collect();
    let mut pairs: Vec<(usize, usize)> = (1..count).map(|k| (k - 1, k)).collect();
    for _ in 0..closures {
        let a = (numbers.next().abs() * count as f64) as usize;
        let b = (numbers.next().abs() * count as f64) as usize;
        if a != b {
            pairs.push((a, b));
        }
    }
    let factors = pairs
        .into_iter()
        .map(|(from, to)| {
            let error = pose::nalgebra::Vector6::from_fn(|_, _| noise * numbers.next());
            let root = Matrix6::from_fn(|row, column| {
                (if row == column { 2.0 } else { 0.0 }) + 0.3 * numbers.next()
            });
            let from_from_to = truth[from].inverse_mul(&truth[to]).boxplus(&error);
            Factor { from, to, from_from_to, information: root.transpose() * root }
        })
        .collect();
    (graph(count, factors), truth)
}

/// A pose anywhere within a few metres.
pub fn anywhere(numbers: &mut Numbers) -> Se3 {
    let translation = Vector3::from_fn(|_, _| 4.0 * numbers.next());
    let turn = Vector3::from_fn(|_, _| 1.8 * numbers.next());
    Se3::new(translation, UnitQuaternion::from_scaled_axis(turn))
}
