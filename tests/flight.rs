//! Robots that fly, through the command: results, recordings, messages, exit codes.

mod desk;

use std::fs;

use desk::{Desk, code, json, root, stderr, stdout};
use serde_json::Value;

/// A flight of a few looks in a small hall.
const SMALL: &str = r#"# A small hall.

name = "hall"
seed = 3
max_steps = 6

[world3d.pillars]
width_m = 6.0
depth_m = 5.0
height_m = 2.5
pillars = 1
radius_max_m = 0.3
gap_m = 0.8

[camera]
columns = 40
rows = 36

[robot]
radius_m = 0.2

[map3d.relative]
vertices = 200

[record]
level = "off"
"#;

/// The names under a map of `metrics.json` that scripts rely on.
const METRIC_NAMES: [&str; 20] = [
    "believed_complete",
    "coverage",
    "false_completion",
    "distance_m",
    "looks",
    "place_edges",
    "collisions",
    "bumps",
    "cells_reachable",
    "frontier_left_m2",
    "frontier_ignored_m2",
    "path_shortening",
    "map_faces",
    "odometry_error_m",
    "free_iou",
    "ways_found",
    "ways_m",
    "ways_repeat_m",
    "ways_refused",
    "free_wrong_share",
];

/// A box with its walls facing inwards, as OBJ.
const BOX: &str = "v 0 0 0\nv 4 0 0\nv 4 3 0\nv 0 3 0\nv 0 0 2.5\nv 4 0 2.5\nv 4 3 2.5\nv 0 3 2.5\n\
    f 1 2 3 4\nf 8 7 6 5\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n";

#[test]
fn the_same_flight_gives_the_same_bytes_at_any_level() {
    let desk = Desk::new(SMALL);
    let fly = |out: &str, level: &str| {
        let level = format!("record.level=\"{level}\"");
        let output = desk.driftlab(&["run", "a.toml", "--out", out, "--set", &level]);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        let read = |name: &str| fs::read(desk.path(out).join(name)).unwrap();
        (read("metrics.json"), read("steps.parquet"))
    };
    let first = fly("one", "off");
    assert_eq!(first, fly("two", "off"));
    assert_eq!(first, fly("three", "full"));
    let metrics: Value = serde_json::from_slice(&first.0).unwrap();
    let map = metrics["maps"]["relative"].as_object().expect("one object per map");
    for name in METRIC_NAMES {
        assert!(map.contains_key(name), "metrics.json: maps.relative.{name}");
    }
    assert!(map["coverage"].as_f64().is_some_and(|share| share > 0.3), "{}", map["coverage"]);
    // The map sees what the robot sees, and hardly more.
    assert!(map["free_iou"].as_f64().is_some_and(|share| share > 0.3), "{}", map["free_iou"]);
    assert!(map["free_wrong_share"].as_f64().is_some_and(|share| share < 0.05));
    // What the run resolved to is a config of the same run.
    let again = desk.driftlab(&["run", "one/run.toml", "--out", "again"]);
    assert_eq!(code(&again), 0, "{}", stderr(&again));
    assert_eq!(first.0, fs::read(desk.path("again/metrics.json")).unwrap());
}

#[test]
fn a_recording_tells_every_event_and_opens_with_its_layout() {
    let desk = Desk::new(SMALL);
    let run = ["run", "a.toml", "--out", "r", "--set", "record.level=\"full\""];
    assert_eq!(code(&desk.driftlab(&run)), 0);
    let result = json(&desk.driftlab(&["inspect", "r", "--json"]));
    assert_eq!(result["has_layout"], true);
    let names = |list: &str, key: &str| -> Vec<String> {
        let all = result[list].as_array().expect("a list");
        all.iter().map(|one| one[key].as_str().expect("a name").to_owned()).collect()
    };
    for timeline in ["step", "distance_mm", "event"] {
        assert!(names("timelines", "name").contains(&timeline.to_owned()), "{timeline}");
    }
    let events = names("events", "variant");
    for event in ["Looked", "Prepared", "Joined", "VertexAdded", "ViewAdded", "Settled", "Closed"] {
        assert!(events.contains(&event.to_owned()), "{event}: {events:?}");
    }
    let entities = names("entities", "path");
    for part in
        ["truth/place", "truth/robot", "camera/depth", "belief/views/0/open", "graph/vertices"]
    {
        assert!(entities.contains(&format!("/relative/{part}")), "{part}: {entities:?}");
    }
}

