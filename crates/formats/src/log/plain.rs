//! Files that are no recordings, as logs: what a laser saw, trajectories, relations.

use std::collections::BTreeMap;
use std::sync::Arc;

use pose::Se2;

use super::{
    Content, ContentKind, EdgeMessage, Header, Log, Message, OdometryMessage, PoseMessage,
    ScanMessage, Stamp, StandingMessage, Topic, spatial,
};
use crate::laser::LaserLog;
use crate::laser::relations::Relation;
use crate::tum::Trajectory;

/// Topics of a log that has none by itself.
pub mod topics {
    /// Scans, in the frame [`LASER`](super::LASER).
    pub const SCAN: &str = "/scan";
    /// The sensor in the frame of the odometry, at each scan.
    pub const ODOMETRY: &str = "/odom";
    /// The body in the frame of the odometry, where the log has lines of it.
    pub const BODY: &str = "/odom/body";
    /// Poses of a trajectory.
    pub const POSE: &str = "/pose";
    /// Relations between two times, as edges of a graph.
    pub const EDGES: &str = "/relations";
    /// The times that relations speak of, as its vertices.
    pub const VERTICES: &str = "/relations/vertices";
}

/// The frame of a sensor that the log does not name.
pub const LASER: &str = "laser";
/// The frame of odometry.
pub const ODOM: &str = "odom";
/// The frame of a body that the log does not name.
pub const BASE: &str = "base_link";
/// The frame of a global estimate.
pub const MAP: &str = "map";

/// A growing log.
struct Growing {
    log: Log,
    encoding: &'static str,
}

impl Growing {
    fn new(encoding: &'static str, warnings: Vec<String>) -> Self {
        Self { log: Log { warnings, ..Log::default() }, encoding }
    }

    fn topic(&mut self, name: &str, schema: &str, kind: ContentKind) -> usize {
        self.log.topics.push(Topic::new(name, schema, self.encoding, Some(kind)));
        self.log.topics.len() - 1
    }

    fn push(&mut self, topic: usize, logged: Stamp, content: Content) {
        self.log.topics[topic].count(logged);
        self.log.messages.push(Message { topic, logged, content });
    }

    /// The log, in the order of time, without topics that have no message.
    fn finish(mut self) -> Log {
        self.log.sort();
        let mut kept = Vec::with_capacity(self.log.topics.len());
        let mut renamed = Vec::with_capacity(self.log.topics.len());
        for topic in self.log.topics.drain(..) {
            renamed.push(kept.len());
            if topic.messages > 0 {
                kept.push(topic);
            }
        }
        for message in &mut self.log.messages {
            message.topic = renamed[message.topic];
        }
        self.log.topics = kept;
        self.log
    }
}

/// The scans of a log, and the poses that its odometry had: of the sensor at each scan, and of the body
/// where the log has lines of that.
///
/// `encoding` is what [`Topic::encoding`] says. The result is sorted by time. Cost: copies the scans.
pub fn of_laser(laser: &LaserLog, encoding: &'static str) -> Log {
    let mut log = Growing::new(encoding, laser.warnings.clone());
    let odometry = log.topic(topics::ODOMETRY, "pose of the laser", ContentKind::Odometry);
    let scans = log.topic(topics::SCAN, "scan", ContentKind::Scan);
    let body = log.topic(topics::BODY, "pose of the body", ContentKind::Odometry);
    let frames: [Arc<str>; 3] = [ODOM.into(), LASER.into(), BASE.into()];
    let pose = |stamp: Stamp, child: &Arc<str>, pose: &Se2| {
        Content::Odometry(OdometryMessage {
            header: Header::new(stamp, Arc::clone(&frames[0])),
            child_frame: Arc::clone(child),
            odom_from_body: spatial(pose),
        })
    };
    for scan in &laser.scans {
        let stamp = Stamp::from_secs(scan.stamp_secs);
        log.push(odometry, stamp, pose(stamp, &frames[1], &scan.odom_from_sensor));
        let header = Header::new(stamp, Arc::clone(&frames[1]));
        let scan = scan.scan.clone();
        let message = ScanMessage { header, scan, range_min_m: 0.0, frame_from_sensor: None };
        log.push(scans, stamp, Content::Scan(message));
    }
    for logged in &laser.odometry {
        let stamp = Stamp::from_secs(logged.stamp_secs);
        log.push(body, stamp, pose(stamp, &frames[2], &logged.odom_from_body));
    }
    log.finish()
}

