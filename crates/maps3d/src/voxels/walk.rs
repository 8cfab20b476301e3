//! The cells that a ray goes through, in order (Amanatides and Woo 1987).

use nalgebra::Point3;

use super::blocks::Cell;

/// Calls with each cell from that of `from` to that of `to`, both in units of cells, the last one included.
///
/// O(cells). Where the ray passes an edge between cells, one of the two beside it is told.
pub(super) fn walk(from: &Point3<f64>, to: &Point3<f64>, mut call: impl FnMut(Cell)) {
    let mut cell = cell_of(from);
    let end = cell_of(to);
    let way = to - from;
    let mut step = [0_i32; 3];
    let (mut next, mut between) = ([f64::INFINITY; 3], [f64::INFINITY; 3]);
    for axis in 0..3 {
        if way[axis] != 0.0 {
            step[axis] = if way[axis] > 0.0 { 1 } else { -1 };
            let border = f64::from(cell[axis]) + if way[axis] > 0.0 { 1.0 } else { 0.0 };
            next[axis] = (border - from[axis]) / way[axis];
            between[axis] = (1.0 / way[axis]).abs();
        }
    }
    // Exactly so many borders lie between the two cells, whatever rounding says of their order.
    let mut left = [0, 1, 2].map(|axis| end[axis].abs_diff(cell[axis]));
    call(cell);
    while left != [0; 3] {
        let mut axis = 3;
        for candidate in 0..3 {
            if left[candidate] > 0 && (axis == 3 || next[candidate] < next[axis]) {
                axis = candidate;
            }
        }
        cell[axis] += step[axis];
        next[axis] += between[axis];
        left[axis] -= 1;
        call(cell);
    }
}

/// The cell of a point in units of cells.
pub(super) fn cell_of(point: &Point3<f64>) -> Cell {
    [0, 1, 2].map(|axis| point[axis].floor() as i32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ray_goes_from_neighbour_to_neighbour_through_its_cells() {
        let mut seed = 3_u64;
        let mut next = move || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (seed >> 40) as f64 / f64::from(1 << 24) * 20.0 - 10.0
        };
        for _ in 0..200 {
            let mut point = || Point3::new(next(), next(), next());
            let (from, to) = (point(), point());
            let mut cells: Vec<Cell> = Vec::new();
            walk(&from, &to, |cell| cells.push(cell));
            assert_eq!((cells[0], cells[cells.len() - 1]), (cell_of(&from), cell_of(&to)));
            for pair in cells.windows(2) {
                let apart: u32 = (0..3).map(|axis| pair[0][axis].abs_diff(pair[1][axis])).sum();
                assert_eq!(apart, 1);
            }
            // Each cell holds a point of the ray.
            for cell in &cells {
                let way = to - from;
                let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
                for axis in 0..3 {
                    let low = (f64::from(cell[axis]) - from[axis]) / way[axis];
                    let high = (f64::from(cell[axis]) + 1.0 - from[axis]) / way[axis];
                    enter = enter.max(low.min(high));
                    leave = leave.min(low.max(high));
                }
                assert!(enter <= leave + 1e-9);
            }
        }
    }

    #[test]
    fn a_point_is_in_one_cell() {
        let mut cells = Vec::new();
        let at = Point3::new(0.5, -0.5, 2.0);
        walk(&at, &at, |cell| cells.push(cell));
        assert_eq!(cells, [[0, -1, 2]]);
    }
}
