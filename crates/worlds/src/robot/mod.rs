//! A simulated robot: the truth behind the observations that [`sensing::Robot`] offers.

pub(crate) mod links;
mod marks;
mod motion;
mod params;
pub(crate) mod random;
pub(crate) mod recognition;
mod sim;
mod tally;

pub use params::{DriveParams, OdometryParams, PlaceParams, RobotParams, SensorParams};
pub use sim::SimRobot;
pub use tally::{Tally, View};
