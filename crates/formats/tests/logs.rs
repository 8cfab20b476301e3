//! Logs that others wrote, and what is written here.
#![expect(clippy::print_stderr, reason = "what was skipped is told")]

use std::io::Cursor;
use std::path::{Path, PathBuf};

use formats::log::{
    CameraMessage, CloudMessage, Content, ContentKind, Decision, DecisionMessage, DepthMessage,
    EdgeMessage, Header, Log, LogReader, OdometryMessage, PoseMessage, ReadOptions, ScanMessage,
    Stamp, StandingMessage, Transform,
};
use formats::mcap::McapWriter;
use formats::{Cloud, DepthPixels};
use pose::nalgebra::{UnitQuaternion, Vector3};
use pose::{Se2, Se3};
use sensing::{Camera, Scan};

fn sample(name: &str) -> Vec<u8> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/samples/logs").join(name);
    std::fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn read(bytes: &[u8]) -> Log {
    LogReader::new(bytes, &ReadOptions::default()).expect("a log").into_log()
}

/// Everything but the bytes of a message, in one line.
fn told(content: &Content) -> String {
    match content {
        Content::Depth(message) => format!("{:?} {:?}", message.header, message.pixels),
        other => format!("{other:?}"),
    }
}

/// What all samples of one kind of writer say, whatever the encoding.
fn check_common(log: &Log, name: &str) {
    assert_eq!(log.damage, None, "{name}");
    let of = |topic: &str| -> Vec<&Content> {
        let topic = log.topic(topic).unwrap_or_else(|| panic!("{name}: no {topic}"));
        log.messages.iter().filter(|m| m.topic == topic).map(|m| &m.content).collect()
    };
    let stamp = Stamp::from_parts(1_700_000_001, 750_000_000);
    let Content::Scan(scan) = of("/scan")[1] else { panic!("{name}: no scan") };
    assert_eq!(scan.header, Header::new(stamp, "laser"), "{name}");
    assert_eq!((scan.scan.first_bearing_rad, scan.scan.bearing_step_rad), (-1.0, 0.5), "{name}");
    let misses: Vec<bool> = scan.scan.ranges_m.iter().map(|range| !range.is_finite()).collect();
    assert_eq!(misses, [false, false, true, false, false], "{name}");
    assert_eq!(scan.scan.ranges_m[3..], [0.25, 7.75], "{name}");
    let Content::Cloud(cloud) = of("/points")[0] else { panic!("{name}: no cloud") };
    assert_eq!(cloud.cloud.points_in_sensor.len(), 2, "{name}");
    let Content::Depth(depth) = of("/depth")[0] else { panic!("{name}: no image") };
    let depths = format!("{:?}", depth.pixels.depths_m);
    assert_eq!(depths, "[NaN, 1.0, 2.0, 0.5, NaN, 0.001]", "{name}");
    assert_eq!((depth.pixels.columns, depth.pixels.rows), (3, 2), "{name}");
    let Content::Camera(camera) = of("/camera")[0] else { panic!("{name}: no camera") };
    assert_eq!(camera.camera, Camera::new(500.0, 510.0, 1.5, 0.5), "{name}");
    assert_eq!((camera.columns, camera.rows, camera.distortion[0]), (3, 2, 0.1), "{name}");
    let quarter = UnitQuaternion::from_scaled_axis(Vector3::z() * std::f64::consts::FRAC_PI_2);
    let expected = Se3::new(Vector3::new(1.0, -2.0, 0.5), quarter);
    let near = |pose: &Se3| pose.boxminus(&expected).norm() < 1e-12;
    let Content::Pose(pose) = of("/pose")[0] else { panic!("{name}: no pose") };
    assert!(near(&pose.frame_from_body) && &*pose.header.frame == "map", "{name}");
    let Content::Transforms(list) = of("/tf")[0] else { panic!("{name}: no transforms") };
    assert!(near(&list[0].parent_from_child), "{name}");
    assert_eq!((&*list[0].header.frame, &*list[0].child_frame), ("odom", "body"), "{name}");
}

#[test]
fn recordings_of_ros_are_read_in_both_versions() {
    for name in ["ros2_zstd.mcap", "ros2_bare.mcap", "ros1_lz4.mcap", "ros1.bag", "ros1_lz4.bag"] {
        let log = read(&sample(name));
        check_common(&log, name);
        assert_eq!(log.topics.len(), 10, "{name}");
        assert!(log.topics.iter().all(|topic| topic.messages == 2), "{name}");
        let refused: Vec<u64> = log.topics.iter().map(|topic| topic.refused).collect();
        assert_eq!(refused, [0, 0, 0, 0, 2, 0, 0, 0, 0, 0], "{name}");
        assert_eq!(log.warnings.len(), 1, "{name}");
        let odom = log.topic("/odom").expect("odometry");
        let odom = log.messages.iter().find(|message| message.topic == odom).expect("a message");
        let Content::Odometry(odom) = &odom.content else { panic!("{name}: no odometry") };
        assert_eq!((&*odom.header.frame, &*odom.child_frame), ("odom", "body"), "{name}");
        let scan = log.messages.iter().find_map(|message| match &message.content {
            Content::Scan(scan) => Some(scan),
            _ => None,
        });
        let scan = scan.expect("a scan");
        assert_eq!((scan.range_min_m, scan.scan.range_max_m), (0.125, 8.0), "{name}");
    }
}

