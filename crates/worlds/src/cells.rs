//! A place drawn on squared paper: which cells are solid.

use geometry::Point2;

/// A rectangular grid of square cells, each solid or free.
///
/// Row 0 is the lowest (least y), column 0 the leftmost; `solid` is row-major.
#[derive(Clone, Debug, PartialEq)]
pub struct CellMap {
    /// Number of columns (x).
    pub columns: usize,
    /// Number of rows (y).
    pub rows: usize,
    /// Side of a cell, metres.
    pub cell_m: f64,
    /// The lower-left corner of cell (0, 0) in the world frame, metres.
    pub origin_in_world: Point2,
    /// Whether each cell is solid, row-major from the lowest row.
    pub solid: Vec<bool>,
}

impl CellMap {
    /// A map of free cells with its lower-left corner at the origin.
    pub fn free(columns: usize, rows: usize, cell_m: f64) -> Self {
        Self {
            columns,
            rows,
            cell_m,
            origin_in_world: Point2::origin(),
            solid: vec![false; columns * rows],
        }
    }

    /// Whether the cell is solid; everything outside the map is.
    pub fn is_solid(&self, column: i64, row: i64) -> bool {
        if column < 0 || row < 0 || column >= self.columns as i64 || row >= self.rows as i64 {
            return true;
        }
        self.solid[row as usize * self.columns + column as usize]
    }

    /// The cell that contains a point: (column, row), maybe outside the map.
    pub fn cell_of(&self, point_in_world: &Point2) -> (i64, i64) {
        let offset = (point_in_world - self.origin_in_world) / self.cell_m;
        (offset.x.floor() as i64, offset.y.floor() as i64)
    }
}
