//! `driftlab log` as a user meets it: results, messages, exit codes, files.

mod desk;

use std::fs;
use std::path::PathBuf;

use desk::{Desk, code, json, root, stderr, stdout};
use formats::log::{Content, ContentKind, Log, LogReader, ReadOptions, planar};
use pose::Se2;

fn sample(name: &str) -> PathBuf {
    root().join("crates/formats/tests/samples/logs").join(name)
}

fn read(path: &std::path::Path) -> Log {
    let bytes = fs::read(path).expect("the file is there");
    LogReader::new(&bytes[..], &ReadOptions::default()).expect("an MCAP file").into_log()
}

/// A little drive: three scans of four rays, and two lines of odometry.
const CARMEN: &str = "\
PARAM robot_frontlaser_offset 0.5
ODOM 0 0 0 0 0 0 100.25 h 0
FLASER 4 1 2 3.3333333333 81 0.5 0 0 0 0 0 100.5 h 0.5
ODOM 1 0 0 0 0 0 101.25 h 1
FLASER 4 1 2 3 4 1.5 0 0 1 0 0 101.5 h 1.5
FLASER 4 1 2 3 4 1.5 0 0.7 1 0 0.7 102.5 h 2.5
TRUEPOS 1
";

#[test]
fn recordings_are_told_about_in_text_and_json() {
    let desk = Desk::new("");
    let mut all = String::new();
    for name in ["ros2_zstd.mcap", "ros1.bag", "foxglove_json_lz4.mcap"] {
        fs::copy(sample(name), desk.path(name)).expect("a copy");
        let told = desk.driftlab(&["log", "info", name]);
        assert_eq!(code(&told), 0, "{}", stderr(&told));
        all.push_str(&format!("# {name}\n{}{}\n", stderr(&told), stdout(&told)));
    }
    insta::assert_snapshot!(all);

    let told = json(&desk.driftlab(&["log", "info", "ros2_zstd.mcap", "--json"]));
    let scans = told["topics"].as_array().expect("topics");
    let scans = scans.iter().find(|topic| topic["name"] == "/scan").expect("scans");
    assert_eq!(scans["schema"], "sensor_msgs/msg/LaserScan");
    assert_eq!((&scans["encoding"], &scans["messages"]), (&"cdr".into(), &2.into()));
    assert!(told["damaged_at"].is_null());
    assert!(told["end"].as_f64() > told["start"].as_f64());
}

#[test]
fn text_logs_and_folders_are_told_about() {
    let desk = Desk::new("");
    desk.put("drive.log", CARMEN);
    desk.put("drive.tum", "1 0 0 0 0 0 0 1\n2 1 0 0 0 0 0.6 0.8\n");
    desk.put("drive.relations", "1 2 1 0 0 0 0 0.5\n2 4 0 1 0 0 0 -0.5\n");
    let gfs = r#"{"map": {"2.5": {"range": [1, 2], "x": 0, "y": 1, "theta": 0.5}}}"#;
    desk.put("drive.json", gfs);
    fs::create_dir(desk.path("room")).expect("a folder");
    let pixels: Vec<String> = (0..12).map(|x| (1000 + x).to_string()).collect();
    let image = format!("P2 4 3 65535 {}", pixels.join(" "));
    desk.put("room/depth_0.pgm", &image);
    desk.put("room/depth_1.pgm", &image);
    desk.put("room/pose.txt", "1 2 3 0 0 0 1\n1 2 4 0 0 0 1\n");
    desk.put("room/camera-intrinsics.txt", "4 0 1.5\n0 4 1\n0 0 1\n");
    let mut all = String::new();
    for name in ["drive.log", "drive.tum", "drive.relations", "drive.json", "room"] {
        let told = desk.driftlab(&["log", "info", name]);
        assert_eq!(code(&told), 0, "{}", stderr(&told));
        all.push_str(&format!("# {name}\n{}{}\n", stderr(&told), stdout(&told)));
    }
    insta::assert_snapshot!(all);

    let out = json(&desk.driftlab(&["log", "convert", "room", "room.mcap", "--json"]));
    assert_eq!(out["topics"]["/depth"], 2);
    let log = read(&desk.path("room.mcap"));
    let depth = log.messages.iter().find_map(|message| match &message.content {
        Content::Depth(depth) => Some(depth.pixels.depths_m[11]),
        _ => None,
    });
    assert_eq!(depth, Some(1.011));
    assert_eq!(log.topics_of(ContentKind::Transforms).count(), 1);
    assert_eq!(log.topics_of(ContentKind::Camera).count(), 1);
}

