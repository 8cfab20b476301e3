//! Nonlinear least squares on pose graphs: Gauss-Newton, Levenberg-Marquardt, dogleg.

mod dogleg;
mod event;
mod gauss_newton;
mod levenberg_marquardt;
mod loss;
mod optimize;
mod options;
mod problem;
mod report;
mod state;

pub use event::{Fill, OptimizerEvent};
pub use loss::{Loss, LossOn};
pub use optimize::{optimize, optimize_weighted, optimize_with};
pub use options::{Options, Solver};
pub use report::{Iteration, Report, Solution, Termination};
