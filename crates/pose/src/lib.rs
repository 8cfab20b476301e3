#![doc = include_str!("../README.md")]

mod se2;

pub use nalgebra;
pub use se2::{Se2, wrap_angle};
