//! Two trajectories against each other: absolute and relative errors of an estimate.
//!
//! 1. [`align`] finds the motion that lays the estimate onto the reference.
//! 2. [`absolute_errors`]: what is left between matching poses (ATE, also called APE).
//! 3. [`relative_errors`]: how motions over some steps differ (RPE); needs no alignment.
//!
//! Definitions as in evo and in Sturm et al. 2012, *A benchmark for the evaluation of RGB-D SLAM
//! systems*.

mod align;
mod errors;

pub use align::{Alignment, Similarity, align};
pub use errors::{PoseErrors, Statistics, absolute_errors, relative_errors};
