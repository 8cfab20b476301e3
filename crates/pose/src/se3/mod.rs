//! SE(3) and SO(3): the rigid motions and the rotations of space.

mod group;
mod jacobians;
mod rotation;
mod tangent;

pub use group::Se3;
pub use rotation::So3;