#[test]
fn a_carmen_log_becomes_mcap_without_losing_a_digit() {
    let desk = Desk::new("");
    desk.put("drive.log", CARMEN);
    let done = desk.driftlab(&["log", "convert", "drive.log", "drive.mcap"]);
    assert_eq!(code(&done), 0, "{}", stderr(&done));
    assert!(stderr(&done).contains("line 7: 1 line(s) start with `TRUEPOS`"), "{}", stderr(&done));
    assert_eq!(stdout(&done), "drive.mcap: 8 messages on 3 topics\n");
    let log = read(&desk.path("drive.mcap"));
    let scans: Vec<_> = log
        .messages
        .iter()
        .filter(|message| log.topics[message.topic].copy_of.is_none())
        .filter_map(|message| match &message.content {
            Content::Scan(scan) => Some(scan),
            _ => None,
        })
        .collect();
    assert_eq!(scans.len(), 3);
    assert_eq!(scans[0].scan.ranges_m, [1.0, 2.0, 3.333_333_333_3, 81.0]);
    assert_eq!(scans[0].scan.bearing_step_rad, std::f64::consts::FRAC_PI_4);
    assert_eq!(scans[0].scan.range_max_m, 80.0);
    let odometry = log.topic("/odom").expect("poses of the sensor");
    let poses: Vec<Se2> = log
        .messages
        .iter()
        .filter(|message| message.topic == odometry)
        .filter_map(|message| match &message.content {
            Content::Odometry(odometry) => Some(planar(&odometry.odom_from_body)),
            _ => None,
        })
        .collect();
    let ahead = Se2::new(1.0, 0.0, 0.7) * Se2::new(0.5, 0.0, 0.0);
    assert!(poses[2].inverse_mul(&ahead).log().norm() < 1e-12, "{poses:?}");
    // What was converted is converted to the same bytes again.
    let again = desk.driftlab(&["log", "convert", "drive.mcap", "again.mcap", "-q"]);
    assert_eq!((code(&again), stderr(&again)), (0, String::new()));
    let (first, second) = (read(&desk.path("drive.mcap")), read(&desk.path("again.mcap")));
    let told = |log: &Log| -> Vec<String> {
        log.messages.iter().map(|m| format!("{} {:?}", log.topics[m.topic].name, m)).collect()
    };
    assert_eq!(told(&first), told(&second));
    // Nothing is replaced unless told to.
    let before = fs::read(desk.path("again.mcap")).expect("a file");
    let refused = desk.driftlab(&["log", "convert", "drive.log", "again.mcap"]);
    assert_eq!(code(&refused), 2);
    assert_eq!(fs::read(desk.path("again.mcap")).expect("a file"), before);
    assert_eq!(code(&desk.driftlab(&["log", "convert", "drive.log", "again.mcap", "--force"])), 0);
}

#[test]
fn damage_is_read_up_to_and_told() {
    let desk = Desk::new("");
    let whole = fs::read(sample("ros2_bare.mcap")).expect("a sample");
    fs::write(desk.path("cut.mcap"), &whole[..whole.len() / 2]).expect("half a file");
    let told = desk.driftlab(&["log", "info", "cut.mcap"]);
    assert_eq!(code(&told), 0);
    let warning = stderr(&told);
    assert!(warning.contains("warning: cut.mcap: byte "), "{warning}");
    assert!(warning.contains("what stands before was read"), "{warning}");
    let facts = json(&desk.driftlab(&["log", "info", "cut.mcap", "--json"]));
    let at = facts["damaged_at"].as_u64().expect("a place");
    assert!(at <= whole.len() as u64 / 2);
    let done = json(&desk.driftlab(&["log", "convert", "cut.mcap", "mended.mcap", "--json"]));
    assert_eq!(done["damaged_at"], at);
    let mended = json(&desk.driftlab(&["log", "info", "mended.mcap", "--json"]));
    assert!(mended["damaged_at"].is_null());
}

#[test]
fn bad_input_gets_one_message_and_leaves_nothing() {
    let desk = Desk::new("");
    for name in ["ros1_bz2.bag", "ros1.bag"] {
        fs::copy(sample(name), desk.path(name)).expect("a copy");
    }
    desk.put("words.txt", "hello there\n");
    desk.put("graph.g2o", "VERTEX_SE2 0 0 0 0\n");
    desk.put("bad.log", "FLASER 3 1 2\n");
    desk.put("short.mcap", "\u{1}MCAP0");
    fs::write(desk.path("head.mcap"), b"\x89MCAP0\r\n").expect("a file");
    fs::create_dir(desk.path("empty")).expect("a folder");
    fs::create_dir(desk.path("broken")).expect("a folder");
    desk.put("broken/depth_0.pgm", "P2 4 3 65535 1 2 x");
    desk.put("broken/pose.txt", "1 2 3 0 0 0 1\n");
    let before = desk.listing();
    let mut told = String::new();
    let mut refuse = |args: &[&str]| {
        let output = desk.driftlab(&[&["log"], args].concat());
        assert_eq!(code(&output), 2, "{args:?}: {}", stderr(&output));
        assert_eq!(stdout(&output), "", "{args:?}");
        told.push_str(&format!("# {}\n{}\n", args.join(" "), stderr(&output)));
    };
    for input in [
        "gone.mcap",
        "words.txt",
        "graph.g2o",
        "bad.log",
        "short.mcap",
        "head.mcap",
        "empty",
        "broken",
        "ros1_bz2.bag",
    ] {
        refuse(&["info", input]);
        refuse(&["convert", input, "out.mcap"]);
    }
    refuse(&["convert", "ros1.bag", "out.bag"]);
    refuse(&["convert", "ros1.bag", "nowhere/out.mcap"]);
    refuse(&["convert", "ros1.bag", "head.mcap"]);
    refuse(&["convert", "ros1.bag", "empty/../ros1.bag"]);
    assert_eq!(desk.listing(), before);
    insta::assert_snapshot!(told);
}
