//! `driftlab graph` as a user meets it: results, messages, exit codes, files.

use std::fs;
use std::path::PathBuf;
use std::process::Output;

use assert_cmd::Command;
use serde_json::Value;

/// A folder of its own.
struct Desk(tempfile::TempDir);

impl Desk {
    fn new() -> Self {
        Self(tempfile::tempdir().expect("a temporary folder"))
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn put(&self, name: &str, text: &str) {
        fs::write(self.path(name), text).expect("a file");
    }

    fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).expect("a text file")
    }

    fn graph(&self, args: &[&str]) -> Output {
        let mut command = Command::cargo_bin("driftlab").expect("the binary is built");
        command.current_dir(self.0.path()).arg("graph").args(args).output().expect("it starts")
    }

    fn json(&self, args: &[&str]) -> Value {
        let args: Vec<&str> = args.iter().copied().chain(["--json", "-q"]).collect();
        let output = self.graph(&args);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        assert_eq!(stderr(&output), "", "quiet");
        let text = stdout(&output);
        assert_eq!(text.trim_end().lines().count(), 1, "one object and nothing else: {text}");
        serde_json::from_str(&text).expect("JSON")
    }

    fn listing(&self) -> Vec<String> {
        let entries = fs::read_dir(self.0.path()).expect("a folder");
        let mut all: Vec<String> = entries
            .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
            .collect();
        all.sort();
        all
    }
}

fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).expect("UTF-8")
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).expect("UTF-8")
}

/// A square driven twice, with one closure; the second edge is a little wrong.
const SQUARE: &str = "\
VERTEX_SE2 0 0 0 0
VERTEX_SE2 1 1 0 1.57
VERTEX_SE2 2 1 1 3.14
VERTEX_SE2 3 0 1 -1.57
FIX 0
EDGE_SE2 0 1 1 0 1.5707963267948966 100 0 0 100 0 400
EDGE_SE2 1 2 1.1 0 1.5707963267948966 100 0 0 100 0 400
EDGE_SE2 2 3 1 0 1.5707963267948966 100 0 0 100 0 400
EDGE_SE2 3 0 1 0 1.5707963267948966 100 0 0 100 0 400
";

#[test]
fn a_square_is_optimised_and_written() {
    let desk = Desk::new();
    desk.put("square.g2o", SQUARE);
    let done = desk.json(&["optimize", "square.g2o", "-o", "out.g2o", "--init", "odometry"]);
    for key in [
        "poses",
        "edges",
        "chi2_initial",
        "chi2",
        "log_cost",
        "sesync_cost",
        "iterations",
        "termination",
        "secs_read",
        "secs_init",
        "cpu_secs_init",
        "secs_optimize",
        "cpu_secs_optimize",
        "rejected_edges",
        "certificate",
    ] {
        assert!(done.get(key).is_some(), "{key}");
    }
    assert_eq!((&done["poses"], &done["edges"]), (&4.into(), &4.into()));
    assert_eq!(done["converged"], true);
    // The gap of 0.1 m is shared by four edges, whose turns take part of it.
    let chi2 = done["chi2"].as_f64().expect("a number");
    assert!(0.1 < chi2 && chi2 < 0.25, "{chi2}");
    assert!(done["chi2_initial"].as_f64() > Some(0.9));
    // Where the start is chosen by trials, the optimisation is told apart from them.
    let chosen = desk.json(&["optimize", "square.g2o"]);
    assert!(chosen["secs_optimize"].as_f64() > Some(0.0), "{chosen}");
    // From its own output nothing is left to do.
    let again = desk.json(&["optimize", "out.g2o", "--init", "file"]);
    assert!((again["chi2_initial"].as_f64().expect("a number") - chi2).abs() < 1e-12);
    let text = desk.read("out.g2o");
    assert!(text.starts_with("VERTEX_SE2 0 0 0 0\nFIX 0\nVERTEX_SE2 1 "), "{text}");
    assert_eq!(text.lines().filter(|line| line.starts_with("EDGE_SE2")).count(), 4);

    let refused = desk.graph(&["optimize", "square.g2o", "-o", "out.g2o"]);
    assert_eq!(refused.status.code(), Some(2));
    let message = "error: out.g2o: the file exists already; --force replaces it\n";
    assert_eq!(stderr(&refused), message);
    assert_eq!(desk.read("out.g2o"), text);
    desk.json(&["optimize", "square.g2o", "-o", "out.g2o", "--force", "--solver", "lm"]);
    assert_eq!(desk.listing(), ["out.g2o", "square.g2o"]);
}

