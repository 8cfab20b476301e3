//! What a log of a robot with a planar laser holds.

use pose::Se2;
use sensing::Scan;

/// A pose as the robot's odometry had it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoggedPose {
    /// When, seconds.
    pub stamp_secs: f64,
    /// The body where the log's odometry has it.
    pub odom_from_body: Se2,
}

/// A scan, and where the robot's odometry had the sensor when it was taken.
#[derive(Clone, Debug, PartialEq)]
pub struct LoggedScan {
    /// When, seconds.
    pub stamp_secs: f64,
    /// The sensor where the log's odometry has it.
    pub odom_from_sensor: Se2,
    /// Bearings and ranges in the sensor's frame; what met nothing has its range as the log has it.
    pub scan: Scan,
}

/// Scans and poses in the order of the file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LaserLog {
    /// The scans.
    pub scans: Vec<LoggedScan>,
    /// Poses without a scan, where the log has them.
    pub odometry: Vec<LoggedPose>,
    /// What was odd, in words, each with the line where it was met first.
    pub warnings: Vec<String>,
}

impl LaserLog {
    /// Time from the first scan to the last, seconds; 0 without scans.
    pub fn span_secs(&self) -> f64 {
        let stamps = || self.scans.iter().map(|scan| scan.stamp_secs);
        let first = stamps().fold(f64::INFINITY, f64::min);
        let last = stamps().fold(f64::NEG_INFINITY, f64::max);
        if first <= last { last - first } else { 0.0 }
    }
}
