//! Flips: tetrahedra exchanged for others on the same vertices.
//!
//! | file | what it does |
//! |---|---|
//! | `state.rs` | the mesh with what it must contain and the log of what can be undone |
//! | `goal.rs` | what a flip is for: counts what is in the way |
//! | `known.rs` | what was found out before |
//! | `face.rs` | 2-3: a face goes |
//! | `ring.rs` | 3-2, 4-4, n-to-m: an edge goes, by the best triangulation of its ring |
//! | `deep.rs` | an edge goes after others that block it, to a bounded depth |
//!
//! A flip is made only if all new tetrahedra are positive, exactly, and if nothing that must stay goes.

mod deep;
mod face;
mod goal;
mod known;
mod ring;
mod state;

pub(crate) use deep::Effort;
pub(crate) use goal::Goal;
pub(crate) use ring::{FLAT, evenness};
pub(crate) use state::Work;
