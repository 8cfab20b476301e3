//! `driftlab replay` as a user meets it: results, messages, exit codes, and what is left on the disk.

mod desk;

use std::fmt::Write as _;
use std::fs;

use desk::{Desk, code, json, root, stderr};
use formats::log::{
    Content, Decision, DecisionMessage, EdgeMessage, Header, LogReader, ReadOptions, ScanMessage,
    Stamp, StandingMessage, planar,
};
use formats::mcap::McapWriter;
use pose::Se2;
use sensing::Scan;
use serde_json::Value;

const CONFIG: &str = "# A log.\nname = \"log\"\n[replay]\nloop_m = 8.0\n[sensor]\nfov_deg = 360.0\n\
    range_m = 6.0\n[map.relative]\n[map.grid]\ncell_m = 0.5\n[record]\nlevel = \"off\"\n";

/// The walls of a hall of 8 m x 6 m with a pillar and a stub.
const WALLS: [[f64; 4]; 9] = [
    [0.0, 0.0, 8.0, 0.0],
    [8.0, 0.0, 8.0, 6.0],
    [8.0, 6.0, 0.0, 6.0],
    [0.0, 6.0, 0.0, 0.0],
    [3.5, 2.5, 4.5, 2.5],
    [4.5, 2.5, 4.5, 3.2],
    [4.5, 3.2, 3.5, 3.2],
    [3.5, 3.2, 3.5, 2.5],
    [0.0, 4.6, 1.2, 4.6],
];

fn range_m(from: &Se2, bearing_rad: f64) -> f64 {
    let (sin, cos) = (from.angle() + bearing_rad).sin_cos();
    let hits = WALLS.iter().filter_map(|[ax, ay, bx, by]| {
        let (ex, ey) = (bx - ax, by - ay);
        let (px, py) = (ax - from.translation.x, ay - from.translation.y);
        let cross = cos * ey - sin * ex;
        let (range, along) = ((px * ey - py * ex) / cross, (px * sin - py * cos) / cross);
        (range > 0.0 && (0.0..=1.0).contains(&along)).then_some(range)
    });
    hits.fold(81.83, f64::min)
}

/// A robot that goes round the pillar and back to where it began, whose wheels see turns too large: its
/// log, and true relations between poses at the times of scans.
fn drive() -> (String, String) {
    let quarter = std::f64::consts::FRAC_PI_2;
    let mut truth = Se2::new(1.0, 1.0, 0.0);
    let mut told = Se2::new(5.0, -3.0, 0.4);
    let (mut log, mut poses) = (String::from("# a log\n"), Vec::new());
    for (side, length_m) in [6.0, 4.0, 6.0, 4.0, 3.0].iter().enumerate() {
        for step in 0..(length_m * 2.0) as usize {
            let turn = if step == 0 && side > 0 { quarter } else { 0.0 };
            let motion = Se2::from_angle(turn) * Se2::new(0.5, 0.0, 0.0);
            if !poses.is_empty() {
                truth = truth * motion;
                told = told * motion * Se2::from_angle(0.01 + 0.02 * turn);
            }
            let secs = 100.0 + poses.len() as f64;
            poses.push((secs, truth));
            let ranges: String = (0..180).fold(String::new(), |mut line, i| {
                let bearing_rad = f64::from(i).to_radians() - quarter;
                write!(line, " {:.3}", range_m(&truth, bearing_rad)).expect("memory");
                line
            });
            let (x, y, theta) = (told.translation.x, told.translation.y, told.angle());
            let pose = format!("{x} {y} {theta}");
            writeln!(log, "FLASER 180{ranges} {pose} {pose} {secs} robot {secs}").expect("memory");
        }
    }
    let mut relations = String::new();
    for (i, (from_secs, from)) in poses.iter().enumerate() {
        for (to_secs, to) in poses.iter().skip(i + 1).step_by(7) {
            let between = from.inverse_mul(to);
            let (x, y, theta) = (between.translation.x, between.translation.y, between.angle());
            writeln!(relations, "{from_secs} {to_secs} {x} {y} 0 0 0 {theta}").expect("memory");
        }
    }
    (log, relations)
}

