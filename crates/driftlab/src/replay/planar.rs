//! Planar logs: files of every format become scans with the odometry of their sensor.

use std::fs;
use std::path::Path;

use formats::laser::{self, LaserLog, LoggedScan};
use formats::log::{DecisionMessage, EdgeMessage, StandingMessage};
use formats::tum::Trajectory;

use super::given::GivenMatch;
use super::{ReplayError, jumps, messages};
use crate::config::Replay;
use crate::logs::no_laser_log;
use crate::run::Input;

/// A planar log in memory.
#[derive(Clone, Debug, Default)]
pub struct PlanarLog {
    /// Scans by rising stamp, each with the sensor where the log's odometry has it.
    pub scans: Vec<LoggedScan>,
    /// The pose graph of the log, where it holds one: for each scan the vertex that it was taken at,
    /// and the edges that were new then. Vertices are numbered as they come, from 0.
    pub graph: Option<Vec<LoggedStep>>,
    /// What a policy told its map after the last scan.
    pub last_decisions: Vec<DecisionMessage>,
    /// Place matches of the topic that was asked for.
    pub matches: Vec<GivenMatch>,
    /// What was odd, one line each.
    pub warnings: Vec<String>,
    /// The file.
    pub inputs: Vec<Input>,
}

/// What a log says of the pose graph at one scan.
#[derive(Clone, Debug, PartialEq)]
pub struct LoggedStep {
    /// What a policy told its map since the scan before, and before the edges.
    pub decisions: Vec<DecisionMessage>,
    /// Edges that were added since the scan before, in order.
    pub edges: Vec<EdgeMessage>,
    /// Where the scan was taken.
    pub standing: StandingMessage,
    /// Whether the log's odometry has the sensor at the time of the scan.
    pub has_odometry: bool,
}

impl PlanarLog {
    /// Time from the first scan to the last, seconds.
    pub fn span_secs(&self) -> f64 {
        match (self.scans.first(), self.scans.last()) {
            (Some(first), Some(last)) => last.stamp_secs - first.stamp_secs,
            _ => 0.0,
        }
    }

    /// The trajectory of the sensor by odometry, one pose per scan.
    pub fn by_odometry(&self) -> Trajectory {
        Trajectory {
            stamps_secs: self.scans.iter().map(|scan| scan.stamp_secs).collect(),
            poses: self
                .scans
                .iter()
                .map(|scan| formats::log::spatial(&scan.odom_from_sensor))
                .collect(),
        }
    }
}

/// The most bytes of a text log, packed or not, that are read.
const TEXT_MOST: u64 = 1 << 30;

/// Reads a planar log of any format, told by its content.
pub(super) fn read(
    path: &Path,
    config: &Replay,
    places: Option<&str>,
) -> Result<PlanarLog, ReplayError> {
    let refuse = |message: String| ReplayError::input(path, message);
    let head =
        head_of(path).map_err(|e| refuse(format!("cannot be read ({e}); expected a log")))?;
    let mut log = if messages::is_message_log(&head) {
        messages::read(path, config, places)?
    } else {
        if let Some(topic) = places {
            let expected = "expected an MCAP file or a bag, which have topics";
            return Err(refuse(format!("found no topic {topic} in a text log, {expected}")));
        }
        let bytes = text_of(path).map_err(refuse)?;
        let input = Input::new(path, &bytes);
        let LaserLog { scans, warnings, .. } = laser::read(&bytes)
            .map_err(|error| refuse(no_laser_log(&bytes).unwrap_or(error).to_string()))?;
        PlanarLog { scans, warnings, inputs: vec![input], ..PlanarLog::default() }
    };
    let sorted = |scans: &[LoggedScan]| {
        scans.windows(2).all(|pair| pair[0].stamp_secs <= pair[1].stamp_secs)
    };
    if log.graph.is_none() && !sorted(&log.scans) {
        log.warnings.push("scans are not in the order of their stamps; put into it".into());
        log.scans.sort_by(|a, b| a.stamp_secs.total_cmp(&b.stamp_secs));
    }
    log.warnings.extend(jumps::bridge(&mut log.scans));
    Ok(log)
}

fn head_of(path: &Path) -> std::io::Result<Vec<u8>> {
    use std::io::Read;
    let mut head = Vec::new();
    fs::File::open(path)?.take(64).read_to_end(&mut head)?;
    Ok(head)
}

fn text_of(path: &Path) -> Result<Vec<u8>, String> {
    let told = |error: std::io::Error| format!("cannot be read ({error}); expected a log");
    let bytes = fs::metadata(path).map_err(told)?.len();
    if bytes > TEXT_MOST {
        return Err(format!("found {bytes} bytes, expected a text log of at most {TEXT_MOST}"));
    }
    fs::read(path).map_err(told)
}
