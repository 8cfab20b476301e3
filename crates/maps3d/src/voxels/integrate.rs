//! One look written into the cells.

use std::collections::BTreeMap;

use nalgebra::Point3;
use pose::Se3;
use sensing::DepthImage;

use super::VoxelParams;
use super::blocks::{BlockKey, Blocks, CELLS, Cell, split};
use super::walk::{cell_of, walk};

const WORDS: usize = CELLS / 64;

/// Which cells of a block a look touched: each counts once, however many rays go through it, and a hit
/// counts before a miss.
#[derive(Clone, Debug)]
struct Touched {
    key: BlockKey,
    free: Box<[u64; WORDS]>,
    hit: Box<[u64; WORDS]>,
}

/// Memory that looks reuse.
#[derive(Clone, Debug, Default)]
pub(super) struct Scratch {
    touched: Vec<Touched>,
    number_of: BTreeMap<BlockKey, usize>,
    last: Option<(BlockKey, usize)>,
}

impl Scratch {
    fn clear(&mut self) {
        self.touched.clear();
        self.number_of.clear();
        self.last = None;
    }

    fn at(&mut self, cell: Cell) -> (&mut Touched, usize) {
        let (key, place) = split(cell);
        let number = match self.last {
            Some((last, number)) if last == key => number,
            _ => {
                let count = self.touched.len();
                let number = *self.number_of.entry(key).or_insert(count);
                if number == count {
                    let (free, hit) = (Box::new([0; WORDS]), Box::new([0; WORDS]));
                    self.touched.push(Touched { key, free, hit });
                }
                self.last = Some((key, number));
                number
            }
        };
        (&mut self.touched[number], place)
    }

    fn free(&mut self, cell: Cell) {
        let (touched, place) = self.at(cell);
        touched.free[place / 64] |= 1 << (place % 64);
    }

    fn hit(&mut self, cell: Cell) {
        let (touched, place) = self.at(cell);
        touched.hit[place / 64] |= 1 << (place % 64);
    }
}

/// Whether a depth is a reading.
pub(super) fn is_reading(depth_m: f32) -> bool {
    depth_m.is_finite() && depth_m > 0.0
}

/// Walks the ray of every pixel; returns the blocks of which a cell changed what it is, ascending.
pub(super) fn integrate(
    blocks: &mut Blocks,
    params: &VoxelParams,
    map_from_camera: &Se3,
    image: &DepthImage,
    scratch: &mut Scratch,
) -> Vec<BlockKey> {
    scratch.clear();
    let per_m = 1.0 / params.cell_m;
    let from = Point3::from(map_from_camera.translation * per_m);
    let columns = image.columns;
    for (at, &depth_m) in image.depths_m.iter().take(image.rows() * columns).enumerate() {
        let reads = is_reading(depth_m);
        if !reads && !params.misses_are_free {
            continue;
        }
        let told_m = if reads { f64::from(depth_m) } else { f64::INFINITY };
        let is_hit = told_m <= params.range_m;
        let (column, row) = ((at % columns) as f64, (at / columns) as f64);
        let end = image.camera.point_in_camera(column, row, told_m.min(params.range_m));
        let to = Point3::from(map_from_camera.transform(&end).coords * per_m);
        walk(&from, &to, |cell| scratch.free(cell));
        if is_hit {
            scratch.hit(cell_of(&to));
        }
    }
    let limits = [params.least, params.most];
    let mut turned = Vec::new();
    for touched in &scratch.touched {
        let changes = (0..CELLS).filter_map(|place| {
            let of = |bits: &[u64; WORDS]| bits[place / 64] >> (place % 64) & 1 == 1;
            if of(&touched.hit) {
                Some((place, params.hit))
            } else {
                of(&touched.free).then_some((place, params.miss))
            }
        });
        if blocks.add(touched.key, limits, changes) {
            turned.push(touched.key);
        }
    }
    turned.sort_unstable();
    turned
}