#[test]
fn a_log_is_replayed_and_judged_without_truth() {
    let desk = Desk::new(CONFIG);
    let (log, relations) = drive();
    desk.put("drive.log", &log);
    desk.put("relations.txt", &relations);
    let args = ["replay", "drive.log", "a.toml", "--relations", "relations.txt", "--json"];
    let result = json(&desk.driftlab(&args));
    assert_eq!(result["dir"], "recordings/log");
    let metrics = &result["metrics"];
    assert_eq!(metrics["keyframes"], 46, "{metrics}");
    assert!(metrics["loop_closures_accepted"].as_u64() > Some(0), "{metrics}");
    assert!(
        metrics["loop_closures_proposed"].as_u64() >= metrics["loop_closures_accepted"].as_u64()
    );
    let number = |of: &Value| of.as_f64().unwrap_or_else(|| panic!("a number: {of}"));
    assert!(number(&metrics["relations_translation_m"]) < 0.05, "{metrics}");
    assert!(number(&metrics["relations_rotation_deg"]) < 1.0, "{metrics}");
    let of_odometry = &metrics["relations"]["of_two_scans"]["odometry"]["translation_m"];
    assert!(number(of_odometry) > 0.3, "the wheels do drift: {metrics}");
    let inconsistency = &metrics["inconsistency"];
    assert!(number(&inconsistency["relative"]) < 0.02, "{inconsistency}");
    assert!(number(&inconsistency["odometry"]) > number(&inconsistency["relative"]));
    // The hall of 48 m2, without the pillar, and without what a sensor that looks ahead has not seen.
    let covered_m2 = number(&metrics["covered_m2"]);
    assert!((40.0..48.5).contains(&covered_m2), "{covered_m2} m2");
    for map in ["relative", "grid"] {
        assert!(metrics["maps"][map]["frontier_left_m"].is_number(), "{metrics}");
        assert!(metrics["maps"][map]["coverage"].is_null(), "nobody knows: {metrics}");
    }
    // The grid lives by the wheels alone.
    assert_eq!(metrics["maps"]["grid"]["place_edges"], 0, "{metrics}");
    assert_eq!(metrics["maps"]["relative"]["place_edges"], metrics["loop_closures_accepted"]);
    let timing = &result["timing"];
    for name in ["wall_secs", "keyframe_millis_median", "keyframe_millis_p99", "bytes_per_keyframe"]
    {
        assert!(number(&timing[name]) > 0.0, "{name}: {timing}");
    }
    assert_eq!(timing["log_secs"], 45.0);

    let read = |name: &str| fs::read(desk.path("recordings/log").join(name)).expect(name);
    let text = |name: &str| String::from_utf8(read(name)).expect("text");
    for name in ["odometry.tum", "tracked.tum", "optimised.tum"] {
        assert_eq!(text(name).lines().count(), 46, "{name}: a pose for each scan");
    }
    assert_eq!(text("graph.g2o").matches("VERTEX_SE2").count(), 46);
    let closures = text("closures.txt");
    assert_eq!(
        Some(closures.lines().count() as u64 - 1),
        metrics["loop_closures_accepted"].as_u64()
    );
    let first = read("metrics.json");
    let steps = read("steps.parquet");

    // The same again is the same, byte for byte; and what was found can be given.
    let again = [&args[..], &["--force"]].concat();
    assert_eq!(code(&desk.driftlab(&again)), 0);
    assert!(read("metrics.json") == first && read("steps.parquet") == steps);
    desk.put("closures.txt", &closures);
    let given = [&args[..], &["--places", "closures.txt", "--out", "given"]].concat();
    let given = json(&desk.driftlab(&given));
    let given = &given["metrics"];
    assert_eq!(given["loop_closures_accepted"], metrics["loop_closures_accepted"]);
    assert!(number(&given["relations_translation_m"]) < 0.06, "{given}");
}

/// The numbers of the lines of a text that start so.
fn rows(text: &str, start: &str) -> Vec<Vec<f64>> {
    let lines = text.lines().filter_map(|line| line.strip_prefix(start));
    lines
        .map(|line| line.split_whitespace().map(|w| w.parse().expect("a number")).collect())
        .collect()
}

