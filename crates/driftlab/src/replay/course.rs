//! What a log came to: keyframes on a graph, closures, poses by every estimate.

use std::time::Duration;

use maps2d::Standing;
use maps2d::volume::Samples;
use pose::Se2;
use posegraph::FactorGraph2;
use sensing::Scan;

use super::steps::ReplayRow;

/// A keyframe: a vertex of the graph.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop {
    /// The scan that it was founded with, as an index into those of the log.
    pub scan: usize,
    /// When, seconds.
    pub stamp_secs: f64,
    /// Distance driven until then by the log's odometry, metres.
    pub distance_m: f64,
    /// The sensor where the log's odometry has it.
    pub odom_from_sensor: Se2,
}

/// How many closures there were, and what became of them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Closures {
    /// Candidates that were matched, or matches that were given.
    pub proposed: u64,
    /// Those that became place edges.
    pub accepted: u64,
    /// Those of them that everything else speaks against at the end.
    pub rejected_by_graph: u64,
    /// What became of each match, by name.
    pub verdicts: Vec<(&'static str, u64)>,
    /// Keyframes whose scan had no say in the step to them.
    pub untracked: u64,
}

/// A replayed log before it is judged.
#[derive(Clone, Debug, Default)]
pub struct Course {
    /// The keyframes, by vertex.
    pub stops: Vec<Stop>,
    /// Where each scan was taken, by scan, where the log says so: vertices are come back to. Empty where the
    /// graph is made from scans.
    pub standings: Vec<Standing>,
    /// Distance driven until the last scan that maps got, by the log's odometry; metres.
    pub distance_m: f64,
    /// Everything that was seen from each of them, its frame.
    pub views: Vec<Samples>,
    /// All measurements with their information.
    pub factors: FactorGraph2,
    /// `map_from_keyframe` as steps alone chain them.
    pub tracked: Vec<Se2>,
    /// `map_from_keyframe` as everything agrees best.
    pub optimised: Vec<Se2>,
    /// The closures.
    pub closures: Closures,
    /// One row per step and map.
    pub rows: Vec<ReplayRow>,
    /// What keyframes cost, milliseconds: place recognition and the relative map.
    pub millis: Vec<f64>,
    /// Known keyframes that might have been near, at each keyframe.
    pub gated: Vec<u64>,
    /// Memory of keyframes, measurements and the relative map, bytes.
    pub bytes: u64,
    /// Scans that maps got.
    pub scans: u64,
}

impl Course {
    /// Notes what was seen from a vertex.
    pub(super) fn saw(&mut self, standing: &Standing, scan: &Scan) {
        let vertex = standing.vertex.0 as usize;
        if self.views.len() <= vertex {
            self.views.resize(vertex + 1, Samples::new());
        }
        self.views[vertex].add(scan, &standing.vertex_from_body);
        self.scans += 1;
    }

    pub(super) fn cost(&mut self, places: Duration, map: Duration) {
        self.millis.push((places + map).as_secs_f64() * 1e3);
    }

    /// The keyframes where the log's odometry has them, from the first on.
    pub fn by_odometry(&self) -> Vec<Se2> {
        let Some(first) = self.stops.first() else { return Vec::new() };
        let from_first = |stop: &Stop| first.odom_from_sensor.inverse_mul(&stop.odom_from_sensor);
        self.stops.iter().map(from_first).collect()
    }
}
