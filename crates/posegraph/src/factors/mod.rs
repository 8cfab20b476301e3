//! Measured relative poses as least-squares factors over SE(2) and SE(3).
//!
//! A factor says that vertex `to` was seen from vertex `from` at the pose `Z = from_from_to`. With
//! the current poses `X = map_from_body` its discrepancy is `D = Z⁻¹ · X_from⁻¹ · X_to`, the
//! identity where the poses agree with the measurement. [`ErrorKind`] says how `D` becomes a
//! vector `e`; the cost of the graph is `χ² = Σ eᵀ Ω e`, without one half.

mod cost;
mod error_kind;
mod graph;
mod information;
mod manifold;
mod normal;
mod se2;
mod se3;
mod sesync_cost;

pub use cost::{chi2, chi2_of_factors};
pub use error_kind::ErrorKind;
pub use graph::{Factor, FactorGraph, FactorGraph2, FactorGraph3};
pub use information::InformationPolicy;
pub(crate) use information::admissible;
pub use manifold::{Linearized, Manifold};
pub use normal::NormalBlocks;
pub use sesync_cost::{sesync_cost2, sesync_cost3};
