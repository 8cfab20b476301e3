//! `driftlab mesh polyhedron`, as a user meets it.

mod desk;

use desk::{Desk, code, json, stderr};

/// A wall at 2 m, a box at 1.5 m, and a hole without readings, in millimetres.
fn framed() -> Desk {
    let desk = Desk::new("");
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
    std::fs::write(desk.path("frame.pgm"), bytes).expect("writable");
    desk
}

const CAMERA: &str = "70,70,39.5,29.5";

const METHODS: [&str; 5] =
    ["centroid", "least-squares", "least-squares-vertical", "quadric", "inverse-depth"];

/// What the command says of the frame with some options.
fn polyhedron(desk: &Desk, options: &[&str]) -> serde_json::Value {
    let mut arguments = vec!["mesh", "polyhedron", "frame.pgm", "--camera", CAMERA, "--json"];
    arguments.extend(options);
    json(&desk.driftlab(&arguments))
}

#[test]
fn a_depth_image_becomes_a_valid_polyhedron() {
    let desk = framed();
    for method in METHODS {
        let out = format!("{method}.ply");
        let told = polyhedron(&desk, &["--reduce", method, "--vertices", "60", "-o", &out]);
        assert_eq!(told["output"], out);
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
            "secs_check",
            "secs_measure",
        ] {
            assert!(told[key].is_number(), "{method} {key}");
        }
        assert!(told["mesh_vertices"].as_u64().expect("a count") <= 60);
        let info = json(&desk.driftlab(&["mesh", "info", &out, "--json"]));
        for key in ["vertices", "faces", "obstacle_faces", "frontier_faces", "closed"] {
            assert_eq!(info[key], told[key], "{method} {key}");
        }
    }
}

#[test]
fn a_bound_on_the_error_and_on_what_lies_outside_hold() {
    let desk = framed();
    let bounded = polyhedron(&desk, &["--error", "0.01"]);
    assert!(bounded["max_m"].as_f64().expect("a distance") <= 0.0101);
    for method in METHODS {
        for bound in ["0", "0.02"] {
            let options = ["--reduce", method, "--vertices", "40", "--conservative", bound];
            let outside_m = polyhedron(&desk, &options)["outside_max_m"].as_f64();
            let bound_m: f64 = bound.parse().expect("a number");
            assert!(outside_m.expect("a distance") <= bound_m + 1e-9, "{method}: {outside_m:?}");
        }
    }
}