/// A trajectory as poses in the frame [`MAP`]; in the order of time.
pub fn of_trajectory(trajectory: &Trajectory) -> Log {
    let mut log = Growing::new("tum", Vec::new());
    let topic = log.topic(topics::POSE, "pose", ContentKind::Pose);
    let map: Arc<str> = MAP.into();
    for (&stamp_secs, &frame_from_body) in trajectory.stamps_secs.iter().zip(&trajectory.poses) {
        let stamp = Stamp::from_secs(stamp_secs);
        let header = Header::new(stamp, Arc::clone(&map));
        log.push(topic, stamp, Content::Pose(PoseMessage { header, frame_from_body }));
    }
    log.finish()
}

/// Relations as a graph: a vertex for each time that one speaks of, an edge for each relation.
///
/// Vertices are numbered in the order of time; edges keep the order of the file but for their times.
pub fn of_relations(relations: &[Relation]) -> Log {
    let stamp = |secs: f64| Stamp::from_secs(secs);
    let ends = relations.iter().flat_map(|relation| [relation.from_secs, relation.to_secs]);
    let mut vertices: BTreeMap<Stamp, u32> = ends.map(|secs| (stamp(secs), 0)).collect();
    for (number, vertex) in (0..).zip(vertices.values_mut()) {
        *vertex = number;
    }
    let mut log = Growing::new("relations", Vec::new());
    let standing = log.topic(topics::VERTICES, "time", ContentKind::Standing);
    let edges = log.topic(topics::EDGES, "relation", ContentKind::Edge);
    for (&at, &vertex) in &vertices {
        let vertex_from_body = Se2::identity();
        log.push(
            standing,
            at,
            Content::Standing(StandingMessage { stamp: at, vertex, vertex_from_body }),
        );
    }
    for relation in relations {
        let (from, to) = (stamp(relation.from_secs), stamp(relation.to_secs));
        let edge = EdgeMessage {
            stamp: from,
            a: vertices[&from],
            b: vertices[&to],
            place: true,
            a_from_b: relation.from_from_to,
        };
        log.push(edges, from, Content::Edge(edge));
    }
    log.finish()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laser::{LoggedPose, LoggedScan};
    use sensing::Scan;

    #[test]
    fn a_laser_log_becomes_scans_and_poses_in_the_order_of_time() {
        let scan = |stamp_secs| LoggedScan {
            stamp_secs,
            odom_from_sensor: Se2::new(1.0, 2.0, 0.5),
            scan: Scan::new(0.0, 0.1, vec![1.0, 2.0], 5.0),
        };
        let pose = LoggedPose { stamp_secs: 1.5, odom_from_body: Se2::identity() };
        let laser =
            LaserLog { scans: vec![scan(2.0), scan(1.0)], odometry: vec![pose], warnings: vec![] };
        let log = of_laser(&laser, "carmen");
        let names: Vec<&str> =
            log.messages.iter().map(|m| log.topics[m.topic].name.as_str()).collect();
        assert_eq!(names, ["/odom", "/scan", "/odom/body", "/odom", "/scan"]);
        let counts: Vec<u64> = log.topics.iter().map(|topic| topic.messages).collect();
        assert_eq!(counts, [2, 2, 1]);
        let without = of_laser(&LaserLog { odometry: vec![], ..laser }, "gfs");
        assert_eq!(without.topics.len(), 2);
        assert!(without.messages.iter().all(|message| message.topic < 2));
    }

    #[test]
    fn relations_number_their_times() {
        let relation = |from_secs, to_secs| Relation {
            from_secs,
            to_secs,
            from_from_to: Se2::new(1.0, 0.0, 0.0),
        };
        let log = of_relations(&[relation(5.0, 1.0), relation(1.0, 3.0)]);
        let ends: Vec<(u32, u32)> = log
            .messages
            .iter()
            .filter_map(|message| match &message.content {
                Content::Edge(edge) => Some((edge.a, edge.b)),
                _ => None,
            })
            .collect();
        assert_eq!(ends, [(0, 1), (2, 0)]);
        assert_eq!((log.topics[0].messages, log.topics[1].messages), (3, 2));
    }

    #[test]
    fn a_trajectory_becomes_poses() {
        let trajectory = Trajectory {
            stamps_secs: vec![2.0, 1.0],
            poses: vec![spatial(&Se2::new(2.0, 0.0, 0.0)), spatial(&Se2::new(1.0, 0.0, 0.0))],
        };
        let log = of_trajectory(&trajectory);
        let Content::Pose(first) = &log.messages[0].content else { panic!("no pose") };
        assert_eq!(first.frame_from_body.translation.x, 1.0);
        assert_eq!(log.span(), Some((Stamp::from_secs(1.0), Stamp::from_secs(2.0))));
    }
}
