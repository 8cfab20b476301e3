//! The evaluation grid over a true place: which cells are free, and which can be reached.

use geometry::{Point2, Vector2};
use worlds::World2d;

use crate::traversal::crossed_interiors;
use crate::{CellShape, MetricsError};

/// Most evaluation cells: about two gigabytes.
const MAX_CELLS: usize = 200_000_000;

/// Equal cells over the bounds of a place; row 0 is the lowest, indices are row-major.
#[derive(Clone, Debug)]
pub(crate) struct FreeCells {
    pub(crate) columns: usize,
    pub(crate) rows: usize,
    /// Width and height of a cell.
    pub(crate) cell_m: Vector2,
    pub(crate) low_in_world: Point2,
    pub(crate) free: Vec<bool>,
    pub(crate) reachable: Vec<bool>,
}

/// Columns, rows, and the width and height of a cell, over bounds of this extent.
fn cut(extent_m: &Vector2, shape: CellShape) -> Result<(usize, usize, Vector2), MetricsError> {
    match shape {
        CellShape::Square { side_m } => {
            // A whole number of cells must not become one more by rounding.
            let count = |extent_m: f64| (extent_m / side_m - 1e-6).ceil().max(1.0);
            let (columns, rows) = (count(extent_m.x), count(extent_m.y));
            let cells = columns * rows;
            let positive = side_m.is_finite() && side_m > 0.0;
            if !positive || cells.is_nan() || cells > MAX_CELLS as f64 {
                return Err(MetricsError::CellSize { cell_m: side_m, cells, limit: MAX_CELLS });
            }
            let most_m = 2.0 * extent_m.amax();
            if side_m > most_m {
                return Err(MetricsError::CellBeyondPlace { cell_m: side_m, most_m });
            }
            Ok((columns as usize, rows as usize, Vector2::new(side_m, side_m)))
        }
        CellShape::Grid { columns, rows } => {
            if !columns.checked_mul(rows).is_some_and(|cells| (1..=MAX_CELLS).contains(&cells)) {
                return Err(MetricsError::GridSize { columns, rows, limit: MAX_CELLS });
            }
            let cell_m = Vector2::new(extent_m.x / columns as f64, extent_m.y / rows as f64);
            Ok((columns, rows, cell_m))
        }
    }
}

impl FreeCells {
    /// Linear in the number of cells and in the length of the walls counted in cells.
    pub(crate) fn new(world: &World2d, shape: CellShape) -> Result<Self, MetricsError> {
        let (low, high) = world.bounds();
        let (columns, rows, cell_m) = cut(&(high - low), shape)?;
        let mut cells = Self {
            columns,
            rows,
            cell_m,
            low_in_world: low,
            free: Vec::with_capacity(columns * rows),
            reachable: vec![false; columns * rows],
        };
        for row in 0..rows {
            let first = cells.centre(row * columns);
            cells.free.extend(world.solid().free_in_row(&first, cell_m.x, columns));
        }
        for (a, b) in world.obstacles() {
            let (a, b) = (cells.in_cells(a), cells.in_cells(b));
            crossed_interiors(&a, &b, |column, row| {
                if let Some(index) = cells.index(column, row) {
                    cells.free[index] = false;
                }
            });
        }
        cells.flood(world);
        Ok(cells)
    }

    /// Centre of a cell in the world frame.
    pub(crate) fn centre(&self, index: usize) -> Point2 {
        let (column, row) = (index % self.columns, index / self.columns);
        Point2::new(
            self.low_in_world.x + (column as f64 + 0.5) * self.cell_m.x,
            self.low_in_world.y + (row as f64 + 0.5) * self.cell_m.y,
        )
    }

    /// A world point in units of cells from the lower-left corner: what is straight stays so.
    pub(crate) fn in_cells(&self, point_in_world: &Point2) -> Point2 {
        Point2::from((point_in_world - self.low_in_world).component_div(&self.cell_m))
    }

    /// Index of a cell inside the grid.
    pub(crate) fn index(&self, column: i64, row: i64) -> Option<usize> {
        let inside =
            column >= 0 && row >= 0 && column < self.columns as i64 && row < self.rows as i64;
        inside.then(|| row as usize * self.columns + column as usize)
    }

    /// Marks what is connected to the start through sides of free cells.
    fn flood(&mut self, world: &World2d) {
        let Some(start) = self.start_cell(world) else { return };
        self.reachable[start] = true;
        let mut open = vec![start];
        while let Some(index) = open.pop() {
            let (column, row) = ((index % self.columns) as i64, (index / self.columns) as i64);
            for (x, y) in
                [(column + 1, row), (column - 1, row), (column, row + 1), (column, row - 1)]
            {
                if let Some(next) = self.index(x, y)
                    && self.free[next]
                    && !self.reachable[next]
                {
                    self.reachable[next] = true;
                    open.push(next);
                }
            }
        }
    }

    /// The start's cell; where a wall cuts it, the free cell nearest to the start whose centre is
    /// in line of sight.
    fn start_cell(&self, world: &World2d) -> Option<usize> {
        let start = Point2::from(world.world_from_start().translation);
        let at = self.in_cells(&start);
        let (column, row) = (at.x.floor() as i64, at.y.floor() as i64);
        for ring in 0..=self.columns.max(self.rows) as i64 {
            let mut best: Option<(f64, usize)> = None;
            for y in row - ring..=row + ring {
                // Only the border of the square: what lies inside was tried before.
                let step = if (y - row).abs() == ring { 1 } else { 2 * ring.max(1) };
                let mut x = column - ring;
                while x <= column + ring {
                    if let Some(index) = self.index(x, y).filter(|&index| self.free[index]) {
                        let centre = self.centre(index);
                        let gap_m = (centre - start).norm();
                        if best.is_none_or(|(least, _)| gap_m < least)
                            && !world.caster().blocked(&start, &centre)
                        {
                            best = Some((gap_m, index));
                        }
                    }
                    x += step;
                }
            }
            if let Some((_, index)) = best {
                return Some(index);
            }
        }
        None
    }
}
