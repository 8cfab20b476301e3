//! Whether a solution can be believed.

use pose::nalgebra::Vector3;

use crate::factors::{FactorGraph, InformationPolicy};
use crate::solvers::Solution;
use crate::synchronize::Rigid;

/// A loop whose rotation errors add up to more than this, about each axis that a rotation has, may be
/// wound once too often: with the same measurements the sum could as well be a full turn less.
const LOOP_RAD: f64 = std::f64::consts::FRAC_PI_2;

/// Where errors around no loop add up to more than this, about each axis, a cost that is too high speaks
/// against the information matrices and not against the solution: every other valley winds around
/// some loop once more or less, and where rotations are right, translations are a linear problem.
const SURE_RAD: f64 = LOOP_RAD / 8.0;

/// `χ²` may exceed its expectation by so many standard deviations.
const DEVIATIONS: f64 = 5.0;

/// Why a solution is not believed at once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Doubt {
    /// The optimiser did not converge.
    NotConverged,
    /// `χ²` is larger than the information matrices can explain, and rotation errors around some loop
    /// are more than next to nothing.
    Cost {
        /// `χ²` of the solution.
        chi2: f64,
        /// At most this is plausible: the degrees of freedom and five standard deviations.
        limit: f64,
    },
    /// The rotation errors around a loop add up to more than noise should.
    Loop {
        /// Index of the factor that closes the loop.
        factor: usize,
        /// Length of the sum, radians.
        sum_rad: f64,
        /// At most this is plausible.
        limit_rad: f64,
    },
}

/// What speaks for and against a solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Judgement {
    /// Measured numbers minus unknowns.
    pub degrees_of_freedom: usize,
    /// `χ²` for each degree of freedom; 1 where the information matrices are right.
    pub chi2_per_degree: f64,
    /// The largest sum of rotation errors around a loop, radians.
    pub loop_rad: f64,
    /// The first doubt, if any.
    pub doubt: Option<Doubt>,
}

/// From this share of its expectation on, `χ²` tells that the information matrices are right.
const CALIBRATED: f64 = 0.8;

impl Judgement {
    /// Whether there is no doubt.
    pub(super) fn is_believed(&self) -> bool {
        self.doubt.is_none()
    }

    /// Whether noise explains a solution: there is no doubt, or `χ²` is about what noise leaves. Then
    /// errors around a loop may add up to much, and steps that still circle are in the right valley.
    ///
    /// With few degrees of freedom noise explains so much that this tells nothing: a solution that winds
    /// around a loop once too often may have twice the cost of the right one and pass.
    pub(super) fn is_explained(&self) -> bool {
        let spread = DEVIATIONS * (2.0 / self.degrees_of_freedom.max(1) as f64).sqrt();
        let tells = spread <= 1.0 - CALIBRATED;
        let plausible = CALIBRATED..=1.0 + spread;
        self.doubt.is_none() || tells && plausible.contains(&self.chi2_per_degree)
    }
}

/// Judges a solution by what needs no factorisation; linear in vertices and factors.
pub fn judge<P: Rigid<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    solution: &Solution<P>,
) -> Judgement {
    let report = &solution.report;
    let used = graph.factors.len() - report.information.left_out.len();
    let free = graph.ids.len().saturating_sub(report.held.len());
    let degrees = (D * used).saturating_sub(D * free);
    let limit = degrees as f64 + DEVIATIONS * (2.0 * degrees as f64).sqrt();
    let (factor, sum_rad) = worst_loop(graph, &report.information, &solution.poses);
    let axes = (if P::DIM == 2 { 1.0 } else { 3.0_f64 }).sqrt();
    let limit_rad = LOOP_RAD * axes;
    let doubt = if !report.termination.is_converged() {
        Some(Doubt::NotConverged)
    } else if report.chi2 > limit && sum_rad > SURE_RAD * axes {
        Some(Doubt::Cost { chi2: report.chi2, limit })
    } else if sum_rad > limit_rad {
        Some(Doubt::Loop { factor, sum_rad, limit_rad })
    } else {
        None
    };
    let chi2_per_degree = report.chi2 / degrees.max(1) as f64;
    Judgement { degrees_of_freedom: degrees, chi2_per_degree, loop_rad: sum_rad, doubt }
}

