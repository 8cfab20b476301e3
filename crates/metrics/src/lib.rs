#![doc = include_str!("../README.md")]

mod accuracy;
mod coverage;
mod error;
mod free_cells;
pub mod trajectory;
mod traversal;
mod verdict;
mod view_fill;
pub mod voxels;
mod witness;

pub use accuracy::Accuracy;
pub use coverage::{CellShape, Coverage, CoverageParams, Rule};
pub use error::MetricsError;
pub use verdict::Verdict;
pub use voxels::{FlightWitness, VoxelAccuracy, VoxelCoverage, VoxelParams};
pub use witness::Witness;
pub use worlds::{Tally, View};
