//! Which vertices are joined to which, and in what order around each.
//!
//! | file | what |
//! |---|---|
//! | `store.rs` | the rings themselves, and how they change |
//! | `meshes.rs` | rings of a mesh, and the mesh of what is left |

mod meshes;
mod store;

pub(in crate::reduce) use store::Rings;
