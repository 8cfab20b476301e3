//! What one factor adds to the normal equations.

use pose::nalgebra::{SMatrix, SVector};

use super::Linearized;

/// The blocks that a factor adds to the normal equations `H δ = -g` of half the cost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalBlocks<const D: usize> {
    /// `J_fromᵀ Ω J_from`.
    pub from_from: SMatrix<f64, D, D>,
    /// `J_toᵀ Ω J_from`: rows belong to the pose the factor leads to.
    pub to_from: SMatrix<f64, D, D>,
    /// `J_toᵀ Ω J_to`.
    pub to_to: SMatrix<f64, D, D>,
    /// `J_fromᵀ Ω e`.
    pub gradient_from: SVector<f64, D>,
    /// `J_toᵀ Ω e`.
    pub gradient_to: SVector<f64, D>,
}

impl<const D: usize> NormalBlocks<D> {
    /// The blocks of a linearised factor with an information matrix.
    #[inline]
    pub fn new(linearized: &Linearized<D>, information: &SMatrix<f64, D, D>) -> Self {
        let Linearized { error, by_from, by_to } = linearized;
        let weighted_to = information * by_to;
        let weighted_from = information * by_from;
        let weighted_error = information * error;
        Self {
            from_from: by_from.tr_mul(&weighted_from),
            to_from: by_to.tr_mul(&weighted_from),
            to_to: by_to.tr_mul(&weighted_to),
            gradient_from: by_from.tr_mul(&weighted_error),
            gradient_to: by_to.tr_mul(&weighted_error),
        }
    }
}
