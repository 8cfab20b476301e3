//! Chordal initialisation: two linear problems instead of one that is not (Martinec and Pajdla 2007;
//! Carlone et al. 2015).
//!
//! 1. One vertex of each component is held, or those that the graph fixes.
//! 2. **Rotations**: `min Σ κ ‖R_j - R_i R̃_ij‖²_F` over all matrices `R`, orthogonal or not, is linear
//!    least squares; rows of the matrices decouple, so one factorisation of a matrix with blocks of `d`
//!    rows serves `d` right-hand sides.
//! 3. Each matrix is projected to the nearest rotation.
//! 4. **Translations**: with these rotations `min Σ τ ‖t_j - t_i - R_i t̃_ij‖²` is linear least squares
//!    over the Laplacian of the graph, one row for each vertex.
//!
//! The weights `κ`, `τ` are SE-Sync's ([`isotropic_weights`](crate::synchronize::isotropic_weights)),
//! so every information matrix will do, full, singular or indefinite, in the plane and in space alike.
//! Where a factor's matrix yields no positive weight it takes no part. Cost: about a sixth of an iteration
//! of Gauss-Newton in space, a third in the plane.

#[expect(clippy::needless_range_loop, reason = "indices of small blocks, as in the formulas")]
mod solve;

pub use solve::chordal;
