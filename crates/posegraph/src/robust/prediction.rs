//! What the rest of the graph says of a closure.

use pose::nalgebra::{SMatrix, SVector};

use super::believed::Believed;
use super::dense::{cholesky, quadratic};
use crate::factors::{Factor, Manifold};
use crate::marginals::{JointCovariance, Marginals};

/// Information that the rest of the graph has at least, as a share of that of the closure: what only the
/// closure itself knows cannot be held against it.
const LEAST: f64 = 1e-9;

/// A closure held against what is predicted without it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Prediction {
    /// Index of the factor.
    pub index: usize,
    /// `eᵀ S⁻¹ e` of the error without the closure: by how much it raises the cost of all, to first order.
    pub chi2: f64,
    /// `√det S`.
    pub spread: f64,
    /// How many times as far as the closure the prediction may be off, as a mean over the axes.
    pub looseness: f64,
}

/// Predicts every closure from the factors that weigh something, itself left out.
///
/// `S` is the covariance of the prediction plus that of the closure, in units of the information
/// matrices. A closure that is certainly beyond `limit` has a lower bound of its `χ²`. `None` where the
/// graph leaves something undetermined. Cost: one factorisation and one pass over its inverse, and
/// the way to the root for each closure without weight that is not far off.
pub(super) fn predictions<P: Manifold<D>, const D: usize>(
    believed: &Believed<P, D>,
    poses: &[P],
    weights: &[f64],
    limit: f64,
) -> Option<Vec<Prediction>> {
    let kind = believed.options.error;
    let (graph, ..) = believed.part(weights);
    let marginals = Marginals::new(&graph, poses, kind).ok()?;
    let closures: Vec<usize> = believed.closures().collect();
    let ends: Vec<(usize, usize)> = closures
        .iter()
        .map(|&index| (believed.graph.factors[index].from, believed.graph.factors[index].to))
        .collect();
    let joints = marginals.of_joined(&ends);
    let each = closures.iter().zip(joints).filter_map(|(&index, joint)| {
        let mut joint = joint?;
        let factor = &believed.graph.factors[index];
        let seen = Seen::new(factor, &poses[factor.from], &poses[factor.to], kind)?;
        if weights[index] > 0.0 {
            return Some(seen.without_itself(index, &joint));
        }
        let far = seen.at_least(index, &joint);
        if far.chi2 > limit {
            return Some(far);
        }
        joint = marginals.joint(factor.from, factor.to)?;
        Some(seen.beside(index, &joint))
    });
    Some(each.collect())
}

/// A closure in coordinates in which its own covariance is the identity.
struct Seen<const D: usize> {
    error: SVector<f64, D>,
    by_from: SMatrix<f64, D, D>,
    by_to: SMatrix<f64, D, D>,
    /// `√det` of its own covariance.
    spread: f64,
}

impl<const D: usize> Seen<D> {
    /// `None` where it has no information.
    fn new<P: Manifold<D>>(
        factor: &Factor<P, D>,
        from: &P,
        to: &P,
        kind: crate::ErrorKind,
    ) -> Option<Self> {
        let information = &factor.information;
        let largest = (0..D).map(|k| information[(k, k)]).fold(0.0, f64::max);
        let floor = SMatrix::<f64, D, D>::identity() * (1e-9 * largest);
        let lower = cholesky(information).or_else(|| cholesky(&(information + floor)))?;
        let linear = P::linearize(kind, &factor.from_from_to, from, to);
        let spread: f64 = (0..D).map(|k| 1.0 / lower[(k, k)]).product();
        Some(Self {
            error: lower.tr_mul(&linear.error),
            by_from: lower.tr_mul(&linear.by_from),
            by_to: lower.tr_mul(&linear.by_to),
            spread,
        })
    }

    /// Covariance of the error by that of the poses.
    fn covariance(&self, joint: &JointCovariance<D>) -> SMatrix<f64, D, D> {
        let cross = self.by_to * joint.b_a * self.by_from.transpose();
        self.alone(joint, 1.0) + cross + cross.transpose()
    }

