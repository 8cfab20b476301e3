//! The local volume of one view: a star-shaped, closed, labelled polyhedron.
//!
//! | file | what |
//! |---|---|
//! | `join.rs` | the surface joined to the camera (\[Mos15\] 3.8) |
//! | `validity.rs` | closed, oriented, 2-manifold and free of crossings, by the proof in the image plane |
//! | `star.rs` | membership by direction, in constant time |
//! | `fan.rs` | the view as tetrahedra that share the camera, placed |

mod fan;
mod join;
mod star;
mod validity;

pub(crate) use fan::placed_fan;
pub(crate) use join::outward;
pub use join::{join, volume_m3};
pub use star::StarView;
pub use validity::validity;
