//! Logs of messages, MCAP and bags: one topic of scans, and the odometry of its sensor.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;
use std::sync::Arc;

use formats::laser::LoggedScan;
use formats::log::{
    Content, DecisionMessage, EdgeMessage, LogReader, ReadOptions, ScanMessage, Stamp,
    StandingMessage, Topic, planar,
};
use pose::Se3;
use pose::nalgebra::Vector3;
use sensing::Scan;

use super::digest::Digesting;
use super::founded::Founded;
use super::frames::{Frames, Track};
use super::given::GivenMatch;
use super::planar::LoggedStep;
use super::{PlanarLog, ReplayError};
use crate::config::{GraphSource, Replay};

/// Odometry this long before or after its own times is no odometry, seconds.
const BEYOND_SECS: f64 = 0.5;

/// Whether a file starts as an MCAP file or a bag of ROS 1 does.
pub(super) fn is_message_log(head: &[u8]) -> bool {
    head.starts_with(b"\x89MCAP") || head.starts_with(b"#ROSBAG")
}

/// What the topics say, by topic.
#[derive(Default)]
struct Heard {
    scans: Vec<(usize, ScanMessage, Option<LoggedStep>)>,
    /// Odometry and poses: topic, name of the body's frame, poses over time.
    tracks: Vec<(usize, Arc<str>, Track)>,
    poses: Vec<(usize, Arc<str>, Track)>,
    frames: Frames,
    matches: Vec<GivenMatch>,
    edges: Vec<EdgeMessage>,
    decisions: Vec<DecisionMessage>,
    standing: Option<StandingMessage>,
    has_graph: bool,
    founded: Founded,
}

impl Heard {
    fn take(&mut self, topic: usize, content: Content, is_places: bool) {
        if !is_places {
            self.founded.take(topic, &content);
        }
        match content {
            Content::Scan(scan) => {
                let edges = std::mem::take(&mut self.edges);
                let decisions = std::mem::take(&mut self.decisions);
                let step = self.standing.clone();
                let step = step.map(|standing| LoggedStep {
                    decisions,
                    edges,
                    standing,
                    has_odometry: false,
                });
                self.scans.push((topic, scan, step));
            }
            Content::Odometry(odometry) => {
                let track = track_of(&mut self.tracks, topic, &odometry.child_frame);
                track.push(odometry.header.stamp, odometry.odom_from_body);
            }
            Content::Pose(pose) => {
                let track = track_of(&mut self.poses, topic, &Arc::from(""));
                track.push(pose.header.stamp, pose.frame_from_body);
            }
            Content::Transforms(transforms) if is_places => {
                self.matches.extend(transforms.iter().filter_map(GivenMatch::of_transform));
            }
            Content::Transforms(transforms) => {
                transforms.iter().for_each(|transform| self.frames.push(transform));
            }
            Content::Edge(edge) if is_places => self.matches.extend(GivenMatch::of_edge(&edge)),
            Content::Edge(edge) => {
                self.has_graph = true;
                self.edges.push(edge);
            }
            Content::Standing(standing) => self.standing = Some(standing),
            Content::Decision(decision) => self.decisions.push(decision),
            Content::Cloud(_) | Content::Depth(_) | Content::Camera(_) => {}
        }
    }

    fn sort(&mut self) {
        self.frames.sort();
        let all = self.tracks.iter_mut().chain(&mut self.poses);
        all.for_each(|(_, _, track)| track.sort());
    }
}

fn track_of<'a>(
    tracks: &'a mut Vec<(usize, Arc<str>, Track)>,
    topic: usize,
    body: &Arc<str>,
) -> &'a mut Track {
    let at = tracks.iter().position(|(of, _, _)| *of == topic).unwrap_or_else(|| {
        tracks.push((topic, Arc::clone(body), Track::default()));
        tracks.len() - 1
    });
    &mut tracks[at].2
}

