//! Blocks for two vertices, from a clique tree.

use pose::nalgebra::SMatrix;

use super::JointCovariance;
use crate::cliques::CliqueTree;
use crate::factors::Manifold;

/// The joint covariance of two vertices that are there.
pub(crate) fn joint<const D: usize>(
    tree: &CliqueTree<D>,
    a: usize,
    b: usize,
) -> JointCovariance<D> {
    let of_a = tree.inverse_blocks(a, &[a, b]);
    let of_b = tree.inverse_blocks(b, &[b]);
    JointCovariance { a_a: of_a[0], b_a: of_a[1], b_b: of_b[0] }
}

/// The covariance of the pose of `b` in the frame of `a`.
pub(crate) fn relative<P: Manifold<D>, const D: usize>(
    tree: &CliqueTree<D>,
    a: usize,
    b: usize,
    a_from_b: &P,
) -> SMatrix<f64, D, D> {
    if a == b {
        return SMatrix::zeros();
    }
    let joint = joint(tree, a, b);
    let by_a = -a_from_b.inverse().adjoint();
    let cross = joint.b_a * by_a.transpose();
    let sum = by_a * joint.a_a * by_a.transpose() + cross + cross.transpose() + joint.b_b;
    (sum + sum.transpose()) * 0.5
}
