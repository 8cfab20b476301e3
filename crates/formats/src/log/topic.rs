//! The topics of a log, and the log as a whole.

use std::fmt;

use super::{Message, Stamp};

/// What the messages of a topic say.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ContentKind {
    /// Planar range scans.
    Scan,
    /// Poses that odometry gives.
    Odometry,
    /// Frames in frames.
    Transforms,
    /// Clouds of points.
    Cloud,
    /// Depth images.
    Depth,
    /// Calibrations of cameras.
    Camera,
    /// Poses.
    Pose,
    /// Edges of a pose graph.
    Edge,
    /// Vertices of a pose graph at which scans are taken.
    Standing,
    /// What a policy told its map.
    Decision,
}

impl fmt::Display for ContentKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Scan => "scan",
            Self::Odometry => "odometry",
            Self::Transforms => "transforms",
            Self::Cloud => "cloud",
            Self::Depth => "depth image",
            Self::Camera => "camera",
            Self::Pose => "pose",
            Self::Edge => "edge",
            Self::Standing => "standing",
            Self::Decision => "decision",
        })
    }
}

/// A topic: a named stream of messages of one type.
#[derive(Clone, Debug, PartialEq)]
pub struct Topic {
    /// Its name.
    pub name: String,
    /// The name of the type of its messages, as the file has it.
    pub schema: String,
    /// How its messages are written: `cdr`, `ros1`, `protobuf`, `json`; the name of the format where that says it all.
    pub encoding: String,
    /// What its messages say; `None` where they are not read.
    pub kind: Option<ContentKind>,
    /// The topic that says the same, more exactly, and is to be read instead.
    pub copy_of: Option<String>,
    /// Messages of this topic in the file so far, also those that were not read.
    pub messages: u64,
    /// Messages of them that should have been readable and were not.
    pub refused: u64,
    /// When the first was logged.
    pub first: Option<Stamp>,
    /// When the last was logged.
    pub last: Option<Stamp>,
}

impl Topic {
    /// A topic without messages.
    pub fn new(
        name: impl Into<String>,
        schema: impl Into<String>,
        encoding: impl Into<String>,
        kind: Option<ContentKind>,
    ) -> Self {
        Self {
            name: name.into(),
            schema: schema.into(),
            encoding: encoding.into(),
            kind,
            copy_of: None,
            messages: 0,
            refused: 0,
            first: None,
            last: None,
        }
    }

    /// Counts a message.
    pub fn count(&mut self, logged: Stamp) {
        self.messages += 1;
        self.first = Some(self.first.map_or(logged, |first| first.min(logged)));
        self.last = Some(self.last.map_or(logged, |last| last.max(logged)));
    }

    /// Messages a second between the first and the last; `None` with less than two stamps.
    pub fn rate_hz(&self) -> Option<f64> {
        let secs = self.last?.secs_since(self.first?);
        (secs > 0.0).then(|| (self.messages - 1) as f64 / secs)
    }
}

/// Where a file is damaged; what stands before was read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Damage {
    /// Bytes from the start of the file to the record that could not be read.
    pub at: u64,
    /// What is wrong with it.
    pub what: String,
}

impl fmt::Display for Damage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "byte {}: {}; what stands before was read", self.at, self.what)
    }
}

/// A log in memory.
#[derive(Clone, Debug, Default)]
pub struct Log {
    /// The topics, in the order in which the file names them.
    pub topics: Vec<Topic>,
    /// The messages that were read, in the order of the file.
    pub messages: Vec<Message>,
    /// Where the reading ended before the end of the file.
    pub damage: Option<Damage>,
    /// What was odd, one line each.
    pub warnings: Vec<String>,
}

impl Log {
    /// The index of the topic of this name.
    pub fn topic(&self, name: &str) -> Option<usize> {
        self.topics.iter().position(|topic| topic.name == name)
    }

    /// The topics of a kind that are no copies of others.
    pub fn topics_of(&self, kind: ContentKind) -> impl Iterator<Item = usize> + '_ {
        let wanted = move |topic: &Topic| topic.kind == Some(kind) && topic.copy_of.is_none();
        (0..self.topics.len()).filter(move |&index| wanted(&self.topics[index]))
    }

    /// When the first and the last message was logged.
    pub fn span(&self) -> Option<(Stamp, Stamp)> {
        let first = self.topics.iter().filter_map(|topic| topic.first).min()?;
        let last = self.topics.iter().filter_map(|topic| topic.last).max()?;
        Some((first, last))
    }

    /// Sorts the messages by the time at which they were logged; those of one time keep their order.
    pub fn sort(&mut self) {
        self.messages.sort_by_key(|message| message.logged);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn topics_count_and_span() {
        let mut log = Log::default();
        let mut scans =
            Topic::new("/scan", "sensor_msgs/msg/LaserScan", "cdr", Some(ContentKind::Scan));
        for nanos in [2_000_000_000, 1_000_000_000, 3_000_000_000] {
            scans.count(Stamp::from_nanos(nanos));
        }
        assert_eq!(scans.rate_hz(), Some(1.0));
        let mut copy = scans.clone();
        copy.name = "/copy".into();
        copy.copy_of = Some("/scan".into());
        log.topics = vec![Topic::new("/empty", "x", "json", None), copy, scans];
        assert_eq!(log.topics_of(ContentKind::Scan).collect::<Vec<_>>(), [2]);
        assert_eq!(log.topic("/copy"), Some(1));
        let (first, last) = log.span().expect("three messages");
        assert_eq!(last.secs_since(first), 2.0);
        assert_eq!(log.topics[0].rate_hz(), None);
        assert_eq!(Log::default().span(), None);
    }
}
