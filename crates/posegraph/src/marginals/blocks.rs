//! The marginals of a graph.

use pose::nalgebra::SMatrix;

use super::query;
use crate::PoseGraphError;
use crate::cliques::{CliqueTree, HELD, Term};
use crate::factors::{ErrorKind, FactorGraph, Manifold, admissible};
use crate::initial::Components;

/// The joint covariance of two vertices, in the frame of each; see the page of the module.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointCovariance<const D: usize> {
    /// Covariance of the first.
    pub a_a: SMatrix<f64, D, D>,
    /// Covariance of the second (rows) with the first (columns).
    pub b_a: SMatrix<f64, D, D>,
    /// Covariance of the second.
    pub b_b: SMatrix<f64, D, D>,
}

/// Covariances of the poses of a graph at a solution.
#[derive(Clone, Debug)]
pub struct Marginals<P, const D: usize> {
    poses: Vec<P>,
    tree: CliqueTree<D>,
}

impl<P: Manifold<D>, const D: usize> Marginals<P, D> {
    /// Factorises the normal equations at these poses; `poses` holds `map_from_body` of every vertex.
    ///
    /// Factors and information matrices are used as the optimiser does. Cost: one ordering and one
    /// factorisation. An error where a direction of a pose is not determined by any factor, or where
    /// there are not as many poses as vertices.
    pub fn new(
        graph: &FactorGraph<P, D>,
        poses: &[P],
        error: ErrorKind,
    ) -> Result<Self, PoseGraphError> {
        let count = graph.ids.len();
        if poses.len() != count {
            return Err(PoseGraphError::PosesMissing { poses: poses.len(), vertices: count });
        }
        let (factors, policy) = admissible(graph);
        let used: Vec<usize> = (0..factors.len())
            .filter(|index| policy.left_out.binary_search(index).is_err())
            .collect();
        let joins = used.iter().map(|&index| (factors[index].from, factors[index].to));
        let mut free = vec![true; count];
        for held in Components::new(count, joins).anchors(&graph.fixed) {
            free[held] = false;
        }
        let variable = |vertex: usize| if free[vertex] { vertex } else { HELD };
        let mut terms = Vec::with_capacity(used.len());
        let mut terms_of = vec![Vec::new(); count];
        for &index in &used {
            let factor = &factors[index];
            let (from, to) = (factor.from, factor.to);
            let linear = P::linearize(error, &factor.from_from_to, &poses[from], &poses[to]);
            let blocks = P::normal_blocks(&linear, &factor.information);
            for vertex in [from, to] {
                terms_of[vertex].push(terms.len());
            }
            terms.push(Term { from: variable(from), to: variable(to), blocks });
        }
        let mut tree = CliqueTree::default();
        tree.grow(count);
        let variables: Vec<usize> = (0..count).filter(|&vertex| free[vertex]).collect();
        tree.change(&variables, &[], &terms, &terms_of, |vertex| free[vertex]);
        match tree.undetermined() {
            0 => Ok(Self { poses: poses.to_vec(), tree }),
            directions => Err(PoseGraphError::Undetermined { directions }),
        }
    }

    /// The covariance of a vertex; 0 where it is held, `None` where there is no such vertex.
    ///
    /// Cost: the numbers stored along the way from its clique to the root.
    pub fn covariance(&self, vertex: usize) -> Option<SMatrix<f64, D, D>> {
        (vertex < self.poses.len()).then(|| self.tree.inverse_blocks(vertex, &[vertex])[0])
    }

    /// The joint covariance of two vertices; `None` where one of them is not there.
    ///
    /// Cost: as for [`covariance`](Self::covariance), of both.
    pub fn joint(&self, a: usize, b: usize) -> Option<JointCovariance<D>> {
        (a.max(b) < self.poses.len()).then(|| query::joint(&self.tree, a, b))
    }

    /// The covariance of the relative pose `X_a⁻¹ X_b`, in the tangent space at it on the right:
    /// in the frame of `b`; `None` where one of them is not there.
    ///
    /// Cost: as for [`covariance`](Self::covariance), of both.
    pub fn relative(&self, a: usize, b: usize) -> Option<SMatrix<f64, D, D>> {
        let (from, to) = (self.poses.get(a)?, self.poses.get(b)?);
        Some(query::relative(&self.tree, a, b, &from.between(to)))
    }

    /// The joint covariances of pairs that a factor joins, all at once; those of other pairs lack `b_a`
    /// unless the elimination brought them together. `None` where a vertex is not there.
    ///
    /// Cost: about that of the factorisation, for all of them together.
    pub fn of_joined(&self, pairs: &[(usize, usize)]) -> Vec<Option<JointCovariance<D>>> {
        let count = self.poses.len();
        let there = |&(a, b): &(usize, usize)| a.max(b) < count;
        let known = pairs.iter().copied().filter(there);
        let asked: Vec<(usize, usize)> = (0..count).map(|own| (own, own)).chain(known).collect();
        let blocks = self.tree.inverse_within_cliques(&asked);
        let (own, shared) = blocks.split_at(count);
        let mut shared = shared.iter();
        let each = pairs.iter().map(|pair| {
            let b_a = if there(pair) { *shared.next()? } else { return None };
            Some(JointCovariance { a_a: own[pair.0], b_a, b_b: own[pair.1] })
        });
        each.collect()
    }

    /// The covariances of all vertices at once; 0 for those that are held.
    ///
    /// Cost: about that of the factorisation, for all of them together.
    pub fn all(&self) -> Vec<SMatrix<f64, D, D>> {
        self.tree.diagonal_of_inverse()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::initial::odometry;
    use crate::synthetic::{Ring, manhattan, ring};

    #[test]
    fn a_long_chain_does_not_become_one_clique() {
        for poses in [500, 2000] {
            let graph = ring(&Ring { poses, ..Ring::default() }).graph;
            let found = Marginals::new(&graph, &odometry(&graph), ErrorKind::G2o).unwrap();
            assert!(found.tree.fill() < 9 * 12 * poses, "{}", found.tree.fill());
        }
    }

    #[test]
    fn joined_pairs_at_once_are_those_one_by_one() {
        let graph = manhattan(120, 5).graph;
        let found = Marginals::new(&graph, &odometry(&graph), ErrorKind::G2o).unwrap();
        let mut pairs: Vec<(usize, usize)> =
            graph.factors.iter().map(|factor| (factor.from, factor.to)).collect();
        pairs.push((3, 400));
        let at_once = found.of_joined(&pairs);
        assert_eq!(at_once.last(), Some(&None));
        for (&(a, b), joint) in pairs.iter().zip(&at_once).take(graph.factors.len()) {
            let (joint, expected) = (joint.unwrap(), found.joint(a, b).unwrap());
            for (joint, expected) in
                [(joint.a_a, expected.a_a), (joint.b_a, expected.b_a), (joint.b_b, expected.b_b)]
            {
                assert!((joint - expected).norm() <= 1e-9 * expected.norm() + 1e-15);
            }
        }
    }
}
