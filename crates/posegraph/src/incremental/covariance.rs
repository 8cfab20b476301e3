//! How well poses are known, from the factor that is there.

use pose::nalgebra::SMatrix;

use super::Incremental;
use crate::factors::Manifold;
use crate::marginals::{JointCovariance, query};

impl<P: Manifold<D>, const D: usize> Incremental<P, D> {
    /// The covariance of a vertex, as [`Marginals::covariance`](crate::Marginals::covariance), but
    /// where poses were linearised last.
    ///
    /// Directions that no factor determines count as held.
    pub fn covariance(&self, vertex: usize) -> Option<SMatrix<f64, D, D>> {
        (vertex < self.len()).then(|| self.tree.inverse_blocks(vertex, &[vertex])[0])
    }

    /// The joint covariance of two vertices, as [`Marginals::joint`](crate::Marginals::joint).
    pub fn joint_covariance(&self, a: usize, b: usize) -> Option<JointCovariance<D>> {
        (a.max(b) < self.len()).then(|| query::joint(&self.tree, a, b))
    }

    /// The covariance of a relative pose, as [`Marginals::relative`](crate::Marginals::relative):
    /// what a loop closure between the two has to agree with.
    pub fn relative_covariance(&self, a: usize, b: usize) -> Option<SMatrix<f64, D, D>> {
        let known = a.max(b) < self.len();
        known.then(|| {
            let a_from_b = self.linearised[a].between(&self.linearised[b]);
            query::relative(&self.tree, a, b, &a_from_b)
        })
    }
}
