//! A table of scores: how near a point is to anything known (Olson 2009).

use geometry::Point2;

/// Cells from a point's own over which its score falls.
const REACH: isize = 2;

/// Scores from 0 to 255 over a grid.
#[derive(Clone, Debug)]
pub struct Table {
    cell_m: f64,
    origin: Point2,
    columns: usize,
    rows: usize,
    scores: Vec<u8>,
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
            (((high - low + 2.0 * margin) / cell_m).ceil() as usize + 1).min(MOST)
        };
        let (columns, rows) = (cells(low[0], high[0]), cells(low[1], high[1]));
        let mut table = Self {
            cell_m,
            origin: Point2::new(low[0] - margin, low[1] - margin),
            columns,
            rows,
            scores: vec![0; columns * rows],
        };
        let fall: Vec<u8> = (-REACH..=REACH)
            .flat_map(|y| (-REACH..=REACH).map(move |x| (x * x + y * y) as f64))
            .map(|squared| (255.0 * (-0.5 * squared).exp()).round() as u8)
            .collect();
        for point in points {
            table.spread(&point, &fall);
        }
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
        if (column as usize) < self.columns && (row as usize) < self.rows {
            u32::from(self.scores[row as usize * self.columns + column as usize])
        } else {
            0
        }
    }
}

/// The best scores over blocks of 1, 2, 4, .. cells along each side, from every cell to the right and up.
///
/// Wide margins of nothing, so that no translation of a window leads a point that matters out of it.
pub(super) struct Pyramid {
    /// Cells of margin to every side.
    margin: usize,
    /// Cells that a point is moved by, at most, and those of the widest block.
    reach: isize,
    inner: [isize; 2],
    columns: usize,
    /// By level: the best score of the block of 2^level cells that starts at a cell.
    levels: Vec<Vec<u8>>,
}

impl Pyramid {
    /// The pyramid up to a level, for translations of at most so many cells to either side.
    ///
    /// Cost: one pass over the cells and their margins for each level.
    pub fn over(table: &Table, top: usize, translations: usize) -> Self {
        let margin = 2 * translations + (1 << top);
        let (columns, rows) = (table.columns + 2 * margin, table.rows + 2 * margin);
        let mut scores = vec![0_u8; columns * rows];
        for row in 0..table.rows {
            let from = &table.scores[row * table.columns..(row + 1) * table.columns];
            let start = (row + margin) * columns + margin;
            scores[start..start + table.columns].copy_from_slice(from);
        }
        let mut levels = vec![scores];
        for level in 0..top {
            // Past the end of a row comes the margin of the next, in which no block reaches anything yet.
            levels.push(widened(&levels[level], 1 << level, columns << level));
        }
        Self {
            margin,
            reach: (translations + (1 << top)) as isize,
            inner: [table.columns as isize, table.rows as isize],
            columns,
            levels,
        }
    }

    /// Where a cell of the table is found; `None` if no translation leads it to anything.
    pub fn base(&self, (x, y): (isize, isize)) -> Option<usize> {
        let matters = |at: isize, count: isize| at >= -self.reach && at < count + self.reach;
        (matters(x, self.inner[0]) && matters(y, self.inner[1])).then(|| {
            let (column, row) = (x + self.margin as isize, y + self.margin as isize);
            row as usize * self.columns + column as usize
        })
    }

    /// The sum over points of the best score that a translation by `column` and `row` cells, and by less
    /// than 2^level cells more along each axis, gives each of them.
    pub fn bound(&self, level: usize, bases: &[usize], column: i32, row: i32) -> u32 {
        let offset = row as isize * self.columns as isize + column as isize;
        let scores = &self.levels[level];
        bases.iter().map(|base| u32::from(scores[base.wrapping_add_signed(offset)])).sum()
    }
}

/// The greatest of each, of what stands `along` after it, `across` after it, and both.
fn widened(all: &[u8], along: usize, across: usize) -> Vec<u8> {
    let after = |shift: usize| &all[shift.min(all.len())..];
    let mut widened = all.to_vec();
    for shift in [along, across, along + across] {
        widened.iter_mut().zip(after(shift)).for_each(|(one, other)| *one = (*one).max(*other));
    }
    widened
}
