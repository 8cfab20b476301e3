//! How a log is replayed: `[replay]`. Degrees are allowed here and end here.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How `driftlab replay` makes keyframes of a log of scans, and finds places in them.
///
/// `sensor.fov_deg` and `sensor.range_m` bound what is taken of each scan; the other keys of a sensor
/// are those of the log.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Replay {
    /// Where the pose graph comes from, when the log holds one.
    pub graph: GraphSource,
    /// The topic of the scans, where a log has several; empty is the one with most messages.
    pub scan_topic: String,
    /// The topic of the odometry, where a log has several; empty is the one with most messages.
    pub odometry_topic: String,
    /// A scan becomes a keyframe where odometry has it so far from the last keyframe, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub keyframe_distance_m: f64,
    /// Or turned by so much, degrees.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub keyframe_angle_deg: f64,
    /// Noise of the log's odometry: standard deviation after one metre, each axis; m/√m.
    #[schemars(range(min = 0.0, max = 100.0))]
    pub wheels_sigma_translation: f64,
    /// The same of its heading; degrees/√m.
    #[schemars(range(min = 0.0, max = 360.0))]
    pub wheels_sigma_rotation: f64,
    /// Standard deviation of its heading after a turn of one radian; degrees/√rad.
    #[schemars(range(min = 0.0, max = 360.0))]
    pub wheels_sigma_turn: f64,
    /// Returns from farther away take no part in matching scans, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub match_range_m: f64,
    /// Standard deviation of a range of the laser, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub range_sigma_m: f64,
    /// Known keyframes that may lie within this distance are tried for recognition, metres.
    #[schemars(range(min = 0.0))]
    pub place_radius_m: f64,
    /// Keyframes between which less than this was driven are no news of each other, metres.
    #[schemars(range(min = 0.0))]
    pub loop_m: f64,
    /// Known keyframes that are tried at each new one, at most.
    #[schemars(range(min = 0, max = 1000))]
    pub tried: u32,
    /// Ways through the graph that are less certain than this are not followed, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub place_sigma_limit_m: f64,
    /// A match is searched no farther than this from where the graph expects it, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub search_m: f64,
    /// Share of a scan that a known place has to explain.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub overlap: f64,
    /// Share of a scan that may stand where the known place saw free space.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub contradiction: f64,
    /// A match is ambiguous where another pose scores more than this share of the best.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub ambiguity: f64,
    /// Matches that have to agree with each other before an unsure one is believed, itself included.
    #[schemars(range(min = 1, max = 1000))]
    pub agreeing: u32,
    /// Corrected maps get optimised poses after so many keyframes with new closures among them.
    #[schemars(range(min = 1, max = 1_000_000))]
    pub settle_every: u32,
    /// An obstacle contradicts another view where it lies so deep inside what that saw as free, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub deep_m: f64,
    /// Side of the cells that covered area is counted in, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub covered_cell_m: f64,
}

/// Where the pose graph of a replay comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum GraphSource {
    /// From the log, where it holds one, bit for bit: exported runs do. Else from the scans.
    Log,
    /// From the scans: keyframes, steps and recognised places are made anew.
    Scans,
}

impl Default for Replay {
    fn default() -> Self {
        Self {
            graph: GraphSource::Log,
            scan_topic: String::new(),
            odometry_topic: String::new(),
            keyframe_distance_m: 0.4,
            keyframe_angle_deg: 15.0,
            wheels_sigma_translation: 0.1,
            wheels_sigma_rotation: 3.0,
            wheels_sigma_turn: 5.0,
            match_range_m: 20.0,
            range_sigma_m: 0.02,
            place_radius_m: 3.0,
            loop_m: 10.0,
            tried: 2,
            place_sigma_limit_m: 5.0,
            search_m: 4.0,
            overlap: 0.5,
            contradiction: 0.15,
            ambiguity: 0.9,
            agreeing: 3,
            settle_every: 50,
            deep_m: 0.3,
            covered_cell_m: 0.2,
        }
    }
}
