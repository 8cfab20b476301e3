//! The recording of an optimisation: what the solver did, iteration by iteration.

mod draw;
mod page;
mod record;

pub use draw::DrawnPose;
pub use record::{OPTIMIZER_EVENTS, OptimisationOptions, OptimisationRecording};
