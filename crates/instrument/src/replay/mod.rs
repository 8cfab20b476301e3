//! The recording of a replay: the same scans by odometry only, as optimised, and relative to the current
//! pose; matches of scans; what each map believes.

mod cloud;
mod matched;
mod options;
mod page;
mod pictures;
mod record;

pub use options::ReplayOptions;
pub use record::{KeyframeSeen, PLACE_EVENTS, ReplayRecording, SettledSeen};
