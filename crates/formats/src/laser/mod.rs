//! Logs of robots with a planar laser, and published relations to judge them by.
//!
//! | file | what |
//! |---|---|
//! | `log` | the plain types that every reader gives |
//! | [`carmen`] | text logs of CARMEN: `FLASER`, `ROBOTLASER1`, `ODOM`, `PARAM` |
//! | [`gfs`] | JSON maps from a time stamp to ranges and a pose |
//! | `json` | as much JSON as that takes |
//! | [`relations`] | relative poses between time stamps |
//!
//! [`read`] tells the first two apart, packed or not.

pub mod carmen;
pub mod gfs;
mod json;
mod log;
pub mod relations;

pub use log::{LaserLog, LoggedPose, LoggedScan};

use crate::FormatError;
use crate::gzip::unpack;

/// Reads a log of either kind, packed with gzip or not.
///
/// # Errors
/// Those of [`crate::gzip::unpack`], [`carmen::read`] and [`gfs::read`].
pub fn read(bytes: &[u8]) -> Result<LaserLog, FormatError> {
    let bytes = unpack(bytes)?;
    match bytes.iter().find(|byte| !byte.is_ascii_whitespace()) {
        Some(b'{') => gfs::read(&bytes),
        _ => carmen::read(&bytes),
    }
}
