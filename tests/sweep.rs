//! Sweeps through the command: killed, shared, merged, reported.

mod desk;

use std::fs;
use std::time::{Duration, Instant};

use desk::{Desk, code, json, stderr, stdout};

/// Twenty runs, each well below a second.
const SWEEP: &str = r#"# A small sweep.

name = "small"
seed = 3

[world.maze]
columns = 3
rows = 3

[map.relative]
[map.grid]

[sweep]
seeds = 5
axes = { "world.maze.loops" = [0.0, 0.5], "odometry.scale" = [0.0, 1] }
"#;

/// The tables that must not depend on how a sweep went.
const SAME: [&str; 2] = ["results.parquet", "curves.parquet"];

fn tables(desk: &Desk, folder: &str) -> [Vec<u8>; 2] {
    SAME.map(|name| fs::read(desk.path(folder).join(name)).expect("a table"))
}

fn lines(desk: &Desk, folder: &str) -> usize {
    let text = fs::read_to_string(desk.path(folder).join("journal.jsonl")).unwrap_or_default();
    text.matches('\n').count()
}

#[test]
fn a_sweep_that_is_killed_again_and_again_gives_the_same_bytes() {
    let desk = Desk::new(SWEEP);
    let whole = json(&desk.driftlab(&["sweep", "a.toml", "--out", "whole", "--csv", "--json"]));
    let rows = whole["rows"].as_array().expect("rows");
    assert_eq!(rows.len(), 40);
    let keys: Vec<&String> = rows[0].as_object().expect("a row").keys().take(5).collect();
    assert_eq!(keys, ["odometry.scale", "world.maze.loops", "seed", "map", "believed_complete"]);
    let labels = |at: usize| (rows[at]["odometry.scale"].clone(), rows[at]["seed"].clone());
    assert_eq!(labels(0), (0.0.into(), 3.into()));
    assert_eq!(labels(39), (1.into(), 7.into()));

    let mut killed = 0;
    for (until, more_millis) in [(1, 0), (4, 13), (8, 37), (13, 3), (17, 71)] {
        let mut sweep = std::process::Command::new(assert_cmd::cargo::cargo_bin("driftlab"))
            .current_dir(desk.folder.path())
            .args(["sweep", "a.toml", "--out", "killed", "--threads", "2", "-q"])
            .spawn()
            .expect("it starts");
        let start = Instant::now();
        while lines(&desk, "killed") < until && start.elapsed() < Duration::from_secs(8) {
            std::thread::sleep(Duration::from_millis(2));
        }
        std::thread::sleep(Duration::from_millis(more_millis));
        killed += usize::from(sweep.try_wait().expect("it can be asked").is_none());
        sweep.kill().expect("it can be killed");
        sweep.wait().expect("it ends");
    }
    assert!(killed >= 3, "only {killed} of 5 kills came before the end");
    let resumed = desk.driftlab(&["sweep", "a.toml", "--out", "killed"]);
    assert_eq!(code(&resumed), 0, "{}", stderr(&resumed));
    assert!(stderr(&resumed).contains("of 20 jobs were done before"), "{}", stderr(&resumed));
    assert_eq!(tables(&desk, "killed"), tables(&desk, "whole"));
    assert_eq!(lines(&desk, "killed"), 21, "a header, and each job once");

    let again = desk.driftlab(&["sweep", "a.toml", "--out", "killed"]);
    assert!(stderr(&again).contains("20 of 20 jobs were done before"), "{}", stderr(&again));
    assert_eq!(tables(&desk, "killed"), tables(&desk, "whole"));
}

#[test]
fn threads_and_shards_leave_no_trace() {
    let desk = Desk::new(SWEEP);
    let sweep = |more: &[&str]| desk.driftlab(&[&["sweep", "a.toml"][..], more].concat());
    for threads in ["1", "5"] {
        let output = sweep(&["--out", threads, "--threads", threads]);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
    }
    assert_eq!(tables(&desk, "1"), tables(&desk, "5"));

    let first = json(&sweep(&["--out", "s", "--shard", "2/3", "--json"]));
    assert_eq!(first["jobs_left"], 13);
    let early = sweep(&["--out", "s", "--merge"]);
    assert_eq!(code(&early), 1);
    assert!(stderr(&early).contains("13 of 20 jobs are not done"), "{}", stderr(&early));
    assert!(!desk.path("s/results.parquet").exists());
    assert_eq!(code(&sweep(&["--out", "s", "--shard", "1/3"])), 0);
    assert_eq!(code(&sweep(&["--out", "elsewhere", "--shard", "3/3"])), 0);
    let merged = sweep(&["--out", "s", "--merge", "elsewhere"]);
    assert_eq!(code(&merged), 0, "{}", stderr(&merged));
    assert_eq!(tables(&desk, "s"), tables(&desk, "1"));
}

#[test]
fn a_row_of_a_sweep_is_what_a_run_measures() {
    let desk = Desk::new(SWEEP);
    let sweep = json(&desk.driftlab(&["sweep", "a.toml", "--set", "sweep.seeds=1", "--json"]));
    let sets = ["seed=3", "world.maze.loops=0.5", "odometry.scale=1", "record.level=\"off\""];
    let sets: Vec<&str> = sets.iter().flat_map(|set| ["--set", set]).collect();
    let run =
        json(&desk.driftlab(&[&["run", "a.toml", "--out", "r", "--json"][..], &sets].concat()));
    let rows = sweep["rows"].as_array().expect("rows");
    assert_eq!(rows.len(), 8);
    for map in ["relative", "grid"] {
        let row = rows.iter().rev().find(|row| row["map"] == map).expect("a row of the map");
        for (name, value) in run["metrics"]["maps"][map].as_object().expect("numbers") {
            assert_eq!(&row[name], value, "{map} {name}");
        }
        assert!(row["step_micros_median"].is_number(), "{row}");
    }
}

