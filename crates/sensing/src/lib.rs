#![doc = include_str!("../README.md")]

mod depth;
mod flight;
mod odometry;
mod robot;
mod scan;

pub use depth::{Camera, DepthImage};
pub use flight::{Flight, FlyingRobot, Returned, SpaceMatch};
pub use odometry::{Odometry, PlaceMatch, Repeated};
pub use robot::Robot;
pub use scan::{Reading, Scan};
