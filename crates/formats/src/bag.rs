//! Bags of ROS 1, version 2.0.
//!
//! A bag is a line and then records: the length of a header, its fields (`name=value`, each behind its
//! length), the length of the data, the data. Chunks hold connections and messages, plain or packed
//! with lz4; those packed with bz2 are refused by name, `rosbag compress --lz4` packs them anew.

use std::collections::BTreeMap;
use std::io::Read;

use crate::FormatError;
use crate::error::{Position, quote};
use crate::log::{Damage, Log, Message, ReadOptions, Stamp, Topic};
use crate::records::{Channels, NewChannel, Packing, Parts, Source, Stopped, Unpacker};

/// The line that a bag begins with.
pub(crate) const MAGIC: [u8; 13] = *b"#ROSBAG V2.0\n";

/// The longest header of a record, bytes.
const MAX_HEADER: u32 = 1 << 20;

/// The longest data of a record, bytes.
const MAX_DATA: u32 = 1 << 30;

/// Records by their field `op`.
mod op {
    pub const MESSAGE: u8 = 2;
    pub const CHUNK: u8 = 5;
    pub const CONNECTION: u8 = 7;
}

/// The messages of a bag, in the order of the file.
///
/// Memory and damage are as with [`McapReader`](crate::mcap::McapReader).
#[derive(Debug)]
pub struct BagReader<R> {
    source: Source<R>,
    channels: Channels,
    unpacker: Unpacker,
    header: Vec<u8>,
    data: Vec<u8>,
    chunk: Vec<u8>,
    chunk_at: usize,
    chunk_origin: u64,
    ended: bool,
}

/// The fields of a header that are read.
#[derive(Default)]
struct Fields<'a> {
    op: Option<u8>,
    connection: Option<u32>,
    time: Option<&'a [u8]>,
    topic: Option<&'a str>,
    kind: Option<&'a str>,
    compression: Option<&'a str>,
    size: Option<u32>,
}

impl<'a> Fields<'a> {
    fn of(header: &'a [u8]) -> Option<Self> {
        let mut parts = Parts::new(header);
        let mut fields = Self::default();
        while !parts.rest().is_empty() {
            let pair = parts.blob()?;
            let equals = pair.iter().position(|&byte| byte == b'=')?;
            let (name, value) = (&pair[..equals], &pair[equals + 1..]);
            let text = || std::str::from_utf8(value).ok();
            let number = || Some(u32::from_le_bytes(*value.as_array()?));
            match name {
                b"op" => fields.op = value.first().copied(),
                b"conn" => fields.connection = number(),
                b"time" => fields.time = Some(value),
                b"topic" => fields.topic = text(),
                b"type" => fields.kind = text(),
                b"compression" => fields.compression = text(),
                b"size" => fields.size = number(),
                _ => {}
            }
        }
        Some(fields)
    }
}

impl<R: Read> BagReader<R> {
    /// A reader at the start of a file.
    ///
    /// # Errors
    /// [`FormatError::Unexpected`] at byte 0 where the file is no bag of version 2.0,
    /// [`FormatError::Scale`] for a scale of depth images that is no scale.
    pub fn new(source: R, options: &ReadOptions) -> Result<Self, FormatError> {
        options.check()?;
        let mut source = Source::new(source);
        match source.array() {
            Ok(MAGIC) => {}
            other => {
                let found = match other {
                    Ok(other) => quote(&String::from_utf8_lossy(&other)),
                    Err(_) => "a file of less than 13 bytes".to_owned(),
                };
                let expected = "a bag of ROS 1, version 2.0";
                return Err(FormatError::unexpected(Position::Byte(0), found, expected));
            }
        }
        Ok(Self {
            source,
            channels: Channels::new(options.depth_units_per_metre),
            unpacker: Unpacker::default(),
            header: Vec::new(),
            data: Vec::new(),
            chunk: Vec::new(),
            chunk_at: 0,
            chunk_origin: 0,
            ended: false,
        })
    }

    /// The topics that were named so far, with counts of what was read so far.
    pub fn topics(&self) -> &[Topic] {
        &self.channels.topics
    }

    /// Where the reading ended before the end of the file.
    pub fn damage(&self) -> Option<&Damage> {
        self.channels.damage.as_ref()
    }

    /// What was odd so far.
    pub fn warnings(&self) -> &[String] {
        &self.channels.warnings
    }

    /// Reads what is left, and keeps all of it in memory.
    pub fn into_log(mut self) -> Log {
        let messages = self.by_ref().collect();
        let Channels { topics, warnings, damage, .. } = self.channels;
        Log { topics, messages, damage, warnings }
    }

    /// The next message that is read; `None` at the end of the file or at damage.
    pub fn next_message(&mut self) -> Option<Message> {
        while !self.ended {
            let read = if self.chunk_at < self.chunk.len() {
                let origin = self.chunk_origin;
                self.next_of_chunk().map_err(|what| (origin, what))
            } else {
                let at = self.source.at();
                self.next_of_file(at).map_err(|what| (at, what))
            };
            match read {
                Ok(Some(message)) => return Some(message),
                Ok(None) => {}
                Err((at, what)) => {
                    self.channels.damaged(at, what);
                    self.ended = true;
                }
            }
        }
        None
    }

