//! Nonlinear least squares on pose graphs: Gauss-Newton, Levenberg-Marquardt, dogleg.

mod event;
mod loss;
mod optimize;
mod options;
mod report;

pub use event::{Fill, OptimizerEvent};
pub use loss::{Loss, LossOn};
pub use optimize::{optimize, optimize_weighted, optimize_with};
pub use options::{Options, Solver};
pub use report::{InformationPolicy, Iteration, Report, Solution, Termination};
