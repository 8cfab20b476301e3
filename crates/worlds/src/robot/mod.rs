//! A simulated robot: the truth behind the observations that [`sensing::Robot`] offers.

mod marks;
mod motion;
mod params;
mod random;
mod recognition;
mod sim;
mod tally;

pub use params::{DriveParams, OdometryParams, PlaceParams, RobotParams, SensorParams};
pub use sim::SimRobot;
pub use tally::{Tally, View};
