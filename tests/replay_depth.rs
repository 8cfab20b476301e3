//! `driftlab replay` of depth images, as a user meets it.

mod desk;

use std::fs;

use desk::{Desk, code, json, stderr, stdout};
use serde_json::Value;

const CONFIG: &str = "# A walk.\nname = \"walk\"\n[replay3d]\nfar_m = 4.0\nbody_radius_m = 0.02\nintrinsics = [400.0, 400.0, 319.5, 239.5]\n\
    [map3d.global_union]\nvertices = 60\n[map3d.relative]\nvertices = 60\n[map3d.voxels]\ncell_m = 0.1\n\
    [record]\nlevel = \"off\"\n";

const COLUMNS: usize = 40;
const ROWS: usize = 30;

/// Levels of a millimetre: a box stands before a wall at 3 m, and a part of the wall gives no reading.
fn image(shift: usize) -> Vec<u8> {
    let mut bytes = format!("P5\n{COLUMNS} {ROWS}\n65535\n").into_bytes();
    for row in 0..ROWS {
        for column in 0..COLUMNS {
            let across = column + shift;
            let level: u16 = match (row, across) {
                (12..22, 14..22) => 1500,
                (0..6, 28..38) => 0,
                _ => 3000,
            };
            bytes.extend(level.to_be_bytes());
        }
    }
    bytes
}

/// A folder with three images of a camera that moves to the right, and their poses.
fn walk(desk: &Desk) {
    fs::create_dir(desk.path("walk")).expect("a new folder");
    let mut poses = String::new();
    for frame in 0..3 {
        fs::write(desk.path(&format!("walk/depth_{frame}.pgm")), image(frame)).expect("a file");
        poses += &format!("{} 0 0 0 0 0 1\n", 0.1 * frame as f64);
    }
    desk.put("walk/pose.txt", &poses);
}

fn desk() -> Desk {
    let desk = Desk::new(CONFIG);
    walk(&desk);
    desk
}

#[test]
fn images_become_maps_meshes_and_a_way_to_the_nearest_frontier() {
    let desk = desk();
    let told = json(&desk.driftlab(&["replay", "walk", "a.toml", "--out", "r", "--json"]));
    let metrics = &told["metrics"];
    assert_eq!((&metrics["keyframes"], &metrics["images"]), (&3.into(), &3.into()));
    assert!((metrics["distance_m"].as_f64().expect("metres") - 0.2).abs() < 1e-9, "{metrics}");
    for map in ["global_union", "relative", "voxels"] {
        let told = &metrics["maps"][map];
        assert!(told["frontier_left_m2"].as_f64().is_some_and(|left| left > 0.1), "{map}: {told}");
        assert_eq!(told["refused_looks"], 0, "{map}");
    }
    for map in ["global_union", "relative"] {
        let told = &metrics["maps"][map];
        let way = told["way"].as_array().expect("a way");
        assert!(way.len() >= 2, "{map}: {told}");
        // It starts where the camera was last.
        let start: Vec<f64> =
            way[0].as_array().expect("a point").iter().filter_map(Value::as_f64).collect();
        assert!((start[0] - 0.2).hypot(start[1]).hypot(start[2]) < 1e-9, "{map}: {start:?}");
    }
    // The union is a labelled solid; the faces of the views are a soup.
    let mesh = json(&desk.driftlab(&["mesh", "info", "r/global_union.ply", "--json"]));
    assert_eq!((&mesh["closed"], &mesh["manifold"]), (&true.into(), &true.into()), "{mesh}");
    for file in ["relative.ply", "camera.tum", "run.toml", "timing.json", "provenance.toml"] {
        assert!(desk.path("r").join(file).exists(), "{file}");
    }
}

#[test]
fn what_is_wrong_with_single_images_leaves_these_out_and_is_told() {
    let desk = desk();
    let mut poses = fs::read_to_string(desk.path("walk/pose.txt")).expect("the poses");
    // One is cut, one is black, the poses of two are none.
    fs::write(desk.path("walk/depth_3.pgm"), &image(0)[..90]).expect("a file");
    let black = [b"P5\n40 30\n65535\n".to_vec(), vec![0; 2 * COLUMNS * ROWS]].concat();
    fs::write(desk.path("walk/depth_4.pgm"), black).expect("a file");
    fs::write(desk.path("walk/depth_5.pgm"), image(0)).expect("a file");
    fs::write(desk.path("walk/depth_6.pgm"), image(0)).expect("a file");
    poses += &"0 0 0 0 0 0 1\n".repeat(2);
    poses += "nan -inf 0 0 0 0 1\n1e12 0 0 0 0 0 1\n";
    desk.put("walk/pose.txt", &poses);
    let good = ["replay", "walk", "a.toml", "--out", "r", "--json"];
    let output = desk.driftlab(&good);
    let (said, told) = (stderr(&output), json(&output));
    let metrics = &told["metrics"];
    assert_eq!((&metrics["keyframes"], &metrics["images"]), (&3.into(), &5.into()), "{said}");
    assert_eq!((&metrics["without_pose"], &metrics["without_readings"]), (&1.into(), &1.into()));
    for words in [
        "depth_3.pgm: ",
        "1 images left out, with less than 32 readings",
        "depth_5.pgm: left out, its line is no pose",
        "found one 1.000e12 m from the origin of the log, expected at most 1e6 m",
        "1 images without a pose within",
    ] {
        assert!(said.contains(words), "{words}: {said}");
    }
    // The maps are those of the good images.
    let again = Desk::new(CONFIG);
    walk(&again);
    let clean = json(&again.driftlab(&good));
    assert_eq!(clean["metrics"]["maps"], metrics["maps"]);
}

