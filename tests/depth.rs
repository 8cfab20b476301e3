//! `driftlab mesh polyhedron`, as a user meets it.

use std::path::Path;
use std::process::Output;

use assert_cmd::Command;
use serde_json::Value;

fn driftlab(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::cargo_bin("driftlab").expect("it is built");
    command.current_dir(folder).args(arguments).output().expect("it starts")
}

fn json(output: &Output) -> Value {
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("one JSON object and nothing else")
}

/// A wall at 2 m, a box at 1.5 m, and a hole without readings, in millimetres.
fn frame(folder: &Path) {
    let mut bytes = b"P5 80 60 65535\n".to_vec();
    for i in 0..80 * 60_u16 {
        let (c, r) = (i % 80, i / 80);
        let level: u16 = match () {
            () if c > 60 && r < 12 => 0,
            () if (20..45).contains(&c) && (20..50).contains(&r) => 1500,
            () => 2000 + (c * 7 + r * 3) % 5,
        };
        bytes.extend(level.to_be_bytes());
    }
    std::fs::write(folder.join("frame.pgm"), bytes).expect("writable");
}

const CAMERA: &str = "70,70,39.5,29.5";

#[test]
fn a_depth_image_becomes_a_valid_polyhedron() {
    let folder = tempfile::tempdir().expect("a folder");
    frame(folder.path());
    for method in
        ["centroid", "least-squares", "least-squares-vertical", "quadric", "inverse-depth"]
    {
        let out = format!("{method}.ply");
        let told = json(&driftlab(
            folder.path(),
            &[
                "mesh",
                "polyhedron",
                "frame.pgm",
                "--camera",
                CAMERA,
                "--reduce",
                method,
                "--vertices",
                "60",
                "-o",
                &out,
                "--json",
            ],
        ));
        for key in ["closed", "manifold"] {
            assert_eq!(told[key], true, "{method} {key}");
        }
        assert_eq!(told["self_intersecting"], false, "{method}");
        assert_eq!(told["uncovered_share"], 0.0, "{method}");
        for key in [
            "vertices",
            "faces",
            "obstacle_faces",
            "frontier_faces",
            "volume_m3",
            "rms_m",
            "p95_m",
            "max_m",
            "outside_max_m",
            "secs_read",
            "secs_triangulate",
            "secs_reduce",
            "secs_polyhedron",
        ] {
            assert!(told[key].is_number(), "{method} {key}");
        }
        assert!(told["mesh_vertices"].as_u64().expect("a count") <= 60);
        let info = json(&driftlab(folder.path(), &["mesh", "info", &out, "--json"]));
        for key in ["vertices", "faces", "obstacle_faces", "frontier_faces", "closed"] {
            assert_eq!(info[key], told[key], "{method} {key}");
        }
    }
}

#[test]
fn a_bound_on_the_error_and_on_what_lies_outside_hold() {
    let folder = tempfile::tempdir().expect("a folder");
    frame(folder.path());
    let bounded = json(&driftlab(
        folder.path(),
        &["mesh", "polyhedron", "frame.pgm", "--camera", CAMERA, "--error", "0.01", "--json"],
    ));
    assert!(bounded["max_m"].as_f64().expect("a distance") <= 0.0101);
    let inside = json(&driftlab(
        folder.path(),
        &[
            "mesh",
            "polyhedron",
            "frame.pgm",
            "--camera",
            CAMERA,
            "--vertices",
            "40",
            "--conservative",
            "0.02",
            "--json",
        ],
    ));
    assert!(inside["outside_max_m"].as_f64().expect("a distance") <= 0.02 + 1e-9);
}

#[test]
fn the_recording_holds_every_kind_of_event() {
    let folder = tempfile::tempdir().expect("a folder");
    frame(folder.path());
    let mut seen = std::collections::BTreeSet::new();
    for (method, more) in [("centroid", None), ("inverse-depth", Some("0.5"))] {
        let record = format!("{method}.rrd");
        let mut arguments = vec![
            "mesh",
            "polyhedron",
            "frame.pgm",
            "--camera",
            CAMERA,
            "--reduce",
            method,
            "--vertices",
            "30",
            "--ladder",
            "200,100,20",
            "--record",
            &record,
            "--json",
        ];
        if let Some(bound) = more {
            arguments.extend(["--conservative", bound]);
        }
        let told = json(&driftlab(folder.path(), &arguments));
        let held = json(&driftlab(folder.path(), &["inspect", &record, "--json"]));
        assert_eq!(held["metrics"]["volume_m3"], told["volume_m3"]);
        for event in held["events"].as_array().expect("a list") {
            seen.insert(event["variant"].as_str().expect("a name").to_owned());
        }
    }
    let declared: std::collections::BTreeSet<String> =
        instrument::DEPTH_EVENTS.iter().map(ToString::to_string).collect();
    assert_eq!(seen, declared);
}

