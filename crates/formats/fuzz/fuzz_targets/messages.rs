//! Any bytes as one message of each type that is read; what is read can be written and read again.
#![no_main]

use formats::log::{LogReader, Message, ReadOptions};
use formats::mcap::McapWriter;
use libfuzzer_sys::fuzz_target;

const TYPES: [(&str, &str); 27] = [
    ("sensor_msgs/msg/LaserScan", "cdr"),
    ("nav_msgs/msg/Odometry", "cdr"),
    ("tf2_msgs/msg/TFMessage", "cdr"),
    ("sensor_msgs/msg/PointCloud2", "cdr"),
    ("sensor_msgs/msg/Image", "cdr"),
    ("sensor_msgs/msg/CameraInfo", "cdr"),
    ("geometry_msgs/msg/PoseStamped", "cdr"),
    ("sensor_msgs/LaserScan", "ros1"),
    ("tf/tfMessage", "ros1"),
    ("sensor_msgs/PointCloud2", "ros1"),
    ("foxglove.LaserScan", "protobuf"),
    ("foxglove.PointCloud", "protobuf"),
    ("foxglove.RawImage", "protobuf"),
    ("foxglove.CameraCalibration", "protobuf"),
    ("foxglove.FrameTransform", "protobuf"),
    ("foxglove.FrameTransforms", "protobuf"),
    ("foxglove.PoseInFrame", "protobuf"),
    ("driftlab.Edge", "protobuf"),
    ("driftlab.Standing", "protobuf"),
    ("driftlab.Decision", "protobuf"),
    ("foxglove.LaserScan", "json"),
    ("foxglove.PointCloud", "json"),
    ("foxglove.RawImage", "json"),
    ("foxglove.CameraCalibration", "json"),
    ("foxglove.FrameTransform", "json"),
    ("foxglove.FrameTransforms", "json"),
    ("foxglove.PoseInFrame", "json"),
];

fn blob(bytes: &[u8]) -> Vec<u8> {
    [&(bytes.len() as u32).to_le_bytes(), bytes].concat()
}

fn record(op: u8, body: &[u8]) -> Vec<u8> {
    [&[op][..], &(body.len() as u64).to_le_bytes(), body].concat()
}

/// A file with one message, and no end.
fn file(schema: &str, encoding: &str, message: &[u8]) -> Vec<u8> {
    let schema = [&1_u16.to_le_bytes()[..], &blob(schema.as_bytes()), &blob(b""), &blob(b"")].concat();
    let ids = [1, 0, 1, 0];
    let channel = [&ids[..], &blob(b"/topic"), &blob(encoding.as_bytes()), &blob(b"")].concat();
    let message = [&[1, 0][..], &[0; 20], message].concat();
    let records = [record(3, &schema), record(4, &channel), record(5, &message)];
    [&b"\x89MCAP0\r\n"[..], &records.concat()].concat()
}

fuzz_target!(|bytes: &[u8]| {
    // The first byte says which type; the rest is the message.
    let Some((&which, message)) = bytes.split_first() else { return };
    let (schema, encoding) = TYPES[usize::from(which) % TYPES.len()];
    let file = file(schema, encoding, message);
    let options = ReadOptions::default();
    let log = LogReader::new(&file[..], &options).expect("it begins as one").into_log();
    assert_eq!(log.topics[0].messages, 1);
    let mut writer = McapWriter::new(Vec::new()).expect("memory");
    for message in &log.messages {
        writer.write_message("/topic", message).expect("memory");
    }
    let bytes = writer.finish().expect("memory");
    let again = LogReader::new(&bytes[..], &options).expect("a file").into_log();
    assert_eq!(again.damage, None);
    // Copies in single precision may say what no scan can: a range of 1e-300 m is none there.
    let exact = |message: &&Message| again.topics[message.topic].copy_of.is_none();
    assert_eq!(again.messages.iter().filter(exact).count(), log.messages.len());
});
