//! The plain occupancy grid (\[ISRR19\] 6.2), the map that the relative polygons are compared with.
//!
//! 1. A scan is placed with the odometry estimate of its pose, as it is (`apply`).
//! 2. A cell is occupied where a ray hits in it; free where it lies fully inside the polygon that
//!    the rays span (\[ISRR19\] 4.1); the latest evidence wins (eq. 6 with certain probabilities)
//!    (`apply`).
//! 3. Frontier cells are free cells with an unknown neighbour (`cells`).
//! 4. With loop closure ([`CorrectedGrid`]) all cells are forgotten whenever poses are corrected, and
//!    every scan is applied again (`corrected`).
//! 5. The planner goes to frontier cells in view, else to the nearest by Dijkstra's search over free
//!    cells (`ask`).

mod apply;
mod ask;
mod cells;
mod corrected;
mod events;
mod map;

pub use cells::{Cell, CellState, Cells};
pub use corrected::CorrectedGrid;
pub use events::GridEvent;
pub use map::{GridMap, GridParams};
