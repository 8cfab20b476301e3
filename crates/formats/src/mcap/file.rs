//! The records of an MCAP file in the making.
//!
//! Written here: the writer of the crate `mcap` lists schemas and channels of the summary in the order
//! of a hash map, so that the same messages would give other bytes each time.

use std::collections::BTreeMap;
use std::io::{self, Write};

use super::reader::MAGIC;

/// Unpacked bytes at which a chunk is closed.
const CHUNK: usize = 1 << 20;

/// How hard zstd tries.
const LEVEL: i32 = 3;

/// One record, or a part of one.
#[derive(Debug, Default, Clone)]
pub(super) struct Bytes(pub Vec<u8>);

impl Bytes {
    pub(super) fn u8(mut self, value: u8) -> Self {
        self.0.push(value);
        self
    }

    pub(super) fn u16(mut self, value: u16) -> Self {
        self.0.extend(value.to_le_bytes());
        self
    }

    pub(super) fn u32(mut self, value: u32) -> Self {
        self.0.extend(value.to_le_bytes());
        self
    }

    pub(super) fn u64(mut self, value: u64) -> Self {
        self.0.extend(value.to_le_bytes());
        self
    }

    pub(super) fn raw(mut self, bytes: &[u8]) -> Self {
        self.0.extend_from_slice(bytes);
        self
    }

    /// Bytes behind their count of 32 bits: texts, lists and maps.
    pub(super) fn blob(self, bytes: &[u8]) -> Self {
        self.u32(bytes.len() as u32).raw(bytes)
    }

    /// These bytes as a record.
    fn record(self, op: u8) -> Self {
        Self::default().u8(op).u64(self.0.len() as u64).raw(&self.0)
    }
}

/// What the summary says of one chunk, but for its place among the others.
#[derive(Debug)]
struct ChunkIndex {
    first: u64,
    last: u64,
    start: u64,
    length: u64,
    message_indexes: BTreeMap<u16, u64>,
    message_index_length: u64,
    packed: u64,
    unpacked: u64,
}

/// A file in the making.
#[derive(Debug)]
pub(super) struct File<W> {
    sink: W,
    at: u64,
    checksum: crc32fast::Hasher,
    chunk: Bytes,
    /// Times and places of the messages of the chunk, by channel.
    index: BTreeMap<u16, Vec<(u64, u64)>>,
    chunks: Vec<ChunkIndex>,
    schemas: Vec<Bytes>,
    channels: Vec<Bytes>,
    counts: BTreeMap<u16, u64>,
}

impl<W: Write> File<W> {
    pub(super) fn new(sink: W, profile: &str, library: &str) -> io::Result<Self> {
        let mut file = Self {
            sink,
            at: 0,
            checksum: crc32fast::Hasher::new(),
            chunk: Bytes::default(),
            index: BTreeMap::new(),
            chunks: Vec::new(),
            schemas: Vec::new(),
            channels: Vec::new(),
            counts: BTreeMap::new(),
        };
        file.put(&MAGIC)?;
        let header = Bytes::default().blob(profile.as_bytes()).blob(library.as_bytes()).record(1);
        file.put(&header.0)?;
        Ok(file)
    }

    /// Adds a schema and gives its number, from 1.
    pub(super) fn schema(&mut self, name: &str, encoding: &str, data: &[u8]) -> io::Result<u16> {
        let id = number(self.schemas.len() + 1, "schemas")?;
        let body = Bytes::default().u16(id).blob(name.as_bytes()).blob(encoding.as_bytes());
        let record = body.blob(data).record(3);
        self.chunk.0.extend_from_slice(&record.0);
        self.schemas.push(record);
        Ok(id)
    }

    /// Adds a channel and gives its number, from 1.
    pub(super) fn channel(
        &mut self,
        schema: u16,
        topic: &str,
        encoding: &str,
        metadata: &BTreeMap<String, String>,
    ) -> io::Result<u16> {
        let id = number(self.channels.len() + 1, "channels")?;
        let pairs = metadata.iter().fold(Bytes::default(), |pairs, (key, value)| {
            pairs.blob(key.as_bytes()).blob(value.as_bytes())
        });
        let body = Bytes::default().u16(id).u16(schema).blob(topic.as_bytes());
        let record = body.blob(encoding.as_bytes()).blob(&pairs.0).record(4);
        self.chunk.0.extend_from_slice(&record.0);
        self.channels.push(record);
        Ok(id)
    }

    /// Adds a message.
    pub(super) fn message(
        &mut self,
        channel: u16,
        sequence: u32,
        time: u64,
        data: &[u8],
    ) -> io::Result<()> {
        self.index.entry(channel).or_default().push((time, self.chunk.0.len() as u64));
        *self.counts.entry(channel).or_default() += 1;
        let chunk = std::mem::take(&mut self.chunk);
        let length = 2 + 4 + 8 + 8 + data.len() as u64;
        let head = chunk.u8(5).u64(length).u16(channel).u32(sequence);
        self.chunk = head.u64(time).u64(time).raw(data);
        if self.chunk.0.len() >= CHUNK { self.close_chunk() } else { Ok(()) }
    }

