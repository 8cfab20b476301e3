//! Small polyhedron reconnection: all ways to fill a small region are searched.
//!
//! | file | what it does |
//! |---|---|
//! | `cavity.rs` | which tetrahedra, and how the region grows |
//! | `signs.rs` | the orientations of all quadruples of the region's vertices, computed once |
//! | `search.rs` | the search, over these signs alone |
//! | `attempt.rs` | for a missing segment, a missing facet, or a vertex to be rid of |

mod attempt;
mod cavity;
mod search;
mod signs;

pub(crate) use cavity::Region;
pub(crate) use search::Search;
