//! Where a scan lies in what is known of a place.
//!
//! | file | what |
//! |---|---|
//! | `table` | scores of points, looked up |
//! | `search` | the best pose of a window, and the best one elsewhere |
//! | `surfaces` | the nearest surface to a point |
//! | `icp` | the pose that brings points onto surfaces, with its covariance |
//! | `verdict` | what of a scan a place explains, and what it contradicts |

mod icp;
mod search;
mod surfaces;
mod table;
mod verdict;

pub use icp::{Aligned, Noise, Prior, align};
pub use search::{Apart, Found, Window, search};
pub use surfaces::Surfaces;
pub use table::Table;
pub use verdict::{Agreement, agreement};
