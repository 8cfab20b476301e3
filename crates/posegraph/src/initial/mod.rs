//! Start values.

mod components;
mod odometry;

pub use components::Components;
pub use odometry::odometry;
