#![doc = include_str!("../README.md")]

mod odometry;
mod robot;
mod scan;

pub use odometry::{Odometry, PlaceMatch, Repeated};
pub use robot::Robot;
pub use scan::{Reading, Scan};