#[test]
fn one_robot_feeds_all_maps_and_the_united_one_tells_what_it_does() {
    let maps = "[map3d.global_union]\nvertices = 200\n[map3d.voxels]\ncell_m = 0.1\n";
    let desk = Desk::new(&format!("{SMALL}{maps}"));
    let set = ["--set", "compare.drive=\"relative\"", "--set", "record.level=\"full\""];
    let run = [&["run", "a.toml", "--out", "r", "--json"][..], &set].concat();
    let result = json(&desk.driftlab(&run));
    let maps = result["metrics"]["maps"].as_object().expect("one object per map");
    assert_eq!(maps.keys().collect::<Vec<_>>(), ["relative", "global_union", "voxels"]);
    for (name, map) in maps {
        assert_eq!(map["distance_m"], maps["relative"]["distance_m"], "{name}");
        assert!(map["frontier_left_m2"].as_f64().is_some_and(|left| left > 0.1), "{name}: {map}");
    }
    let result = json(&desk.driftlab(&["inspect", "r", "--json"]));
    let events = result["events"].as_array().expect("a list");
    for variant in ["Placed", "United", "Sorted"] {
        let is_told = |one: &Value| one["map"] == "/global_union" && one["variant"] == variant;
        assert!(events.iter().any(is_told), "{variant}: {events:?}");
    }
}

#[test]
fn a_mesh_file_is_flown_in_and_replaces_another_place() {
    let desk = Desk::new(SMALL);
    desk.put("box.obj", BOX);
    let result = json(&desk.driftlab(&["run", "a.toml", "--world", "box.obj", "--json"]));
    let map = &result["metrics"]["maps"]["relative"];
    assert!(map["cells_reachable"].as_u64().is_some_and(|cells| cells > 500), "{map}");
    let provenance = fs::read_to_string(desk.path("recordings/hall/provenance.toml")).unwrap();
    assert!(provenance.contains("box.obj"), "{provenance}");
}

#[test]
fn what_a_camera_did_not_read_is_frontier_where_it_ends_to_read() {
    let desk = Desk::new(SMALL);
    let sets = ["camera.far_m=1.5", "max_steps=1"];
    for kind in ["relative", "global_union"] {
        let map = format!("map3d.{kind}.vertices=200");
        let sets: Vec<&str> =
            sets.iter().chain([&map.as_str()]).flat_map(|set| ["--set", *set]).collect();
        let run = [&["run", "a.toml", "--json", "--force"][..], &sets].concat();
        let result = json(&desk.driftlab(&run));
        let left_m2 =
            result["metrics"]["maps"][kind]["frontier_left_m2"].as_f64().expect("a number");
        // The base of a pyramid of 100 by 90 degrees at 1.5 m is 10.7 square metres, at 8 m 305.
        assert!((1.0..16.0).contains(&left_m2), "{kind}: {left_m2} m²");
    }
}

#[test]
fn a_robot_that_gets_out_through_a_hole_ends_there() {
    let desk = Desk::new(SMALL);
    desk.put("hole.obj", &BOX.replace("f 4 8 5 1\n", ""));
    let start = ["--set", "start={x_m=0.3,y_m=1.5,heading_deg=180}", "--set", "max_steps=60"];
    let run = [&["run", "a.toml", "--world", "hole.obj", "--json"][..], &start].concat();
    let output = desk.driftlab(&run);
    let result = json(&output);
    assert_eq!(result["metrics"]["maps"]["relative"]["termination"], "left_the_place");
    assert!(stderr(&output).contains("hole"), "{}", stderr(&output));
}