/// Reads an MCAP file or a bag.
pub(super) fn read(
    path: &Path,
    config: &Replay,
    places: Option<&str>,
) -> Result<PlanarLog, ReplayError> {
    let refuse = |message: String| ReplayError::input(path, message);
    let file = File::open(path).map_err(|e| refuse(format!("cannot be read ({e})")))?;
    let mut source = BufReader::new(Digesting::new(file));
    let mut reader = LogReader::new(&mut source, &ReadOptions::default())
        .map_err(|error| refuse(error.to_string()))?;
    let mut heard = Heard::default();
    while let Some(message) = reader.next() {
        let is_places = places.is_some_and(|name| {
            reader.topics().get(message.topic).is_some_and(|topic| topic.name == name)
        });
        heard.take(message.topic, message.content, is_places);
    }
    let topics = reader.topics().to_vec();
    let mut warnings = reader.warnings().to_vec();
    let damage = reader.damage().cloned();
    warnings.extend(damage.iter().map(|damage| format!("damaged at {damage}")));
    // What is missing may stand behind the damage.
    let refuse = |message: String| match &damage {
        None => refuse(message),
        Some(damage) if topics.is_empty() => refuse(format!("byte {}: {}", damage.at, damage.what)),
        Some(damage) => refuse(format!("{message}; damaged at {damage}")),
    };
    drop(reader);
    // What stands behind the last message belongs to the file, too.
    let _ = std::io::copy(&mut source, &mut std::io::sink());
    let inputs = vec![source.into_inner().into_input(path)];
    heard.sort();
    if let Some(name) = places
        && !topics.iter().any(|topic| topic.name == name)
    {
        return Err(refuse(format!("found no topic {name}, expected {}", names(&topics))));
    }

    let among: Vec<usize> = heard.scans.iter().map(|scan| scan.0).collect();
    let topic = chosen(&topics, &among, &config.scan_topic, "scans", "replay.scan_topic")
        .map_err(refuse)?;
    told_of_others(&topics, &among, topic, "scans", &mut warnings);
    let with_graph = config.graph == GraphSource::Log
        && heard.has_graph
        && heard.scans.iter().filter(|scan| scan.0 == topic).all(|scan| scan.2.is_some());
    if with_graph && let Some(fault) = heard.founded.fault(&topics) {
        return Err(refuse(fault));
    }
    let source = Source::of(&heard, &topics, &config.odometry_topic, topic, &mut warnings)
        .map_err(refuse)?;
    let mut log = PlanarLog {
        graph: with_graph.then(Vec::new),
        matches: std::mem::take(&mut heard.matches),
        inputs,
        ..PlanarLog::default()
    };
    source.tell_of_mount(&heard, topic, &mut warnings);
    let (mut without, mut held, mut decisions) = (0_u64, Vec::new(), Vec::new());
    // The last stamp, and how many scans had it.
    let mut at_one_time: (Option<Stamp>, usize) = (None, 0);
    for (of, message, step) in &heard.scans {
        if *of != topic {
            // Edges that another topic's scan took along.
            held.extend(step.iter().flat_map(|step| step.edges.iter().cloned()));
            decisions.extend(step.iter().flat_map(|step| step.decisions.iter().cloned()));
            continue;
        }
        let stamp = message.header.stamp;
        let nth = if at_one_time.0 == Some(stamp) { at_one_time.1 } else { 0 };
        at_one_time = (Some(stamp), nth + 1);
        let odom_from_sensor = source.at(&heard, &message.header.frame, stamp, nth);
        let has_odometry = odom_from_sensor.is_some();
        let Some(odom_from_sensor) = odom_from_sensor.or(with_graph.then(Se3::identity)) else {
            without += 1;
            continue;
        };
        let mount = message.frame_from_sensor.unwrap_or_else(Se3::identity);
        let odom_from_sensor = odom_from_sensor * mount;
        let upside_down = (odom_from_sensor.rotation * Vector3::z()).z < 0.0;
        log.scans.push(LoggedScan {
            stamp_secs: stamp.secs(),
            odom_from_sensor: planar(&odom_from_sensor),
            scan: taken(message, upside_down),
        });
        if let (Some(graph), Some(step)) = (&mut log.graph, step) {
            let mut step = LoggedStep { has_odometry, ..step.clone() };
            step.edges.splice(0..0, std::mem::take(&mut held));
            step.decisions.splice(0..0, std::mem::take(&mut decisions));
            graph.push(step);
        }
    }
    decisions.append(&mut heard.decisions);
    log.last_decisions = decisions;
    if without > 0 {
        warnings.push(format!("{without} scan(s) without odometry near their time; left out"));
    }
    if log.scans.is_empty() {
        let name = &topics[topic].name;
        return Err(refuse(format!("found no odometry at the times of the scans of {name}")));
    }
    log.warnings = warnings;
    Ok(log)
}

