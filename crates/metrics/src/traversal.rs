//! Which unit cells a segment passes through. Coordinates are in units of cells.

use geometry::Point2;

/// Rounding that does not count as entering a cell, in cells.
const EPS: f64 = 1e-9;

/// Calls `visit(column, row)` for every cell whose open interior the segment crosses, once each.
///
/// A segment that runs along the sides of cells crosses none. Cost: the cells visited.
pub(crate) fn crossed_interiors(a: &Point2, b: &Point2, mut visit: impl FnMut(i64, i64)) {
    let (a, b) = if a.x <= b.x { (a, b) } else { (b, a) };
    let (first, last) = ((a.x + EPS).floor() as i64, (b.x - EPS).ceil() as i64 - 1);
    for column in first..=last {
        let (y0, y1) = rows_in_column(a, b, column);
        let (low, high) = (y0.min(y1), y0.max(y1));
        for row in (low + EPS).floor() as i64..(high - EPS).ceil() as i64 {
            visit(column, row);
        }
    }
}

/// Calls `visit(column, row)` for every half-open cell `[c, c + 1) × [r, r + 1)` that the closed
/// segment touches, once each. Cost: the cells visited.
pub(crate) fn touched_cells(a: &Point2, b: &Point2, mut visit: impl FnMut(i64, i64)) {
    let (a, b) = if a.x <= b.x { (a, b) } else { (b, a) };
    for column in a.x.floor() as i64..=b.x.floor() as i64 {
        let (y0, y1) = rows_in_column(a, b, column);
        for row in y0.min(y1).floor() as i64..=y0.max(y1).floor() as i64 {
            visit(column, row);
        }
    }
}

/// y of the segment where it enters and leaves a column that it spans; `a` is the left end.
fn rows_in_column(a: &Point2, b: &Point2, column: i64) -> (f64, f64) {
    let (left, right) = (column as f64, column as f64 + 1.0);
    let slope = (b.y - a.y) / (b.x - a.x);
    let enter = if a.x >= left { a.y } else { a.y + (left - a.x) * slope };
    let leave = if b.x <= right { b.y } else { a.y + (right - a.x) * slope };
    (enter, leave)
}