#[test]
fn bad_input_gets_one_message_and_leaves_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    frame(folder.path());
    std::fs::write(folder.path().join("short.pgm"), b"P5 80 60 65535\nshort").expect("writable");
    std::fs::write(folder.path().join("what.txt"), b"hello").expect("writable");
    for (arguments, words) in [
        (vec!["missing.png"], "missing.png"),
        (vec!["short.pgm"], "byte 15: found 5 bytes"),
        (vec!["what.txt"], "no known kind of depth image"),
        (vec!["frame.pgm", "--crop", "30"], "80 x 60 pixels, of which 30 are cropped"),
        (vec!["frame.pgm", "--vertices", "3"], "vertices is 3"),
        (vec!["frame.pgm", "--far", "0"], "far_m is 0"),
        (vec!["frame.pgm", "--camera", "0,1,2,3"], "fx 0"),
        (vec!["frame.pgm", "--depth-scale", "0"], "a scale of 0"),
    ] {
        let mut all = vec!["mesh", "polyhedron"];
        all.extend(&arguments);
        all.extend(["-o", "out.ply", "-q"]);
        let output = driftlab(folder.path(), &all);
        let text = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {text}");
        assert!(text.contains(words), "{arguments:?}: {text}");
        assert!(output.stdout.is_empty());
        assert!(!folder.path().join("out.ply").exists());
    }
}

/// A config of a small room.
const ROOM: &str = "name = \"small\"\n[depth]\ncrop = 2\n[room]\ncolumns = 64\nrows = 48\n[ladder]\n\
                    methods = [\"centroid\", \"inverse-depth\"]\nvertices = [200, 50, 12]\n";

#[test]
fn a_ladder_shows_every_method_at_every_number() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("room.toml"), ROOM).expect("writable");
    let told = json(&driftlab(folder.path(), &["mesh", "ladder", "room.toml", "--json"]));
    let rungs: Vec<(String, u64)> = told["rungs"]
        .as_array()
        .expect("a list")
        .iter()
        .map(|rung| {
            let method = rung["method"].as_str().expect("a name").to_owned();
            (method, rung["vertices"].as_u64().expect("a count"))
        })
        .collect();
    let expected = ["centroid", "inverse-depth"]
        .iter()
        .flat_map(|method| [200, 50, 12].map(|count| ((*method).to_owned(), count)));
    assert_eq!(rungs, expected.collect::<Vec<_>>());
    let held = json(&driftlab(folder.path(), &["inspect", "recordings/small.rrd", "--json"]));
    assert_eq!(held["metrics"]["rungs"], told["rungs"]);
    let paths: Vec<&str> = held["entities"]
        .as_array()
        .expect("a list")
        .iter()
        .filter_map(|entity| entity["path"].as_str())
        .collect();
    for method in ["centroid", "inverse_depth"] {
        for path in ["view/{}/surface/obstacle", "plots/p95_m/{}", "image/{}/edges"] {
            let path = path.replace("{}", method);
            assert!(paths.iter().any(|p| p.trim_start_matches('/') == path), "{path} {paths:?}");
        }
    }
    // Any image of the user's, too.
    frame(folder.path());
    let arguments = [
        "mesh",
        "ladder",
        "room.toml",
        "frame.pgm",
        "--camera",
        CAMERA,
        "--record",
        "a.rrd",
        "--json",
    ];
    assert_eq!(json(&driftlab(folder.path(), &arguments))["file"], "frame.pgm");
    // What is there is not replaced, and what is wrong leaves nothing.
    for (text, arguments, words) in [
        (ROOM, vec!["--record", "a.rrd"], "a.rrd: the file exists already"),
        (ROOM, vec!["what.png", "--record", "b.rrd"], "what.png"),
        (&ROOM.replace("crop = 2", "crop = 30"), vec!["--record", "b.rrd"], "30 are cropped"),
        (&ROOM.replace("centroid", "middle"), vec!["--record", "b.rrd"], "room.toml:8:11"),
    ] {
        std::fs::write(folder.path().join("room.toml"), text).expect("writable");
        let mut all = vec!["mesh", "ladder", "room.toml", "-q"];
        all.extend(&arguments);
        let output = driftlab(folder.path(), &all);
        let text = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {text}");
        assert!(text.contains(words), "{arguments:?}: {text}");
        assert!(!folder.path().join("b.rrd").exists());
    }
}
