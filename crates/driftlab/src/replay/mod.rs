//! Replaying logs of real robots: the same maps, fed by what a person drove.
//!
//! | file | what |
//! |---|---|
//! | `log` | tells planar logs from folders of depth images |
//! | `planar`, `messages`, `frames`, `digest` | files of every format to scans with odometry |
//! | `jumps` | odometry that jumps |
//! | `founded` | whether the vertices of a log's graph come in order |
//! | `given` | place matches that somebody else found |
//! | `fits` | whether these, and relations, speak of the log |
//! | `params` | the config as the algorithms want it |
//! | `by_scans` | keyframes, steps and places from the scans |
//! | `by_graph` | the pose graph as the log has it |
//! | `chain` | its vertices by odometry alone, and the way driven |
//! | `sides` | the maps, each with what its kind is told |
//! | `session`, `course` | the replay as a whole, and what it came to |
//! | `between` | poses of all scans from those of the keyframes |
//! | `recording` | what the recording is shown |
//! | `relations`, `consistency`, `covered`, `judge` | metrics |
//! | `depth` | the same for depth images, and maps of space |
//! | `report`, `steps`, `files` | the files of a replay |

mod between;
mod by_graph;
mod by_scans;
mod chain;
mod consistency;
mod course;
mod covered;
mod depth;
mod digest;
mod error;
mod files;
mod fits;
mod founded;
mod frames;
mod given;
mod judge;
mod jumps;
mod log;
mod messages;
mod params;
mod planar;
mod recording;
mod relations;
mod report;
mod session;
mod sides;
mod steps;

pub use consistency::Inconsistency;
pub use course::{Closures, Course, Stop};
pub use depth::{
    DepthFrame, DepthFrames, DepthMapMetrics, DepthMapTiming, DepthMetrics, DepthReplayed,
    DepthTiming, depth_files, replay_depth,
};
pub use error::ReplayError;
pub use files::files;
pub use fits::{unmatched, unrelated};
pub use given::{GivenMatch, Moment, read_matches};
pub use judge::Asked;
pub use log::Log;
pub use planar::{LoggedStep, PlanarLog};
pub use recording::start_replay_recording;
pub use relations::{OverRelations, RelationErrors, Relations};
pub use report::{PlaceToGo, ReplayMapMetrics, ReplayMetrics, ReplayTiming};
pub use session::{Replayed, replay};
pub use steps::ReplayRow;
