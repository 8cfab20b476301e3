//! How much of a place was really seen, and how far the robot had driven at each first sight.

use geometry::{Point2, Vector2};
use worlds::{View, World2d};

use crate::MetricsError;
use crate::free_cells::FreeCells;
use crate::traversal::touched_cells;
use crate::view_fill::RowFill;

/// When a cell counts as seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// A ray touches the cell on its way from the sensor to the hit (\[ISRR19\] sec. 6).
    Rays,
    /// Its centre lies in the true view polygon, which joins the ends of neighbouring rays: for
    /// cells finer than the spacing of the rays.
    View,
}

/// How a place is cut into evaluation cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CellShape {
    /// Squares from the lower-left corner of the bounds; the last ones may reach beyond them.
    Square {
        /// Side of a cell, metres, positive.
        side_m: f64,
    },
    /// So many equal cells over the bounds, square or not (\[Zie18\] sec. 3.2 has 25 by 20).
    Grid {
        /// Cells side by side, at least 1.
        columns: usize,
        /// Cells above each other, at least 1.
        rows: usize,
    },
}

/// How coverage is judged.
#[derive(Clone, Debug, PartialEq)]
pub struct CoverageParams {
    /// How the place is cut into evaluation cells.
    pub cells: CellShape,
    /// When a cell counts as seen.
    pub rule: Rule,
}

impl Default for CoverageParams {
    /// The paper's: 1 m cells, touched by rays.
    fn default() -> Self {
        Self { cells: CellShape::Square { side_m: 1.0 }, rule: Rule::Rays }
    }
}

/// Cells of a true place, and at which driven distance each was first seen.
///
/// Only free cells that the robot could reach count: a cell is free when no obstacle touches its
/// open interior, and reachable when free cells join it to the start's cell side by side. Cells
/// lie over the bounds of the place, row-major from the lowest row.
#[derive(Clone, Debug)]
pub struct Coverage {
    params: CoverageParams,
    cells: FreeCells,
    first_seen_m: Vec<f64>,
    cells_total: usize,
    cells_reachable: usize,
    cells_seen: usize,
    first_seen_sum_m: f64,
    newly_seen: Vec<usize>,
    fill: RowFill,
}

impl Coverage {
    /// Nothing seen yet. Linear in the number of cells, and in the length of the walls.
    ///
    /// # Errors
    /// [`MetricsError::CellSize`] where the side of a square cell is not positive or makes too many
    /// cells, [`MetricsError::CellBeyondPlace`] where it is longer than the place twice over,
    /// [`MetricsError::GridSize`] where columns and rows make none or too many.
    pub fn new(world: &World2d, params: CoverageParams) -> Result<Self, MetricsError> {
        let cells = FreeCells::new(world, params.cells)?;
        let count = |marks: &[bool]| marks.iter().filter(|&&mark| mark).count();
        Ok(Self {
            params,
            first_seen_m: vec![f64::INFINITY; cells.free.len()],
            cells_total: count(&cells.free),
            cells_reachable: count(&cells.reachable),
            cells_seen: 0,
            first_seen_sum_m: 0.0,
            newly_seen: Vec::new(),
            fill: RowFill::default(),
            cells,
        })
    }

    /// Marks what a view saw at a driven distance. Cost: the cells within the view.
    pub fn see(&mut self, view: &View, distance_m: f64) {
        let origin = self.cells.in_cells(&Point2::from(view.world_from_sensor.translation));
        match self.params.rule {
            Rule::Rays => {
                for (end, &hit) in view.ends_in_world.iter().zip(&view.hit) {
                    let mut end = self.cells.in_cells(end);
                    let ray = end - origin;
                    let length = ray.norm();
                    if hit && length > 0.0 {
                        // A hit on a wall along a cell border must not see the cell behind it.
                        end -= ray * (1e-9 / length).min(1.0);
                    }
                    touched_cells(&origin, &end, |column, row| {
                        self.sight(column, row, distance_m);
                    });
                }
            }
            Rule::View => {
                if view.bearing_step_rad >= std::f64::consts::PI {
                    return;
                }
                let mut polygon: Vec<Point2> =
                    view.ends_in_world.iter().map(|end| self.cells.in_cells(end)).collect();
                if !view.full_circle {
                    polygon.push(origin);
                }
                let mut fill = std::mem::take(&mut self.fill);
                fill.fill(&polygon, |column, row| self.sight(column, row, distance_m));
                self.fill = fill;
            }
        }
    }

    fn sight(&mut self, column: i64, row: i64, distance_m: f64) {
        let Some(index) = self.cells.index(column, row) else { return };
        if self.cells.reachable[index] && self.first_seen_m[index] == f64::INFINITY {
            self.first_seen_m[index] = distance_m;
            self.first_seen_sum_m += distance_m;
            self.cells_seen += 1;
            self.newly_seen.push(index);
        }
    }

    /// How coverage is judged.
    pub fn params(&self) -> &CoverageParams {
        &self.params
    }

    /// Number of free cells, reachable or not.
    pub fn cells_total(&self) -> usize {
        self.cells_total
    }

    /// Number of free cells that the robot can reach: those that count.
    pub fn cells_reachable(&self) -> usize {
        self.cells_reachable
    }

    /// Number of reachable cells seen so far.
    pub fn cells_seen(&self) -> usize {
        self.cells_seen
    }

    /// Share of the reachable cells seen so far; 0 where none can be reached.
    pub fn fraction(&self) -> f64 {
        if self.cells_reachable == 0 {
            return 0.0;
        }
        self.cells_seen as f64 / self.cells_reachable as f64
    }

    /// Whether every reachable cell was seen, of at least one.
    pub fn is_complete(&self) -> bool {
        self.cells_reachable > 0 && self.cells_seen == self.cells_reachable
    }

    /// d_exp of \[ISRR19\] sec. 6: the mean over the reachable cells of the distance at which each
    /// was first seen, metres; `None` until all were.
    pub fn d_exp_m(&self) -> Option<f64> {
        self.is_complete().then(|| self.first_seen_sum_m / self.cells_reachable as f64)
    }

    /// Driven distance at which a cell was first seen, metres; `None` for a cell not seen, or one
    /// that does not count.
    pub fn first_seen_m(&self, index: usize) -> Option<f64> {
        self.first_seen_m.get(index).copied().filter(|distance_m| distance_m.is_finite())
    }

    /// The cells first seen since the last call, as indices in order of sight.
    pub fn take_newly_seen(&mut self) -> Vec<usize> {
        std::mem::take(&mut self.newly_seen)
    }

    /// Columns and rows of the evaluation grid.
    pub fn size(&self) -> (usize, usize) {
        (self.cells.columns, self.cells.rows)
    }

    /// Width and height of a cell, metres.
    pub fn cell_m(&self) -> Vector2 {
        self.cells.cell_m
    }

    /// Centre of a cell in the world frame.
    pub fn centre_in_world(&self, index: usize) -> Point2 {
        self.cells.centre(index)
    }

    /// Whether a cell counts: free, and reachable from the start.
    pub fn counts(&self, index: usize) -> bool {
        self.cells.reachable.get(index).copied().unwrap_or(false)
    }
}