    /// Writes what is left, the summary and the footer.
    pub(super) fn finish(mut self) -> io::Result<W> {
        self.close_chunk()?;
        let checksum = self.checksum.clone().finalize();
        self.put(&Bytes::default().u32(checksum).record(15).0)?;

        let summary_start = self.at;
        let indexes: Vec<Bytes> = self.chunks.iter().map(index_record).collect();
        let groups = [
            (3, std::mem::take(&mut self.schemas)),
            (4, std::mem::take(&mut self.channels)),
            (11, vec![self.statistics()]),
            (8, indexes),
        ];
        let mut summary = Bytes::default();
        let mut offsets = Bytes::default();
        for (op, records) in groups {
            if records.is_empty() {
                continue;
            }
            let start = summary.0.len();
            summary = records.iter().fold(summary, |summary, record| summary.raw(&record.0));
            let length = (summary.0.len() - start) as u64;
            let offset = Bytes::default().u8(op).u64(summary_start + start as u64).u64(length);
            offsets = offsets.raw(&offset.record(14).0);
        }
        let offsets_start = summary_start + summary.0.len() as u64;
        summary = summary.raw(&offsets.0);
        // The checksum covers the footer up to itself.
        summary = summary.u8(2).u64(20).u64(summary_start).u64(offsets_start);
        let checksum = crc32fast::hash(&summary.0);
        self.put(&summary.u32(checksum).raw(&MAGIC).0)?;
        self.sink.flush()?;
        Ok(self.sink)
    }

    fn statistics(&self) -> Bytes {
        let first = self.chunks.iter().map(|chunk| chunk.first).min().unwrap_or(0);
        let last = self.chunks.iter().map(|chunk| chunk.last).max().unwrap_or(0);
        let counts = self.counts.iter();
        let counts = counts.fold(Bytes::default(), |all, (&id, &count)| all.u16(id).u64(count));
        Bytes::default()
            .u64(self.counts.values().sum())
            .u16(self.schemas.len() as u16)
            .u32(self.channels.len() as u32)
            .u32(0)
            .u32(0)
            .u32(self.chunks.len() as u32)
            .u64(first)
            .u64(last)
            .blob(&counts.0)
            .record(11)
    }

    fn close_chunk(&mut self) -> io::Result<()> {
        let chunk = std::mem::take(&mut self.chunk).0;
        if chunk.is_empty() {
            return Ok(());
        }
        let index = std::mem::take(&mut self.index);
        let times = || index.values().flatten().map(|&(time, _)| time);
        let (first, last) = (times().min().unwrap_or(0), times().max().unwrap_or(0));
        let packed = zstd::bulk::compress(&chunk, LEVEL)?;
        let start = self.at;
        let body = Bytes::default().u64(first).u64(last).u64(chunk.len() as u64);
        let body = body.u32(crc32fast::hash(&chunk)).blob(b"zstd");
        self.put(&body.u64(packed.len() as u64).raw(&packed).record(6).0)?;
        let length = self.at - start;
        let indexes_start = self.at;
        let mut message_indexes = BTreeMap::new();
        for (channel, messages) in index {
            message_indexes.insert(channel, self.at);
            let list = messages.iter();
            let list = list.fold(Bytes::default(), |list, &(time, at)| list.u64(time).u64(at));
            self.put(&Bytes::default().u16(channel).blob(&list.0).record(7).0)?;
        }
        self.chunks.push(ChunkIndex {
            first,
            last,
            start,
            length,
            message_indexes,
            message_index_length: self.at - indexes_start,
            packed: packed.len() as u64,
            unpacked: chunk.len() as u64,
        });
        Ok(())
    }

    fn put(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.sink.write_all(bytes)?;
        self.checksum.update(bytes);
        self.at += bytes.len() as u64;
        Ok(())
    }
}

fn index_record(chunk: &ChunkIndex) -> Bytes {
    let places = chunk.message_indexes.iter();
    let places = places.fold(Bytes::default(), |all, (&id, &at)| all.u16(id).u64(at));
    Bytes::default()
        .u64(chunk.first)
        .u64(chunk.last)
        .u64(chunk.start)
        .u64(chunk.length)
        .blob(&places.0)
        .u64(chunk.message_index_length)
        .blob(b"zstd")
        .u64(chunk.packed)
        .u64(chunk.unpacked)
        .record(8)
}

fn number(count: usize, of: &str) -> io::Result<u16> {
    u16::try_from(count).map_err(|_| io::Error::other(format!("more than 65535 {of}")))
}
