//! Walls as points: one for each cell that any return lies in.

use std::collections::BTreeSet;

use geometry::Point2;

/// Side of the cells that points are thinned by, metres.
pub(super) const CELL_M: f64 = 0.1;

/// The first point in each cell, in the order in which they came.
#[derive(Debug, Default)]
pub(super) struct Thin {
    cells: BTreeSet<(i32, i32)>,
}

impl Thin {
    /// Whether a point is the first of its cell.
    #[expect(clippy::cast_possible_truncation, reason = "drawn points lie within some kilometres")]
    pub fn takes(&mut self, point: &Point2) -> bool {
        let cell = |metres: f64| (metres / CELL_M).floor() as i32;
        self.cells.insert((cell(point.x), cell(point.y)))
    }
}

/// The points of a list that are the first of their cells.
pub(super) fn thinned(points: &[Point2]) -> Vec<Point2> {
    let mut thin = Thin::default();
    points.iter().filter(|point| thin.takes(point)).copied().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_point_is_left_of_each_cell() {
        let points = [(0.01, 0.0), (0.02, 0.05), (0.11, 0.0), (-0.01, 0.0)];
        let points: Vec<Point2> = points.iter().map(|&(x, y)| Point2::new(x, y)).collect();
        assert_eq!(thinned(&points), [points[0], points[2], points[3]]);
    }
}