    /// The same without the correlation of the poses.
    fn alone(&self, joint: &JointCovariance<D>, times: f64) -> SMatrix<f64, D, D> {
        (self.by_from * joint.a_a * self.by_from.transpose()
            + self.by_to * joint.b_b * self.by_to.transpose())
            * times
    }

    /// Of a closure that took part: with `M = 1 - Σ` its error without itself is `M⁻¹ e`, of
    /// covariance `M⁻¹`.
    fn without_itself(&self, index: usize, joint: &JointCovariance<D>) -> Prediction {
        let rest = SMatrix::identity() - self.covariance(joint);
        let rest = (rest + rest.transpose()) * 0.5 + SMatrix::identity() * LEAST;
        match quadratic(&rest, &self.error) {
            Some((chi2, root)) => self.told(index, chi2, 1.0 / root),
            None => self.told(index, 0.0, f64::INFINITY),
        }
    }

    /// Of a closure that took no part.
    fn beside(&self, index: usize, joint: &JointCovariance<D>) -> Prediction {
        self.against(index, &(SMatrix::identity() + self.covariance(joint)))
    }

    /// A lower bound of the same: a difference varies at most twice as much as both alone.
    fn at_least(&self, index: usize, joint: &JointCovariance<D>) -> Prediction {
        self.against(index, &(SMatrix::identity() + self.alone(joint, 2.0)))
    }

    fn against(&self, index: usize, covariance: &SMatrix<f64, D, D>) -> Prediction {
        let covariance = (covariance + covariance.transpose()) * 0.5;
        match quadratic(&covariance, &self.error) {
            Some((chi2, root)) => self.told(index, chi2, root),
            None => self.told(index, self.error.norm_squared(), 1.0),
        }
    }

    /// `root` is `√det S` where the covariance of the closure is 1.
    fn told(&self, index: usize, chi2: f64, root: f64) -> Prediction {
        let looseness = root.powf(1.0 / D as f64);
        Prediction { index, chi2, spread: self.spread * root, looseness }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::factors::FactorGraph;
    use crate::initial::odometry;
    use crate::solvers::{Options, optimize_weighted};
    use crate::synthetic::{Lattice, lattice, manhattan};

    /// By how much each closure raises the cost of all, by optimising without it.
    fn hold_to_trials<P: Manifold<D>, const D: usize>(graph: &FactorGraph<P, D>) {
        let believed = Believed::new(graph, &Options::default());
        let solve = |weights: &[f64]| {
            let start = odometry(graph);
            optimize_weighted(graph, &start, weights, &Options::default(), &mut probe::Off)
        };
        let all = solve(&believed.trusting);
        let inside = predictions(&believed, &all.poses, &believed.trusting, f64::INFINITY).unwrap();
        for own in inside.iter().step_by(7) {
            let mut weights = believed.trusting.clone();
            weights[own.index] = 0.0;
            let without = solve(&weights);
            let raised = all.report.cost - without.report.cost;
            assert!((own.chi2 - raised).abs() < 0.05 * raised + 0.02, "{} {raised}", own.chi2);
            let outside = predictions(&believed, &without.poses, &weights, f64::INFINITY).unwrap();
            let same = outside.iter().find(|other| other.index == own.index).unwrap();
            assert!((same.chi2 - raised).abs() < 0.05 * raised + 0.02, "{} {raised}", same.chi2);
            assert!((same.spread / own.spread - 1.0).abs() < 0.05);
            let bounded = predictions(&believed, &without.poses, &weights, 0.0).unwrap();
            let bounded = bounded.iter().find(|other| other.index == own.index).unwrap();
            assert!(bounded.chi2 <= same.chi2 * (1.0 + 1e-9));
        }
    }

    #[test]
    fn a_closure_in_the_plane_raises_the_cost_by_what_is_predicted() {
        hold_to_trials(&manhattan(150, 3).graph);
    }

    #[test]
    fn a_closure_in_space_raises_the_cost_by_what_is_predicted() {
        hold_to_trials(&lattice(&Lattice { side: 4, ..Lattice::default() }).graph);
    }
}