/// The scan as maps take it: what is too near to be measured touches the sensor, and a sensor that hangs
/// upside down has its rays in the other order.
fn taken(message: &ScanMessage, upside_down: bool) -> Scan {
    let mut scan = message.scan.clone();
    for range_m in &mut scan.ranges_m {
        if *range_m < message.range_min_m {
            *range_m = 0.0;
        }
    }
    if upside_down && !scan.is_empty() {
        let last = scan.bearing_rad(scan.len() - 1);
        scan.ranges_m.reverse();
        scan.first_bearing_rad = -last;
    }
    scan
}

/// Where the odometry of a scan comes from.
enum Source {
    /// A topic of odometry, and the name of its body's frame.
    Odometry(usize),
    /// A topic of poses of the body.
    Pose(usize),
    /// Transforms from this frame.
    Frames(Arc<str>),
    /// The log has none, and a pose graph in its place.
    None,
}

impl Source {
    fn of(
        heard: &Heard,
        topics: &[Topic],
        asked: &str,
        scans: usize,
        warnings: &mut Vec<String>,
    ) -> Result<Self, String> {
        let key = "replay.odometry_topic";
        let of = |tracks: &[(usize, Arc<str>, Track)]| {
            tracks.iter().map(|track| track.0).collect::<Vec<usize>>()
        };
        let (odometry, poses) = (of(&heard.tracks), of(&heard.poses));
        let named = |all: &[usize]| all.iter().any(|&topic| topics[topic].name == asked);
        let frame = heard.scans.iter().find(|scan| scan.0 == scans).map(|s| &s.1.header.frame);
        if !odometry.is_empty() && (asked.is_empty() || named(&odometry)) {
            // Odometry of the sensor, or of a body on which it is known how it is mounted, comes first.
            let mounted: Vec<usize> = heard
                .tracks
                .iter()
                .filter(|track| frame.is_some_and(|frame| heard.frames.leads(&track.1, frame)))
                .map(|track| track.0)
                .collect();
            let among = if asked.is_empty() && !mounted.is_empty() { &mounted } else { &odometry };
            let topic = chosen(topics, among, asked, "odometry", key)?;
            told_of_others(topics, &odometry, topic, "odometry", warnings);
            return Ok(Self::Odometry(topic));
        }
        if !asked.is_empty() && named(&poses) {
            return Ok(Self::Pose(chosen(topics, &poses, asked, "poses", key)?));
        }
        if !asked.is_empty() {
            let all = [odometry, poses].concat();
            return chosen(topics, &all, asked, "odometry", key).map(Self::Pose);
        }
        if let Some(odom) = frame.and_then(|frame| heard.frames.odometry_above(frame)) {
            return Ok(Self::Frames(odom));
        }
        if !poses.is_empty() {
            return Ok(Self::Pose(chosen(topics, &poses, asked, "poses", key)?));
        }
        if heard.has_graph {
            return Ok(Self::None);
        }
        Err("found scans without odometry, expected nav_msgs/Odometry, transforms from a frame \
             `odom`, or poses"
            .into())
    }