/// A robot comes back to vertices that it founded long ago: scans there are where these vertices are, and the
/// way to them was driven.
#[test]
fn scans_of_an_exported_run_are_at_their_vertices_and_the_whole_way_counts() {
    let desk = Desk::new(&CONFIG.replace("[map.relative]\n", ""));
    let sample = root().join("recordings/samples/maze.mcap");
    let bytes = fs::read(&sample).expect("the sample");
    let log = LogReader::new(&bytes[..], &ReadOptions::default()).expect("MCAP").into_log();
    let (mut standings, mut way_m, mut last) = (Vec::new(), 0.0, None::<Se2>);
    for message in &log.messages {
        match &message.content {
            Content::Standing(standing) => standings.push(standing.clone()),
            Content::Odometry(odometry) => {
                let pose = planar(&odometry.odom_from_body);
                way_m += last.map_or(0.0, |last| last.inverse_mul(&pose).distance());
                last = Some(pose);
            }
            _ => {}
        }
    }
    let newest = |i: usize| standings[..=i].iter().map(|s| s.vertex).max();
    let old = (0..standings.len()).filter(|&i| Some(standings[i].vertex) < newest(i)).count();
    assert!(old > 50, "known vertices are come back to: {old} scans");

    let sample = sample.to_str().expect("a path of letters");
    let result = json(&desk.driftlab(&["replay", sample, "a.toml", "--json"]));
    let metrics = &result["metrics"];
    let distance_m = metrics["distance_m"].as_f64().expect("a number");
    assert!((distance_m - way_m).abs() < 1e-6, "{distance_m} m of {way_m} m");
    assert_eq!(metrics["maps"]["grid"]["distance_m"], metrics["distance_m"]);

    let text =
        |name: &str| fs::read_to_string(desk.path("recordings/log").join(name)).expect("text");
    let vertices = rows(&text("graph.g2o"), "VERTEX_SE2 ");
    let scans = rows(&text("optimised.tum"), "");
    assert_eq!(scans.len(), standings.len());
    for (scan, standing) in scans.iter().zip(&standings) {
        let vertex = &vertices[standing.vertex as usize];
        let pose = Se2::new(vertex[1], vertex[2], vertex[3]) * standing.vertex_from_body;
        let off_m = (pose.translation.x - scan[1]).hypot(pose.translation.y - scan[2]);
        assert!(off_m < 1e-4, "{off_m} m at vertex {}", standing.vertex);
    }
}

#[test]
fn a_recording_shows_the_scans_three_ways_and_every_match() {
    let desk = Desk::new(CONFIG);
    desk.put("drive.log", &drive().0);
    let replay = |level: &str, out: &str| {
        let level = format!("record.level=\"{level}\"");
        json(&desk.driftlab(&[
            "replay",
            "drive.log",
            "a.toml",
            "--set",
            &level,
            "--out",
            out,
            "--json",
        ]))
    };
    let (seen, unseen) = (replay("full", "seen"), replay("off", "unseen"));
    assert_eq!(seen["metrics"], unseen["metrics"], "nobody's watching changes anything");
    assert!(!desk.path("unseen/run.rrd").exists());
    let told = json(&desk.driftlab(&["inspect", "seen", "--json"])).to_string();
    for path in [
        "pictures/by_odometry/walls",
        "pictures/as_optimised/walls",
        "pictures/around_the_robot/walls",
        "match/before/current",
        "match/after/covariance",
        "relative/belief/edges/obstacle",
        "grid/belief/cells",
    ] {
        assert!(told.contains(path), "{path}: {told}");
    }
    for event in ["KeyframeAdded", "Tracked", "CandidatesRanked", "PlaceMatched", "Closed"] {
        assert!(told.contains(event), "{event}: {told}");
    }
}

#[test]
fn matches_and_relations_of_another_log_are_told() {
    let desk = Desk::new(CONFIG);
    let log = drive().0.lines().take(9).collect::<Vec<&str>>().join("\n");
    desk.put("drive.log", &log);
    // One that fits, the same from the other end, two of another log, one of a single scan.
    let places = "100 106 3 0 0\n# known current\n106 101 -2.5 0 0\n5 106 0 0 0\n\
                  100 900 0 0 0\n100.1 99.9 0 0 0\n";
    desk.put("places.txt", places);
    desk.put("relations.txt", "1 2 1 0 0 0 0 0\n");
    let args = ["replay", "drive.log", "a.toml", "--places", "places.txt"];
    let output = desk.driftlab(&[&args[..], &["--relations", "relations.txt"]].concat());
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    for told in [
        "warning: places.txt: 2 of 5 place match(es) have no scan of the log within 0.5 s of one of \
         their times; left out, first line 4\n",
        "warning: places.txt: 1 of 5 place match(es) name the same scan twice; left out, first line 6\n",
        "warning: relations.txt: none of 1 relation(s) lies within the log, from 100 s to 107 s\n",
    ] {
        assert!(stderr(&output).contains(told), "{told}: {}", stderr(&output));
    }
    let result = json(&desk.driftlab(&[&args[..], &["--json", "--force"]].concat()));
    assert_eq!(result["metrics"]["loop_closures_accepted"], 2, "{result}");
    assert_eq!(result["metrics"]["loop_closures_rejected_by_graph"], 0, "{result}");
}

