//! What Gauss-Newton leaves out of the second derivatives.

use pose::nalgebra::SMatrix;

use super::NormalBlocks;

/// The part of a factor's second derivatives that its Jacobians do not show.
///
/// Perturbations of both poses act on the discrepancy as `D · exp(x) · exp(y)` with `x = -A δ_from`,
/// `y = δ_to` and `A` the adjoint of `X_to⁻¹ X_from`, which is `D · exp(x + y + ½[x, y] + …)`. Half
/// the cost gains `½ zᵀ S z + xᵀ B y` with `z = x + y`: `S` from the curvature of the error, `B`
/// from the commutator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curvature<const D: usize> {
    /// `S`, symmetric.
    pub along: SMatrix<f64, D, D>,
    /// `B`, antisymmetric.
    pub commutator: SMatrix<f64, D, D>,
}

impl<const D: usize> Curvature<D> {
    /// Adds it to the blocks of a factor, with the adjoint of `X_to⁻¹ X_from`.
    pub fn add_to(&self, blocks: &mut NormalBlocks<D>, adjoint: &SMatrix<f64, D, D>) {
        let along = self.along * adjoint;
        blocks.to_to += self.along;
        blocks.from_from += adjoint.tr_mul(&along);
        blocks.to_from += self.commutator * adjoint - along;
    }
}
