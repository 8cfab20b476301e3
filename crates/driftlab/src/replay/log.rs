//! What a log is: scans of a plane, or depth images of space. The one place that tells them apart.

use std::path::Path;

use super::{DepthFrames, PlanarLog, ReplayError, planar};
use crate::config::Config;

/// A log, taken as the config wants it.
#[derive(Debug)]
pub enum Log {
    /// A file with scans of a planar laser and odometry.
    Planar(PlanarLog),
    /// A folder with depth images and their poses, or a recording of such; read as it is asked for.
    Depth(Box<DepthFrames>),
}

impl Log {
    /// Opens a log: for maps of space its depth images, for maps of the plane its scans.
    ///
    /// `places` is the topic of given place matches, if they come from the log.
    ///
    /// # Errors
    /// [`ReplayError::Input`] for a file that cannot be read, is no log, or lacks scans or odometry, and for
    /// a folder where the maps are of the plane.
    pub fn open(path: &Path, config: &Config, places: Option<&str>) -> Result<Self, ReplayError> {
        if config.is_of_space() {
            let settings = config.replay3d.clone().unwrap_or_default();
            return Ok(Self::Depth(Box::new(DepthFrames::open(path, &settings)?)));
        }
        if path.is_dir() {
            let found = "found a folder, expected a log with scans of a planar laser; depth images want \
                         a config with [map3d]";
            return Err(ReplayError::input(path, found));
        }
        let settings = config.replay.clone().unwrap_or_default();
        Ok(Self::Planar(planar::read(path, &settings, places)?))
    }
}
