//! Which cell centres lie in a view. Coordinates are in units of cells.

use geometry::Point2;

/// Rounding that still counts as inside, in cells.
const EPS: f64 = 1e-9;

/// Fills polygons row by row; keeps its memory between calls.
#[derive(Clone, Debug, Default)]
pub(crate) struct RowFill {
    /// Where the border crosses the middle of each row, from the lowest row of the polygon.
    crossings: Vec<Vec<f64>>,
}

impl RowFill {
    /// Calls `visit(column, row)` for every cell whose centre lies in the simple polygon, once
    /// each; on the border itself either may happen.
    ///
    /// Cost: the rows that each edge spans, and the cells visited.
    pub(crate) fn fill(&mut self, polygon: &[Point2], mut visit: impl FnMut(i64, i64)) {
        let (low, high) = polygon
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), p| (l.min(p.y), h.max(p.y)));
        if !low.is_finite() || !high.is_finite() {
            return;
        }
        let first_row = (low - 0.5).floor() as i64;
        let rows = ((high - 0.5).ceil() as i64 - first_row + 1).max(0) as usize;
        if self.crossings.len() < rows {
            self.crossings.resize_with(rows, Vec::new);
        }
        self.crossings[..rows].iter_mut().for_each(Vec::clear);
        for i in 0..polygon.len() {
            let (a, b) = (polygon[i], polygon[(i + 1) % polygon.len()]);
            let (a, b) = if a.y <= b.y { (a, b) } else { (b, a) };
            // Middles y with a.y <= y < b.y: each is crossed by an even number of edges.
            let slope = (b.x - a.x) / (b.y - a.y);
            let mut row = (a.y - 0.5).ceil();
            while row + 0.5 < b.y {
                let x = a.x + (row + 0.5 - a.y) * slope;
                self.crossings[(row as i64 - first_row) as usize].push(x);
                row += 1.0;
            }
        }
        for (row, crossings) in (first_row..).zip(&mut self.crossings[..rows]) {
            crossings.sort_by(f64::total_cmp);
            for span in crossings.chunks_exact(2) {
                let first = (span[0] - 0.5 - EPS).ceil() as i64;
                let last = (span[1] - 0.5 + EPS).floor() as i64;
                for column in first..=last {
                    visit(column, row);
                }
            }
        }
    }
}
