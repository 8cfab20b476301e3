//! The voxel baseline: log-odds occupancy in cells, by default of 5 cm, in one global frame.
//!
//! 1. **Place** (`map.rs`). Vertices lie where odometry puts them; place edges move nothing. Corrected poses
//!    are not supported, unless looks are kept: then everything is forgotten and walked again.
//! 2. **Walk** (`walk.rs`, `integrate.rs`). The ray of every pixel goes from cell to cell (Amanatides and Woo
//!    1987). Of one look each cell counts once: a hit where a ray ended in it, else a miss. A ray without a
//!    reading is a miss as far as the range.
//! 3. **Add** (`blocks.rs`). Log odds are added within limits. Cells lie in blocks of 16³, made where
//!    something is known; one byte per cell.
//! 4. **Frontier** (`frontier.rs`): free cells beside cells that nobody looked into; what hangs together over
//!    less than a named area does not count. Only blocks that changed are looked at again.
//! 5. **Ways** (`ways.rs`): distances to occupied and unknown cells; breadth first to the nearest frontier.
//!
//! Cells finer than the rays of an image are far apart leave gaps between rays, and frontier in them: for
//! images of few pixels larger cells are needed.

mod blocks;
mod frontier;
mod integrate;
mod map;
mod params;
mod walk;
mod ways;

pub use blocks::Cell;
pub use map::VoxelMap;
pub use params::VoxelParams;