#[test]
fn every_solver_and_start_ends_at_the_same_cost() {
    let desk = Desk::new();
    desk.json(&["generate", "sphere", "--poses", "100", "-o", "a.g2o", "--noise-deg", "1"]);
    let mut costs = Vec::new();
    for solver in ["gn", "lm", "dogleg"] {
        for init in ["file", "odometry", "spanning-tree"] {
            let done = desk.json(&["optimize", "a.g2o", "--solver", solver, "--init", init]);
            assert_eq!(done["converged"], true, "{solver} {init}: {done}");
            costs.push(done["chi2"].as_f64().expect("a number"));
        }
    }
    for cost in &costs {
        assert!((cost / costs[0] - 1.0).abs() < 1e-6, "{costs:?}");
    }
}

#[test]
fn an_optimisation_is_recorded() {
    let desk = Desk::new();
    desk.json(&["generate", "manhattan", "--poses", "200", "-o", "a.g2o"]);
    let done = desk.json(&["optimize", "a.g2o", "--record", "a.rrd", "--solver", "lm"]);
    let plain = desk.json(&["optimize", "a.g2o", "--solver", "lm"]);
    assert_eq!(done["chi2"], plain["chi2"], "a probe changes nothing");
    let mut command = Command::cargo_bin("driftlab").expect("the binary is built");
    let output = command.current_dir(desk.0.path()).args(["inspect", "a.rrd", "--json"]).output();
    let held: Value = serde_json::from_str(&stdout(&output.expect("it starts"))).expect("JSON");
    assert_eq!((&held["damage"], &held["has_layout"]), (&Value::Null, &true.into()));
    assert_eq!(held["metrics"]["chi2"], done["chi2"]);
    let iterations = done["iterations"].as_u64().expect("a count");
    let timeline = &held["timelines"][0];
    assert_eq!(timeline["name"], "iteration");
    assert_eq!(
        (timeline["first"].as_u64(), timeline["last"].as_u64()),
        (Some(0), Some(iterations))
    );
    let entities = held["entities"].as_array().expect("a list");
    let rows = |path: &str| {
        let entity = entities.iter().find(|entity| entity["path"] == path);
        entity.map_or(0, |entity| entity["rows"].as_u64().expect("a count"))
    };
    for path in ["/graph/odometry", "/graph/closures", "/graph/poses", "/edges/histogram"] {
        assert_eq!(rows(path), iterations + 1, "{path}");
    }
    for path in ["/plots/log10_damping", "/plots/gain_ratio", "/plots/accepted"] {
        assert_eq!(rows(path), iterations, "{path}");
    }
    let events: Vec<_> = held["events"].as_array().expect("a list").iter().collect();
    let variants: Vec<_> = events.iter().map(|event| event["variant"].clone()).collect();
    assert_eq!(variants, ["Finished", "Iterated", "Started"]);
}

#[test]
fn info_counts() {
    let desk = Desk::new();
    let text = format!(
        "{SQUARE}EDGE_SE2 0 2 1 1 3.14 1 0 0 1 0 -1\nEDGE_SE2 7 8 1 0 0 1 0 0 1 0 1\nEQUIV 1 2\n"
    );
    desk.put("a.g2o", &text);
    let held = desk.json(&["info", "a.g2o"]);
    let expected = [
        ("poses", 6),
        ("poses_given", 4),
        ("fixed", 1),
        ("edges", 6),
        ("odometry_edges", 4),
        ("loop_closures", 2),
        ("parallel_edges", 0),
        ("components", 2),
        ("largest_component", 4),
        ("dimensions", 2),
        ("degrees_of_freedom", 6),
    ];
    for (key, value) in expected {
        assert_eq!(held[key], value, "{key}");
    }
    assert_eq!((&held["format"], &held["chi2"]), (&"g2o".into(), &Value::Null));
    assert_eq!(held["information"]["indefinite"], 1);
    assert_eq!(held["information"]["eigenvalue_max"], 400.0);
    assert_eq!(held["unknown_tags"][0]["tag"], "EQUIV");
    assert_eq!(held["warnings"].as_array().map(Vec::len), Some(2));
    let shown = desk.graph(&["info", "a.g2o"]);
    let page = format!("{}---\n{}", stdout(&shown), stderr(&shown));
    insta::with_settings!({ omit_expression => true }, { insta::assert_snapshot!(page) });
}

