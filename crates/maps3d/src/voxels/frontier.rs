//! Frontier: free cells beside cells that nobody looked into.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::{Point3, Vector3};

use super::VoxelMap;
use super::blocks::{BlockKey, Blocks, CELLS, Cell, SIDE, cell_at, split};
use super::map::CellsOf;
use crate::{FrontierPatch, FrontierPoint, Hovering};

/// The six neighbours of a cell.
pub(super) const BESIDE: [Cell; 6] =
    [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]];

/// A cell next to another.
#[inline]
pub(super) fn beside(cell: Cell, by: Cell) -> Cell {
    std::array::from_fn(|axis| cell[axis].wrapping_add(by[axis]))
}

/// The frontier cells of each block, as places in it, ascending.
#[derive(Clone, Debug, Default)]
pub(super) struct Frontier {
    cells: CellsOf,
}

/// A frontier cell: the cube that it is gathered in, middle, way into the unknown, area in square metres.
type Keyed = ([i32; 3], Point3<f64>, Vector3<f64>, f64);

/// Frontier cells that hang together: area, square metres, and the points that stand for it.
#[derive(Clone, Debug)]
pub(super) struct Opening {
    area_m2: f64,
    /// Middle, unit vector into the unknown, area in square metres; the frame is `map`.
    points: Vec<(Point3<f64>, Vector3<f64>, f64)>,
}

impl Frontier {
    /// Finds the frontier cells of blocks that changed and of those beside them anew. O(cells of blocks).
    pub fn update(&mut self, blocks: &Blocks, turned: &[BlockKey]) {
        let mut dirty: BTreeSet<BlockKey> = turned.iter().copied().collect();
        for &key in turned {
            dirty.extend(BESIDE.map(|by| beside(key, by)));
        }
        for key in dirty {
            let mut found: Vec<u16> = Vec::new();
            for (cell, odds) in blocks.cells(key) {
                let opens = |by: &Cell| blocks.odds(beside(cell, *by)).is_none();
                if odds <= 0 && BESIDE.iter().any(opens) {
                    found.push(split(cell).1 as u16);
                }
            }
            if found.is_empty() {
                self.cells.remove(&key);
            } else {
                self.cells.insert(key, found);
            }
        }
    }

    /// All frontier cells, block by block.
    fn all(&self) -> impl Iterator<Item = Cell> + '_ {
        self.cells
            .iter()
            .flat_map(|(key, places)| places.iter().map(|&place| cell_at(*key, place.into())))
    }

    /// Memory held on the heap, bytes.
    pub fn heap_bytes(&self) -> usize {
        self.cells.values().map(|places| 2 * places.capacity() + 48).sum()
    }
}

/// Frontier cells that no part holds yet, one bit each.
struct Left {
    number_of: BTreeMap<BlockKey, usize>,
    bits: Vec<[u64; CELLS / 64]>,
    last: Option<(BlockKey, Option<usize>)>,
}

impl Left {
    fn of(frontier: &Frontier) -> Self {
        let mut left = Self { number_of: BTreeMap::new(), bits: Vec::new(), last: None };
        for (key, places) in &frontier.cells {
            let mut bits = [0; CELLS / 64];
            for &place in places {
                bits[usize::from(place) / 64] |= 1 << (place % 64);
            }
            left.number_of.insert(*key, left.bits.len());
            left.bits.push(bits);
        }
        left
    }

    /// Takes a cell out; whether it was there.
    fn take(&mut self, cell: Cell) -> bool {
        let (key, place) = split(cell);
        let number = match self.last {
            Some((last, number)) if last == key => number,
            _ => {
                let number = self.number_of.get(&key).copied();
                self.last = Some((key, number));
                number
            }
        };
        let Some(number) = number else { return false };
        let word = &mut self.bits[number][place / 64];
        let bit = 1 << (place % 64);
        let was = *word & bit != 0;
        *word &= !bit;
        was
    }
}