#[test]
fn recordings_of_foxglove_are_read_as_protobuf_and_json() {
    for name in ["foxglove_protobuf_zstd.mcap", "foxglove_json_lz4.mcap"] {
        let log = read(&sample(name));
        check_common(&log, name);
        assert_eq!(log.warnings, [""; 0], "{name}");
        let list = log.topic("/tfs").expect("transforms");
        let list = log.messages.iter().find(|message| message.topic == list).expect("a message");
        let Content::Transforms(list) = &list.content else { panic!("{name}: no transforms") };
        assert_eq!((list.len(), &list[0]), (2, &list[1]), "{name}");
    }
    let json = read(&sample("foxglove_json_lz4.mcap"));
    let other = &json.topics[json.topic("/other").expect("a topic that is not read")];
    assert_eq!((other.kind, other.messages, other.refused), (None, 2, 0));
    // The points of Foxglove's clouds have a pose of their own.
    let proto = read(&sample("foxglove_protobuf_zstd.mcap"));
    let cloud = proto.messages.iter().find_map(|message| match &message.content {
        Content::Cloud(cloud) => Some(cloud.cloud.points_in_sensor[0]),
        _ => None,
    });
    let [x, y, z] = cloud.expect("a cloud");
    assert!((x + 1.0).abs() < 1e-6 && (y + 1.0).abs() < 1e-6 && z == 3.5);
}

#[test]
fn what_is_not_read_is_refused_by_name() {
    let log = read(&sample("ros1_bz2.bag"));
    let damage = log.damage.expect("bz2 is not read");
    assert!(damage.what.contains("bz2") && damage.what.contains("rosbag compress --lz4"));
    assert!(log.messages.is_empty());
    let refused = |bytes: &[u8]| {
        LogReader::new(bytes, &ReadOptions::default()).map(|_| ()).expect_err("no log").to_string()
    };
    let other = "byte 0: found `VERTEX2 0 0 0`, expected an MCAP file or a bag of ROS 1";
    assert_eq!(refused(b"VERTEX2 0 0 0 0"), other);
    assert!(refused(b"").contains("expected an MCAP file"));
    assert!(refused(b"#ROSBAG V1.2\n").contains("version 2.0"));
    let scale = ReadOptions { depth_units_per_metre: 0.0 };
    assert!(LogReader::new(&sample("ros1.bag")[..], &scale).is_err());
}

/// One message of each kind, with numbers that single precision does not hold.
fn all_kinds() -> Vec<(&'static str, Content)> {
    let header = |nanos, frame: &str| Header::new(Stamp::from_nanos(nanos), frame);
    let turn = UnitQuaternion::from_scaled_axis(Vector3::new(0.1, -0.2, 0.3));
    let pose = Se3::new(Vector3::new(0.1, 0.2, -0.3), turn);
    let planar = Se2::new(0.1, -0.0, 1.0 / 3.0) * Se2::new(1e-9, 2.0, 0.7);
    let ranges_m = vec![0.1, f64::INFINITY, 1.0 / 3.0, f64::NAN, 5.0];
    let scan = Scan::new(-1.1, 0.1 + 1e-12, ranges_m, 5.6);
    let scan = |frame_from_sensor| ScanMessage {
        header: header(1_500_000_001, "laser"),
        scan: scan.clone(),
        range_min_m: 0.1,
        frame_from_sensor,
    };
    let cloud = Cloud { columns: 2, rows: 1, points_in_sensor: vec![[1.0, 2.0, 0.1]; 2] };
    let pixels = DepthPixels { columns: 1, rows: 2, depths_m: vec![0.1, 2.0] };
    let gave_up = Decision::GaveUp {
        vertex: 7,
        vertex_from_body: planar,
        goal_in_body: [0.1, -0.0],
        radius_m: 1.0 / 3.0,
        everywhere: true,
    };
    let decision = |decision| {
        let stamp = Stamp::from_nanos(10);
        Content::Decision(DecisionMessage { stamp, map: "relative".into(), decision })
    };
    vec![
        ("/scan", Content::Scan(scan(None))),
        ("/posed", Content::Scan(scan(Some(pose)))),
        (
            "/odom",
            Content::Odometry(OdometryMessage {
                header: header(2, "odom"),
                child_frame: "body".into(),
                odom_from_body: pose,
            }),
        ),
        (
            "/tf",
            Content::Transforms(vec![Transform {
                header: header(3, "map"),
                child_frame: "odom".into(),
                parent_from_child: pose,
            }]),
        ),
        ("/cloud", Content::Cloud(CloudMessage { header: header(4, "laser"), cloud })),
        ("/depth", Content::Depth(DepthMessage { header: header(5, "camera"), pixels })),
        (
            "/camera",
            Content::Camera(CameraMessage {
                header: header(6, "camera"),
                columns: 640,
                rows: 480,
                camera: Camera::new(500.1, 500.2, 320.3, 240.4),
                distortion_model: "plumb_bob".into(),
                distortion: vec![0.1, 0.2],
            }),
        ),
        ("/pose", Content::Pose(PoseMessage { header: header(7, "map"), frame_from_body: pose })),
        (
            "/edges",
            Content::Edge(EdgeMessage {
                stamp: Stamp::from_nanos(8),
                a: 0,
                b: u32::MAX,
                place: true,
                a_from_b: planar,
            }),
        ),
        (
            "/standing",
            Content::Standing(StandingMessage {
                stamp: Stamp::from_nanos(9),
                vertex: 3,
                vertex_from_body: planar,
            }),
        ),
        ("/gave_up", decision(gave_up)),
        ("/looked_again", decision(Decision::LookedAgain)),
    ]
}