    /// The poses of the body over time and the name of its frame, where a topic has them.
    fn track<'a>(&self, heard: &'a Heard) -> Option<&'a (usize, Arc<str>, Track)> {
        let (tracks, topic) = match self {
            Self::Odometry(topic) => (&heard.tracks, *topic),
            Self::Pose(topic) => (&heard.poses, *topic),
            Self::Frames(_) | Self::None => return None,
        };
        tracks.iter().find(|track| track.0 == topic)
    }

    /// Warns where no transforms tell how the sensor of a topic is mounted on the body.
    fn tell_of_mount(&self, heard: &Heard, scans: usize, warnings: &mut Vec<String>) {
        let Some((_, body, _)) = self.track(heard) else { return };
        let Some((_, scan, _)) = heard.scans.iter().find(|scan| scan.0 == scans) else { return };
        let frame = &scan.header.frame;
        // A message of poses does not name its body.
        if !body.is_empty() && !heard.frames.leads(body, frame) {
            warnings.push(format!(
                "no transforms lead from {body} to {frame}: the sensor counts as the middle of the body"
            ));
        }
    }

    /// The frame of a scan where the odometry has it; of scans of one stamp the `nth`.
    fn at(&self, heard: &Heard, frame: &str, stamp: Stamp, nth: usize) -> Option<Se3> {
        if let Self::Frames(odom) = self {
            let near = heard.frames.beyond_secs(odom, frame, stamp) <= BEYOND_SECS;
            return heard.frames.lookup(odom, frame, stamp).filter(|_| near);
        }
        let (_, body, track) = self.track(heard)?;
        if track.is_empty() || track.beyond_secs(stamp) > BEYOND_SECS {
            return None;
        }
        // Without a chain of transforms the sensor counts as the body's middle.
        let body_from_sensor = heard.frames.lookup(body, frame, stamp);
        Some(track.nth_at(stamp, nth)? * body_from_sensor.unwrap_or_else(Se3::identity))
    }
}

/// The topic of this name, or of all that messages came from the one with most; one that repeats another less
/// exactly only where it is asked for.
fn chosen(
    topics: &[Topic],
    among: &[usize],
    asked: &str,
    what: &str,
    key: &str,
) -> Result<usize, String> {
    let mut there: Vec<usize> = among.to_vec();
    there.sort_unstable();
    there.dedup();
    if !asked.is_empty() {
        let found = there.iter().find(|&&topic| topics[topic].name == asked);
        let all: Vec<&str> = there.iter().map(|&topic| topics[topic].name.as_str()).collect();
        let expected = if all.is_empty() { "none is there".into() } else { all.join(", ") };
        return found
            .copied()
            .ok_or_else(|| format!("found no {what} on {asked} (`{key}`), expected {expected}"));
    }
    let of = |topic: usize| (topics[topic].copy_of.is_none(), topics[topic].messages);
    let most = there.iter().copied().max_by_key(|&topic| (of(topic), usize::MAX - topic));
    most.ok_or_else(|| format!("found no {what}, expected a topic of them among {}", names(topics)))
}

fn told_of_others(
    topics: &[Topic],
    among: &[usize],
    topic: usize,
    what: &str,
    warnings: &mut Vec<String>,
) {
    let is_other = |other: &usize| *other != topic && topics[*other].copy_of.is_none();
    let mut others: Vec<usize> = among.iter().copied().filter(is_other).collect();
    others.sort_unstable();
    others.dedup();
    if !others.is_empty() {
        let others: Vec<&str> = others.iter().map(|&o| topics[o].name.as_str()).collect();
        let others = others.join(", ");
        warnings.push(format!("{what} of {}; not of {others}", topics[topic].name));
    }
}

fn names(topics: &[Topic]) -> String {
    let told = |topic: &Topic| format!("{} ({})", topic.name, topic.schema);
    let all: Vec<String> = topics.iter().map(told).collect();
    if all.is_empty() { "an empty list of topics".into() } else { all.join(", ") }
}
