//! SE-Sync: pose graphs with one weight per block, solved globally (Rosen et al. 2019).
//!
//! The cost is chordal, and another one than `χ²`:
//!
//! `F(R, t) = Σ κ_ij ‖R_j - R_i R̃_ij‖²_F + τ_ij ‖t_j - t_i - R_i t̃_ij‖²`.
//!
//! 1. **Weights** ([`isotropic_weights`]): each information matrix gives one number for its rotation
//!    and one for its translation. Everything else in it is lost, which is why the optimum of `F` can
//!    cost a thousand times the lowest `χ²`, and is a start for it and no more.
//! 2. **Quadratic form**: with `X = [R_1 t_1 … R_n t_n]` it is `F = ⟨X, M X⟩`, `M` sparse and positive
//!    semidefinite, a block of `d + 1` rows for each vertex. Translations stay in it; Rosen et al.
//!    first eliminate them, which makes the matrix dense, so that it can only be applied. Stationary
//!    points and the sign of the certificate are the same.
//! 3. **Relaxation**: the columns of a rotation are orthonormal. Let them have `r ≥ d` entries instead
//!    of `d`: a product of Stiefel manifolds, `St(d, r)ⁿ × ℝ^{r n}`. The higher `r`, the fewer local
//!    minima.
//! 4. **Descent** at one rank: damped Newton steps with a sparse Cholesky factor of the Hessian.
//! 5. **Certificate**: at a stationary point the multipliers `Λ_i = sym(R_iᵀ (M X)_i)` give the matrix
//!    `S = M - Λ`; where it is positive semidefinite no point of any rank costs less
//!    ([`certificate`](crate::certificate)).
//! 6. **Staircase** (Boumal 2015): else an eigenvector `v` of a negative eigenvalue, put into a new
//!    dimension, is a direction along which the cost falls; step along it, and go on at rank `r + 1`.
//! 7. **Rounding**: the leading `d` principal axes of a certified point, each rotation projected to
//!    SO(d), are poses; they are descended from once more, at rank `d`, and tested themselves.
//!
//! Vertices are renumbered by minimum degree once, and all matrices of a graph share that pattern.
//! Nothing is random.
//!
//! Sources: Rosen, Carlone, Bandeira, Leonard 2019, *SE-Sync: A certifiably correct algorithm for
//! synchronization over the special Euclidean group*; Boumal 2015, *A Riemannian low-rank method for
//! optimization over semidefinite matrices with block-diagonal constraints*.

mod event;
#[expect(clippy::needless_range_loop, reason = "indices of small blocks, as in the formulas")]
pub(crate) mod measurements;
pub(crate) mod newton;
pub(crate) mod poses;
#[expect(clippy::needless_range_loop, reason = "indices of small blocks, as in the formulas")]
pub(crate) mod problem;
mod rigid;
pub(crate) mod rounding;
pub(crate) mod sparse;
pub(crate) mod staircase;
#[expect(clippy::needless_range_loop, reason = "indices of small blocks, as in the formulas")]
pub(crate) mod stiefel;
mod tangent;

pub use event::SynchronizeEvent;
pub use measurements::{isotropic_weights, sesync_cost};
pub use rigid::{Columns, Rigid};
pub use staircase::SynchronizeOptions;
