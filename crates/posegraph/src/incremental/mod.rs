//! Poses one by one, each optimised with all before it for far less than a solve from scratch.

mod covariance;
mod islands;
mod options;
mod smoother;
mod withdraw;

pub use options::{IncrementalOptions, Update};
pub use smoother::Incremental;