#[test]
fn formats_are_converted_into_each_other() {
    let desk = Desk::new();
    desk.json(&["generate", "manhattan", "--poses", "60", "-o", "a.g2o"]);
    desk.json(&["convert", "a.g2o", "b.graph"]);
    assert!(desk.read("b.graph").starts_with("VERTEX2 0 "));
    desk.json(&["convert", "b.graph", "c.txt", "--to", "g2o"]);
    let costs = ["a.g2o", "b.graph", "c.txt"].map(|file| {
        let held = desk.json(&["info", file]);
        held["chi2"].as_f64().expect("a cost")
    });
    assert!(costs.iter().all(|cost| (cost / costs[0] - 1.0).abs() < 1e-9), "{costs:?}");

    let done = desk.json(&["convert", "a.g2o", "a.tum"]);
    assert_eq!((&done["poses"], &done["lost"]), (&60.into(), &"the edges".into()));
    assert_eq!(desk.read("a.tum").lines().count(), 60);
    let done = desk.json(&["convert", "a.tum", "back.g2o"]);
    assert_eq!((&done["poses"], &done["lost"]), (&60.into(), &Value::Null));
    assert!(desk.read("back.g2o").starts_with("VERTEX_SE3:QUAT 0 "));
    let same = desk.json(&["compare", "a.g2o", "back.g2o"]);
    assert_eq!(same["matched"], 60);
    assert!(same["ate_rmse_m"].as_f64() < Some(1e-12));
}

#[test]
fn an_estimate_is_compared_with_the_truth() {
    let desk = Desk::new();
    let made = ["generate", "sphere", "--poses", "225", "-o", "a.g2o", "--truth", "truth.tum"];
    // The extension of each file tells its format.
    desk.json(&made);
    desk.json(&["optimize", "a.g2o", "-o", "b.g2o"]);
    let before = desk.json(&["compare", "truth.tum", "a.g2o"]);
    let after = desk.json(&["compare", "truth.tum", "b.g2o", "--delta", "5"]);
    let ate = |held: &Value| held["ate_rmse_m"].as_f64().expect("a number");
    assert!(ate(&after) < 0.3 * ate(&before), "{before} {after}");
    assert_eq!((&after["matched"], &after["delta"]), (&225.into(), &5.into()));
    assert_eq!(after["rpe"]["translation_m"]["count"], 220);
    let origin = desk.json(&["compare", "truth.tum", "b.g2o", "--align", "origin"]);
    assert!(ate(&origin) >= ate(&after));
    desk.put("square.g2o", SQUARE);
    let output = desk.graph(&["compare", "square.g2o", "b.g2o"]);
    let told = "warning: square.g2o is in 2D and b.g2o in 3D; poses of the plane are compared as at height 0\n";
    assert_eq!((output.status.code(), stderr(&output).as_str()), (Some(0), told));
}

#[test]
fn a_certificate_says_how_wide_its_gap_is_and_of_which_poses() {
    let desk = Desk::new();
    desk.put("square.g2o", SQUARE);
    let done = desk.json(&["optimize", "square.g2o", "--certify"]);
    let certificate = &done["certificate"];
    assert_eq!(certificate["verdict"], "globally_optimal");
    let number = |key: &str| certificate[key].as_f64().expect(key);
    assert_eq!(number("gap_relative"), number("gap") / number("sesync_cost"));
    assert!((0.0..1e-4).contains(&number("gap_relative")));
    // Of the square both costs have nearly the same solution.
    assert!((0.0..0.01).contains(&number("poses_apart_m")), "{certificate}");
    assert!((0.0..0.01).contains(&number("poses_apart_rad")), "{certificate}");
}

/// A ring of ten poses that closes once, with start values that wind twice around.
fn wound_ring() -> String {
    let turn = std::f64::consts::TAU / 10.0;
    let (mut x, mut y) = (0.0_f64, 0.0_f64);
    let mut text = String::new();
    for k in 0..10 {
        let angle = 2.0 * turn * f64::from(k);
        text += &format!("VERTEX_SE2 {k} {x} {y} {angle}\n");
        (x, y) = (x + angle.cos(), y + angle.sin());
    }
    for k in 0..10 {
        text += &format!("EDGE_SE2 {k} {} 1 0 {turn} 100 0 0 100 0 100\n", (k + 1) % 10);
    }
    text
}

#[test]
fn a_solution_that_winds_once_too_often_is_not_certified() {
    let desk = Desk::new();
    desk.put("ring.g2o", &wound_ring());
    let done = desk.json(&["optimize", "ring.g2o", "--init", "file", "--certify"]);
    assert!(done["chi2"].as_f64().expect("a cost") > 1.0, "{done}");
    assert_eq!(done["certificate"]["verdict"], "not_certified", "{done}");
    assert!(done["certificate"]["lower_chi2"].as_f64().expect("a cost") < 1e-6, "{done}");
    let right = desk.json(&["optimize", "ring.g2o", "--certify"]);
    assert!(right["chi2"].as_f64().expect("a cost") < 1e-6, "{right}");
    assert_eq!(right["certificate"]["verdict"], "globally_optimal", "{right}");
}