fn written() -> Vec<u8> {
    let mut writer = McapWriter::new(Cursor::new(Vec::new())).expect("memory");
    for (at, (topic, content)) in all_kinds().into_iter().enumerate() {
        writer.write(topic, Stamp::from_nanos(at as i64), &content).expect("memory");
    }
    writer.finish().expect("memory").into_inner()
}

#[test]
fn what_is_written_reads_back_bit_for_bit() {
    let bytes = written();
    let log = read(&bytes);
    assert_eq!((log.damage.as_ref(), &log.warnings[..]), (None, &[][..]));
    for (topic, content) in all_kinds() {
        let name = if content.kind() == ContentKind::Scan {
            format!("/exact{topic}")
        } else {
            topic.into()
        };
        let index = log.topic(&name).unwrap_or_else(|| panic!("no {name}"));
        let back: Vec<String> =
            log.messages.iter().filter(|m| m.topic == index).map(|m| told(&m.content)).collect();
        // Debug output of floats tells them apart to the last bit.
        assert_eq!(back, [told(&content)], "{name}");
    }
    let copy = &log.topics[log.topic("/scan").expect("a copy for ROS")];
    assert_eq!(copy.copy_of.as_deref(), Some("/exact/scan"));
    assert_eq!(log.topics_of(ContentKind::Scan).count(), 2);
    assert!(written() == bytes, "the same messages give the same bytes");
}

#[test]
fn another_reader_finds_the_same_messages() {
    let bytes = written();
    let strict = ::mcap::read::ChunkFlattener::new(&bytes).expect("an MCAP file");
    assert!(strict.into_iter().all(|record| record.is_ok()));
    let messages = ::mcap::MessageStream::new(&bytes).expect("an MCAP file");
    let messages: Vec<_> = messages.map(|message| message.expect("a message")).collect();
    let log = read(&bytes);
    assert_eq!(messages.len(), log.messages.len());
    for (theirs, ours) in messages.iter().zip(&log.messages) {
        assert_eq!(theirs.channel.topic, log.topics[ours.topic].name);
        assert_eq!(theirs.log_time as i64, ours.logged.nanos());
    }
    let summary = ::mcap::Summary::read(&bytes).expect("readable").expect("a summary");
    let stats = summary.stats.as_ref().expect("statistics");
    assert_eq!(stats.message_count, log.messages.len() as u64);
    let indexed: usize = summary
        .chunk_indexes
        .iter()
        .flat_map(|chunk| summary.read_message_indexes(&bytes, chunk).expect("an index"))
        .map(|(channel, entries)| {
            for entry in &entries {
                let chunk = &summary.chunk_indexes[0];
                let found = summary.seek_message(&bytes, chunk, entry).expect("a message");
                assert_eq!(found.channel.id, channel.id);
            }
            entries.len()
        })
        .sum();
    assert_eq!(indexed, log.messages.len());
}

#[test]
fn recordings_of_others_are_read() {
    let Some(data) = data() else { return };
    let counts = |name: &str| {
        let bytes = std::fs::read(data.join("mcap").join(name)).expect("readable");
        let log = read(&bytes);
        assert_eq!(log.damage, None, "{name}");
        let all: u64 = log.topics.iter().map(|topic| topic.messages).sum();
        (log.topics.len(), all, log.messages.len(), log.warnings)
    };
    assert_eq!(counts("talker.mcap").0, 3);
    assert_eq!(counts("talker.mcap").1, 20);
    assert_eq!(counts("cdr_test_0.mcap"), (2, 7, 0, Vec::new()));
    let (topics, all, read, warnings) = counts("test_bag_mcap.mcap");
    assert_eq!((topics, all), (94, 188));
    assert_eq!(
        read, 12,
        "two of LaserScan, PointCloud2, CameraInfo, Odometry, PoseStamped, TFMessage"
    );
    assert_eq!(warnings.len(), 1, "the made up image: {warnings:?}");
}

/// The folder of data, if there is one.
fn data() -> Option<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let data = std::env::var_os("DRIFTLAB_DATA").map(PathBuf::from);
    let data = data.unwrap_or_else(|| root.join("../shared/data"));
    if data.join("mcap").is_dir() {
        return Some(data);
    }
    eprintln!("SKIPPED: no folder of data at {}", data.display());
    None
}
