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
    let slope = (b.y - a.y) / (b.x - a.x);
    let (first, last) = (floor(a.x), floor(b.x));
    let mut enter = a.y;
    for column in first..=last {
        let leave = if column == last { b.y } else { a.y + ((column + 1) as f64 - a.x) * slope };
        let (enter_row, leave_row) = (floor(enter), floor(leave));
        for row in enter_row.min(leave_row)..=enter_row.max(leave_row) {
            visit(column, row);
        }
        enter = leave;
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

/// The whole number at or below, without the call into the maths library that `f64::floor` is on
/// plain x86-64.
#[inline]
fn floor(x: f64) -> i64 {
    let toward_zero = x as i64;
    toward_zero - i64::from((toward_zero as f64) > x)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use proptest::prelude::*;

    use super::*;

    /// Whether a segment with ends on the quarter grid crosses the open interior of a cell:
    /// separating axes in whole numbers, in units of a quarter cell.
    fn crosses_exactly(a: (i64, i64), b: (i64, i64), column: i64, row: i64) -> bool {
        let (left, low) = (4 * column, 4 * row);
        let overlaps = |p: i64, q: i64, from: i64| p.max(q) > from && p.min(q) < from + 4;
        let side = |x: i64, y: i64| (b.0 - a.0) * (y - a.1) - (b.1 - a.1) * (x - a.0);
        let sides =
            [side(left, low), side(left + 4, low), side(left, low + 4), side(left + 4, low + 4)];
        let straddles = sides.iter().any(|&s| s < 0) && sides.iter().any(|&s| s > 0);
        overlaps(a.0, b.0, left) && overlaps(a.1, b.1, low) && (straddles || a == b)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(3000))]

        #[test]
        fn interiors_are_crossed_exactly(
            a in (-24..24i64, -24..24i64), b in (-24..24i64, -24..24i64),
        ) {
            let point = |p: (i64, i64)| Point2::new(p.0 as f64 / 4.0, p.1 as f64 / 4.0);
            let mut found = Vec::new();
            crossed_interiors(&point(a), &point(b), |column, row| found.push((column, row)));
            let once: BTreeSet<(i64, i64)> = found.iter().copied().collect();
            prop_assert_eq!(once.len(), found.len(), "no cell twice");
            for column in -8..8 {
                for row in -8..8 {
                    let expected = crosses_exactly(a, b, column, row);
                    prop_assert_eq!(once.contains(&(column, row)), expected, "{} {}", column, row);
                }
            }
            // A touched cell holds every crossed one, and visits none twice either.
            let mut touched = Vec::new();
            touched_cells(&point(a), &point(b), |column, row| touched.push((column, row)));
            let touched_once: BTreeSet<(i64, i64)> = touched.iter().copied().collect();
            prop_assert_eq!(touched_once.len(), touched.len());
            prop_assert!(touched_once.is_superset(&once));
        }
    }

    #[test]
    fn a_segment_along_a_border_touches_but_does_not_cross() {
        let (a, b) = (Point2::new(0.5, 2.0), Point2::new(2.5, 2.0));
        let mut crossed = 0;
        crossed_interiors(&a, &b, |_, _| crossed += 1);
        assert_eq!(crossed, 0);
        let mut touched = Vec::new();
        touched_cells(&a, &b, |column, row| touched.push((column, row)));
        assert_eq!(touched, vec![(0, 2), (1, 2), (2, 2)]);
    }
}
