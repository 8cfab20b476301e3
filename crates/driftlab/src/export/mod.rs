//! What a robot did, in formats that other programs read.
//!
//! | file | what |
//! |---|---|
//! | `feed` | what the maps of one robot were fed, in order: the contents of a log |
//! | `refeed` | the same, read back from a log |
//! | `run_log` | that as MCAP: scans, odometry, transforms, pose graph, polygons |
//! | `volumes` | the labelled edges of a volume as lines |
//! | `tracks` | trajectories as TUM, the pose graph as g2o |
//! | `files` | all files of one robot, which get their names together |
//!
//! A run and a replay of a log write the same files: [`Exports`] takes what was fed, and the events
//! that tell of volumes.

mod feed;
mod files;
mod refeed;
mod run_log;
mod tracks;
mod volumes;

pub use feed::{Fed, Feed, gave_up, tell};
pub use files::{ExportError, ExportFolder, Exports};
pub use refeed::{RefeedError, is_fed, refeed};
pub use run_log::RunLog;
pub use tracks::Tracks;
pub use volumes::{edges_of_view, edges_of_volume};
