//! Odometry: which factors are trusted, and how well it knows one vertex from another.

use pose::nalgebra::{SMatrix, SVector};

use super::dense::{covariance, quadratic};
use crate::factors::{ErrorKind, Factor, FactorGraph, Manifold};

/// Whether each factor is a loop closure, which may be rejected.
///
/// All factors between neighbours in the order of vertices are trusted. Where a vertex has none to
/// the one before it, the first factor to the nearest earlier vertex is trusted, for something must
/// hold it. Factors that lead nowhere are no closures.
pub fn closures<P: Manifold<D>, const D: usize>(graph: &FactorGraph<P, D>) -> Vec<bool> {
    let count = graph.ids.len();
    let mut held_by: Vec<Option<(usize, usize)>> = vec![None; count];
    for (index, factor) in graph.factors.iter().enumerate() {
        let (earlier, later) = ends(factor);
        if leads(factor, count) && held_by[later].is_none_or(|(known, _)| earlier > known) {
            held_by[later] = Some((earlier, index));
        }
    }
    let mut closes: Vec<bool> = (graph.factors.iter())
        .map(|factor| leads(factor, count) && factor.from.abs_diff(factor.to) > 1)
        .collect();
    for (_, index) in held_by.into_iter().flatten() {
        closes[index] = false;
    }
    closes
}

fn leads<P: Manifold<D>, const D: usize>(factor: &Factor<P, D>, count: usize) -> bool {
    factor.from < count
        && factor.to < count
        && factor.from != factor.to
        && factor.from_from_to.is_finite()
}

fn ends<P, const D: usize>(factor: &Factor<P, D>) -> (usize, usize) {
    (factor.from.min(factor.to), factor.from.max(factor.to))
}

/// A loop closure, read from the earlier vertex to the later one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Closure<P, const D: usize> {
    pub low: usize,
    pub high: usize,
    low_from_high: P,
    /// Of the tangent at `high`.
    covariance: SMatrix<f64, D, D>,
}

impl<P: Manifold<D>, const D: usize> Closure<P, D> {
    /// `None` where the factor has no information.
    pub fn new(factor: &Factor<P, D>, kind: ErrorKind) -> Option<Self> {
        let own = tangent_covariance(factor, kind)?;
        let (low, high) = ends(factor);
        if factor.from == low {
            return Some(Self { low, high, low_from_high: factor.from_from_to, covariance: own });
        }
        let turned = factor.from_from_to.adjoint();
        let covariance = turned * own * turned.transpose();
        Some(Self { low, high, low_from_high: factor.from_from_to.inverse(), covariance })
    }
}

/// Covariance of the tangent at `to`, as the information matrix says.
fn tangent_covariance<P: Manifold<D>, const D: usize>(
    factor: &Factor<P, D>,
    kind: ErrorKind,
) -> Option<SMatrix<f64, D, D>> {
    let own = covariance(&factor.information)?;
    if D == 6 && kind == ErrorKind::G2o {
        // The vector part of a quaternion is half of the angle.
        let scale = SVector::<f64, D>::from_fn(|k, _| if k < 3 { 1.0 } else { 2.0 });
        let scale = SMatrix::from_diagonal(&scale);
        return Some(scale * own * scale);
    }
    Some(own)
}

/// How well two closures agree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Agreement {
    /// `eᵀ C⁻¹ e`.
    pub chi2: f64,
    /// `√det C`.
    pub spread: f64,
}

/// The chain of odometry with its spread: what it says of any two vertices costs the same.
pub(super) struct Chain<P, const D: usize> {
    poses: Vec<P>,
    inverses: Vec<SMatrix<f64, D, D>>,
    /// Covariance since the start, in the tangent of the map: sums along the chain.
    spread: Vec<SMatrix<f64, D, D>>,
    /// Changes where the chain is broken.
    segment: Vec<usize>,
}

impl<P: Manifold<D>, const D: usize> Chain<P, D> {
    pub fn new(graph: &FactorGraph<P, D>, kind: ErrorKind) -> Self {
        let count = graph.ids.len();
        let mut step: Vec<Option<usize>> = vec![None; count];
        for (index, factor) in graph.factors.iter().enumerate() {
            let (_, later) = ends(factor);
            if leads(factor, count) && factor.from.abs_diff(factor.to) == 1 && step[later].is_none()
            {
                step[later] = Some(index);
            }
        }
        let mut poses: Vec<P> = Vec::with_capacity(count);
        let mut spread: Vec<SMatrix<f64, D, D>> = Vec::with_capacity(count);
        let mut segment: Vec<usize> = Vec::with_capacity(count);
        for (vertex, step) in step.iter().enumerate() {
            let known = step.and_then(|index| {
                let factor = &graph.factors[index];
                Some((factor, tangent_covariance(factor, kind)?))
            });
            let Some((factor, own)) = known else {
                poses.push(P::identity());
                spread.push(SMatrix::zeros());
                segment.push(vertex);
                continue;
            };
            let before = poses[vertex - 1];
            let forward = factor.to == vertex;
            let pose = if forward {
                before.compose(&factor.from_from_to)
            } else {
                before.compose(&factor.from_from_to.inverse())
            };
            // Noise sits in the tangent of the vertex that the factor leads to.
            let turned = if forward { pose.adjoint() } else { before.adjoint() };
            spread.push(spread[vertex - 1] + turned * own * turned.transpose());
            poses.push(pose);
            segment.push(segment[vertex - 1]);
        }
        let inverses = poses.iter().map(|pose| pose.inverse().adjoint()).collect();
        Self { poses, inverses, spread, segment }
    }

    /// Whether odometry leads from one vertex to the other.
    pub fn joins(&self, a: usize, b: usize) -> bool {
        self.segment[a] == self.segment[b]
    }

    /// The relative pose of two vertices, and its covariance in the tangent at the second.
    fn between(&self, a: usize, b: usize) -> (P, SMatrix<f64, D, D>) {
        let (earlier, later) = (a.min(b), a.max(b));
        let spread = self.spread[later] - self.spread[earlier];
        let turned = &self.inverses[b];
        (self.poses[a].between(&self.poses[b]), turned * spread * turned.transpose())
    }

    /// `eᵀ C⁻¹ e` of the loop through two closures and the odometry between their ends, with the
    /// covariance `C` that the information matrices give it to first order (Mangelson et al. 2018,
    /// section IV).
    ///
    /// Infinite where `C` is singular. Odometry must join the ends.
    pub fn compare(&self, a: &Closure<P, D>, b: &Closure<P, D>) -> Agreement {
        let (first, first_spread) = self.between(a.low, b.low);
        let (last, last_spread) = self.between(b.high, a.high);
        let over = first.compose(&b.low_from_high).compose(&last);
        let error = a.low_from_high.local(&over);
        let rest = b.low_from_high.compose(&last).inverse().adjoint();
        let last_turned = last.inverse().adjoint();
        let covariance = a.covariance
            + rest * first_spread * rest.transpose()
            + last_turned * b.covariance * last_turned.transpose()
            + last_spread;
        let (chi2, spread) =
            quadratic(&covariance, &error).unwrap_or((f64::INFINITY, f64::INFINITY));
        Agreement { chi2, spread }
    }

    /// The poses along it, from the identity.
    pub fn poses(&self) -> &[P] {
        &self.poses
    }
}
