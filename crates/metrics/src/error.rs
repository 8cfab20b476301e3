//! What can be wrong with an evaluation.

/// Why coverage cannot be judged.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MetricsError {
    /// The side of square cells is not positive, or makes too many cells.
    #[error("evaluation cells of {cell_m} m make {cells} cells: from 1 to {limit} are allowed")]
    CellSize {
        /// Side of a cell, metres.
        cell_m: f64,
        /// Cells over the bounds of the place, maybe not a number.
        cells: f64,
        /// Most cells that are allowed.
        limit: usize,
    },
    /// One square cell would hold the whole place several times.
    #[error("evaluation cells of {cell_m} m: at most {most_m} m, twice the extent of the place")]
    CellBeyondPlace {
        /// Side of a cell, metres.
        cell_m: f64,
        /// Twice the longer side of the bounds of the place, metres.
        most_m: f64,
    },
    /// Columns and rows make no cell, or too many.
    #[error("{columns} columns and {rows} rows: from 1 to {limit} evaluation cells are allowed")]
    GridSize {
        /// Cells side by side.
        columns: usize,
        /// Cells above each other.
        rows: usize,
        /// Most cells that are allowed.
        limit: usize,
    },
}
