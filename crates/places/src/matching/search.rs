//! The best pose of a window, by scores at several resolutions (Olson 2009).

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use geometry::Point2;
use pose::Se2;

use super::Table;
use super::table::Pyramid;

/// Where a search looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    /// The middle: the scan in the frame of the place.
    pub place_from_scan: Se2,
    /// To either side along each axis, metres.
    pub reach_m: f64,
    /// To either side in heading, radians.
    pub reach_rad: f64,
    /// Between headings, radians.
    pub angle_step_rad: f64,
}

/// What a search found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found {
    /// The best pose of the scan in the frame of the place.
    pub place_from_scan: Se2,
    /// Its score, from 0 to 1: 1 where every point lies on something known.
    pub score: f64,
    /// The best score of a pose that is another one, from 0 to 1; not looked for below the share of the
    /// best that counts.
    pub elsewhere: f64,
}

/// A block of 2^level translations along each axis at one heading, with the best that it can hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Block {
    bound: u32,
    // Ties go to the middle of the window, so that the answer depends on no order of visits.
    from_middle: Reverse<u64>,
    level: Reverse<u8>,
    heading: i32,
    column: i32,
    row: i32,
}

/// Which poses are others: what makes a match ambiguous.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Apart {
    /// Farther away than this, metres.
    pub metres: f64,
    /// Turned by more than this, radians.
    pub radians: f64,
    /// Only scores above this share of the best are of interest.
    pub share: f64,
}

/// Blocks that are bounded, at most: a search that has looked at so many takes the best that it knows.
const LOOKS: usize = 30_000;

/// The widest block has 2^this translations along each axis.
const WIDEST: usize = 4;

/// The best pose of a window for points, and the best score of a pose elsewhere.
///
/// Exact over the window's grid of poses: translations by cells of the table, headings by the step. Blocks
/// of translations are opened in the order of their bounds, so that single poses come up by falling score.
/// `None` where there is no point. Cost: a lookup per point for every block that is bounded.
pub fn search(table: &Table, points: &[Point2], window: &Window, apart: &Apart) -> Option<Found> {
    if points.is_empty() {
        return None;
    }
    let mut looking = Looking::new(table, points, window);
    let best = looking.best()?;
    let pose = looking.pose(&best);
    let most = 255.0 * points.len() as f64;
    let elsewhere = looking.elsewhere(&best, apart);
    Some(Found {
        place_from_scan: pose,
        score: f64::from(best.bound) / most,
        elsewhere: f64::from(elsewhere) / most,
    })
}

/// A search under way.
struct Looking<'a> {
    window: &'a Window,
    cell_m: f64,
    /// Translations to either side, in cells; headings to either side, in steps.
    cells: i32,
    turns: i32,
    pyramid: Pyramid,
    /// By heading: where the pyramid holds each point.
    turned: Vec<Vec<usize>>,
    heap: BinaryHeap<Block>,
    looks: usize,
}

impl<'a> Looking<'a> {
    fn new(table: &Table, points: &[Point2], window: &'a Window) -> Self {
        let cell_m = table.cell_m();
        let cells = (window.reach_m / cell_m).ceil() as i32;
        let turns = (window.reach_rad / window.angle_step_rad).ceil() as i32;
        let top = (cells.max(1).ilog2() as usize).min(WIDEST);
        let mut looking = Self {
            window,
            cell_m,
            cells,
            turns,
            pyramid: Pyramid::over(table, top, cells as usize),
            turned: Vec::with_capacity(2 * turns as usize + 1),
            heap: BinaryHeap::new(),
            looks: 0,
        };
        for turn in -turns..=turns {
            let pose = at(window, turn, 0, 0, cell_m);
            let cells_of = points.iter().map(|point| table.cell(&pose.transform(point)));
            let bases = cells_of.filter_map(|cell| looking.pyramid.base(cell)).collect();
            looking.turned.push(bases);
            for row in (-cells..=cells).step_by(1 << top) {
                for column in (-cells..=cells).step_by(1 << top) {
                    let block = looking.bounded(top, turn, column, row);
                    looking.heap.push(block);
                }
            }
        }
        looking
    }

