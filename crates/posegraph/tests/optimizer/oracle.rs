//! Random graphs, and the dense side of every comparison.

use std::fmt::Debug;

use pose::nalgebra::{DMatrix, DVector, SMatrix, SVector, UnitQuaternion, Vector3};
use pose::{Se2, Se3};
use posegraph::{ErrorKind, Factor, FactorGraph, Manifold, Options};

pub const KINDS: [ErrorKind; 3] = [ErrorKind::G2o, ErrorKind::Log, ErrorKind::Split];

/// Numbers in -1..1 from a seed (a linear congruential generator of Knuth's).
pub struct Draw(pub u64);

impl Draw {
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    pub fn below(&mut self, bound: usize) -> usize {
        ((0.5 * (self.unit() + 1.0) * bound as f64) as usize).min(bound - 1)
    }

    pub fn vector<const D: usize>(&mut self, size: f64) -> SVector<f64, D> {
        SVector::from_fn(|_, _| size * self.unit())
    }

    /// A positive definite matrix with condition number of at most about a thousand.
    pub fn information<const D: usize>(&mut self) -> SMatrix<f64, D, D> {
        let root = SMatrix::<f64, D, D>::from_fn(|_, _| self.unit());
        let information = root * root.transpose() + SMatrix::identity() * 0.1;
        (information + information.transpose()) * 10.0
    }
}

/// Poses that can be drawn.
pub trait Drawn<const D: usize>: Manifold<D> + Debug {
    fn drawn(draw: &mut Draw, translation_m: f64, rotation_rad: f64) -> Self;
}

impl Drawn<3> for Se2 {
    fn drawn(draw: &mut Draw, translation_m: f64, rotation_rad: f64) -> Self {
        let t = draw.vector::<2>(translation_m);
        Self::new(t.x, t.y, rotation_rad * draw.unit())
    }
}

impl Drawn<6> for Se3 {
    fn drawn(draw: &mut Draw, translation_m: f64, rotation_rad: f64) -> Self {
        let axis = draw.vector::<3>(1.0) + Vector3::new(0.0, 0.0, 1e-3);
        let rotation = axis.normalize() * (rotation_rad * draw.unit());
        Self::new(draw.vector(translation_m), UnitQuaternion::from_scaled_axis(rotation))
    }
}

/// A chain with closures: true poses, and measurements with a little noise.
pub fn graph<P: Drawn<D>, const D: usize>(
    seed: u64,
    vertices: usize,
    closures: usize,
    noise: f64,
) -> FactorGraph<P, D> {
    let draw = &mut Draw(seed);
    let mut poses = vec![P::identity()];
    for _ in 1..vertices {
        let last = *poses.last().unwrap();
        poses.push(last.compose(&P::drawn(draw, 2.0, 1.0)));
    }
    let mut pairs: Vec<(usize, usize)> = (1..vertices).map(|to| (to - 1, to)).collect();
    for _ in 0..closures {
        let (from, to) = (draw.below(vertices), draw.below(vertices));
        if from != to {
            pairs.push((from, to));
        }
    }
    let factors = pairs
        .into_iter()
        .map(|(from, to)| Factor {
            from,
            to,
            from_from_to: poses[from].between(&poses[to]).compose(&P::drawn(draw, noise, noise)),
            information: draw.information(),
        })
        .collect();
    let ids = (0..vertices as u64).map(|id| 10 * id + 3).collect();
    FactorGraph { ids, initial: vec![None; vertices], fixed: Vec::new(), factors }
}

/// Options that go on until rounding ends the progress.
pub fn exact(kind: ErrorKind) -> Options {
    Options { error: kind, relative_decrease: 1e-15, step: 1e-11, ..Options::default() }
}

/// Gauss-Newton on dense normal equations with Jacobians by central differences; vertex 0 is held.
pub fn dense_solution<P: Drawn<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    start: &[P],
    kind: ErrorKind,
) -> Vec<P> {
    let mut poses = start.to_vec();
    let unknowns = (poses.len() - 1) * D;
    for _ in 0..30 {
        let mut matrix = DMatrix::<f64>::zeros(unknowns, unknowns);
        let mut gradient = DVector::<f64>::zeros(unknowns);
        for factor in &graph.factors {
            let error =
                P::error(kind, &factor.from_from_to, &poses[factor.from], &poses[factor.to]);
            let mut jacobian = DMatrix::<f64>::zeros(D, unknowns);
            for vertex in [factor.from, factor.to].into_iter().filter(|&vertex| vertex > 0) {
                let by = central(|delta| {
                    let mut moved = poses.clone();
                    moved[vertex] = moved[vertex].retract(&delta);
                    P::error(kind, &factor.from_from_to, &moved[factor.from], &moved[factor.to])
                });
                jacobian.view_mut((0, (vertex - 1) * D), (D, D)).copy_from(&by);
            }
            let weighted = jacobian.transpose() * factor.information;
            gradient += &weighted * error;
            matrix += weighted * jacobian;
        }
        let step = matrix.cholesky().unwrap().solve(&-gradient);
        for (vertex, pose) in poses.iter_mut().enumerate().skip(1) {
            *pose = pose.retract(&SVector::from_fn(|k, _| step[(vertex - 1) * D + k]));
        }
        if step.amax() < 1e-12 {
            break;
        }
    }
    poses
}

/// The derivative of `f`, a function of a perturbation, at 0 by central differences.
pub fn central<const D: usize>(
    f: impl Fn(SVector<f64, D>) -> SVector<f64, D>,
) -> SMatrix<f64, D, D> {
    let step = 1e-5;
    SMatrix::from_columns(&std::array::from_fn::<_, D, _>(|column| {
        let mut delta = SVector::<f64, D>::zeros();
        delta[column] = step;
        (f(delta) - f(-delta)) / (2.0 * step)
    }))
}

/// The largest step between two sets of poses.
pub fn distance<P: Manifold<D>, const D: usize>(a: &[P], b: &[P]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| a.local(b).amax()).fold(0.0, f64::max)
}
