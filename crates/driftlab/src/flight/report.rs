//! What `metrics.json` and `timing.json` hold of each map of a flight: names that scripts rely on.

use std::collections::BTreeMap;

use serde::Serialize;

use super::StageTiming;
use crate::run::CorrectionTiming;

/// What one map of space believed and what was true.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FlightMetrics {
    /// Whether the robot believed that it had seen everything.
    pub believed_complete: bool,
    /// Share of the voxels that the camera could see and that were really seen.
    pub coverage: f64,
    /// It believed so, and it was not so.
    pub false_completion: bool,
    /// Distance flown, metres.
    pub distance_m: f64,
    /// Distance at which it believed to be done, metres; null unless complete and true.
    pub d_max_m: Option<f64>,
    /// Mean distance at the first sight of a voxel, metres; null unless complete and true.
    pub d_exp_m: Option<f64>,
    /// Distance at which the map believed that nothing was left, rightly or not, metres; null where it
    /// never did.
    pub no_frontier_m: Option<f64>,
    /// Steps of the loop.
    pub steps: u64,
    /// Depth images taken.
    pub looks: u64,
    /// Depth images that a map could make nothing of.
    pub refused_looks: u64,
    /// Place matches used.
    pub place_edges: u64,
    /// Commanded motions that would have touched a surface.
    pub collisions: u64,
    /// Motions whose noise pushed the robot into one.
    pub bumps: u64,
    /// Least distance to a surface on the whole true path, metres.
    pub min_clearance_m: f64,
    /// Free voxels that hang together with what the robot reaches.
    pub cells_total: u64,
    /// Those that the camera could see from where the robot could get.
    pub cells_reachable: u64,
    /// Frontier left that counts, square metres.
    pub frontier_left_m2: f64,
    /// Frontier left that does not: slivers, and what was given up though it may be seen, square metres.
    pub frontier_ignored_m2: f64,
    /// The largest piece among it, square metres.
    pub frontier_ignored_largest_m2: f64,
    /// Frontier that was given up, whatever the reason, square metres.
    pub frontier_given_up_m2: f64,
    /// Of it, what no place has in view in all that is believed to be free, and what something solid stands before
    /// from wherever it was looked at, square metres; not counted as ignored.
    pub frontier_unreachable_m2: f64,
    /// Pieces of frontier given up.
    pub given_up: u64,
    /// Share of the distance that was flown along known ways.
    pub backtracking_share: f64,
    /// Sum of the turning angles, radians.
    pub turning_rad: f64,
    /// Vertices of the pose graph.
    pub vertices: u64,
    /// Volumes on vertices, or cells.
    pub map_volumes: u64,
    /// Faces of the map.
    pub map_faces: u64,
    /// Tetrahedra of the last time that the map was cut into some; null for a map that is not.
    pub map_tetrahedra: Option<u64>,
    /// How often the map placed its views anew.
    pub corrections: u64,
    /// How often the map could not take a view in as it should.
    pub map_invalid: u64,
    /// Intersection over union of the free space that the map believes in at the end and the true one, at voxels asked
    /// from the vertex that is nearest to each, and no farther than 2 m.
    pub free_iou: f64,
    /// Of the voxels that the map takes for free there, the share that is not.
    pub free_wrong_share: f64,
    /// Paths that were planned through tetrahedra.
    pub paths: u64,
    /// Their lengths through centroids, summed, metres.
    pub paths_m: f64,
    /// By which share they got shorter in their corridors; null without a path.
    pub path_shortening: Option<f64>,
    /// Times that the robot set out to somewhere that is not straight from where it was, and asked its map for a way
    /// through the views between; 0 for a map that rides along, as are the next five.
    pub ways_asked: u64,
    /// Times that the map knew one.
    pub ways_found: u64,
    /// What these are long, metres.
    pub ways_m: f64,
    /// What the same is long along the graph, metres.
    pub ways_repeat_m: f64,
    /// Times that the way through views was flown, or begun.
    pub ways_flown: u64,
    /// Times that a leg of one could not be flown, and the robot went back to the graph.
    pub ways_refused: u64,
    /// Distance between where odometry alone believes the robot in the end and where it is, metres.
    pub odometry_error_m: f64,
    /// How the run ended: `complete`, `stuck`, `step_limit`, or `left_the_place` for a robot that got out of the bounds
    /// of a mesh with a hole.
    pub termination: String,
}

/// What one map of a flight cost.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FlightTiming {
    /// Median time of a step, microseconds, without the simulator and the recording.
    pub step_micros_median: f64,
    /// 99th percentile of the same.
    pub step_micros_p99: f64,
    /// Median time from a depth image to the updated map, microseconds.
    pub look_micros_median: f64,
    /// 99th percentile of the same.
    pub look_micros_p99: f64,
    /// Median time that the recording added to a step, microseconds.
    pub record_micros_median: f64,
    /// 99th percentile of the same.
    pub record_micros_p99: f64,
    /// Time of all corrections together, seconds.
    pub correction_secs: f64,
    /// Each correction, in order; of single runs only.
    pub corrections: Vec<CorrectionTiming>,
    /// Most memory that the map held, bytes.
    pub map_bytes_peak: u64,
    /// The same for each depth image, bytes.
    pub map_bytes_per_look: f64,
    /// What each stage of the map cost, by name: of a look `prepare`, `triangulate`, `reduce` and `join` (to the
    /// polyhedron), then `unite` or `consolidate`; and of what the policy asks.
    pub stages: BTreeMap<&'static str, StageTiming>,
    /// Most memory that the program held until then, recording included, bytes; null where the system does not tell.
    pub peak_rss_bytes: Option<u64>,
    /// Time of the run of this map, seconds.
    pub wall_secs: f64,
}
