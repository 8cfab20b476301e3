//! Removal of the vertex that contributes least, again and again (\[Mos15\] 3.5).
//!
//! | file | what |
//! |---|---|
//! | `rings/` | the triangulation: the neighbours of each vertex, in order |
//! | `contribution.rs` | centroid, least squares, relevance on the border (3.5.2, 3.5.3, 3.7) |
//! | `mend.rs` | a vertex taken out, its hole closed |
//! | `remove.rs` | the loop of scenario 5 |

mod contribution;
mod mend;
mod remove;
mod rings;

pub use contribution::Contribution;
pub(super) use mend::Mend;
pub(super) use remove::{Removal, remove};
pub(super) use rings::Rings;
