//! SE-Sync's cost, which weighs all directions of a block alike.

use pose::nalgebra::{Matrix2, Matrix3};
use pose::{Se2, Se3};

use super::{FactorGraph2, FactorGraph3};

/// SE-Sync's cost of poses of the plane (Rosen et al. 2019, section 3, equation 12).
///
/// `F = Σ κ ‖Rj - Ri R̄ij‖² + τ ‖tj - ti - Ri t̄ij‖²` with Frobenius norms. As SE-Sync derives the
/// weights from a file: `κ = I33`, `τ = 2 / tr(It⁻¹)` for the block `It` of the translation. Where
/// that block has no inverse, `τ` is 0.
pub fn sesync_cost2(graph: &FactorGraph2, poses: &[Se2]) -> f64 {
    let cost = |factor: &super::Factor<Se2, 3>| {
        let (from, to, measured) = (&poses[factor.from], &poses[factor.to], &factor.from_from_to);
        let block: Matrix2<f64> = factor.information.fixed_view::<2, 2>(0, 0).into_owned();
        let tau = block.try_inverse().map_or(0.0, |inverse| 2.0 / inverse.trace());
        let turn = to.rotation.to_rotation_matrix().into_inner()
            - (from.rotation * measured.rotation).to_rotation_matrix().into_inner();
        let shift = to.translation - from.translation - from.rotation * measured.translation;
        factor.information[(2, 2)] * turn.norm_squared() + tau * shift.norm_squared()
    };
    graph.factors.iter().map(cost).sum()
}

/// SE-Sync's cost of poses of space; see [`sesync_cost2`].
///
/// As SE-Sync derives the weights from a file: `κ = 3 / (2 tr(Ir⁻¹))`, `τ = 3 / tr(It⁻¹)`.
pub fn sesync_cost3(graph: &FactorGraph3, poses: &[Se3]) -> f64 {
    let weight = |block: Matrix3<f64>, scale: f64| {
        block.try_inverse().map_or(0.0, |inverse| scale / inverse.trace())
    };
    let cost = |factor: &super::Factor<Se3, 6>| {
        let (from, to, measured) = (&poses[factor.from], &poses[factor.to], &factor.from_from_to);
        let tau = weight(factor.information.fixed_view::<3, 3>(0, 0).into_owned(), 3.0);
        let kappa = weight(factor.information.fixed_view::<3, 3>(3, 3).into_owned(), 1.5);
        let turn = to.rotation_matrix() - from.rotation_matrix() * measured.rotation_matrix();
        let shift = to.translation - from.translation - from.rotation * measured.translation;
        kappa * turn.norm_squared() + tau * shift.norm_squared()
    };
    graph.factors.iter().map(cost).sum()
}
