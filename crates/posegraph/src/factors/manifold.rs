//! What the optimiser asks of poses.

use std::fmt::Debug;

use pose::nalgebra::{SMatrix, SVector};

use super::{Curvature, ErrorKind, NormalBlocks};

/// Poses as a Lie group with `D` degrees of freedom, tangent vectors translation first.
///
/// Perturbations act on the right: `retract(x, δ) = x · exp(δ)`.
pub trait Manifold<const D: usize>: Copy + PartialEq + Debug + Send + Sync + 'static {
    /// The motion that moves nothing.
    fn identity() -> Self;

    /// `self · other`.
    fn compose(&self, other: &Self) -> Self;

    /// The motion back.
    fn inverse(&self) -> Self;

    /// `self⁻¹ · other`.
    fn between(&self, other: &Self) -> Self;

    /// `self · exp(step)`.
    fn retract(&self, step: &SVector<f64, D>) -> Self;

    /// `log(self⁻¹ · other)`: the step that [`retract`](Self::retract) needs to reach `other`.
    fn local(&self, other: &Self) -> SVector<f64, D>;

    /// The adjoint: `self · exp(δ) · self⁻¹ = exp(Ad δ)`.
    fn adjoint(&self) -> SMatrix<f64, D, D>;

    /// Whether every number in it is finite.
    fn is_finite(&self) -> bool;

    /// The error of a factor with measurement `measured` between the poses `from` and `to`.
    fn error(kind: ErrorKind, measured: &Self, from: &Self, to: &Self) -> SVector<f64, D>;

    /// The same error with its Jacobians by perturbations on the right of both poses.
    fn linearize(kind: ErrorKind, measured: &Self, from: &Self, to: &Self) -> Linearized<D>;

    /// What a factor with this linearisation adds to the normal equations.
    #[inline]
    fn normal_blocks(
        linearized: &Linearized<D>,
        information: &SMatrix<f64, D, D>,
    ) -> NormalBlocks<D> {
        NormalBlocks::new(linearized, information)
    }

    /// What Gauss-Newton leaves out of the second derivatives of this factor; `None` for errors
    /// for which it is not worked out.
    fn curvature(
        kind: ErrorKind,
        linearized: &Linearized<D>,
        information: &SMatrix<f64, D, D>,
    ) -> Option<Curvature<D>>;
}

/// The error of a factor and its derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Linearized<const D: usize> {
    /// The error, translation first.
    pub error: SVector<f64, D>,
    /// Its derivative by a perturbation on the right of the pose it starts from.
    pub by_from: SMatrix<f64, D, D>,
    /// Its derivative by a perturbation on the right of the pose it leads to.
    pub by_to: SMatrix<f64, D, D>,
}
