#![doc = include_str!("../README.md")]

mod se2;
mod se3;

pub use nalgebra;
pub use se2::{Se2, covariance_of_compose, covariance_of_inverse, wrap_angle};
pub use se3::{Se3, So3};
