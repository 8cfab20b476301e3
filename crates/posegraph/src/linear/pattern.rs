//! Which blocks of the matrix are stored, and where.

use super::ordering::minimum_degree;

/// Where a block is stored: entry `(row, column)` of it is at `start + column · stride + row`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Slot {
    /// Position of the first entry.
    pub start: usize,
    /// Distance between columns.
    pub stride: usize,
}

/// The lower triangle of a symmetric block matrix in elimination order, stored by columns.
///
/// The `D` columns of a block column are stored one after the other, each with all rows of the
/// diagonal block first and then those of the blocks below it, from the top down.
#[derive(Clone, Debug)]
pub(crate) struct BlockPattern<const D: usize> {
    /// Position of each block in the elimination order.
    position: Vec<usize>,
    /// Where the blocks below the diagonal of each column start in `rows`.
    starts: Vec<usize>,
    /// Positions of the blocks below the diagonal, ascending in each column.
    rows: Vec<usize>,
}

impl<const D: usize> BlockPattern<D> {
    /// The pattern in which these pairs of blocks meet, in an order that keeps the factor sparse.
    ///
    /// Pairs may repeat and stand in any order; the result depends on the set only. Cost: sorting
    /// the pairs, and the ordering.
    pub(crate) fn new(count: usize, pairs: impl Iterator<Item = (usize, usize)>) -> Self {
        let mut pairs: Vec<(usize, usize)> = pairs
            .filter(|(a, b)| a != b)
            .map(|(a, b)| if a < b { (b, a) } else { (a, b) })
            .collect();
        pairs.sort_unstable();
        pairs.dedup();
        let (starts, rows) = by_columns(count, pairs.iter().copied());
        let order = minimum_degree(&starts, &rows);
        let mut position = vec![0; count];
        for (at, &block) in order.iter().enumerate() {
            position[block] = at;
        }
        // Two stable passes sort by row, then by column.
        let lower = pairs.iter().map(|&(a, b)| {
            let (a, b) = (position[a], position[b]);
            (a.max(b), a.min(b))
        });
        let (by_row_starts, columns) = by_columns(count, lower);
        let sorted = (0..count).flat_map(|row| {
            columns[by_row_starts[row]..by_row_starts[row + 1]].iter().map(move |&c| (c, row))
        });
        let (starts, rows) = by_columns(count, sorted);
        Self { position, starts, rows }
    }

    /// Number of blocks in a row or column.
    pub(crate) fn blocks(&self) -> usize {
        self.position.len()
    }

    /// Position of a block in the elimination order: its unknowns start at `D` times this.
    pub(crate) fn position(&self, block: usize) -> usize {
        self.position[block]
    }

    /// Number of stored numbers.
    pub(crate) fn len(&self) -> usize {
        (self.blocks() + self.rows.len()) * D * D
    }

    /// Where the diagonal block at a position of the order is stored.
    pub(crate) fn diagonal(&self, position: usize) -> Slot {
        Slot {
            start: (self.starts[position] + position) * D * D,
            stride: (self.below(position).len() + 1) * D,
        }
    }

    /// Where the block at `(row, column)` is stored, positions of the order with `row > column`;
    /// `None` where no pair gave one.
    pub(crate) fn slot(&self, row: usize, column: usize) -> Option<Slot> {
        let at = self.below(column).binary_search(&row).ok()?;
        let diagonal = self.diagonal(column);
        Some(Slot { start: diagonal.start + (at + 1) * D, ..diagonal })
    }

    /// Positions of the stored blocks below the diagonal of a column, ascending.
    pub(crate) fn below(&self, column: usize) -> &[usize] {
        &self.rows[self.starts[column]..self.starts[column + 1]]
    }
}

/// Pairs `(column, row)` gathered by column, in each column in the order in which they come.
fn by_columns(
    count: usize,
    pairs: impl Iterator<Item = (usize, usize)> + Clone,
) -> (Vec<usize>, Vec<usize>) {
    let mut starts = vec![0; count + 1];
    let mut total = 0;
    for (column, _) in pairs.clone() {
        starts[column + 1] += 1;
        total += 1;
    }
    for column in 0..count {
        starts[column + 1] += starts[column];
    }
    let mut next = starts.clone();
    let mut rows = vec![0; total];
    for (column, row) in pairs {
        rows[next[column]] = row;
        next[column] += 1;
    }
    (starts, rows)
}
