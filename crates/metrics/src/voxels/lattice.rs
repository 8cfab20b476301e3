//! Voxels over a place.

use geometry::{Point3, Vector3};
use worlds::World3d;

use crate::MetricsError;

/// Most voxels over a place.
const MOST_VOXELS: usize = 1 << 26;

/// A regular lattice of cubes; indices run along x first, then y, then z.
#[derive(Clone, Debug)]
pub(super) struct Lattice {
    pub(super) low: Point3,
    pub(super) cell_m: f64,
    pub(super) counts: [usize; 3],
}

impl Lattice {
    /// Cubes over the bounds of a place; the last ones may reach beyond them.
    pub(super) fn over(world: &World3d, cell_m: f64) -> Result<Self, MetricsError> {
        let (low, high) = world.bounds();
        let counts = (high - low).map(|side| (side / cell_m).ceil().max(1.0));
        let cells = counts.iter().product::<f64>();
        if !(cell_m > 0.0 && cells <= MOST_VOXELS as f64) {
            return Err(MetricsError::CellSize { cell_m, cells, limit: MOST_VOXELS });
        }
        Ok(Self { low, cell_m, counts: [0, 1, 2].map(|k| counts[k] as usize) })
    }

    pub(super) fn len(&self) -> usize {
        self.counts.iter().product()
    }

    pub(super) fn steps(&self, index: usize) -> [i64; 3] {
        let [x, y, _] = self.counts;
        [index % x, index / x % y, index / x / y].map(|step| step as i64)
    }

    pub(super) fn index(&self, steps: [i64; 3]) -> Option<usize> {
        let [x, y, z] = steps;
        let inside = (0..3).all(|k| steps[k] >= 0 && (steps[k] as usize) < self.counts[k]);
        inside.then(|| (z as usize * self.counts[1] + y as usize) * self.counts[0] + x as usize)
    }

    pub(super) fn centre(&self, index: usize) -> Point3 {
        let [x, y, z] = self.steps(index).map(|step| step as f64 + 0.5);
        self.low + Vector3::new(x, y, z) * self.cell_m
    }

    pub(super) fn neighbours(&self, index: usize) -> impl Iterator<Item = usize> + '_ {
        let at = self.steps(index);
        (0..6).filter_map(move |side| {
            let mut next = at;
            next[side / 2] += if side % 2 == 0 { -1 } else { 1 };
            self.index(next)
        })
    }

    /// Everything that hangs together with `seeds` over neighbours that `joins`.
    pub(super) fn flood(
        &self,
        seeds: &[usize],
        mut joins: impl FnMut(usize, usize) -> bool,
    ) -> Vec<bool> {
        let mut marks = vec![false; self.len()];
        let mut open = seeds.to_vec();
        for &seed in seeds {
            marks[seed] = true;
        }
        while let Some(at) = open.pop() {
            for next in self.neighbours(at) {
                if !marks[next] && joins(at, next) {
                    marks[next] = true;
                    open.push(next);
                }
            }
        }
        marks
    }
}