#[test]
fn a_config_without_a_table_for_it_says_what_is_taken() {
    let desk = desk();
    desk.put(
        "b.toml",
        "name = \"b\"\n[world3d.rooms]\n[map3d.voxels]\n[record]\nlevel = \"off\"\n",
    );
    let output = desk.driftlab(&["replay", "walk", "b.toml", "--out", "r"]);
    let said = stderr(&output);
    assert_eq!(code(&output), 0, "{said}");
    assert!(said.contains("b.toml: no table [replay3d]"), "{said}");
}

#[test]
fn a_recording_of_the_images_gives_the_same_result() {
    let desk = desk();
    assert_eq!(code(&desk.driftlab(&["log", "convert", "walk", "walk.mcap"])), 0);
    let result = |log: &str, out: &str| {
        let output = desk.driftlab(&["replay", log, "a.toml", "--out", out]);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        let read = |file: &str| fs::read(desk.path(out).join(file)).expect("a file");
        (read("metrics.json"), read("global_union.ply"), read("relative.ply"))
    };
    let from_folder = result("walk", "a");
    assert_eq!(from_folder, result("walk", "b"));
    assert_eq!(from_folder, result("walk.mcap", "c"));
}

#[test]
fn the_recording_opens_with_depth_image_map_and_way() {
    let desk = desk();
    let run = ["replay", "walk", "a.toml", "--out", "r", "--set", "record.level=\"full\""];
    assert_eq!(code(&desk.driftlab(&run)), 0);
    let told = json(&desk.driftlab(&["inspect", "r", "--json"]));
    assert_eq!(told["has_layout"], true);
    let list = |list: &str, key: &str| -> Vec<String> {
        let all = told[list].as_array().expect("a list");
        all.iter().map(|one| one[key].as_str().expect("a name").to_owned()).collect()
    };
    let (events, entities) = (list("events", "variant"), list("entities", "path"));
    for event in ["Looked", "Prepared", "Joined", "United", "RoutePlanned", "Expanded", "Finished"]
    {
        assert!(events.contains(&event.to_owned()), "{event}: {events:?}");
    }
    for part in [
        "/global_union/belief/union/map",
        "/global_union/belief/union/operand",
        "/global_union/belief/union/search/tetrahedra",
        "/global_union/belief/union/search/graph",
        "/global_union/belief/union/search/closed",
        "/global_union/belief/union/search/path",
        "/relative/camera/depth",
    ] {
        assert!(entities.contains(&part.to_owned()), "{part}: {entities:?}");
    }
    assert!(!entities.iter().any(|path| path.contains("/truth/")), "{entities:?}");
}

#[test]
fn what_cannot_be_replayed_is_told_and_leaves_nothing() {
    let desk = desk();
    fs::create_dir(desk.path("empty")).expect("a new folder");
    fs::create_dir(desk.path("nan")).expect("a new folder");
    fs::write(desk.path("nan/frame-000000.depth.png"), b"").expect("a file");
    desk.put("nan/frame-000000.pose.txt", &"nan nan nan nan\n".repeat(4));
    fs::create_dir(desk.path("cut")).expect("a new folder");
    fs::write(desk.path("cut/depth_0.pgm"), &image(0)[..90]).expect("a file");
    desk.put("cut/pose.txt", "0 0 0 0 0 0 1\n");
    desk.put("plane.toml", "name = \"p\"\n[replay]\n[map.relative]\n");
    desk.put("no_map.toml", "name = \"p\"\n[replay3d]\n[map3d]\n");
    let cases: [&[&str]; 7] = [
        &["nowhere", "a.toml"],
        &["empty", "a.toml"],
        &["nan", "a.toml"],
        &["cut", "a.toml"],
        &["walk", "plane.toml"],
        &["walk", "no_map.toml"],
        &["walk", "a.toml", "--relations", "x.txt"],
    ];
    let mut page = String::new();
    for args in cases {
        let output = desk.driftlab(&[&["replay"][..], args, &["--out", "r"]].concat());
        assert_eq!(code(&output), 2, "{args:?}: {}", stderr(&output));
        assert_eq!(stdout(&output), "", "{args:?}");
        assert!(!desk.path("r").exists(), "{args:?}");
        page.push_str(&format!("$ driftlab replay {}\n{}\n", args.join(" "), stderr(&output)));
    }
    insta::with_settings!({ omit_expression => true }, { insta::assert_snapshot!(page) });
}
