//! What can be wrong with a place.

/// Why a place cannot be built.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum WorldError {
    /// The map has no area, or its extent is not finite.
    #[error("the map spans {width_m} m by {height_m} m: both must be positive")]
    NoArea {
        /// Extent along x, metres.
        width_m: f64,
        /// Extent along y, metres.
        height_m: f64,
    },
    /// The list of cells does not fill the map.
    #[error("the map lists {found} cells where its columns and rows make {expected}")]
    CellCount {
        /// Cells listed.
        found: usize,
        /// Columns times rows.
        expected: usize,
    },
    /// The start does not stand in free space.
    #[error("the start ({x_m} m, {y_m} m) is not in free space")]
    StartNotFree {
        /// x of the start in the world frame, metres.
        x_m: f64,
        /// y of the start in the world frame, metres.
        y_m: f64,
    },
}
