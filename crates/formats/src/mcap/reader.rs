//! Reads an MCAP file from start to end.

use std::collections::BTreeMap;
use std::io::Read;

use crate::FormatError;
use crate::error::{Position, quote};
use crate::log::{Damage, Log, Message, ReadOptions, Stamp, Topic};
use crate::records::{
    Channels, MAX_UNPACKED, NewChannel, Packing, Parts, Source, Stopped, Unpacker,
};

/// What an MCAP file begins and ends with.
pub(crate) const MAGIC: [u8; 8] = *b"\x89MCAP0\r\n";

/// The longest record that is taken into memory, 2^30 bytes.
const MAX_RECORD: u64 = 1 << 30;

/// Records by their first byte.
mod op {
    pub const HEADER: u8 = 1;
    pub const FOOTER: u8 = 2;
    pub const SCHEMA: u8 = 3;
    pub const CHANNEL: u8 = 4;
    pub const MESSAGE: u8 = 5;
    pub const CHUNK: u8 = 6;
    pub const DATA_END: u8 = 15;
}

/// The messages of an MCAP file, in the order of the file.
///
/// Memory is that of the largest record and of what it unpacks to; a record is taken into memory once
/// its length was held against 2^30 bytes, a chunk against 2^29. What is damaged ends the reading:
/// [`damage`](Self::damage) tells where, and what stands before was given. A message that can be framed
/// but not understood is left out, counted, and warned about once for each topic.
#[derive(Debug)]
pub struct McapReader<R> {
    source: Source<R>,
    channels: Channels,
    schemas: BTreeMap<u16, String>,
    unpacker: Unpacker,
    record: Vec<u8>,
    chunk: Chunk,
    stage: Stage,
}