#[test]
fn bad_input_gets_one_message_and_leaves_nothing() {
    let desk = Desk::new();
    desk.put("square.g2o", SQUARE);
    desk.put("cut.g2o", &SQUARE[..SQUARE.len() - 12]);
    desk.put("edges.g2o", "EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n");
    desk.put("empty.g2o", "");
    desk.put("odd.g2o", "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 NaN 0 0\n");
    desk.put("far.tum", "1000.5 0 0 0 0 0 0 1\n");
    let before = desk.listing();
    let cases: [&[&str]; 14] = [
        &["info", "missing.g2o"],
        &["info", "cut.g2o"],
        &["info", "empty.g2o"],
        &["optimize", "odd.g2o", "-o", "out.g2o"],
        &["optimize", "square.g2o", "-o", "out.xyz"],
        &["optimize", "square.g2o", "-o", "square.g2o"],
        &["optimize", "square.g2o", "-o", "out.g2o", "--record", "out.g2o"],
        &["optimize", "far.tum"],
        &["compare", "square.g2o", "edges.g2o"],
        &["compare", "square.g2o", "far.tum"],
        &["convert", "edges.g2o", "out.tum"],
        &["convert", "square.g2o", "."],
        &["generate", "ring", "--poses", "1", "-o", "out.g2o"],
        &["generate", "ring", "--noise-m", "nan", "-o", "out.g2o"],
    ];
    let mut page = String::new();
    for args in cases {
        let output = desk.graph(args);
        assert_eq!(output.status.code(), Some(2), "{args:?}: {}", stderr(&output));
        assert_eq!(stdout(&output), "", "{args:?}");
        page.push_str(&format!("$ driftlab graph {}\n{}\n", args.join(" "), stderr(&output)));
    }
    assert_eq!(desk.listing(), before);
    insta::with_settings!({ omit_expression => true }, { insta::assert_snapshot!(page) });
}

#[test]
fn edges_that_are_rejected_count_nowhere() {
    let desk = Desk::new();
    desk.json(&["generate", "manhattan", "--poses", "100", "-o", "town.g2o"]);
    let clean = desk.json(&["optimize", "town.g2o", "--certify"]);
    let wrong = "EDGE_SE2 3 90 0.3 40 2 400 0 0 400 0 2500\n";
    desk.put("wrong.g2o", &(desk.read("town.g2o") + wrong));
    let done = desk.json(&["optimize", "wrong.g2o", "--robust", "gnc-tls", "--certify"]);
    assert_eq!(done["rejected_edges"].as_array().map(Vec::len), Some(1), "{done}");
    assert_eq!(done["certificate"]["verdict"], clean["certificate"]["verdict"]);
    for key in ["chi2", "log_cost", "sesync_cost"] {
        let (with, without) = (done[key].as_f64().unwrap(), clean[key].as_f64().unwrap());
        assert!((with - without).abs() <= 1e-3 * without, "{key}: {with} against {without}");
    }
}

#[test]
fn one_seed_one_file() {
    let desk = Desk::new();
    for shape in ["sphere", "torus", "lattice", "ring", "manhattan", "city"] {
        desk.json(&["generate", shape, "--poses", "64", "-o", "a.g2o", "--force"]);
        desk.json(&["generate", shape, "--poses", "64", "-o", "b.g2o", "--force"]);
        assert_eq!(desk.read("a.g2o"), desk.read("b.g2o"), "{shape}");
    }
}

#[test]
fn poses_that_are_no_numbers_are_not_written() {
    let desk = Desk::new();
    let long = "1e300 0 0 1e300 0 0 1e300 0 1";
    desk.put("huge.g2o", &format!("EDGE_SE2 0 1 {long}\nEDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n"));
    let output = desk.graph(&["optimize", "huge.g2o", "-o", "out.g2o"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(stderr(&output).contains("ended with not_finite"), "{}", stderr(&output));
    assert_eq!(desk.listing(), ["huge.g2o"]);
}

#[test]
fn what_no_edge_determines_stays_where_it_was() {
    let desk = Desk::new();
    desk.put("one.g2o", "VERTEX_SE2 7 1 2 3\n");
    let told = desk.json(&["optimize", "one.g2o", "-o", "out.g2o"]);
    assert_eq!(told["chi2"].to_string(), "0.0", "and not -0.0");
    assert_eq!(told["termination"], "nothing_to_do");
    assert_eq!(desk.read("out.g2o"), desk.read("one.g2o"));

    // Information of zero says nothing: an error says so, and the poses are written as they came.
    let free = "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 5 0 0\nEDGE_SE2 0 1 1 0 0 0 0 0 0 0 0\n";
    desk.put("free.g2o", free);
    let output = desk.graph(&["optimize", "free.g2o", "--init", "file", "-o", "free2.g2o"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(stderr(&output).contains("ended with singular"), "{}", stderr(&output));
    assert_eq!(desk.read("free2.g2o"), free);
}
