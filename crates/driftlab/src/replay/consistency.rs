//! Whether overlapping views agree: how much of what one saw stands inside what another saw as free.

use geometry::Point2;
use geometry::planar::StarPolygon;
use maps2d::volume::{LocalVolume, VolumeParams};
use pose::Se2;
use posegraph::{PoseGraph, Scope, ScopeScratch, Skeleton};
use probe::VertexId;
use serde::Serialize;

use super::course::Course;

/// Walls are asked about this often along their length, metres.
const EVERY_M: f64 = 0.1;

/// Views that are compared with all around them, at most; more are taken at even steps.
const ROOTS: usize = 400;

/// The share of obstacle length that lies deep inside the free space of other views nearby, by each way
/// of placing them; null where no views overlap.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Inconsistency {
    /// Placed by the log's odometry.
    pub odometry: Option<f64>,
    /// Placed by steps alone.
    pub tracked: Option<f64>,
    /// Placed relative to each other, along the shortest path of the graph.
    pub relative: Option<f64>,
    /// Placed as everything agrees best.
    pub optimised: Option<f64>,
    /// Pairs of views that were compared.
    pub pairs: u64,
    /// Obstacle length that another view could judge, placed relative to it, metres.
    pub judged_m: f64,
}

/// Compares views within `radius_m` of each other along the graph.
///
/// A point of a wall is judged where it lies within a metre behind what the other view saw in its
/// direction, or before that; it contradicts where it lies `deep_m` or more inside.
pub(super) fn inconsistency(
    course: &Course,
    graph: &PoseGraph,
    params: &VolumeParams,
    radius_m: f64,
    deep_m: f64,
) -> Inconsistency {
    let params = VolumeParams { strict_margin_m: deep_m, ..*params };
    let views: Vec<View> = course
        .views
        .iter()
        .map(|samples| maps2d::volume::build(samples, &params))
        .map(|volume| View::of(&volume.unwrap_or_else(|_| LocalVolume::empty())))
        .collect();
    let skeleton = skeleton_of(graph, radius_m);
    let (mut scope, mut scratch) = (Scope::default(), ScopeScratch::default());
    let by_odometry = course.by_odometry();
    let mut sums = [Sum::default(); 4];
    let mut pairs = 0;
    let every = views.len().div_ceil(ROOTS).max(1);
    for root in (0..views.len()).step_by(every) {
        scratch.place(&skeleton, VertexId(root as u32), radius_m, &mut scope);
        for row in scope.placed() {
            let other = row.vertex.0 as usize;
            if other == root || other >= views.len() {
                continue;
            }
            pairs += 1;
            let between = |poses: &[Se2]| match (poses.get(root), poses.get(other)) {
                (Some(root), Some(other)) => other.inverse_mul(root),
                _ => Se2::identity(),
            };
            let placed = [
                between(&by_odometry),
                between(&course.tracked),
                row.root_from_vertex.inverse(),
                between(&course.optimised),
            ];
            for (sum, other_from_root) in sums.iter_mut().zip(placed) {
                sum.add(&views[root], &views[other], &other_from_root);
            }
        }
    }
    let [odometry, tracked, relative, optimised] = sums.map(Sum::share);
    let judged_m = sums[2].judged as f64 * EVERY_M;
    Inconsistency { odometry, tracked, relative, optimised, pairs, judged_m }
}

/// A graph to place views on.
pub(super) fn skeleton_of(graph: &PoseGraph, horizon_m: f64) -> Skeleton {
    let (mut skeleton, mut scratch) = (Skeleton::new(horizon_m), ScopeScratch::default());
    for (id, edge) in graph.edges().filter(|(_, edge)| !edge.withdrawn) {
        skeleton.cover(edge.a.max(edge.b));
        skeleton.add_edge(id, edge, &mut scratch);
    }
    skeleton
}

/// A view: points along its walls, what it saw, and what of it is deep inside.
struct View {
    walls: Vec<Point2>,
    seen: StarPolygon,
    inner: StarPolygon,
}

impl View {
    fn of(volume: &LocalVolume) -> Self {
        let mut walls: Vec<Point2> = Vec::new();
        let mut left_m = 0.0;
        for wall in &volume.obstacles {
            let along = wall.to - wall.from;
            let length_m = along.norm();
            let mut at_m = EVERY_M - left_m;
            while at_m <= length_m {
                walls.push(wall.from + along * (at_m / length_m));
                at_m += EVERY_M;
            }
            left_m = length_m - (at_m - EVERY_M);
        }
        Self { walls, seen: volume.polygon.clone(), inner: volume.inner.clone() }
    }
}

#[derive(Clone, Copy, Debug, Default)]
struct Sum {
    judged: u64,
    deep: u64,
}

impl Sum {
    fn add(&mut self, of: &View, by: &View, by_from_of: &Se2) {
        let reach_m = by.seen.outer_radius() + 1.0;
        for wall in &of.walls {
            let point = by_from_of.transform(wall);
            let range_m = point.coords.norm();
            if range_m > reach_m {
                continue;
            }
            let seen_m = by.seen.radius_towards(&point);
            if seen_m > 0.0 && range_m <= seen_m + 1.0 {
                self.judged += 1;
                self.deep += u64::from(by.inner.contains(&point));
            }
        }
    }

    fn share(self) -> Option<f64> {
        (self.judged > 0).then(|| self.deep as f64 / self.judged as f64)
    }
}
