//! The best pose of a window, by scores at two resolutions (Olson 2009).

use std::collections::BinaryHeap;

use geometry::Point2;
use pose::Se2;

use super::Table;
use super::table::BLOCK;

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

/// A block of translations at one heading, with the best that it can hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Block {
    bound: u32,
    // Ties go to the middle of the window, so that the answer depends on no order of visits.
    from_middle: std::cmp::Reverse<u64>,
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

/// Blocks that are opened, at most: what is left is bounded by their order.
const OPENED: usize = 3000;

/// The best pose of a window for points, and the best score of a pose elsewhere.
///
/// Exact over the window's grid of poses: translations by cells of the table, headings by the step.
/// `None` where there is no point. Cost: a lookup per point for every block of 4 x 4 translations and
/// every heading, and 16 more for each block whose bound reaches the share of the best.
pub fn search(table: &Table, points: &[Point2], window: &Window, apart: &Apart) -> Option<Found> {
    if points.is_empty() {
        return None;
    }
    let cells = (window.reach_m / table.cell_m()).ceil() as i32;
    let blocks = (2 * cells + 1).div_euclid(BLOCK as i32) + 1;
    let turns = (window.reach_rad / window.angle_step_rad).ceil() as i32;
    let first = -(blocks * BLOCK as i32) / 2;

    let mut turned: Vec<Vec<(isize, isize)>> = Vec::with_capacity(2 * turns as usize + 1);
    let mut heap = BinaryHeap::new();
    for turn in -turns..=turns {
        let pose = at(window, turn, 0, 0, table.cell_m());
        let at_cells: Vec<(isize, isize)> =
            points.iter().map(|point| table.cell(&pose.transform(point))).collect();
        for by in 0..blocks {
            for bx in 0..blocks {
                let (column, row) = (first + bx * BLOCK as i32, first + by * BLOCK as i32);
                let bound: u32 = at_cells
                    .iter()
                    .map(|&(x, y)| table.bound_at(x + column as isize, y + row as isize))
                    .sum();
                let off = (i64::from(column) + 2).pow(2) + (i64::from(row) + 2).pow(2);
                let from_middle = std::cmp::Reverse(off as u64 + u64::from(turn.unsigned_abs()));
                heap.push(Block { bound, from_middle, heading: turn, column, row });
            }
        }
        turned.push(at_cells);
    }

    let mut best: Option<(u32, Se2)> = None;
    let mut peaks: Vec<(u32, Se2)> = Vec::new();
    let mut opened = 0;
    while let Some(block) = heap.pop() {
        let enough = best.map_or(0.0, |(score, _)| apart.share * f64::from(score));
        if best.is_some() && (f64::from(block.bound) < enough || opened >= OPENED) {
            break;
        }
        opened += 1;
        let at_cells = &turned[(block.heading + turns) as usize];
        let mut top: Option<(u32, i32, i32)> = None;
        for row in block.row..block.row + BLOCK as i32 {
            for column in block.column..block.column + BLOCK as i32 {
                let score: u32 = at_cells
                    .iter()
                    .map(|&(x, y)| table.score(x + column as isize, y + row as isize))
                    .sum();
                if top.is_none_or(|(least, _, _)| score > least) {
                    top = Some((score, column, row));
                }
            }
        }
        if let Some((score, column, row)) = top {
            let pose = at(window, block.heading, column, row, table.cell_m());
            if best.is_none_or(|(least, _)| score > least) {
                best = Some((score, pose));
            }
            peaks.push((score, pose));
        }
    }
    let (score, pose) = best?;
    let most = 255.0 * points.len() as f64;
    let is_other = |other: &Se2| {
        let between = pose.inverse_mul(other);
        between.distance() > apart.metres || between.angle().abs() > apart.radians
    };
    let elsewhere = peaks.iter().filter(|(_, other)| is_other(other)).map(|peak| peak.0).max();
    Some(Found {
        place_from_scan: pose,
        score: f64::from(score) / most,
        elsewhere: f64::from(elsewhere.unwrap_or(0)) / most,
    })
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
