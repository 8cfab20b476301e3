//! Definitions of the messages that are written, as they stand in a recording.

mod descriptors;
mod ros2;

pub(crate) use descriptors::descriptor_set;
pub(crate) use ros2::definition;
