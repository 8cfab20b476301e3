//! `metrics.json` and `timing.json`: names that scripts rely on.

use serde::Serialize;
use serde_json::Value;

use super::Disagreement;

/// What `metrics.json` holds of a run in the plane.
pub type MetricsReport = MapsMetrics<MapMetrics>;

/// What `timing.json` holds of a run in the plane.
pub type TimingReport = MapsTiming<MapTiming>;

/// What `metrics.json` holds, with `M` of each map: the same for the same config, seed and program.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MapsMetrics<M: Serialize> {
    /// Name of the experiment.
    pub name: String,
    /// Its seed.
    pub seed: u64,
    /// Each map's result by its name, in the order in which they ran.
    #[serde(serialize_with = "as_object")]
    pub maps: Vec<(String, M)>,
    /// Where maps that one robot feeds first disagreed about a frontier.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub disagreement: Option<Disagreement>,
    /// The first disagreement of each cause, in order.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub disagreements: Vec<Disagreement>,
}

/// What one map believed and what was true.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MapMetrics {
    /// Whether the robot believed that it had seen everything.
    pub believed_complete: bool,
    /// Share of the reachable free cells that were really seen.
    pub coverage: f64,
    /// It believed so, and it was not so.
    pub false_completion: bool,
    /// Distance driven, metres.
    pub distance_m: f64,
    /// Distance at which it believed to be done, metres; null unless complete and true.
    pub d_max_m: Option<f64>,
    /// Mean distance at the first sight of a cell, metres; null unless complete and true.
    pub d_exp_m: Option<f64>,
    /// Distance at which the last cell was first seen, metres; null unless every cell was.
    pub all_seen_m: Option<f64>,
    /// Distance at which the map believed that nothing was left, rightly or not, metres; null where
    /// it never did.
    pub no_frontier_m: Option<f64>,
    /// Steps of the loop.
    pub steps: u64,
    /// Scans taken.
    pub scans: u64,
    /// Place matches used.
    pub place_edges: u64,
    /// Commanded motions that would have touched an obstacle.
    pub collisions: u64,
    /// Motions whose noise pushed the robot into one.
    pub bumps: u64,
    /// Least distance to an obstacle on the whole true path, metres.
    pub min_clearance_m: f64,
    /// Free cells.
    pub cells_total: u64,
    /// Free cells that the robot could reach.
    pub cells_reachable: u64,
    /// Frontier left that counts, metres.
    pub frontier_left_m: f64,
    /// Frontier left that does not: slivers, and what could not be reached, metres.
    pub frontier_ignored_m: f64,
    /// Share of the distance that was driven over known ground to get somewhere.
    pub backtracking_share: f64,
    /// Sum of the turning angles, radians.
    pub turning_rad: f64,
    /// Vertices of the pose graph.
    pub vertices: u64,
    /// How often the map corrected its poses.
    pub corrections: u64,
    /// How often the map found itself broken, and kept a view out.
    pub map_invalid: u64,
    /// Intersection over union of believed and true free space; null without a global frame.
    pub free_iou: Option<f64>,
    /// Mean distance of believed walls from true ones, metres; null without a global frame.
    pub wall_distance_m: Option<f64>,
    /// Absolute trajectory error of the map's poses, metres; null without a global frame.
    pub ate_m: Option<f64>,
    /// How the run ended.
    pub termination: String,
}

/// What `timing.json` holds, with `T` of each map: everything that depends on the clock or on memory.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MapsTiming<T: Serialize> {
    /// Each map's cost by its name, in the order in which they ran.
    #[serde(serialize_with = "as_object")]
    pub maps: Vec<(String, T)>,
    /// Time of the whole command, seconds.
    pub wall_secs: f64,
}

/// What one map cost.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MapTiming {
    /// Median time of a step, microseconds, without the simulator and the recording.
    pub step_micros_median: f64,
    /// 99th percentile of the same.
    pub step_micros_p99: f64,
    /// Median time that the recording added to a step, microseconds.
    pub record_micros_median: f64,
    /// 99th percentile of the same.
    pub record_micros_p99: f64,
    /// Median time of a correction, the optimisation and all that the map did anew for it,
    /// microseconds; null without one.
    pub correction_micros_median: Option<f64>,
    /// 99th percentile of the same.
    pub correction_micros_p99: Option<f64>,
    /// Time of all corrections together, seconds.
    pub correction_secs: f64,
    /// Each correction, in order; of single runs only.
    pub corrections: Vec<CorrectionTiming>,
    /// Most memory that the map held, bytes.
    pub map_bytes_peak: u64,
    /// Time of the run of this map, seconds.
    pub wall_secs: f64,
}

/// What one correction cost.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct CorrectionTiming {
    /// Step of the loop.
    pub step: u64,
    /// The optimisation, and all that the map did anew for it, seconds.
    pub secs: f64,
}

pub(crate) fn as_object<T: Serialize, S: serde::Serializer>(
    maps: &[(String, T)],
    out: S,
) -> Result<S::Ok, S::Error> {
    out.collect_map(maps.iter().map(|(name, value)| (name, value)))
}

/// A report as a JSON value; numbers that JSON cannot write are null.
pub fn to_json(report: &impl Serialize) -> Result<Value, serde_json::Error> {
    serde_json::to_value(report)
}

/// The text of a report's file.
pub fn to_file(report: &impl Serialize) -> Result<Vec<u8>, serde_json::Error> {
    let mut text = serde_json::to_vec_pretty(report)?;
    text.push(b'\n');
    Ok(text)
}

/// The value below which the share `q` of the samples lies (the nearest rank); 0 for no sample.
pub fn quantile(samples: &[f64], q: f64) -> f64 {
    let mut sorted = samples.to_vec();
    sorted.sort_by(f64::total_cmp);
    let rank = (q * sorted.len() as f64).ceil() as usize;
    sorted.get(rank.saturating_sub(1)).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_samples() {
        let samples: Vec<f64> = (1..=100).rev().map(f64::from).collect();
        assert_eq!(quantile(&samples, 0.5), 50.0);
        assert_eq!(quantile(&samples, 0.99), 99.0);
        assert_eq!(quantile(&[7.0], 0.5), 7.0);
        assert_eq!(quantile(&[], 0.5), 0.0);
    }
}