    fn bounded(&mut self, level: usize, heading: i32, column: i32, row: i32) -> Block {
        self.looks += 1;
        let bases = &self.turned[(heading + self.turns) as usize];
        let bound = self.pyramid.bound(level, bases, column, row);
        // Twice the distance of the block's middle, which falls between cells.
        let middle = |first: i32| i64::from(2 * first + (1 << level) - 1);
        let off = middle(column).pow(2) + middle(row).pow(2);
        let from_middle = Reverse(off as u64 + 4 * u64::from(heading.unsigned_abs()));
        Block { bound, from_middle, level: Reverse(level as u8), heading, column, row }
    }

    /// The four parts of a block, those within the window.
    fn parts(&mut self, block: &Block) -> impl Iterator<Item = Block> + use<> {
        let level = usize::from(block.level.0) - 1;
        let half = 1 << level;
        let mut parts = [None; 4];
        let corners = [(0, 0), (half, 0), (0, half), (half, half)];
        for (part, (right, up)) in parts.iter_mut().zip(corners) {
            let (column, row) = (block.column + right, block.row + up);
            if column <= self.cells && row <= self.cells {
                *part = Some(self.bounded(level, block.heading, column, row));
            }
        }
        parts.into_iter().flatten()
    }

    /// The best single pose.
    fn best(&mut self) -> Option<Block> {
        while let Some(block) = self.heap.pop() {
            if block.level.0 == 0 {
                return Some(block);
            }
            let parts = self.parts(&block);
            if self.looks >= LOOKS {
                return parts.max().and_then(|part| self.down(part));
            }
            self.heap.extend(parts);
        }
        None
    }

    /// From a block the way of the best part to a single pose.
    fn down(&mut self, mut block: Block) -> Option<Block> {
        while block.level.0 > 0 {
            block = self.parts(&block).max()?;
        }
        Some(block)
    }

    /// The best score of a pose that is another than the best one; 0 where none has more than the share
    /// that counts.
    fn elsewhere(&mut self, best: &Block, apart: &Apart) -> u32 {
        if apart.share >= 1.0 {
            return 0;
        }
        let enough = apart.share * f64::from(best.bound);
        while let Some(block) = self.heap.pop() {
            if f64::from(block.bound) < enough {
                break;
            }
            if self.is_near(&block, best, apart) {
                continue;
            }
            // What could not be looked at may be as good as its bound.
            if block.level.0 == 0 || self.looks >= LOOKS {
                return block.bound;
            }
            let parts = self.parts(&block);
            self.heap.extend(parts.filter(|part| f64::from(part.bound) >= enough));
        }
        0
    }

    /// Whether all poses of a block are the same one as the best.
    fn is_near(&self, block: &Block, best: &Block, apart: &Apart) -> bool {
        let turn = f64::from(block.heading - best.heading) * self.window.angle_step_rad;
        let last = (1 << block.level.0) - 1;
        let farthest =
            |first: i32, of: i32| f64::from((first - of).abs().max((first + last - of).abs()));
        let off = farthest(block.column, best.column).hypot(farthest(block.row, best.row));
        turn.abs() <= apart.radians && off * self.cell_m <= apart.metres
    }

    fn pose(&self, block: &Block) -> Se2 {
        at(self.window, block.heading, block.column, block.row, self.cell_m)
    }
}

/// The pose of a window's grid: headings turn the scan about its own origin.
fn at(window: &Window, turn: i32, column: i32, row: i32, cell_m: f64) -> Se2 {
    let middle = &window.place_from_scan;
    let angle = middle.angle() + f64::from(turn) * window.angle_step_rad;
    Se2::new(
        middle.translation.x + f64::from(column) * cell_m,
        middle.translation.y + f64::from(row) * cell_m,
        angle,
    )
}
