//! What a map takes voxels for, against what is true.

use geometry::Point3;
use worlds::World3d;

use super::VoxelCoverage;

/// The free space that a map of space believes in, against the true one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VoxelAccuracy {
    /// Intersection over union of believed and true free space, 0 to 1; 1 where there is neither.
    pub free_iou: f64,
    /// Of what the map takes for free, the share that is not: inside of something, or behind it; 0 to 1.
    pub wrong_share: f64,
    /// Voxels that the map was asked about.
    pub asked: usize,
}

impl VoxelCoverage {
    /// Asks a map about at most `most` voxels, evenly taken: those that count, which are free, and those that are not
    /// free and that no surface passes. `is_free` is given their centres in the world frame; where it has no answer, a voxel is not
    /// asked about.
    ///
    /// What no camera could see is not asked about either: nobody could know. Cost: a distance query for each voxel that is
    /// not free, and the answers.
    pub fn accuracy(
        &self,
        world: &World3d,
        most: usize,
        is_free: &mut dyn FnMut(&Point3) -> Option<bool>,
    ) -> VoxelAccuracy {
        let half_m = 0.5 * self.params().cell_m;
        let caster = world.caster();
        let cells: usize = self.size().iter().product();
        let is_judged = |at: &usize| {
            self.counts(*at)
                || (!self.is_free(*at) && caster.distance_to(&self.centre_in_world(*at)) >= half_m)
        };
        let judged: Vec<usize> = (0..cells).filter(is_judged).collect();
        let every = judged.len().div_ceil(most.max(1)).max(1);
        let (mut both, mut either, mut believed, mut asked) = (0_usize, 0_usize, 0_usize, 0_usize);
        for &at in judged.iter().step_by(every) {
            let Some(believes) = is_free(&self.centre_in_world(at)) else { continue };
            let truly = self.counts(at);
            both += usize::from(truly && believes);
            either += usize::from(truly || believes);
            believed += usize::from(believes);
            asked += 1;
        }
        let share = |of: usize, all: usize| (all > 0).then(|| of as f64 / all as f64);
        VoxelAccuracy {
            free_iou: share(both, either).unwrap_or(1.0),
            wrong_share: share(believed - both, believed).unwrap_or(0.0),
            asked,
        }
    }
}
