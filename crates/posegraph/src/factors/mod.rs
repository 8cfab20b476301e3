#![doc = include_str!("../../docs/errors.md")]

mod cost;
mod curvature;
mod error_kind;
mod graph;
mod information;
mod manifold;
mod normal;
mod se2;
mod se3;

pub use cost::{chi2, chi2_of_factors};
pub use curvature::Curvature;
pub use error_kind::ErrorKind;
pub use graph::{Factor, FactorGraph, FactorGraph2, FactorGraph3};
pub use information::InformationPolicy;
pub(crate) use information::{admissible, admissible_information};
pub use manifold::{Linearized, Manifold};
pub use normal::NormalBlocks;