    fn next_of_chunk(&mut self) -> Result<Option<Message>, String> {
        let start = self.chunk_at;
        let cut = || format!("a record that is cut off, at byte {start} of a chunk");
        let mut parts = Parts::new(&self.chunk[start..]);
        let (header, data) = parts.blob().zip(parts.blob()).ok_or_else(cut)?;
        self.chunk_at = self.chunk.len() - parts.rest().len();
        let end = self.chunk_at;
        let origin = self.chunk_origin;
        let fields = Fields::of(header).ok_or_else(cut)?;
        match fields.op {
            Some(op::CONNECTION) => connection(&mut self.channels, &fields, data).map(|()| None),
            Some(op::MESSAGE) => message(&mut self.channels, &fields, data, |at| {
                let at = end - data.len() + at;
                format!("byte {at} of the chunk at byte {origin}")
            }),
            _ => Ok(None),
        }
        .map_err(|what| format!("{what}, at byte {start} of a chunk"))
    }

    fn next_of_file(&mut self, origin: u64) -> Result<Option<Message>, String> {
        let length = match self.source.array() {
            Ok(length) => u32::from_le_bytes(length),
            Err(Stopped::End(0)) => {
                self.ended = true;
                return Ok(None);
            }
            Err(stopped) => return Err(told(&stopped)),
        };
        if length > MAX_HEADER {
            return Err(format!("a header of {length} bytes, at most {MAX_HEADER} are read"));
        }
        self.source.body(length as usize, &mut self.header).map_err(|stopped| told(&stopped))?;
        let length = self.source.array().map_err(|stopped| told(&stopped))?;
        let length = u32::from_le_bytes(length);
        let fields = Fields::of(&self.header).ok_or("a header whose fields are cut off")?;
        if !matches!(fields.op, Some(op::CHUNK | op::CONNECTION | op::MESSAGE)) {
            let skipped = self.source.skip(u64::from(length));
            return skipped.map(|()| None).map_err(|stopped| told(&stopped));
        }
        if length > MAX_DATA {
            return Err(format!("a record of {length} bytes, at most {MAX_DATA} are read"));
        }
        self.source.body(length as usize, &mut self.data).map_err(|stopped| told(&stopped))?;
        let data = &self.data;
        match fields.op {
            Some(op::CONNECTION) => {
                connection(&mut self.channels, &fields, data)?;
                Ok(None)
            }
            Some(op::MESSAGE) => {
                let start = self.source.at() - data.len() as u64;
                message(&mut self.channels, &fields, data, |at| {
                    format!("byte {}", start + at as u64)
                })
            }
            _ => {
                let size = fields.size.ok_or("a chunk that does not tell its size")?;
                (self.chunk_at, self.chunk_origin) = (0, origin);
                match fields.compression {
                    Some("none") if data.len() == size as usize => {
                        std::mem::swap(&mut self.chunk, &mut self.data);
                    }
                    Some("none") => {
                        return Err(format!("a chunk of {} bytes, not {size}", data.len()));
                    }
                    Some("lz4") => {
                        let size = u64::from(size);
                        let unpacker = &mut self.unpacker;
                        let done = unpacker.unpack(Packing::Lz4, data, size, &mut self.chunk);
                        if let Err(what) = done {
                            self.chunk.clear();
                            return Err(what);
                        }
                    }
                    Some("bz2") => {
                        let what = "a chunk packed with bz2, which is not read (pack the bag anew: \
                                    rosbag compress --lz4)";
                        return Err(what.to_owned());
                    }
                    other => {
                        let other = quote(other.unwrap_or(""));
                        return Err(format!("a chunk packed with {other}, which is not read"));
                    }
                }
                if self.data.capacity() > 1 << 24 {
                    self.data = Vec::new();
                }
                Ok(None)
            }
        }
    }
}

impl<R: Read> Iterator for BagReader<R> {
    type Item = Message;

    fn next(&mut self) -> Option<Message> {
        self.next_message()
    }
}

fn told(stopped: &Stopped) -> String {
    match stopped {
        Stopped::End(_) => "the file ends within a record".to_owned(),
        Stopped::Failed(why) => format!("the file cannot be read on ({why})"),
    }
}

fn id_of(fields: &Fields<'_>) -> Result<u16, String> {
    let id = fields.connection.ok_or("a record without its connection")?;
    u16::try_from(id).map_err(|_| format!("connection {id}, beyond 65535"))
}

fn connection(channels: &mut Channels, fields: &Fields<'_>, data: &[u8]) -> Result<(), String> {
    let id = id_of(fields)?;
    if channels.has(id) {
        // The end of a bag names all connections once more.
        return Ok(());
    }
    let inner = Fields::of(data).ok_or("a connection whose fields are cut off")?;
    let (Some(topic), Some(schema)) = (fields.topic, inner.kind) else {
        return Err("a connection without its topic or its type".to_owned());
    };
    let metadata = &BTreeMap::new();
    channels.add(id, &NewChannel { topic, schema, encoding: "ros1", metadata })
}

fn message(
    channels: &mut Channels,
    fields: &Fields<'_>,
    data: &[u8],
    place: impl FnOnce(usize) -> String,
) -> Result<Option<Message>, String> {
    let mut time = Parts::new(fields.time.ok_or("a message without its time")?);
    let (secs, nanos) = time.u32().zip(time.u32()).ok_or("a message without its time")?;
    let logged = Stamp::from_parts(i64::from(secs), nanos);
    channels.message(id_of(fields)?, logged, data, place)
}
