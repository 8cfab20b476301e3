//! What the recording of a replay holds, as chosen before it starts.

use std::path::PathBuf;

use geometry::Point2;

use crate::{Every, Level, MapOptions};

/// What the recording of a replay holds, and what it says about itself.
#[derive(Clone, Debug)]
pub struct ReplayOptions {
    /// The file, under its final name; it is overwritten.
    pub path: PathBuf,
    /// The name of the experiment.
    pub name: String,
    /// How much is recorded.
    pub level: Level,
    /// Which keyframes of which family of the maps.
    pub every: Every,
    /// The maps, in the order in which they are shown.
    pub maps: Vec<MapOptions>,
    /// What the experiment is about, in words (Markdown); first on the text page.
    pub about: String,
    /// The resolved config, TOML.
    pub config: String,
    /// Lower-left and upper-right corner of what the log's odometry drives through, for the first look,
    /// metres from the first keyframe.
    pub bounds_in_odom: (Point2, Point2),
    /// How far around the robot relative placement is shown, metres.
    pub sight_m: f64,
}
