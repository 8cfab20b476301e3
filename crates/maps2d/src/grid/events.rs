//! What the grid tells.

use super::{Cell, CellState, GridMap};

/// Steps of the occupancy grid (\[ISRR19\] 6.2).
#[derive(Clone, Copy, Debug)]
pub enum GridEvent<'a> {
    /// A scan was applied.
    ScanApplied {
        /// The cells whose state changed, with the state before and now.
        changed: &'a [(Cell, CellState, CellState)],
        /// The map, to be read.
        grid: &'a GridMap,
    },
    /// Poses changed, and all scans were applied again.
    Rebuilt {
        /// How many scans were applied.
        scans: usize,
        /// The map, to be read.
        grid: &'a GridMap,
    },
}

probe::variants!(GridEvent<'_>: ScanApplied, Rebuilt);