/// The records inside a chunk.
#[derive(Debug, Default)]
struct Chunk {
    bytes: Vec<u8>,
    at: usize,
    /// Where the chunk begins in the file.
    origin: u64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stage {
    Data,
    /// Behind the data: what follows repeats and indexes it.
    Summary,
    Ended,
}

impl<R: Read> McapReader<R> {
    /// A reader at the start of a file.
    ///
    /// # Errors
    /// [`FormatError::Unexpected`] at byte 0 where the file is no MCAP file, [`FormatError::Scale`] for a
    /// scale of depth images that is no scale.
    pub fn new(source: R, options: &ReadOptions) -> Result<Self, FormatError> {
        options.check()?;
        let mut source = Source::new(source);
        match source.array::<8>() {
            Ok(MAGIC) => {}
            Ok(other) => {
                let found = quote(&String::from_utf8_lossy(&other));
                return Err(FormatError::unexpected(Position::Byte(0), found, "an MCAP file"));
            }
            Err(stopped) => {
                let found = told(&stopped, "a file of less than 8 bytes");
                return Err(FormatError::unexpected(Position::Byte(0), found, "an MCAP file"));
            }
        }
        Ok(Self {
            source,
            channels: Channels::new(options.depth_units_per_metre),
            schemas: BTreeMap::new(),
            unpacker: Unpacker::default(),
            record: Vec::new(),
            chunk: Chunk::default(),
            stage: Stage::Data,
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
        while self.stage != Stage::Ended {
            let read = if self.chunk.at < self.chunk.bytes.len() {
                let origin = self.chunk.origin;
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
                    self.stage = Stage::Ended;
                }
            }
        }
        None
    }

    /// Takes one record from the chunk in memory.
    fn next_of_chunk(&mut self) -> Result<Option<Message>, String> {
        let Self { chunk, channels, schemas, .. } = self;
        let start = chunk.at;
        let mut parts = Parts::new(&chunk.bytes[start..]);
        let record = parts.u8().zip(parts.u64());
        let Some((op, body)) = record.and_then(|(op, length)| Some((op, parts.take(length)?)))
        else {
            return Err(format!("a record that is cut off, at byte {start} of a chunk"));
        };
        let in_chunk = |what| format!("{what}, at byte {start} of a chunk");
        chunk.at = chunk.bytes.len() - parts.rest().len();
        let (origin, behind) = (chunk.origin, chunk.at);
        match op {
            op::MESSAGE => message(channels, body, |left| {
                format!("byte {} of the chunk at byte {origin}", behind - left)
            })
            .map_err(in_chunk),
            op::SCHEMA => schema(schemas, body).map(|()| None).map_err(in_chunk),
            op::CHANNEL => channel(channels, schemas, body).map(|()| None).map_err(in_chunk),
            op::CHUNK => Err(in_chunk("a chunk within a chunk".to_owned())),
            _ => Ok(None),
        }
    }

    /// Takes one record from the file.
    fn next_of_file(&mut self, at: u64) -> Result<Option<Message>, String> {
        let head = self.source.array::<9>().map_err(|stopped| match stopped {
            Stopped::End(0) => "the file ends without a footer".to_owned(),
            stopped => told(&stopped, "the file ends within the head of a record"),
        })?;
        let [op, length @ ..] = head;
        let length = u64::from_le_bytes(length);
        let data = self.stage == Stage::Data;
        let kept = match op {
            op::SCHEMA | op::CHANNEL | op::MESSAGE | op::CHUNK => data,
            op::HEADER | op::FOOTER | op::DATA_END => true,
            _ => false,
        };
        if !kept {
            let skipped = self.source.skip(length);
            return skipped.map(|()| None).map_err(|stopped| cut(&stopped, op, length));
        }
        if length > MAX_RECORD {
            return Err(format!("a record of {length} bytes, at most {MAX_RECORD} are read"));
        }
        let body = self.source.body(length as usize, &mut self.record);
        body.map_err(|stopped| cut(&stopped, op, length))?;
        let Self { record, channels, schemas, .. } = self;
        match op {
            op::MESSAGE => {
                let end = at + 9 + length;
                return message(channels, record, |left| format!("byte {}", end - left as u64));
            }
            op::SCHEMA => schema(schemas, record)?,
            op::CHANNEL => channel(channels, schemas, record)?,
            op::CHUNK => self.open_chunk(at)?,
            op::DATA_END => self.stage = Stage::Summary,
            op::FOOTER => {
                self.stage = Stage::Ended;
                let magic = self.source.array::<8>();
                if magic != Ok(MAGIC) {
                    return Err("a footer without the end of an MCAP file behind it".to_owned());
                }
            }
            _ => {}
        }
        Ok(None)
    }

    /// Unpacks the chunk that is the record in memory.
    fn open_chunk(&mut self, origin: u64) -> Result<(), String> {
        let mut parts = Parts::new(&self.record);
        let head = (|| {
            let (_first, _last) = (parts.u64()?, parts.u64()?);
            let (size, crc) = (parts.u64()?, parts.u32()?);
            let packing = parts.text()?;
            let length = parts.u64()?;
            let packed = parts.take(length)?;
            Some((size, crc, packing, packed))
        })();
        let Some((size, crc, packing, packed)) = head else {
            return Err("a chunk that is shorter than it says".to_owned());
        };
        let chunk = &mut self.chunk;
        (chunk.at, chunk.origin) = (0, origin);
        let packing = match packing {
            "" => None,
            "zstd" => Some(Packing::Zstd),
            "lz4" => Some(Packing::Lz4),
            other => {
                return Err(format!("a chunk packed with {}, which is not read", quote(other)));
            }
        };
        match packing {
            None if size != packed.len() as u64 => {
                return Err(format!("a chunk of {} bytes that should have {size}", packed.len()));
            }
            None => {
                let length = packed.len();
                chunk.at = self.record.len() - parts.rest().len() - length;
                self.record.truncate(chunk.at + length);
                std::mem::swap(&mut chunk.bytes, &mut self.record);
            }
            Some(packing) => {
                if let Err(what) = self.unpacker.unpack(packing, packed, size, &mut chunk.bytes) {
                    chunk.bytes.clear();
                    return Err(what);
                }
            }
        }
        if self.record.capacity() > 1 << 24 {
            self.record = Vec::new();
        }
        let chunk = &mut self.chunk;
        let measured = if crc == 0 { 0 } else { crc32fast::hash(&chunk.bytes[chunk.at..]) };
        if measured != crc {
            chunk.bytes.clear();
            return Err(format!("a chunk whose checksum is {measured:08x}, not {crc:08x}"));
        }
        Ok(())
    }
}

impl<R: Read> Iterator for McapReader<R> {
    type Item = Message;

