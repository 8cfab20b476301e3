//! Reading MCAP: bare iteration over the messages by the crate `mcap`, and reading with decoding here.
//!
//! ```text
//! cargo bench -p formats --bench mcap
//! DRIFTLAB_MCAP=drive.mcap cargo bench -p formats --bench mcap file
//! ```
//!
//! Each sample is a minute of a robot: 40 scans of 1,081 rays and 50 odometries a second, as ROS 2 writes
//! them; ranges come from a formula with noise, so that zstd and lz4 have to work.

use std::hint::black_box;
use std::io::Cursor;

use criterion::{Criterion, Throughput};
use formats::log::{
    Content, Header, LogReader, OdometryMessage, ReadOptions, ScanMessage, Stamp, spatial,
};
use formats::mcap::McapWriter;
use mcap::{Compression, MessageStream, WriteOptions};
use pose::Se2;
use sensing::Scan;

/// The messages of a minute, written here: scans for ROS with exact copies, and odometry.
fn written() -> Vec<u8> {
    let mut writer = McapWriter::new(Cursor::new(Vec::new())).expect("memory");
    for tick in 0..60 * 200 {
        let at = Stamp::from_nanos(1_000_000_000 + tick * 5_000_000);
        if tick % 5 == 0 {
            let ranges_m = (0..1081_i64).map(|ray| {
                let noise = (ray * 7919 + tick * 104_729) % 1000;
                4.0 + (ray as f64 * 0.01).sin() + noise as f64 * 1e-5
            });
            let scan = Scan::new(-2.356, 0.004_363, ranges_m.collect(), 30.0);
            let header = Header::new(at, "laser");
            let scan = ScanMessage { header, scan, range_min_m: 0.1, frame_from_sensor: None };
            writer.write("/scan", at, &Content::Scan(scan)).expect("memory");
        }
        if tick % 4 == 0 {
            let pose = Se2::new(tick as f64 * 1e-3, (tick as f64 * 1e-3).sin(), 0.1);
            let odometry = OdometryMessage {
                header: Header::new(at, "odom"),
                child_frame: "base_link".into(),
                odom_from_body: spatial(&pose),
            };
            writer.write("/odom", at, &Content::Odometry(odometry)).expect("memory");
        }
    }
    writer.finish().expect("memory").into_inner()
}

/// The messages of ROS of a file, packed anew by the crate `mcap`.
fn repacked(bytes: &[u8], compression: Option<Compression>) -> Vec<u8> {
    let mut sink = Cursor::new(Vec::new());
    let mut writer =
        WriteOptions::new().compression(compression).create(&mut sink).expect("memory");
    for message in MessageStream::new(bytes).expect("an MCAP file") {
        let message = message.expect("a message");
        if message.channel.message_encoding == "cdr" {
            writer.write(&message).expect("memory");
        }
    }
    writer.finish().expect("memory");
    drop(writer);
    sink.into_inner()
}

/// Iterates as bare as the crate `mcap` allows.
fn bare(bytes: &[u8]) -> usize {
    let messages = MessageStream::new(bytes).expect("an MCAP file");
    messages.map(|message| black_box(message.expect("a message")).data.len()).sum()
}

/// Reads and decodes.
fn decoded(bytes: &[u8]) -> usize {
    let reader = LogReader::new(bytes, &ReadOptions::default()).expect("an MCAP file");
    reader.map(|message| usize::from(black_box(message).topic < 99)).sum()
}

fn bench(criterion: &mut Criterion) {
    let written = written();
    let samples =
        [("plain", None), ("zstd", Some(Compression::Zstd)), ("lz4", Some(Compression::Lz4))];
    for (name, compression) in samples {
        let bytes = repacked(&written, compression);
        compare(criterion, name, &bytes);
    }
    if let Some(path) = std::env::var_os("DRIFTLAB_MCAP") {
        let bytes = std::fs::read(path).expect("DRIFTLAB_MCAP names a file");
        compare(criterion, "file", &bytes);
    }
}

fn compare(criterion: &mut Criterion, name: &str, bytes: &[u8]) {
    let mut group = criterion.benchmark_group(name);
    group.throughput(Throughput::Bytes(bytes.len() as u64)).sample_size(20);
    group.bench_function("bare", |bencher| bencher.iter(|| bare(bytes)));
    group.bench_function("decoded", |bencher| bencher.iter(|| decoded(bytes)));
    group.finish();
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    bench(&mut criterion);
    criterion.final_summary();
}
