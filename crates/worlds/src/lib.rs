#![doc = include_str!("../README.md")]

mod cells;
mod depth_room;
mod error;
mod flyer;
pub mod generate;
pub mod paper;
pub mod raster;
mod robot;
mod solid;
pub mod space;
pub mod start;
pub mod thesis;
mod world;

pub use cells::CellMap;
pub use depth_room::DepthRoom;
pub use error::WorldError;
pub use flyer::{
    CameraParams, FlightNoiseParams, FlyerParams, SimFlyer, SpaceView, StructuredLight,
};
pub use robot::{
    DriveParams, OdometryParams, PlaceParams, RobotParams, SensorParams, SimRobot, Tally, View,
};
pub use solid::Solid;
pub use space::World3d;
pub use world::World2d;