    fn next(&mut self) -> Option<Message> {
        self.next_message()
    }
}

fn told(stopped: &Stopped, end: &str) -> String {
    match stopped {
        Stopped::End(_) => end.to_owned(),
        Stopped::Failed(why) => format!("the file cannot be read on ({why})"),
    }
}

fn cut(stopped: &Stopped, op: u8, length: u64) -> String {
    match stopped {
        Stopped::End(there) => {
            format!("a record of kind {op} of {length} bytes, of which {there} are there")
        }
        Stopped::Failed(_) => told(stopped, ""),
    }
}

fn schema(schemas: &mut BTreeMap<u16, String>, body: &[u8]) -> Result<(), String> {
    let mut parts = Parts::new(body);
    let named = parts.u16().zip(parts.text());
    let (id, name) = named.ok_or_else(|| "a schema that is cut off".to_owned())?;
    // A longer name is refused where a channel speaks of it.
    let end = name.char_indices().map(|(at, _)| at).find(|at| *at > 2048).unwrap_or(name.len());
    schemas.insert(id, name[..end].to_owned());
    Ok(())
}

fn channel(
    channels: &mut Channels,
    schemas: &BTreeMap<u16, String>,
    body: &[u8],
) -> Result<(), String> {
    let mut parts = Parts::new(body);
    let read = (|| {
        let (id, schema) = (parts.u16()?, parts.u16()?);
        let (topic, encoding) = (parts.text()?, parts.text()?);
        let mut pairs = Parts::new(parts.blob()?);
        let mut metadata = BTreeMap::new();
        while !pairs.rest().is_empty() && metadata.len() < 64 {
            let (key, value) = (pairs.text()?, pairs.text()?);
            if key.starts_with("driftlab.") && value.len() < 1024 {
                metadata.insert(key.to_owned(), value.to_owned());
            }
        }
        Some((id, schema, topic, encoding, metadata))
    })();
    let Some((id, schema, topic, encoding, metadata)) = read else {
        return Err("a channel that is cut off".to_owned());
    };
    let schema = match schemas.get(&schema) {
        Some(name) => name,
        None if schema == 0 => "",
        None => return Err(format!("a channel of schema {schema}, which was not named before")),
    };
    channels.add(id, &NewChannel { topic, schema, encoding, metadata: &metadata })
}

/// Reads a message; `place` tells where so many bytes before the end of the record are.
fn message(
    channels: &mut Channels,
    body: &[u8],
    place: impl FnOnce(usize) -> String,
) -> Result<Option<Message>, String> {
    let mut parts = Parts::new(body);
    let head = (|| {
        let (id, _sequence) = (parts.u16()?, parts.u32()?);
        let (logged, _published) = (parts.u64()?, parts.u64()?);
        Some((id, logged))
    })();
    let Some((id, logged)) = head else { return Err("a message that is cut off".to_owned()) };
    let logged = Stamp::from_nanos(i64::try_from(logged).unwrap_or(i64::MAX));
    let bytes = parts.rest();
    channels.message(id, logged, bytes, |at| place(bytes.len().saturating_sub(at)))
}

const _: () = assert!(MAX_UNPACKED <= MAX_RECORD);
