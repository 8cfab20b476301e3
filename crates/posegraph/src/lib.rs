#![doc = include_str!("../README.md")]

pub mod certificate;
mod cliques;
mod error;
pub mod factors;
pub mod incremental;
pub mod initial;
mod linear;
pub mod marginals;
mod placement;
pub mod robust;
pub mod solvers;
pub mod synchronize;
pub mod synthetic;

pub use certificate::{Certificate, Verdict, certify, certify_with};
pub use error::PoseGraphError;
pub use factors::{
    ErrorKind, Factor, FactorGraph, FactorGraph2, FactorGraph3, InformationPolicy, Linearized,
    Manifold,
};
pub use incremental::{Incremental, IncrementalOptions, Update};
pub use initial::{Start, default_start, default_start_by, default_start_with};
pub use marginals::{JointCovariance, Marginals};
pub use placement::{
    Edge, EdgeKind, Link, Placed, Placement, PoseGraph, RelativePose, Scope, ScopeScratch,
    Skeleton, Via,
};
pub use robust::{Robust, RobustSolution, optimize_robust};
pub use solvers::{
    Fill, Iteration, Loss, LossOn, Optimizer, OptimizerEvent, Options, Report, Solution, Solver,
    Termination, optimize, optimize_weighted, optimize_with,
};
pub use synchronize::{Rigid, SynchronizeEvent, SynchronizeOptions, sesync_cost};
