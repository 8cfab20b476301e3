//! How well poses are known: marginal covariances, without inverting the whole matrix.
//!
//! The covariance of all poses is the inverse of the matrix `H` of the normal equations at the
//! solution: dense, and never computed. What is asked for are blocks of it.
//!
//! 1. **Factorise** `H = L Lᵀ` as a tree of cliques, in an order that keeps `L` sparse.
//! 2. **One vertex, or two** ([`Marginals::covariance`], [`Marginals::joint`]): solve for the `D` unit
//!    columns of a vertex. Going up, the solution is not 0 only on the way from the clique of the
//!    vertex to the root; coming down, only the ways to the vertices asked for are computed. The
//!    cost is that of the numbers stored along the ways, not of the factor.
//! 3. **All vertices** ([`Marginals::all`]): from the root down, the covariance of a clique follows
//!    from that of its separator, which is part of its parent's (Takahashi, Fagan and Chin 1973;
//!    Golub and Plemmons 1980; for pose graphs Kaess and Dellaert 2009). The cost is that of a
//!    factorisation.
//! 4. **A relative pose** `T = X_a⁻¹ X_b` ([`Marginals::relative`]): a step moves it by
//!    `δ = δ_b - Ad(T⁻¹) δ_a`, so its covariance follows from the joint one of both vertices. Unlike
//!    that of a vertex it does not depend on which vertex is held.
//!
//! **Frames.** Covariances are of steps in the tangent space at the pose, on its right:
//! `X exp(δ)`, in the frame of the body, translation in metres first, then rotation in radians. The
//! error that is minimised may scale rotations otherwise; its Jacobians account for that.
//!
//! **Gauge.** As in the optimiser, the vertices named in the graph are held, and the first one of
//! each component that has none; they have covariance 0, and all others are relative to them. Two
//! components know nothing of each other: a relative covariance between them means only that both
//! are held.
//!
//! **Weights.** Information matrices count as they stand, so covariances are as honest as they are.
//! After a robust optimisation multiply each by the weight of its factor first.

mod blocks;
pub(crate) mod query;

pub use blocks::{JointCovariance, Marginals};
