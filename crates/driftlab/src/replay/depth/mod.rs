//! Replaying depth images with poses: maps of space, fed by what somebody carried through a place.
//!
//! | file | what |
//! |---|---|
//! | `frames` | depth images, each with its pose and its camera, one after the other |
//! | `maps` | the maps, with what their kind alone can tell |
//! | `session` | the replay as a whole |
//! | `way` | the way to the nearest frontier |
//! | `report`, `files` | the files of a replay |

mod files;
mod frames;
mod maps;
mod report;
mod session;
mod way;

pub use files::depth_files;
pub use frames::{DepthFrame, DepthFrames};
pub use report::{DepthMapMetrics, DepthMapTiming, DepthMetrics, DepthTiming};
pub use session::{DepthReplayed, replay_depth};
