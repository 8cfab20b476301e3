//! SE(2): the rigid motions of the plane.

mod covariance;
mod group;
mod jacobians;
mod tangent;

pub use covariance::{covariance_of_compose, covariance_of_inverse};
pub use group::{Se2, wrap_angle};
