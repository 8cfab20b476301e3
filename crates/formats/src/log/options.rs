//! How logs are read.

use crate::FormatError;

/// How the messages of a log are taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReadOptions {
    /// Units of depth images of whole numbers per metre.
    pub depth_units_per_metre: f64,
}

impl Default for ReadOptions {
    /// Depth images count millimetres, as ROS has it.
    fn default() -> Self {
        Self { depth_units_per_metre: 1000.0 }
    }
}

impl ReadOptions {
    pub(crate) fn check(&self) -> Result<(), FormatError> {
        crate::depth::check_scale(self.depth_units_per_metre)
    }
}