/// The factor whose loop through a breadth-first tree has the largest sum of rotation errors, in the
/// frame of the map, and the length of that sum.
///
/// What two branches of the tree share cancels, so each loop is summed by its own edges. Cost: linear.
fn worst_loop<P: Rigid<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    policy: &InformationPolicy,
    poses: &[P],
) -> (usize, f64) {
    let count = graph.ids.len();
    let errors: Vec<Vector3<f64>> = (graph.factors.iter())
        .enumerate()
        .map(|(index, factor)| {
            if policy.left_out.binary_search(&index).is_ok() {
                return Vector3::zeros();
            }
            let expected = poses[factor.from].compose(&factor.from_from_to);
            P::turn_between(&expected, &poses[factor.to])
        })
        .collect();
    let tree = Tree::new(graph, policy);
    let mut along = vec![Vector3::zeros(); count];
    for &(vertex, parent, factor) in &tree.steps {
        let forward = graph.factors[factor].from == parent;
        along[vertex] = along[parent] + if forward { errors[factor] } else { -errors[factor] };
    }
    let mut worst = (0, 0.0);
    for (index, factor) in graph.factors.iter().enumerate() {
        if policy.left_out.binary_search(&index).is_err() {
            let sum = (along[factor.from] + errors[index] - along[factor.to]).norm();
            if sum > worst.1 {
                worst = (index, sum);
            }
        }
    }
    worst
}

/// A breadth-first forest: each vertex but the roots with its parent and the factor between, parents
/// first.
struct Tree {
    steps: Vec<(usize, usize, usize)>,
}

impl Tree {
    fn new<P: Rigid<D>, const D: usize>(
        graph: &FactorGraph<P, D>,
        policy: &InformationPolicy,
    ) -> Self {
        let count = graph.ids.len();
        let used = |index: &usize| policy.left_out.binary_search(index).is_err();
        let mut starts = vec![0usize; count + 1];
        for index in (0..graph.factors.len()).filter(used) {
            starts[graph.factors[index].from + 1] += 1;
            starts[graph.factors[index].to + 1] += 1;
        }
        for v in 0..count {
            starts[v + 1] += starts[v];
        }
        let mut next = starts.clone();
        let mut beside = vec![(0usize, 0usize); starts[count]];
        for index in (0..graph.factors.len()).filter(used) {
            let factor = &graph.factors[index];
            for (a, b) in [(factor.from, factor.to), (factor.to, factor.from)] {
                beside[next[a]] = (b, index);
                next[a] += 1;
            }
        }
        let mut steps = Vec::with_capacity(count);
        let mut seen = vec![false; count];
        let mut queue = std::collections::VecDeque::new();
        for root in 0..count {
            if std::mem::replace(&mut seen[root], true) {
                continue;
            }
            queue.push_back(root);
            while let Some(vertex) = queue.pop_front() {
                for &(other, factor) in &beside[starts[vertex]..starts[vertex + 1]] {
                    if !std::mem::replace(&mut seen[other], true) {
                        steps.push((other, vertex, factor));
                        queue.push_back(other);
                    }
                }
            }
        }
        Self { steps }
    }
}

#[cfg(test)]
mod tests {
    use pose::Se2;
    use pose::nalgebra::Matrix3;

    use super::{Doubt, judge};
    use crate::factors::{Factor, FactorGraph};
    use crate::solvers::{Options, optimize};

    /// A ring measured without noise, and the solution from a start that turns this often on the way.
    fn doubt_of(turns: f64, information: f64) -> Option<Doubt> {
        let count = 60;
        let step = std::f64::consts::TAU / f64::from(count);
        let information = Matrix3::from_diagonal(&[1e-6, 1e-6, information].into());
        let from_from_to = Se2::new(1.0, 0.0, step);
        let count = count as usize;
        let graph = FactorGraph {
            ids: (0..count as u64).collect(),
            initial: vec![None; count],
            fixed: Vec::new(),
            factors: (0..count)
                .map(|k| Factor { from: k, to: (k + 1) % count, from_from_to, information })
                .collect(),
        };
        let mut start = vec![Se2::identity()];
        for k in 1..count {
            let last = start[k - 1];
            start.push(last * Se2::new(1.0, 0.0, turns * step));
        }
        judge(&graph, &optimize(&graph, &start, &Options::default())).doubt
    }

    #[test]
    fn a_loop_wound_twice_is_doubted_however_low_its_cost() {
        assert_eq!(doubt_of(1.0, 0.5), None);
        assert!(matches!(doubt_of(2.0, 0.5), Some(Doubt::Loop { sum_rad, .. }) if sum_rad > 6.0));
        assert!(matches!(doubt_of(2.0, 500.0), Some(Doubt::Cost { .. })));
    }
}