impl VoxelMap {
    /// Puts frontier together and measures it: cells that share a side, an edge or a corner hang together.
    pub(super) fn measure(&mut self) {
        let cell_m2 = self.params.cell_m * self.params.cell_m;
        let mut left = Left::of(&self.frontier);
        let all: Vec<Cell> = self.frontier.all().collect();
        let mut tally = crate::MapTally::default();
        let mut patches: Vec<Opening> = Vec::new();
        let mut stack: Vec<Cell> = Vec::new();
        for first in all {
            if !left.take(first) {
                continue;
            }
            let (mut part, mut given_up_m2) = (Vec::new(), 0.0);
            stack.push(first);
            while let Some(cell) = stack.pop() {
                let normal = self.unknown_beside(cell);
                let middle = self.middle_of(cell);
                let is_near =
                    |(place, radius_m): &(Point3<f64>, f64)| (middle - place).norm() <= *radius_m;
                let area_m2 = cell_m2 * normal.1;
                if self.given_up.iter().any(is_near) {
                    given_up_m2 += area_m2;
                } else {
                    part.push((middle, normal.0, area_m2));
                }
                for by in 0..27 {
                    let by = [by % 3 - 1, by / 3 % 3 - 1, by / 9 - 1];
                    let next = beside(cell, by);
                    if left.take(next) {
                        stack.push(next);
                    }
                }
            }
            let area_m2: f64 = part.iter().map(|(_, _, area_m2)| area_m2).sum();
            tally.given_up_m2 += given_up_m2;
            if area_m2 >= self.params.sliver_m2 && area_m2 > 0.0 {
                tally.open_m2 += area_m2;
                tally.patches += 1;
                patches.push(Opening { area_m2, points: self.gathered(part) });
            } else {
                tally.sliver_m2 += area_m2;
                tally.largest_sliver_m2 = tally.largest_sliver_m2.max(area_m2);
            }
        }
        self.tally = tally;
        self.patches = patches;
    }

    /// The sum of the directions from a cell to unknown cells beside it, and their number.
    fn unknown_beside(&self, cell: Cell) -> (Vector3<f64>, f64) {
        let mut sum = (Vector3::zeros(), 0.0);
        for by in BESIDE {
            if self.blocks.odds(beside(cell, by)).is_none() {
                sum.0 += Vector3::from(by.map(f64::from));
                sum.1 += 1.0;
            }
        }
        sum
    }

    /// Cells of a part as points about as far apart as was asked for: what lies in one cube is one, at the
    /// cell nearest to its middle.
    fn gathered(
        &self,
        part: Vec<(Point3<f64>, Vector3<f64>, f64)>,
    ) -> Vec<(Point3<f64>, Vector3<f64>, f64)> {
        let mut keyed: Vec<Keyed> = part
            .into_iter()
            .map(|(middle, normal, area_m2)| {
                let cube = super::walk::cell_of(&(middle / self.params.point_spacing_m));
                (cube, middle, normal, area_m2)
            })
            .collect();
        keyed.sort_by_key(|a| a.0);
        let mut points: Vec<(Point3<f64>, Vector3<f64>, f64)> = Vec::new();
        for cube in keyed.chunk_by(|a, b| a.0 == b.0) {
            let area_m2: f64 = cube.iter().map(|cell| cell.3).sum();
            let middle =
                cube.iter().map(|cell| cell.1.coords * cell.3).sum::<Vector3<f64>>() / area_m2;
            let normal: Vector3<f64> = cube.iter().map(|cell| cell.2).sum();
            let apart = |cell: &&Keyed| (cell.1.coords - middle).norm_squared();
            let nearest = cube.iter().min_by(|a, b| apart(a).total_cmp(&apart(b)));
            if let Some(nearest) = nearest {
                // Where directions cancel, any of them will do.
                let way = normal.try_normalize(1e-9).unwrap_or_else(Vector3::z);
                points.push((nearest.1, way, area_m2));
            }
        }
        points.sort_by(|a, b| b.2.total_cmp(&a.2));
        points
    }

    /// The patches in the frame `body`; all there are.
    pub(super) fn patches_for(&self, hovering: &Hovering, out: &mut Vec<FrontierPatch>) {
        out.clear();
        let Some(map_from_body) = self.map_from_body(hovering) else { return };
        let turn = map_from_body.rotation.inverse();
        for (number, patch) in self.patches.iter().enumerate() {
            let point =
                |&(middle, normal, area_m2): &(Point3<f64>, Vector3<f64>, f64)| FrontierPoint {
                    in_body: map_from_body.inverse_transform(&middle),
                    normal_in_body: turn * normal,
                    area_m2,
                };
            out.push(FrontierPatch {
                owner: hovering.vertex,
                points: patch.points.iter().map(point).collect(),
                area_m2: patch.area_m2,
                tag: number as u64,
            });
        }
    }

    /// Whether a cell is on a frontier that counts: near one of the points that stand for it.
    pub(super) fn is_goal(&self, middle: &Point3<f64>, near_m: f64) -> bool {
        self.patches
            .iter()
            .flat_map(|patch| &patch.points)
            .any(|(point, _, _)| (point - middle).norm() <= near_m)
    }
}

const _: () = assert!(SIDE * SIDE * SIDE <= 1 << 16);
