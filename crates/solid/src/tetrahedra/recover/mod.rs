//! Making the mesh conform to its constraints.
//!
//! | file | what it does |
//! |---|---|
//! | `present.rs` | which segments and facets are there already |
//! | `segments.rs` | one missing segment, by flips |
//! | `detour.rs` | a stuck segment, over a point on it |
//! | `facets.rs` | one missing facet, by flips |
//! | `plan.rs` | how hard, and in which order |
//! | `passes.rs` | all of them, and the division of what is stuck |

mod detour;
mod facets;
mod passes;
mod plan;
mod present;
mod segments;

pub(crate) use passes::{commit, conform};
pub(crate) use plan::{PLANS, Plan};
