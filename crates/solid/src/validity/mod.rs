//! How valid a mesh is: four levels, each defect named and located.
//!
//! | level | what it says | file |
//! |---|---|---|
//! | closed | every edge has an even number of faces | `edges.rs` |
//! | oriented | every edge is passed as often one way as the other | `edges.rs` |
//! | 2-manifold | every edge has two faces, and the faces round each vertex are one fan | `edges.rs`, `vertices.rs` |
//! | not self-intersecting | two faces have in common no more than corners and edges that are common to both | `crossings.rs`, `faces_meet.rs` |
//!
//! The first three are told by index, the last by place: corners of two faces at exactly the same
//! place are common to both, whatever their indices. So the union of two boxes that touch along an
//! edge, whose vertices there exist twice, is a 2-manifold and does not intersect itself.
//!
//! 1. Edges are sorted; each run tells how many faces pass it, and which way.
//! 2. Faces round a vertex are joined across its edges; more than one group is a defect.
//! 3. Flat faces (exactly collinear corners) are defects of the last level.
//! 4. Faces whose boxes touch are tested pair by pair, exactly: coplanar overlaps and mere touches
//!    are found like proper crossings.

mod check;
mod crossings;
mod edges;
mod faces_meet;
mod vertices;

pub use check::{Defect, Validity, check, check_topology};
pub use crossings::{Contact, Crossing, crossings};
pub(crate) use crossings::{crossed, flat_faces, meets_itself_at};
pub(crate) use faces_meet::meet;
