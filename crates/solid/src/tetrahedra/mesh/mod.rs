//! Tetrahedra in compact arrays.
//!
//! | file | what it holds |
//! |---|---|
//! | `tet.rs` | one tetrahedron, its corners and faces |
//! | `complex.rs` | all of them, and what must hold |
//! | `around.rs` | the ring round an edge, the star of a vertex |
//! | `replace.rs` | the only way in which recovery changes anything: an exchange that can be undone |

mod around;
mod complex;
mod replace;
mod tet;

pub(crate) use around::Ring;
pub(crate) use complex::Mesh;
pub(crate) use replace::Exchange;
pub(crate) use tet::{FACE, GHOST, NONE, Tet, sorted3};