/// A log with a graph of two vertices, and one message more.
fn graph_log(odd: &Content) -> Vec<u8> {
    let stamp = Stamp::from_secs;
    let standing = |secs: f64, vertex: u32| {
        let vertex_from_body = Se2::identity();
        Content::Standing(StandingMessage { stamp: stamp(secs), vertex, vertex_from_body })
    };
    let scan = |secs: f64| {
        Content::Scan(ScanMessage {
            header: Header::new(stamp(secs), "base_link"),
            scan: Scan::new(-0.5, 0.1, vec![2.0; 11], 5.0),
            range_min_m: 0.0,
            frame_from_sensor: None,
        })
    };
    let edge = EdgeMessage {
        stamp: stamp(2.0),
        a: 0,
        b: 1,
        place: false,
        a_from_b: Se2::new(1.0, 0.0, 0.0),
    };
    let mut writer = McapWriter::new(Vec::new()).expect("memory");
    for (topic, secs, content) in [
        ("/graph/standing", 1.0, &standing(1.0, 0)),
        ("/scan", 1.0, &scan(1.0)),
        ("/graph/edges", 2.0, &Content::Edge(edge)),
        ("/graph/standing", 2.0, &standing(2.0, 1)),
        ("/scan", 2.0, &scan(2.0)),
        ("/graph/odd", 3.0, odd),
        ("/scan", 3.0, &scan(3.0)),
    ] {
        writer.write(topic, stamp(secs), content).expect("memory");
    }
    writer.finish().expect("memory")
}

#[test]
fn numbers_of_a_graph_without_bounds_ask_for_no_memory() {
    let desk = Desk::new(CONFIG);
    let (stamp, at) = (Stamp::from_secs(3.0), Se2::identity());
    let gave_up = |vertex: u32, radius_m: f64| {
        let decision = Decision::GaveUp {
            vertex,
            vertex_from_body: at,
            goal_in_body: [1.0, 0.0],
            radius_m,
            everywhere: true,
        };
        Content::Decision(DecisionMessage { stamp, map: "grid".into(), decision })
    };
    let standing =
        |vertex| Content::Standing(StandingMessage { stamp, vertex, vertex_from_body: at });
    let edge = |a, b| Content::Edge(EdgeMessage { stamp, a, b, place: true, a_from_b: at });
    for (odd, found) in [
        (standing(4_000_000_000), "a standing at vertex 4000000000, expected 2 at most"),
        (edge(0, 4_000_000_000), "an edge to vertex 4000000000, expected 2 at most"),
        (edge(3, 1), "an edge from vertex 3, expected 2 at most"),
        (gave_up(u32::MAX, 1.0), "a decision at vertex 4294967295, expected 1 at most"),
    ] {
        fs::write(desk.path("odd.mcap"), graph_log(&odd)).expect("a file");
        let output = desk.driftlab(&["replay", "odd.mcap", "a.toml"]);
        assert_eq!(code(&output), 2, "{}", stderr(&output));
        let told = format!("odd.mcap: /graph/odd at 3.000000000 s: found {found}");
        assert!(stderr(&output).contains(&told), "{}", stderr(&output));
        assert!(!desk.path("recordings").exists());
    }
    // The next vertex is no gap, and a radius beyond everything gives up what is there.
    for (odd, left) in [(edge(1, 2), false), (gave_up(1, 1e300), true)] {
        fs::write(desk.path("odd.mcap"), graph_log(&odd)).expect("a file");
        let args = ["replay", "odd.mcap", "a.toml", "--json", "--force"];
        let result = json(&desk.driftlab(&args));
        let grid = &result["metrics"]["maps"]["grid"];
        assert_eq!(grid["vertices"], if left { 2 } else { 3 }, "{grid}");
        assert_eq!(grid["frontier_ignored_m"].as_f64() > Some(0.0), left, "{grid}");
    }
}

