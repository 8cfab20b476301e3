//! A table of scores: how near a point is to anything known (Olson 2009).

use geometry::Point2;

/// Cells from a point's own over which its score falls.
const REACH: isize = 2;

/// Cells of a block of translations that are bounded together.
pub(super) const BLOCK: usize = 4;

/// Scores from 0 to 255 over a grid, and over blocks of it the best that any translation within a block
/// can give.
#[derive(Clone, Debug)]
pub struct Table {
    cell_m: f64,
    origin: Point2,
    columns: usize,
    rows: usize,
    scores: Vec<u8>,
    block_columns: usize,
    block_rows: usize,
    blocks: Vec<u8>,
}

/// Cells along one side, at most: a place is some ten metres wide.
const MOST: usize = 2048;

impl Table {
    /// The table of a place's points.
    pub fn new(points: impl Iterator<Item = Point2> + Clone, cell_m: f64) -> Self {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for point in points.clone() {
            low = [low[0].min(point.x), low[1].min(point.y)];
            high = [high[0].max(point.x), high[1].max(point.y)];
        }
        if low[0] > high[0] {
            (low, high) = ([0.0; 2], [0.0; 2]);
        }
        let margin = (REACH + 1) as f64 * cell_m;
        let cells = |low: f64, high: f64| {
            let count = (((high - low + 2.0 * margin) / cell_m).ceil() as usize + 1).min(MOST);
            count.div_ceil(BLOCK) * BLOCK
        };
        let (columns, rows) = (cells(low[0], high[0]), cells(low[1], high[1]));
        let mut table = Self {
            cell_m,
            origin: Point2::new(low[0] - margin, low[1] - margin),
            columns,
            rows,
            scores: vec![0; columns * rows],
            block_columns: columns / BLOCK + 1,
            block_rows: rows / BLOCK + 1,
            blocks: Vec::new(),
        };
        let fall: Vec<u8> = (-REACH..=REACH)
            .flat_map(|y| (-REACH..=REACH).map(move |x| (x * x + y * y) as f64))
            .map(|squared| (255.0 * (-0.5 * squared).exp()).round() as u8)
            .collect();
        for point in points {
            table.spread(&point, &fall);
        }
        table.bound();
        table
    }

    fn spread(&mut self, point: &Point2, fall: &[u8]) {
        let (x, y) = self.cell(point);
        let side = 2 * REACH + 1;
        for dy in -REACH..=REACH {
            for dx in -REACH..=REACH {
                let (column, row) = (x + dx, y + dy);
                let inside = (0..self.columns as isize).contains(&column)
                    && (0..self.rows as isize).contains(&row);
                if inside {
                    let at = row as usize * self.columns + column as usize;
                    let score = fall[((dy + REACH) * side + dx + REACH) as usize];
                    self.scores[at] = self.scores[at].max(score);
                }
            }
        }
    }

    /// A block's bound covers its own cells and those of the next block in either direction: where a
    /// point gets to by a translation of less than a block.
    fn bound(&mut self) {
        let mut own = vec![0_u8; self.block_columns * self.block_rows];
        for row in 0..self.rows {
            for column in 0..self.columns {
                let at = row / BLOCK * self.block_columns + column / BLOCK;
                own[at] = own[at].max(self.scores[row * self.columns + column]);
            }
        }
        // One row and column more on the low side: points that a translation brings in.
        let (columns, rows) = (self.block_columns + 1, self.block_rows + 1);
        let get = |column: isize, row: isize| {
            let inside = (0..self.block_columns as isize).contains(&column)
                && (0..self.block_rows as isize).contains(&row);
            if inside { own[row as usize * self.block_columns + column as usize] } else { 0 }
        };
        let mut blocks = vec![0_u8; columns * rows];
        for row in 0..rows as isize {
            for column in 0..columns as isize {
                let (x, y) = (column - 1, row - 1);
                let best = get(x, y).max(get(x + 1, y)).max(get(x, y + 1)).max(get(x + 1, y + 1));
                blocks[row as usize * columns + column as usize] = best;
            }
        }
        (self.block_columns, self.block_rows, self.blocks) = (columns, rows, blocks);
    }

    /// Side of a cell, metres.
    pub fn cell_m(&self) -> f64 {
        self.cell_m
    }

    /// The cell of a point, which may lie outside.
    pub(super) fn cell(&self, point: &Point2) -> (isize, isize) {
        let offset = (point - self.origin) / self.cell_m;
        (offset.x.floor() as isize, offset.y.floor() as isize)
    }

    /// Score of a point, from 0 to 255; 0 far from anything known.
    pub fn score_at(&self, point: &Point2) -> u32 {
        let (column, row) = self.cell(point);
        self.score(column, row)
    }

    /// Score of a cell; 0 outside.
    #[inline]
    pub(super) fn score(&self, column: isize, row: isize) -> u32 {
        if (column as usize) < self.columns && (row as usize) < self.rows {
            u32::from(self.scores[row as usize * self.columns + column as usize])
        } else {
            0
        }
    }

    /// The best score of a cell moved by 0 to [`BLOCK`] - 1 cells up and to the right.
    #[inline]
    pub(super) fn bound_at(&self, column: isize, row: isize) -> u32 {
        let block = BLOCK as isize;
        let (x, y) = (column.div_euclid(block) + 1, row.div_euclid(block) + 1);
        if (x as usize) < self.block_columns && (y as usize) < self.block_rows {
            u32::from(self.blocks[y as usize * self.block_columns + x as usize])
        } else {
            0
        }
    }
}
