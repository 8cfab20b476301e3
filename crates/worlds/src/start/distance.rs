//! How far every cell is from solid ground.

use crate::CellMap;

/// The squared Euclidean distance, in cells and between centres, from each cell to the nearest solid
/// cell, row-major; a ring of solid cells around the map counts. 0 for solid cells.
///
/// No distance exceeds half the shorter side, so that 32 bits hold every square for maps of up to
/// 2^32 cells. Linear in the cells, exact in integers: distances along columns first, then along each row the
/// lower envelope of the parabolas that stand on them (Meijster, Roerdink and Hesselink, "A general
/// algorithm for computing distance transforms in linear time", 2000).
pub fn squared_distances(cells: &CellMap) -> Vec<u32> {
    let (columns, rows) = (cells.columns, cells.rows);
    let mut result = vec![0_u32; columns * rows];
    // Along columns: steps down to solid ground, then the lesser of that and the steps up.
    for row in 0..rows {
        for column in 0..columns {
            let index = row * columns + column;
            let below = if row == 0 { 0 } else { result[index - columns] };
            result[index] = if cells.solid[index] { 0 } else { below + 1 };
        }
    }
    for row in (0..rows).rev() {
        for column in 0..columns {
            let index = row * columns + column;
            let above = if row + 1 == rows { 0 } else { result[index + columns] };
            result[index] = result[index].min(above + 1);
        }
    }
    let mut envelope = Envelope::default();
    for row in result.chunks_mut(columns.max(1)) {
        envelope.lower(row);
    }
    result
}

/// The lower envelope of the parabolas of one row; kept to reuse its memory.
#[derive(Default)]
struct Envelope {
    /// Heights of the parabolas: distance along the column, with a solid column at each end.
    heights: Vec<i64>,
    /// The parabolas of the envelope, and the first column at which each is the lowest.
    kept: Vec<(i64, i64)>,
}

impl Envelope {
    /// Turns distances along columns into squared distances in the plane.
    fn lower(&mut self, row: &mut [u32]) {
        self.heights.clear();
        self.heights.push(0);
        self.heights.extend(row.iter().map(|&steps| i64::from(steps)));
        self.heights.push(0);
        let heights = &self.heights;
        let last = heights.len() as i64;
        let value = |at: i64, of: i64| {
            let height = heights[of as usize];
            (at - of) * (at - of) + height * height
        };
        self.kept.clear();
        self.kept.push((0, 0));
        for next in 1..last {
            while let Some(&(of, from)) = self.kept.last()
                && value(from, of) > value(from, next)
            {
                self.kept.pop();
            }
            let from = match self.kept.last() {
                None => 0,
                Some(&(of, _)) => {
                    let (a, b) = (heights[of as usize], heights[next as usize]);
                    let meet = next * next - of * of + b * b - a * a;
                    1 + meet.div_euclid(2 * (next - of))
                }
            };
            if from < last {
                self.kept.push((next, from));
            }
        }
        let mut which = self.kept.len() - 1;
        for at in (0..last - 2).rev() {
            while self.kept[which].1 > at + 1 {
                which -= 1;
            }
            row[at as usize] = value(at + 1, self.kept[which].0) as u32;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// By the definition: the least over all solid cells and the ring around the map.
    fn slow(cells: &CellMap) -> Vec<u32> {
        let (columns, rows) = (cells.columns as i64, cells.rows as i64);
        let all = |c: i64, r: i64| (c.min(columns - 1).max(0), r.min(rows - 1).max(0)) == (c, r);
        let mut distances = Vec::new();
        for row in 0..rows {
            for column in 0..columns {
                let mut least = u32::MAX;
                for r in -1..=rows {
                    for c in -1..=columns {
                        if !all(c, r) || cells.is_solid(c, r) {
                            let squared = (c - column).pow(2) + (r - row).pow(2);
                            least = least.min(squared as u32);
                        }
                    }
                }
                distances.push(least);
            }
        }
        distances
    }

    proptest! {
        #[test]
        fn agrees_with_the_definition(
            columns in 1..14_usize,
            rows in 1..14_usize,
            density in 0.0..0.5_f64,
            draws in prop::collection::vec(0.0..1.0_f64, 14 * 14),
        ) {
            let solid = draws[..columns * rows].iter().map(|&draw| draw < density).collect();
            let cells = CellMap { solid, ..CellMap::free(columns, rows, 1.0) };
            prop_assert_eq!(squared_distances(&cells), slow(&cells));
        }
    }
}
