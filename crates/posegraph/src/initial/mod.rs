//! Start values.

mod odometry;

pub use odometry::odometry;