#[test]
fn a_sweep_over_flights_has_a_row_for_each() {
    let desk =
        Desk::new(&format!("{SMALL}[sweep]\nseeds = 2\n[sweep.axes]\nodometry.scale = [0, 1]\n"));
    let output = desk.driftlab(&["sweep", "a.toml", "--out", "s", "-q"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let table = json(&desk.driftlab(&["sweep", "a.toml", "--out", "s", "--json"]));
    assert_eq!(table["rows"].as_array().map(Vec::len), Some(4), "{table}");
}

#[test]
fn every_bad_flight_gets_one_message_and_leaves_nothing() {
    let desk = Desk::new("");
    desk.put("broken.obj", "v 0 0 0\nv 1 0 0\nv 0 1 zero\nf 1 2 3\n");
    desk.put("open.obj", "v 0 0 0\nv 4 0 0\nv 0 3 0\nf 1 2 3\n");
    desk.put("nothing.off", "OFF\n0 0 0\n");
    let maps = "[map3d.relative]\n";
    let cases: [(&str, String, &[&str]); 13] = [
        ("table of the plane", format!("{SMALL}[sensor]\nrange_m = 5\n"), &[]),
        ("table of space", "[world.maze]\n[map.relative]\n[camera]\nrows = 20\n".into(), &[]),
        ("two places", format!("{SMALL}[world3d.cave]\n"), &[]),
        ("no map", "[world3d.rooms]\n".into(), &[]),
        ("no place", maps.into(), &[]),
        ("impossible value", format!("[world3d.rooms]\ndoor_m = 9\n{maps}"), &[]),
        ("wheels", format!("[world3d.rooms]\n[odometry]\nbias_rotation = 1\n{maps}"), &[]),
        ("a body that does not fit", SMALL.replace("radius_m = 0.2", "radius_m = 3.0"), &[]),
        ("start outside", format!("start.x_m = 50\n{SMALL}"), &[]),
        ("broken mesh", SMALL.into(), &["--world", "broken.obj"]),
        ("mesh that is not closed in", SMALL.into(), &["--world", "open.obj"]),
        ("mesh of nothing", SMALL.into(), &["--world", "nothing.off"]),
        ("voxels without end", format!("{SMALL}[metrics3d]\ncell_m = 1e-6\n"), &[]),
    ];
    let mut page = String::new();
    for (name, config, more) in &cases {
        desk.put("a.toml", config);
        let before = desk.listing();
        let output = desk.driftlab(&[&["run", "a.toml"][..], more].concat());
        let text = stderr(&output).replace(&desk.folder.path().display().to_string(), "DIR");
        assert_eq!(code(&output), 2, "{name}: {text}");
        assert_eq!(stdout(&output), "", "{name}");
        assert_eq!(desk.listing(), before, "{name}: something is left behind");
        page.push_str(&format!("# {name}\n{text}\n"));
    }
    insta::with_settings!({ omit_expression => true }, { insta::assert_snapshot!(page) });
}

#[test]
fn a_flight_that_is_killed_leaves_a_recording_that_opens() {
    use std::time::{Duration, Instant};
    let config = root().join("configs/3d/rooms.toml");
    let desk = Desk::new("");
    let mut run = std::process::Command::new(assert_cmd::cargo::cargo_bin("driftlab"))
        .current_dir(desk.folder.path())
        .args(["run", &config.to_string_lossy(), "--out", "r", "-q"])
        .spawn()
        .expect("it starts");
    let enough = || fs::metadata(desk.path("r/run.rrd")).is_ok_and(|file| file.len() > 200_000);
    let start = Instant::now();
    while !enough() && start.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(20));
    }
    assert!(run.try_wait().expect("it can be asked").is_none(), "it ended too early to be killed");
    run.kill().expect("it can be killed");
    run.wait().expect("it ends");
    let result = json(&desk.driftlab(&["inspect", "r", "--json"]));
    assert_eq!((&result["metrics"], &result["has_layout"]), (&Value::Null, &true.into()));
}
