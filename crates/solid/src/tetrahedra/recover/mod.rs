//! Making the mesh conform to its constraints.
//!
//! | file | what it does |
//! |---|---|
//! | `present.rs` | which segments and facets are there already |
//! | `segments.rs` | one missing segment, by flips |
//! | `facets.rs` | one missing facet, by flips |
//! | `detour.rs` | one stuck segment, after letting go of a held one for a while |
//! | `passes.rs` | all of them, with rising effort |

mod detour;
mod facets;
mod passes;
mod present;
mod segments;

pub(crate) use passes::{commit, conform};
pub(crate) use segments::Attempt;