#[test]
fn what_cannot_be_replayed_is_told_and_leaves_nothing() {
    let desk = Desk::new(CONFIG);
    let line = "FLASER 3 1 1 1 0 0 0 0 0 0 1 h 1\n";
    desk.put("one.log", line);
    desk.put("bad.log", "FLASER 3 1 1\n");
    desk.put("no.log", "nothing\n");
    desk.put("empty.log", "");
    fs::write(desk.path("picture.log"), b"\x89PNG\r\n\x1a\n\0\0").expect("a file");
    // Cut within the first record, and behind topics that hold no scan.
    let sample = fs::read(root().join("recordings/samples/maze.mcap")).expect("the sample");
    fs::write(desk.path("head.mcap"), &sample[..200]).expect("a file");
    let at = Stamp::from_secs(1.0);
    let standing = StandingMessage { stamp: at, vertex: 0, vertex_from_body: Se2::identity() };
    let mut writer = McapWriter::new(Vec::new()).expect("memory");
    writer.write("/graph/standing", at, &Content::Standing(standing)).expect("memory");
    let whole = writer.finish().expect("memory");
    fs::write(desk.path("half.mcap"), &whole[..whole.len() * 9 / 10]).expect("a file");
    desk.put("places.txt", "1 2 x 0 0\n");
    desk.put("relations.txt", "1 2 3\n");
    desk.put("true.toml", "[replay]\n[map.grid]\nposes = \"true\"\n");
    for (args, found) in [
        (&["gone.log", "a.toml"][..], "gone.log: cannot be read"),
        (&[".", "a.toml"], ".: found a folder, expected a log"),
        (&["bad.log", "a.toml"], "bad.log: line 1, column 8"),
        (
            &["no.log", "a.toml"],
            "no.log: byte 0: found a file of no known kind, expected an MCAP file",
        ),
        (&["empty.log", "a.toml"], "empty.log: byte 0: found an empty file, expected an MCAP file"),
        (
            &["picture.log", "a.toml"],
            "found a PNG file, expected an MCAP file, a bag of ROS 1, a log of",
        ),
        (&["head.mcap", "a.toml"], "head.mcap: byte "),
        (&["head.mcap", "a.toml"], ", of which "),
        (&["half.mcap", "a.toml"], "; damaged at byte "),
        (&["one.log", "true.toml"], "true.toml:3:9: found \"true\" for `map.grid.poses`"),
        (&["one.log", "a.toml", "--places", "places.txt"], "places.txt: line 1: found `x`"),
        (&["one.log", "a.toml", "--places", "/closures"], "found no topic /closures in a text log"),
        (&["one.log", "a.toml", "--relations", "relations.txt"], "relations.txt: line 1, column 6"),
        (&["one.log", "a.toml", "--set", "replay.overlap=2"], "found 2.0 for `replay.overlap`"),
    ] {
        let output = desk.driftlab(&[&["replay"], args].concat());
        assert_eq!(code(&output), 2, "{args:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(found), "{args:?}: {}", stderr(&output));
    }
    let run = desk.driftlab(&["run", "a.toml"]);
    assert_eq!(code(&run), 2);
    assert!(stderr(&run).contains("a log is for `driftlab replay`"), "{}", stderr(&run));
    assert!(!desk.path("recordings").exists());

    // A log of one scan is no place to go round, but a log.
    let result = json(&desk.driftlab(&["replay", "one.log", "a.toml", "--json"]));
    assert_eq!(
        (&result["metrics"]["keyframes"], &result["metrics"]["loop_closures_proposed"]),
        (&1.into(), &0.into())
    );
}

#[test]
fn the_shipped_config_is_one_for_logs() {
    let desk = Desk::new("");
    let config = root().join("configs/logs/laser.toml");
    let config = config.to_str().expect("a path of letters");
    desk.put("one.log", "FLASER 3 1 1 1 0 0 0 0 0 0 1 h 1\n");
    let result = json(&desk.driftlab(&["replay", "one.log", config, "--json"]));
    let maps = result["metrics"]["maps"].as_object().expect("maps");
    assert!(maps.len() >= 3, "several representations: {maps:?}");
}
