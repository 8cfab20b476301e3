//! What a log is: scans of a plane, or depth images of space. The one place that tells them apart.

use std::path::{Path, PathBuf};

use super::{PlanarLog, ReplayError, planar};
use crate::config::Replay;

/// A log, told by what it is.
#[derive(Clone, Debug)]
pub enum Log {
    /// A file with scans of a planar laser and odometry.
    Planar(PlanarLog),
    /// A folder with depth images and their poses.
    Depth(PathBuf),
}

impl Log {
    /// Reads a log; a folder is not looked into yet.
    ///
    /// `places` is the topic of given place matches, if they come from the log.
    ///
    /// # Errors
    /// [`ReplayError::Input`] for a file that cannot be read, is no log, or lacks scans or odometry.
    pub fn open(path: &Path, config: &Replay, places: Option<&str>) -> Result<Self, ReplayError> {
        if path.is_dir() {
            return Ok(Self::Depth(path.to_owned()));
        }
        Ok(Self::Planar(planar::read(path, config, places)?))
    }
}
