//! `metrics.json` and `timing.json` of a replay of depth images: names that scripts rely on.

use serde::Serialize;

use crate::run::as_object;

/// What `metrics.json` holds: the same for the same config, log and program.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DepthMetrics {
    /// Name of the experiment.
    pub name: String,
    /// Its seed; nothing is drawn in a replay.
    pub seed: u64,
    /// Depth images that became views: vertices of the pose graph.
    pub keyframes: u64,
    /// Depth images of the log that could be read, and in a folder have a pose. `replay3d.every` passes over some.
    pub images: u64,
    /// Of these, left out because no pose is near enough in time.
    pub without_pose: u64,
    /// Of these, left out because they have too few readings.
    pub without_readings: u64,
    /// Distance that the camera was carried, metres.
    pub distance_m: f64,
    /// Each map's result by its name.
    #[serde(serialize_with = "as_object")]
    pub maps: Vec<(String, DepthMapMetrics)>,
}

/// What one map made of the images.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DepthMapMetrics {
    /// Images that it could make nothing of.
    pub refused_looks: u64,
    /// Frontier left that counts, square metres.
    pub frontier_left_m2: f64,
    /// Frontier left that does not, square metres.
    pub frontier_ignored_m2: f64,
    /// The largest sliver among it, square metres.
    pub frontier_ignored_largest_m2: f64,
    /// Pieces of frontier that count.
    pub frontier_places: u64,
    /// Faces of the map.
    pub map_faces: u64,
    /// Volumes on vertices, or cells.
    pub map_volumes: u64,
    /// Tetrahedra that the way was planned through; null for a map that is not cut into some.
    pub map_tetrahedra: Option<u64>,
    /// How often the map could not take a view in as it should.
    pub map_invalid: u64,
    /// Length of the way from the last camera to the nearest frontier, metres; null where there is none.
    pub way_m: Option<f64>,
    /// By which share it got shorter than through the centroids of tetrahedra; null without any.
    pub path_shortening: Option<f64>,
    /// Where it bends, in the frame of the log's poses, metres.
    pub way: Vec<[f64; 3]>,
    /// How it ended: always `end of log`.
    pub termination: &'static str,
}

/// What `timing.json` holds.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DepthTiming {
    /// Time of the whole replay, seconds.
    pub wall_secs: f64,
    /// Time from the first image to the last, seconds.
    pub log_secs: f64,
    /// Each map's cost by its name.
    #[serde(serialize_with = "as_object")]
    pub maps: Vec<(String, DepthMapTiming)>,
}

/// What one map cost.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DepthMapTiming {
    /// Median time from a depth image to the updated map, milliseconds.
    pub keyframe_millis_median: f64,
    /// 99th percentile of the same.
    pub keyframe_millis_p99: f64,
    /// Time to find the way to the nearest frontier, tetrahedra included, milliseconds.
    pub way_millis: f64,
    /// Memory at the end by keyframes, bytes.
    pub bytes_per_keyframe: f64,
}
