//! How much of a place of space was really seen.

use geometry::Point3;
use worlds::{CameraParams, SpaceView, Tally, World3d};

use super::lattice::Lattice;
use super::sight::visible;
use crate::{MetricsError, Verdict};

/// How coverage of space is judged.
#[derive(Clone, Debug, PartialEq)]
pub struct VoxelParams {
    /// Side of a voxel, metres, positive.
    pub cell_m: f64,
    /// Share of the voxels from which on a place counts as seen. Below 1, because whether a voxel in a nook
    /// is seen through a gap between two pixels is nobody's fault.
    pub complete_share: f64,
}

impl Default for VoxelParams {
    fn default() -> Self {
        Self { cell_m: 0.25, complete_share: 0.99 }
    }
}

/// Voxels of a true place, and at which flown distance each was first seen; the module page says which count.
#[derive(Clone, Debug)]
pub struct VoxelCoverage {
    params: VoxelParams,
    lattice: Lattice,
    free: Vec<bool>,
    counts: Vec<bool>,
    first_seen_m: Vec<f64>,
    /// Voxels that count and were not seen yet, ascending.
    unseen: Vec<usize>,
    cells_total: usize,
    cells_counted: usize,
    first_seen_sum_m: f64,
    newly_seen: Vec<usize>,
}

impl VoxelCoverage {
    /// Nothing seen yet, by a robot of that radius with that camera. About a distance query per voxel, and a
    /// few rays for each free one.
    ///
    /// # Errors
    /// [`MetricsError::CellSize`] where the side of a voxel is not positive or makes too many.
    pub fn new(
        world: &World3d,
        camera: &CameraParams,
        radius_m: f64,
        params: VoxelParams,
    ) -> Result<Self, MetricsError> {
        let lattice = Lattice::over(world, params.cell_m)?;
        let caster = world.caster();
        let centres: Vec<Point3> = (0..lattice.len()).map(|at| lattice.centre(at)).collect();
        let distances_m: Vec<f64> = centres.iter().map(|at| caster.distance_to(at)).collect();
        let start = Point3::from(world.world_from_start().translation);
        // The start is rarely a centre: all voxels around it that are straight ahead.
        let around = 2.0 * params.cell_m;
        let seeds: Vec<usize> = (0..lattice.len())
            .filter(|&at| {
                distances_m[at] >= radius_m
                    && (centres[at] - start).norm() <= around
                    && caster.clearance(&start, &centres[at]) >= radius_m
            })
            .collect();
        let reached = lattice.flood(&seeds, |from, to| {
            distances_m[to] >= radius_m
                && (params.cell_m <= 2.0 * radius_m
                    || caster.clearance(&centres[from], &centres[to]) >= radius_m)
        });
        let half_m = 0.5 * params.cell_m;
        let starts: Vec<usize> = (0..lattice.len()).filter(|&at| reached[at]).collect();
        // Solid blocks are hollow to rays: only what hangs together with what is reached can be seen.
        let mut free = lattice.flood(&starts, |from, to| {
            distances_m[to] >= half_m && !caster.blocked(&centres[from], &centres[to])
        });
        for at in 0..lattice.len() {
            free[at] &= distances_m[at] >= half_m;
        }
        let counts = visible(world, &lattice, camera, &reached, &free);
        let unseen: Vec<usize> = (0..lattice.len()).filter(|&at| counts[at]).collect();
        Ok(Self {
            params,
            first_seen_m: vec![f64::INFINITY; lattice.len()],
            cells_total: free.iter().filter(|&&free| free).count(),
            cells_counted: unseen.len(),
            first_seen_sum_m: 0.0,
            newly_seen: Vec::new(),
            lattice,
            free,
            counts,
            unseen,
        })
    }

    /// Marks what a look saw at a flown distance. Cost: the voxels not seen yet.
    pub fn see(&mut self, view: &SpaceView, distance_m: f64) {
        let Self { lattice, unseen, newly_seen, first_seen_m, first_seen_sum_m, .. } = self;
        unseen.retain(|&at| {
            let is_new = view.contains(&lattice.centre(at));
            if is_new {
                first_seen_m[at] = distance_m;
                *first_seen_sum_m += distance_m;
                newly_seen.push(at);
            }
            !is_new
        });
    }

    /// How coverage is judged.
    pub fn params(&self) -> &VoxelParams {
        &self.params
    }

    /// Number of free voxels that hang together with what the robot reaches.
    pub fn cells_total(&self) -> usize {
        self.cells_total
    }

    /// Number of free voxels that the camera could see: those that count.
    pub fn cells_counted(&self) -> usize {
        self.cells_counted
    }

    /// Share of the voxels that count seen so far; 0 where none counts.
    pub fn fraction(&self) -> f64 {
        if self.cells_counted == 0 {
            return 0.0;
        }
        1.0 - self.unseen.len() as f64 / self.cells_counted as f64
    }

    /// Whether the share from which on a place counts as seen is reached, of at least one voxel.
    pub fn is_complete(&self) -> bool {
        self.cells_counted > 0 && self.fraction() >= self.params.complete_share
    }

    /// d_exp of \[ISRR19\] sec. 6: the mean over the voxels that were seen of the distance at which each was
    /// first, metres; `None` until the place counts as seen.
    pub fn d_exp_m(&self) -> Option<f64> {
        let seen = self.cells_counted - self.unseen.len();
        self.is_complete().then(|| self.first_seen_sum_m / seen as f64)
    }

    /// Flown distance at which a voxel was first seen, metres; `None` for one not seen, or that does not
    /// count.
    pub fn first_seen_m(&self, index: usize) -> Option<f64> {
        self.first_seen_m.get(index).copied().filter(|distance_m| distance_m.is_finite())
    }

    /// The voxels first seen since the last call, as indices in order of sight.
    pub fn take_newly_seen(&mut self) -> Vec<usize> {
        std::mem::take(&mut self.newly_seen)
    }

    /// The voxels that count and were not seen, as indices.
    pub fn unseen(&self) -> &[usize] {
        &self.unseen
    }

    /// Voxels along x, y and z; indices run along x first, then y, then z.
    pub fn size(&self) -> [usize; 3] {
        self.lattice.counts
    }

    /// Centre of a voxel in the world frame.
    pub fn centre_in_world(&self, index: usize) -> Point3 {
        self.lattice.centre(index)
    }

    /// Whether a voxel counts: free, and the camera could see it.
    pub fn counts(&self, index: usize) -> bool {
        self.counts.get(index).copied().unwrap_or(false)
    }

    /// Whether a voxel is free and hangs together with what the robot reaches, whether the camera could see it or not.
    pub fn is_free(&self, index: usize) -> bool {
        self.free.get(index).copied().unwrap_or(false)
    }

    /// The judgement, were the run to end here.
    pub fn verdict(&self, tally: &Tally, believed_complete: bool) -> Verdict {
        let complete = self.is_complete();
        Verdict {
            believed_complete,
            coverage: self.fraction(),
            false_completion: believed_complete && !complete,
            distance_m: tally.distance_m,
            d_max_m: (believed_complete && complete).then_some(tally.distance_m),
            d_exp_m: self.d_exp_m().filter(|_| believed_complete),
            cells_total: self.cells_total,
            cells_reachable: self.cells_counted,
        }
    }
}
