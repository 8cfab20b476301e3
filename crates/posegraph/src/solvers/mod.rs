//! Nonlinear least squares on pose graphs: Gauss-Newton, Levenberg-Marquardt, dogleg.
//!
//! 1. Look at the graph once: which factors are of use, what to do about their information
//!    matrices, which vertices are held, in which order to eliminate the others, and where the
//!    factor of the matrix has entries.
//! 2. Linearise every factor at the current poses, in order, into the stored blocks of the normal
//!    equations. What is derived stands in [`factors`](crate::factors).
//! 3. Factorise, solve, move the poses: which step is taken is the [`Solver`]'s business.
//! 4. End where hardly anything is left to gain; say why, with the measured value and the
//!    threshold ([`Termination`]). Not converging is no error.
//!
//! **Which solver.** Gauss-Newton is the default: from odometry its full steps reach the best known
//! cost on every public graph tried, where damped steps stop in local minima (the Intel graph of
//! 1228 poses). It falls back to damping where full steps get lost. Levenberg-Marquardt and dogleg
//! never raise the cost; they are for starts that are near already.
//!
//! **Losses** are applied by reweighting (IRLS): a factor of `s = eᵀ Ω e` weighs the derivative of its
//! loss in the next iteration. [`optimize_weighted`] multiplies with weights of the caller.
//!
//! Everything is computed in the order of the data, so the same input gives the same bits.

mod dogleg;
mod event;
mod gauss_newton;
mod last_step;
mod levenberg_marquardt;
mod loss;
mod optimize;
mod options;
mod problem;
mod report;
mod state;

pub use event::{Fill, OptimizerEvent};
pub use loss::{Loss, LossOn};
pub use optimize::{Optimizer, optimize, optimize_weighted, optimize_with};
pub use options::{Options, Solver};
pub use report::{Iteration, Report, Solution, Termination};
