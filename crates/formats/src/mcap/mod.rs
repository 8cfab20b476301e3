//! MCAP: recordings of ROS 1, ROS 2 and Foxglove.
//!
#![doc = include_str!("../../docs/logs.md")]

mod file;
mod reader;
mod writer;

pub(crate) use reader::MAGIC;
pub use reader::McapReader;
pub use writer::McapWriter;