#[test]
fn another_sweep_and_bad_axes_are_refused() {
    let desk = Desk::new(SWEEP);
    let few = ["--set", "sweep.seeds=1", "--out", "r"];
    let sweep = |more: &[&str]| desk.driftlab(&[&["sweep", "a.toml"][..], &few, more].concat());
    assert_eq!(code(&sweep(&[])), 0);
    let other = sweep(&["--set", "sensor.rays=20"]);
    assert_eq!(code(&other), 2);
    assert!(stderr(&other).contains("found the journal of another sweep"), "{}", stderr(&other));
    assert_eq!(code(&sweep(&["--set", "sensor.rays=20", "--force"])), 0);
    desk.put("none.toml", "[world.maze]\n[map.grid]\n");
    desk.put("bad.toml", &SWEEP.replace("[0.0, 1]", "[0.0, -1]"));
    desk.put("key.toml", &SWEEP.replace("odometry.scale", "odometry.noise"));
    for (config, message) in [
        ("none.toml", "none.toml: found no [sweep], expected"),
        ("bad.toml", "bad.toml:15:62: found -1.0 for `odometry.scale`, expected"),
        ("key.toml", "key.toml:15:62: found unknown key `odometry.noise`, expected"),
    ] {
        let output = desk.driftlab(&["sweep", config, "--out", "none"]);
        assert_eq!(code(&output), 2);
        assert!(stderr(&output).contains(message), "{}", stderr(&output));
        assert!(!desk.path("none").exists(), "{config}");
    }
    desk.put("file", "");
    let output = desk.driftlab(&["sweep", "a.toml", "--out", "file/r"]);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("cannot be written"), "{}", stderr(&output));
}

#[test]
fn graph_sweeps_are_resumed_too() {
    let desk = Desk::new(
        "[graph.outliers]\nfiles = [\"gone.g2o\", \"city.g2o\"]\n\
         methods = [\"none\", \"huber\"]\nshares = [0.3]\nseeds = 1\n",
    );
    let made = ["graph", "generate", "city", "--poses", "60", "-o", "city.g2o"];
    assert_eq!(code(&desk.driftlab(&made)), 0);
    let data = desk.folder.path().to_string_lossy().into_owned();
    let sweep = |more: &[&str]| {
        let args = [&["sweep", "a.toml"][..], more].concat();
        desk.driftlab_with(&args, &[("DRIFTLAB_DATA", &data)])
    };
    let first = sweep(&["--out", "r", "--shard", "1/2"]);
    assert_eq!(code(&first), 0, "{}", stderr(&first));
    assert!(stderr(&first).contains("warning: gone.g2o"), "{}", stderr(&first));
    let output = sweep(&["--out", "r", "--threads", "1"]);
    assert!(stderr(&output).contains("1 of 2 jobs were done before"), "{}", stderr(&output));
    assert!(stdout(&output).starts_with("| graph | method | 30 % wrong |"), "{}", stdout(&output));
    assert_eq!(code(&sweep(&["--out", "w"])), 0);
    let results = |folder: &str| fs::read(desk.path(folder).join("results.parquet")).expect("rows");
    assert_eq!(results("r"), results("w"));
}

#[test]
fn a_report_holds_tables_and_plots() {
    let desk = Desk::new(SWEEP);
    let few = ["--set", "sweep.seeds=2"];
    assert_eq!(code(&desk.driftlab(&[&["sweep", "a.toml", "--out", "s"][..], &few].concat())), 0);
    let run = ["run", "a.toml", "--out", "r", "--set", "record.level=\"off\""];
    assert_eq!(code(&desk.driftlab(&run)), 0);
    let told = json(&desk.driftlab(&["report", "s", "r", "--out", "rep", "--json"]));
    let groups = told["studies"][0]["groups"].as_array().expect("groups");
    assert_eq!(groups.len(), 8);
    assert_eq!((&groups[0]["runs"], &groups[0]["map"]), (&2.into(), &"relative".into()));
    assert_eq!(groups[0]["success"]["of"], 2);
    assert!(groups[0]["means"]["coverage"]["mean"].is_number(), "{}", groups[0]);
    assert_eq!(told["studies"][1]["groups"].as_array().map(Vec::len), Some(2));

    let page = fs::read_to_string(desk.path("rep/report.html")).expect("a page");
    let text = fs::read_to_string(desk.path("rep/report.md")).expect("a page");
    assert!(page.matches("<svg").count() >= 10, "{}", page.matches("<svg").count());
    assert!(page.contains("A small sweep."), "what the config says about itself");
    for plot in text.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
        assert!(desk.path("rep").join(plot).is_file(), "{plot}");
    }
    let again = desk.driftlab(&["report", "s", "--out", "rep"]);
    assert_eq!(code(&again), 2, "it is there already");
    let none = desk.driftlab(&["report", "rep", "--out", "other"]);
    assert_eq!(code(&none), 2);
    assert!(stderr(&none).contains("found no results, expected"), "{}", stderr(&none));
    assert!(!desk.path("other").exists());
}