#[test]
fn the_recording_holds_every_kind_of_event() {
    let desk = framed();
    let mut seen = std::collections::BTreeSet::new();
    for (method, more) in [("centroid", None), ("inverse-depth", Some("0.5"))] {
        let record = format!("{method}.rrd");
        let mut options = vec!["--reduce", method, "--vertices", "30", "--ladder", "200,100,20"];
        options.extend(["--record", &record]);
        if let Some(bound) = more {
            options.extend(["--conservative", bound]);
        }
        let told = polyhedron(&desk, &options);
        let held = json(&desk.driftlab(&["inspect", &record, "--json"]));
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
    let desk = framed();
    desk.put("short.pgm", "P5 80 60 65535\nshort");
    desk.put("what.txt", "hello");
    std::fs::write(desk.path("photo.png"), PHOTO).expect("writable");
    for (arguments, words) in [
        (vec!["photo.png"], "a PNG image of RGB, 8 bits, expected grey of 16 bits"),
        (vec!["frame.pgm", "--error", "inf"], "--error: found inf, expected a distance above 0 m"),
        (vec!["frame.pgm", "--error", "0"], "--error: found 0, expected a distance above 0 m"),
        (vec!["frame.pgm", "--far", "1e300"], "--far: found 1.00000e300, expected"),
        (vec!["frame.pgm", "--vertices", "99999999999"], "at most 2^28"),
        (vec!["frame.pgm", "--vertices", "9", "--ladder", "20,0"], "--ladder: found 0"),
        (
            vec!["frame.pgm", "--vertices", "9", "--conservative", "inf"],
            "--conservative: found inf",
        ),
        (vec!["frame.pgm", "--vertices", "9", "--conservative", "-1"], "--conservative: found -1"),
        (
            vec!["frame.pgm", "--depth-scale", "1e300"],
            "--depth-scale: found a scale of 1.00000e300",
        ),
        (vec!["frame.pgm", "--size", "0,4"], "--size: found 0,4"),
        (vec!["frame.pgm", "--record", "nowhere/a.rrd"], "the folder nowhere does not exist"),
        (vec!["missing.png"], "missing.png"),
        (vec!["short.pgm"], "byte 15: found 5 bytes"),
        (vec!["what.txt"], "no known kind of depth image"),
        (vec!["frame.pgm", "--crop", "30"], "80 x 60 pixels, of which 30 are cropped"),
        (vec!["frame.pgm", "--crop", "18446744073709551615"], "are cropped on each side"),
        (vec!["frame.pgm", "--vertices", "3"], "--vertices: found 3"),
        (vec!["frame.pgm", "--error", "-1"], "--error: found -1"),
        (vec!["frame.pgm", "--far", "0"], "--far: found 0"),
        (vec!["frame.pgm", "--conservative", "0.1"], "--vertices <N>|--error <M>"),
        (vec!["frame.pgm", "--reduce", "magic", "--vertices", "9"], "'magic'"),
        (vec!["frame.pgm", "--camera", "0,1,2,3"], "fx 0"),
        (vec!["frame.pgm", "--depth-scale", "0"], "a scale of 0"),
    ] {
        let mut all = vec!["mesh", "polyhedron"];
        all.extend(&arguments);
        all.extend(["-o", "out.ply", "-q"]);
        let output = desk.driftlab(&all);
        let text = stderr(&output);
        assert_eq!(code(&output), 2, "{arguments:?}: {text}");
        assert!(text.contains(words), "{arguments:?}: {text}");
        assert!(output.stdout.is_empty());
        assert!(!desk.path("out.ply").exists());
    }
}

/// A picture of one pixel.
const PHOTO: &[u8] = b"\x89PNG\x0d\x0a\x1a\x0a\x00\x00\x00\x0dIHDR\x00\x00\x00\x01\x00\x00\x00\x01\x08\x02\x00\x00\x00\x90wS\xde\x00\x00\x00\x0cIDATx\x9cc`db\x06\x00\x00\x0e\x00\x07\xd7o\xe4x\x00\x00\x00\x00IEND\xaeB`\x82";

#[test]
fn what_was_typed_is_checked_before_anything_else() {
    let desk = framed();
    for (arguments, words) in [
        (vec!["frame.pgm", "--error", "inf"], "--error"),
        (vec!["frame.pgm", "--crop", "40"], "40 are cropped"),
        (vec!["missing.png", "--error", "0"], "--error"),
        (vec!["missing.png", "-o", "nowhere/out.ply"], "the folder nowhere does not exist"),
    ] {
        let mut all = vec!["mesh", "polyhedron"];
        all.extend(&arguments);
        let output = desk.driftlab(&all);
        let text = stderr(&output);
        assert_eq!(code(&output), 2, "{arguments:?}: {text}");
        assert!(text.contains(words) && !text.contains("warning"), "{arguments:?}: {text}");
        assert_eq!(text.lines().count(), 1, "{text}");
    }
    assert!(!desk.path("nowhere").exists());
}

#[test]
fn a_line_of_pixels_is_a_polyhedron() {
    let desk = framed();
    let floats: Vec<u8> =
        [1.0_f32, 2.0, f32::NAN, 3.0].into_iter().flat_map(f32::to_le_bytes).collect();
    std::fs::write(desk.path("line.raw"), floats).expect("writable");
    for size in ["4,1", "1,4"] {
        let line = ["mesh", "polyhedron", "line.raw", "--camera", "4,4,2,0", "--size", size];
        let output = desk.driftlab(&line);
        assert!(stderr(&output).contains("as wide as its pixels"), "{}", stderr(&output));
        let told = json(&desk.driftlab(&[&line[..], &["--json"]].concat()));
        assert_eq!((&told["closed"], &told["manifold"]), (&true.into(), &true.into()));
        assert_eq!(told["self_intersecting"], false);
        assert!(told["volume_m3"].as_f64().expect("a volume") > 0.0);
        assert_eq!(told["mesh_vertices"], 8);
    }
}

#[test]
fn a_made_up_room_is_an_image_like_others() {
    let desk = Desk::new("");
    let room = ["mesh", "room", "--size", "64,48", "--json"];
    let told = json(&desk.driftlab(&[&room[..], &["-o", "a.png"]].concat()));
    let camera = told["camera"].as_str().expect("numbers").to_owned();
    json(&desk.driftlab(&[&room[..], &["-o", "a.pgm"]].concat()));
    let view = |file: &str| {
        let line = ["mesh", "polyhedron", file, "--camera", &camera, "--vertices", "60", "--json"];
        let mut told = json(&desk.driftlab(&line));
        assert_eq!((&told["closed"], &told["self_intersecting"]), (&true.into(), &false.into()));
        told["p95_m"].take()
    };
    assert_eq!(view("a.png"), view("a.pgm"));
    assert!(view("a.png").as_f64().expect("metres") < 0.1);
    for (line, words) in [
        (&["-o", "a.png"][..], "exists already"),
        (&["-o", "a.tiff"], "expected .png or .pgm"),
        (&["-o", "b.png", "--size", "1,48"], "--size: found 1,48"),
    ] {
        let output = desk.driftlab(&[&["mesh", "room"], line].concat());
        assert_eq!(code(&output), 2);
        assert!(stderr(&output).contains(words), "{}", stderr(&output));
    }
}

#[test]
fn a_recording_takes_the_place_of_nothing_else() {
    let desk = framed();
    desk.put("room.toml", ROOM);
    let frame = std::fs::read(desk.path("frame.pgm")).expect("readable");
    for line in [
        &["polyhedron", "frame.pgm", "-o", "s.ply", "--record", "./s.ply"][..],
        &["polyhedron", "frame.pgm", "--record", "frame.pgm", "--force"],
        &["ladder", "room.toml", "frame.pgm", "--record", "frame.pgm", "--force"],
        &["ladder", "room.toml", "--record", "room.toml", "--force"],
    ] {
        let output = desk.driftlab(&[&["mesh"], line].concat());
        assert_eq!(code(&output), 2, "{line:?}");
        assert!(stderr(&output).contains("expected two files"), "{}", stderr(&output));
    }
    assert_eq!(std::fs::read(desk.path("frame.pgm")).expect("readable"), frame);
    assert_eq!(std::fs::read(desk.path("room.toml")).expect("readable"), ROOM.as_bytes());
    assert!(!desk.path("s.ply").exists());
}

#[test]
fn options_that_would_do_nothing_are_refused() {
    let desk = framed();
    desk.put("room.toml", ROOM);
    for (line, words) in [
        (&["ladder", "room.toml", "--camera", "1,1,0,0"][..], "DEPTH"),
        (&["polyhedron", "frame.pgm", "--size", "8,6"], "--size: found 8,6"),
    ] {
        let output = desk.driftlab(&[&["mesh"], line].concat());
        assert_eq!(code(&output), 2, "{line:?}");
        assert!(stderr(&output).contains(words), "{}", stderr(&output));
    }
}

#[test]
fn the_whole_grid_is_shown_and_measured_too() {
    let desk = framed();
    desk.put("room.toml", &ROOM.replace("[200, 50, 12]", "[]"));
    let told = json(&desk.driftlab(&["mesh", "ladder", "room.toml", "--json"]));
    assert_eq!(told["rungs"][0]["vertices"], 60 * 44);
    assert!(told["rungs"][0]["p95_m"].as_f64().expect("metres") < 1e-6);
    let held = json(&desk.driftlab(&["inspect", "recordings/small.rrd", "--json"]));
    let paths = held["entities"].as_array().expect("a list");
    let surface = "view/centroid/surface/obstacle";
    let at = |entity: &serde_json::Value| entity["path"].as_str().unwrap_or("").ends_with(surface);
    assert!(paths.iter().any(at), "{paths:?}");
}

/// A config of a small room.
const ROOM: &str = "name = \"small\"\n[depth]\ncrop = 2\n[room]\ncolumns = 64\nrows = 48\n[ladder]\n\
                    methods = [\"centroid\", \"inverse-depth\"]\nvertices = [200, 50, 12]\n";

#[test]
fn a_ladder_shows_every_method_at_every_number() {
    let desk = framed();
    desk.put("room.toml", ROOM);
    let told = json(&desk.driftlab(&["mesh", "ladder", "room.toml", "--json"]));
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
    let held = json(&desk.driftlab(&["inspect", "recordings/small.rrd", "--json"]));
    assert_eq!(held["metrics"]["rungs"], told["rungs"]);
    // A viewer opens at the first time: there must be meshes to look at.
    let timelines = held["timelines"].as_array().expect("a list");
    let vertices = timelines.iter().find(|timeline| timeline["name"] == "vertices");
    assert_eq!(vertices.expect("the timeline")["first"], 12);
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
    assert_eq!(json(&desk.driftlab(&arguments))["file"], "frame.pgm");
    // What is there is not replaced, and what is wrong leaves nothing.
    for (text, arguments, words) in [
        (ROOM, vec!["--record", "a.rrd"], "a.rrd: the file exists already"),
        (ROOM, vec!["what.png", "--record", "b.rrd"], "what.png"),
        (&ROOM.replace("crop = 2", "crop = 30"), vec!["--record", "b.rrd"], "30 are cropped"),
        (&ROOM.replace("centroid", "middle"), vec!["--record", "b.rrd"], "room.toml:8:11"),
        (&ROOM.replace("200", "99999999999"), vec!["--record", "b.rrd"], "room.toml:9:"),
        (&ROOM.replace("inverse-depth", "centroid"), vec!["--record", "b.rrd"], "twice"),
        (&ROOM.replace("small", "a\\u0000"), vec!["--record", "b.rrd"], "room.toml:1:"),
    ] {
        desk.put("room.toml", text);
        let mut all = vec!["mesh", "ladder", "room.toml", "-q"];
        all.extend(&arguments);
        let output = desk.driftlab(&all);
        let text = stderr(&output);
        assert_eq!(code(&output), 2, "{arguments:?}: {text}");
        assert!(text.contains(words), "{arguments:?}: {text}");
        assert!(!desk.path("b.rrd").exists());
    }
}
