//! `metrics.json` and `timing.json` of a replay: names that scripts rely on.

use serde::Serialize;

use super::consistency::Inconsistency;
use super::relations::Relations;
use crate::run::{MapTiming, as_object};

/// What `metrics.json` holds: the same for the same config, log and program.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ReplayMetrics {
    /// Name of the experiment.
    pub name: String,
    /// Its seed; nothing is drawn in a replay.
    pub seed: u64,
    /// Vertices of the pose graph.
    pub keyframes: u64,
    /// Scans of the log.
    pub scans: u64,
    /// Distance driven by the log's odometry, metres.
    pub distance_m: f64,
    /// Area that was seen as free, square metres.
    pub covered_m2: f64,
    /// Known places that were tried, or given.
    pub loop_closures_proposed: u64,
    /// Those that became place edges.
    pub loop_closures_accepted: u64,
    /// Those that did not.
    pub loop_closures_rejected: u64,
    /// Accepted ones that everything else speaks against at the end.
    pub loop_closures_rejected_by_graph: u64,
    /// What became of each match, by name.
    #[serde(serialize_with = "counts")]
    pub verdicts: Vec<(&'static str, u64)>,
    /// Keyframes whose scan had no say in the step to them.
    pub untracked: u64,
    /// Mean absolute error of the optimised poses over the relations between two scans, metres; null
    /// without any.
    pub relations_translation_m: Option<f64>,
    /// The same of the heading, degrees.
    pub relations_rotation_deg: Option<f64>,
    /// Errors of all estimates; null without relations.
    pub relations: Option<Relations>,
    /// How much views contradict each other.
    pub inconsistency: Inconsistency,
    /// Each map's result by its name.
    #[serde(serialize_with = "as_object")]
    pub maps: Vec<(String, ReplayMapMetrics)>,
}

fn counts<S: serde::Serializer>(all: &[(&'static str, u64)], out: S) -> Result<S::Ok, S::Error> {
    out.collect_map(all.iter().copied())
}

/// A place where the person should have gone: the middle of a frontier that was left.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct PlaceToGo {
    /// Where the optimised graph has it, metres from the first keyframe.
    pub x_m: f64,
    /// The same, to the left.
    pub y_m: f64,
    /// Length of the frontier that hangs together there, metres.
    pub length_m: f64,
    /// The keyframe that saw it.
    pub keyframe: u64,
}

/// What one map came to. The names are those of a run; what takes the truth to know is null.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ReplayMapMetrics {
    /// Whether nothing was left to explore at the end.
    pub believed_complete: bool,
    /// Nobody knows the truth of a log.
    pub coverage: Option<f64>,
    /// As above.
    pub false_completion: Option<bool>,
    /// Distance driven by the log's odometry, metres.
    pub distance_m: f64,
    /// As `coverage`.
    pub d_max_m: Option<f64>,
    /// As `coverage`.
    pub d_exp_m: Option<f64>,
    /// Scans that became keyframes, or were taken at one.
    pub steps: u64,
    /// Scans that the map got.
    pub scans: u64,
    /// Recognised places that the map was told of, as edges or by way of optimised poses.
    pub place_edges: u64,
    /// As `coverage`.
    pub collisions: Option<u64>,
    /// As `coverage`.
    pub bumps: Option<u64>,
    /// As `coverage`.
    pub min_clearance_m: Option<f64>,
    /// As `coverage`.
    pub cells_total: Option<u64>,
    /// As `coverage`.
    pub cells_reachable: Option<u64>,
    /// Frontier left that counts, metres.
    pub frontier_left_m: f64,
    /// Frontier left that does not, metres.
    pub frontier_ignored_m: f64,
    /// Volumes or cells with frontier that counts.
    pub frontier_places: u64,
    /// As `coverage`: a person chose the way.
    pub backtracking_share: Option<f64>,
    /// Vertices of the pose graph.
    pub vertices: u64,
    /// How often the map's poses were corrected.
    pub corrections: u64,
    /// How often the map found itself broken, and kept a view out.
    pub map_invalid: u64,
    /// How it ended: `end_of_log`.
    pub termination: &'static str,
    /// Where the person should have gone; of the relative map.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub places_to_go: Vec<PlaceToGo>,
}

/// What `timing.json` holds: everything that depends on the clock or on memory.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ReplayTiming {
    /// Time of the whole command, seconds.
    pub wall_secs: f64,
    /// Time that the log spans, seconds.
    pub log_secs: f64,
    /// Median time of a keyframe, milliseconds: matching, place recognition, and the relative map (the
    /// first, where there is none), without recording.
    pub keyframe_millis_median: f64,
    /// 99th percentile of the same.
    pub keyframe_millis_p99: f64,
    /// Mean of the same over the first tenth of the keyframes.
    pub keyframe_millis_first_tenth: f64,
    /// And over the last.
    pub keyframe_millis_last_tenth: f64,
    /// Known keyframes that might have been near, mean over the first tenth of the keyframes.
    pub candidates_first_tenth: f64,
    /// And over the last.
    pub candidates_last_tenth: f64,
    /// Memory of keyframes, measurements and the relative map at the end, bytes by keyframes.
    pub bytes_per_keyframe: f64,
    /// Each map's cost by its name.
    #[serde(serialize_with = "as_object")]
    pub maps: Vec<(String, MapTiming)>,
}
