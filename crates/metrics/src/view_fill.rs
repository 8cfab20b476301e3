//! Which cell centres lie in a view. Coordinates are in units of cells.

use geometry::Point2;

/// Rounding that still counts as inside, in cells: neighbouring triangles must leave no gap.
const EPS: f64 = 1e-9;

/// Calls `visit(column, row)` for every cell whose centre lies in the closed triangle.
///
/// Cost: the rows that the triangle spans and the cells visited.
pub(crate) fn centres_in_triangle(corners: [Point2; 3], mut visit: impl FnMut(i64, i64)) {
    let low = corners.iter().map(|p| p.y).fold(f64::INFINITY, f64::min);
    let high = corners.iter().map(|p| p.y).fold(f64::NEG_INFINITY, f64::max);
    let first_row = (low - 0.5 - EPS).ceil() as i64;
    let last_row = (high - 0.5 + EPS).floor() as i64;
    for row in first_row..=last_row {
        let y = (row as f64 + 0.5).clamp(low, high);
        let (mut left, mut right) = (f64::INFINITY, f64::NEG_INFINITY);
        for i in 0..3 {
            let (a, b) = (corners[i], corners[(i + 1) % 3]);
            // From the lower end, so that a shared edge gives both its triangles the same x.
            let (a, b) = if (a.y, a.x) <= (b.y, b.x) { (a, b) } else { (b, a) };
            if y < a.y || y > b.y {
                continue;
            }
            if a.y == b.y {
                left = left.min(a.x);
                right = right.max(b.x);
            } else {
                let x = a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
                left = left.min(x);
                right = right.max(x);
            }
        }
        let first = (left - 0.5 - EPS).ceil();
        let last = (right - 0.5 + EPS).floor();
        if first <= last {
            for column in first as i64..=last as i64 {
                visit(column, row);
            }
        }
    }
}
