#![doc = include_str!("../README.md")]

pub mod planar;
pub mod predicates;
pub mod rays;

/// A point of the plane, metres; its frame is in the name of the variable.
pub type Point2 = nalgebra::Point2<f64>;
/// A vector of the plane, metres.
pub type Vector2 = nalgebra::Vector2<f64>;
/// A point of space, metres; its frame is in the name of the variable.
pub type Point3 = nalgebra::Point3<f64>;
/// A vector of space, metres.
pub type Vector3 = nalgebra::Vector3<f64>;
