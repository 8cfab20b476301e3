//! Writes an MCAP file.

use std::collections::BTreeMap;
use std::io::{self, Write};

use super::file::File;
use crate::FormatError;
use crate::log::{Content, Message, ScanMessage, SceneEntity, Stamp};
use crate::messages::{COPY_OF, schemas, write_cdr, write_proto};

/// Where exact scans stand beside those for ROS: `/scan` and `/exact/scan`.
const EXACT: &str = "/exact";

/// A file in the making.
///
/// Everything that ROS 2 has a type for is written as such, in CDR, and viewers and stock readers
/// understand it. Scans of ROS have single precision: beside each stands `foxglove.LaserScan` on a
/// topic of its own under `/exact`, with which [`McapReader`](super::McapReader) reads back every bit;
/// the first says in the metadata of its channel that it is a copy. Edges and standings of a pose graph, and what a policy told its map,
/// are protocol buffers of this project (`driftlab.Edge`, `.Standing`, `.Decision`), polygons and graphs to be drawn are
/// `foxglove.SceneUpdate`. All schemas are in the file. The same messages give the same bytes.
#[derive(Debug)]
pub struct McapWriter<W: Write> {
    inner: File<W>,
    /// Channels by topic, type, and what else tells them apart, and the messages of each.
    channels: BTreeMap<(String, &'static str, Vec<String>), (u16, u32)>,
}

fn failed(error: io::Error) -> FormatError {
    FormatError::Write { reason: error.to_string() }
}

impl<W: Write> McapWriter<W> {
    /// Begins a file; chunks are packed with zstd.
    ///
    /// # Errors
    /// [`FormatError::Write`], as of all that is written.
    pub fn new(sink: W) -> Result<Self, FormatError> {
        let inner = File::new(sink, "ros2", "driftlab").map_err(failed)?;
        Ok(Self { inner, channels: BTreeMap::new() })
    }

    /// Writes a message on a topic, as it was logged at a time.
    ///
    /// # Errors
    /// [`FormatError::Write`]
    pub fn write(
        &mut self,
        topic: &str,
        logged: Stamp,
        content: &Content,
    ) -> Result<(), FormatError> {
        match content {
            Content::Scan(scan) => self.scan(topic, logged, scan, content),
            Content::Edge(edge) => {
                self.protobuf(topic, logged, "driftlab.Edge", &write_proto::edge(edge))
            }
            Content::Standing(standing) => {
                let bytes = write_proto::standing(standing);
                self.protobuf(topic, logged, "driftlab.Standing", &bytes)
            }
            Content::Decision(decision) => {
                let bytes = write_proto::decision(decision);
                self.protobuf(topic, logged, "driftlab.Decision", &bytes)
            }
            _ => self.ros(topic, logged, content, BTreeMap::new()),
        }
    }

    /// Writes a message of a log on a topic.
    ///
    /// # Errors
    /// [`FormatError::Write`]
    pub fn write_message(&mut self, topic: &str, message: &Message) -> Result<(), FormatError> {
        self.write(topic, message.logged, &message.content)
    }

    /// Writes things to be drawn.
    ///
    /// # Errors
    /// [`FormatError::Write`]
    pub fn scene(
        &mut self,
        topic: &str,
        logged: Stamp,
        entities: &[SceneEntity],
    ) -> Result<(), FormatError> {
        let bytes = write_proto::scene(logged, entities);
        self.protobuf(topic, logged, "foxglove.SceneUpdate", &bytes)
    }

    /// Ends the file: writes what is left, the summary and the footer.
    ///
    /// # Errors
    /// [`FormatError::Write`]
    pub fn finish(self) -> Result<W, FormatError> {
        self.inner.finish().map_err(failed)
    }

    fn scan(
        &mut self,
        topic: &str,
        logged: Stamp,
        scan: &ScanMessage,
        content: &Content,
    ) -> Result<(), FormatError> {
        let exact = format!("{EXACT}{}{topic}", if topic.starts_with('/') { "" } else { "/" });
        if scan.frame_from_sensor.is_none() {
            let metadata = BTreeMap::from([(COPY_OF.to_owned(), exact.clone())]);
            self.ros(topic, logged, content, metadata)?;
        }
        let metadata = write_proto::scan_metadata(scan);
        let bytes = write_proto::scan(scan);
        self.protobuf_with(&exact, logged, "foxglove.LaserScan", &bytes, metadata)
    }

    fn ros(
        &mut self,
        topic: &str,
        logged: Stamp,
        content: &Content,
        metadata: BTreeMap<String, String>,
    ) -> Result<(), FormatError> {
        let Some(kind) = write_cdr::type_of(content) else { return Ok(()) };
        let bytes = write_cdr::encode(content);
        let key = (topic.to_owned(), kind, metadata.values().cloned().collect());
        let (channel, sequence) = self.channel(key, metadata, || {
            let (package, name) = kind.split_once('/').unwrap_or(("", kind));
            let definition = schemas::definition(kind).into_bytes();
            (format!("{package}/msg/{name}"), "ros2msg", "cdr", definition)
        })?;
        self.put(channel, sequence, logged, &bytes)
    }

    fn protobuf(
        &mut self,
        topic: &str,
        logged: Stamp,
        kind: &'static str,
        bytes: &[u8],
    ) -> Result<(), FormatError> {
        self.protobuf_with(topic, logged, kind, bytes, BTreeMap::new())
    }

    fn protobuf_with(
        &mut self,
        topic: &str,
        logged: Stamp,
        kind: &'static str,
        bytes: &[u8],
        metadata: BTreeMap<String, String>,
    ) -> Result<(), FormatError> {
        let key = (topic.to_owned(), kind, metadata.values().cloned().collect());
        let (channel, sequence) = self.channel(key, metadata, || {
            (kind.to_owned(), "protobuf", "protobuf", schemas::descriptor_set(kind))
        })?;
        self.put(channel, sequence, logged, bytes)
    }

    /// The channel of a key, opened where it is new, and how many messages it had before.
    fn channel(
        &mut self,
        key: (String, &'static str, Vec<String>),
        metadata: BTreeMap<String, String>,
        schema: impl FnOnce() -> (String, &'static str, &'static str, Vec<u8>),
    ) -> Result<(u16, u32), FormatError> {
        if let Some((channel, sequence)) = self.channels.get_mut(&key) {
            *sequence = sequence.wrapping_add(1);
            return Ok((*channel, *sequence));
        }
        let (name, encoding, messages, data) = schema();
        let schema = self.inner.schema(&name, encoding, &data).map_err(failed)?;
        let channel = self.inner.channel(schema, &key.0, messages, &metadata).map_err(failed)?;
        self.channels.insert(key, (channel, 0));
        Ok((channel, 0))
    }

    fn put(
        &mut self,
        channel: u16,
        sequence: u32,
        logged: Stamp,
        bytes: &[u8],
    ) -> Result<(), FormatError> {
        let time = logged.nanos().max(0) as u64;
        self.inner.message(channel, sequence, time, bytes).map_err(failed)
    }
}
