//! A simulated robot that flies: the truth behind the observations of [`sensing::FlyingRobot`].
//!
//! | file | what |
//! |---|---|
//! | `params.rs` | what the robot is made of |
//! | `camera.rs` | the depth camera: rays from the true pose, noise of structured light |
//! | `motion.rs` | flying in truth: noise, and surfaces that stop the robot |
//! | `recognition.rs` | which known places it recognises |
//! | `sim.rs` | the robot itself |

mod camera;
mod motion;
mod params;
mod recognition;
mod sim;

pub use camera::SpaceView;
pub use params::{CameraParams, FlightNoiseParams, FlyerParams, StructuredLight};
pub use sim::SimFlyer;
