#![doc = include_str!("../../docs/tetrahedra.md")]

mod classify;
mod constrained;
mod constraints;
mod delaunay;
mod events;
mod fan;
mod filled;
mod flips;
mod gate;
mod mesh;
mod order;
mod predicates;
mod reconnect;
mod recover;
mod result;
mod steiner;

pub use constrained::{tetrahedralize, tetrahedralize_in, tetrahedralize_with};
pub use delaunay::{Delaunay, delaunay, delaunay_with};
pub use events::{Cause, Snapshot, TetrahedraEvent};
pub use fan::fan;
pub use gate::Inside;
pub use result::{BoundaryFace, Tetrahedra};
