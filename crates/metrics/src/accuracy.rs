//! How true a global map is: free space, walls, poses.

use geometry::Point2;
use maps2d::GlobalBelief;
use maps2d::grid::CellState;
use pose::nalgebra::{UnitQuaternion, Vector3};
use pose::{Se2, Se3};
use worlds::World2d;

use crate::Coverage;
use crate::trajectory::{Alignment, absolute_errors, align};

/// Free space is compared at points so far apart, metres.
const SAMPLE_M: f64 = 0.25;

/// Walls are judged at points so far apart along them, metres.
const ALONG_WALL_M: f64 = 0.1;

/// A global map against the truth, both laid together where the robot started.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Accuracy {
    /// Intersection over union of believed and true free space that can be reached; 0 to 1.
    pub free_iou: f64,
    /// Mean distance of believed walls from the nearest true one, metres; `None` without walls.
    pub wall_distance_m: Option<f64>,
    /// Absolute trajectory error: root mean square over vertices after a rigid alignment, metres;
    /// `None` without vertices.
    pub ate_m: Option<f64>,
}

impl Accuracy {
    /// Judges a belief whose frame is that of the start; `truth` is the true pose of each vertex.
    ///
    /// Cost: the area of place and belief over 0.25 m squared, and the length of the walls.
    pub fn of(world: &World2d, coverage: &Coverage, belief: &GlobalBelief, truth: &[Se2]) -> Self {
        let world_from_map = world.world_from_start();
        Self {
            free_iou: free_iou(world, coverage, belief, &world_from_map),
            wall_distance_m: wall_distance_m(world, belief, &world_from_map),
            ate_m: ate_m(truth, &belief.map_from_vertex),
        }
    }
}

fn free_iou(world: &World2d, coverage: &Coverage, belief: &GlobalBelief, place: &Se2) -> f64 {
    let (mut low, mut high) = world.bounds();
    let cells = &belief.cells;
    for slot in 0..cells.slots() {
        let cell = cells.cell(slot);
        if cells.state(cell) == CellState::Free {
            let at = place.transform(&cells.centre(cell));
            (low, high) = (low.inf(&at), high.sup(&at));
        }
    }
    let (origin, _) = world.bounds();
    let (columns, rows) = coverage.size();
    let side_m = coverage.cell_m();
    let truly = |point: &Point2| {
        let (x, y) = ((point.x - origin.x) / side_m.x, (point.y - origin.y) / side_m.y);
        let within = x >= 0.0 && y >= 0.0 && x < columns as f64 && y < rows as f64;
        within && coverage.counts(y as usize * columns + x as usize) && world.is_free(point)
    };
    let (mut both, mut either) = (0_u64, 0_u64);
    let steps = |low: f64, high: f64| ((high - low) / SAMPLE_M).ceil().clamp(0.0, 1e5) as usize;
    for i in 0..steps(low.x, high.x) {
        for j in 0..steps(low.y, high.y) {
            let point = Point2::new(
                low.x + (i as f64 + 0.5) * SAMPLE_M,
                low.y + (j as f64 + 0.5) * SAMPLE_M,
            );
            let cell = cells.at(&place.inverse_transform(&point));
            let believed = cells.state(cell) == CellState::Free;
            let free = truly(&point);
            both += u64::from(believed && free);
            either += u64::from(believed || free);
        }
    }
    if either == 0 { 0.0 } else { both as f64 / either as f64 }
}

fn wall_distance_m(world: &World2d, belief: &GlobalBelief, place: &Se2) -> Option<f64> {
    let (mut sum_m, mut count) = (0.0, 0_u64);
    for (from, to) in &belief.walls {
        let length_m = (to - from).norm();
        let pieces = (length_m / ALONG_WALL_M).ceil().clamp(1.0, 1e6);
        for k in 0..pieces as u64 {
            let share = (k as f64 + 0.5) / pieces;
            let at = place.transform(&(from + (to - from) * share));
            sum_m += world.caster().distance_to(&at);
            count += 1;
        }
    }
    (count > 0).then(|| sum_m / count as f64)
}

fn ate_m(truth: &[Se2], estimate: &[Se2]) -> Option<f64> {
    let in_space = |poses: &[Se2]| -> Vec<Se3> {
        let lifted = |pose: &Se2| {
            let rotation = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), pose.angle());
            Se3::new(Vector3::new(pose.translation.x, pose.translation.y, 0.0), rotation)
        };
        poses.iter().map(lifted).collect()
    };
    let count = truth.len().min(estimate.len());
    if count == 0 {
        return None;
    }
    let (truth, estimate) = (in_space(&truth[..count]), in_space(&estimate[..count]));
    let motion = align(&truth, &estimate, Alignment::Rigid);
    let aligned: Vec<Se3> = estimate.iter().map(|pose| motion.apply(pose)).collect();
    Some(absolute_errors(&truth, &aligned).translation_m.rmse)
}
