//! What the recording of a flight holds, as chosen before it.

use std::path::PathBuf;

use geometry::Point3;

use crate::{Every, Level};

/// What the recording of a flight holds, and what it says about itself.
#[derive(Clone, Debug)]
pub struct FlightOptions {
    /// The file, under its final name; it is overwritten.
    pub path: PathBuf,
    /// The name of the experiment.
    pub name: String,
    /// How much is recorded.
    pub level: Level,
    /// Which steps of which family.
    pub every: Every,
    /// The names of the maps, in the order in which they are shown.
    pub maps: Vec<String>,
    /// What the experiment is about, in words (Markdown); first on the text page.
    pub about: String,
    /// The resolved config, TOML.
    pub config: String,
    /// Lowest and highest corner of the place in the world frame, for the first look.
    pub bounds_in_world: (Point3, Point3),
    /// Whether a simulator knows the truth; a log does not.
    pub has_truth: bool,
}

impl FlightOptions {
    /// Whether a map claims to know nothing but what is around the robot.
    pub(crate) fn is_around_robot(map: &str) -> bool {
        map == "relative"
    }
}
