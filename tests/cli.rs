//! The command as a user meets it: results, messages, exit codes, and what is left on the disk.

mod desk;

use std::fs;
use std::path::PathBuf;

use desk::{Desk, code, json, root, stderr, stdout};
use serde_json::Value;

/// A run that takes well below a second: two robots in a small generated maze.
const SMALL: &str = r#"# A small maze.

name = "small"
seed = 3

[world.maze]
columns = 3
rows = 3

[map.relative]
[map.grid]

[record]
level = "summary"
"#;

/// The names under a map of `metrics.json` that scripts rely on.
const METRIC_NAMES: [&str; 17] = [
    "believed_complete",
    "coverage",
    "false_completion",
    "distance_m",
    "d_max_m",
    "d_exp_m",
    "steps",
    "scans",
    "place_edges",
    "collisions",
    "bumps",
    "min_clearance_m",
    "cells_total",
    "cells_reachable",
    "frontier_left_m",
    "frontier_ignored_m",
    "backtracking_share",
];

#[test]
fn a_run_leaves_its_folder_and_prints_its_result() {
    let desk = Desk::new(SMALL);
    let result = json(&desk.driftlab(&["run", "a.toml", "--json"]));
    assert_eq!(result["dir"], "recordings/small");
    let listing = desk.listing();
    let files: Vec<&str> =
        listing.iter().filter_map(|path| path.strip_prefix("recordings/small/")).collect();
    let expected =
        ["metrics.json", "provenance.toml", "run.rrd", "run.toml", "steps.parquet", "timing.json"];
    assert_eq!(files, expected);

    let read = |name: &str| fs::read_to_string(desk.path("recordings/small").join(name)).unwrap();
    let metrics: Value = serde_json::from_str(&read("metrics.json")).unwrap();
    let timing: Value = serde_json::from_str(&read("timing.json")).unwrap();
    assert_eq!((&result["metrics"], &result["timing"]), (&metrics, &timing));
    assert_eq!((&metrics["name"], &metrics["seed"]), (&"small".into(), &3.into()));
    for map in ["relative", "grid"] {
        let names = metrics["maps"][map].as_object().expect("one object per map");
        for name in METRIC_NAMES {
            assert!(names.contains_key(name), "metrics.json: maps.{map}.{name}");
        }
        for name in ["step_micros_median", "step_micros_p99", "map_bytes_peak", "wall_secs"] {
            assert!(timing["maps"][map][name].is_number(), "timing.json: maps.{map}.{name}");
        }
    }
    let provenance: toml::Table = read("provenance.toml").parse().unwrap();
    assert_eq!(provenance["seed"].as_integer(), Some(3));
    assert_eq!(provenance["inputs"][0]["path"].as_str(), Some("a.toml"));
    assert_eq!(provenance["inputs"][0]["bytes"].as_integer(), Some(SMALL.len() as i64));
    assert!(provenance["termination"]["relative"].is_str());
}

#[test]
fn the_table_is_the_result_and_messages_go_to_standard_error() {
    let desk = Desk::new(SMALL);
    let output = desk.driftlab(&["run", "a.toml", "--out", "here"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let text = stdout(&output);
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 3, "{text}");
    assert!(lines[0].starts_with("map ") && lines[0].contains("believed complete"), "{text}");
    assert!(lines[1].starts_with("relative ") && lines[2].starts_with("grid "), "{text}");
    assert!(stderr(&output).contains("driftlab view here/run.rrd"), "{}", stderr(&output));
    let quiet = desk.driftlab(&["run", "a.toml", "--out", "there", "-q"]);
    assert_eq!((stdout(&quiet), stderr(&quiet)), (String::new(), String::new()));
}

#[test]
fn the_resolved_config_of_a_run_gives_the_same_run() {
    let desk = Desk::new(SMALL);
    let sets = ["--set", "odometry.scale=0.5", "--set", "record.level=\"off\""];
    let mut args = vec!["run", "a.toml", "--json", "--out", "first"];
    args.extend(sets);
    let first = json(&desk.driftlab(&args));
    assert!(!desk.path("first/run.rrd").exists(), "record.level is off");
    let second = json(&desk.driftlab(&["run", "first/run.toml", "--json", "--out", "second"]));
    assert_eq!(first["metrics"], second["metrics"]);
    let read = |name: &str| fs::read(desk.path(name)).unwrap();
    assert_eq!(read("first/steps.parquet"), read("second/steps.parquet"));
    assert_eq!(read("first/run.toml"), read("second/run.toml"));
}

#[test]
fn two_runs_give_the_same_bytes_on_any_number_of_threads_and_at_any_level() {
    let desk = Desk::new(SMALL);
    let run = |out: &str, threads: &str, level: &str| {
        let level = format!("record.level=\"{level}\"");
        let args = ["run", "a.toml", "--out", out, "--set", &level];
        let env = [("RAYON_NUM_THREADS", threads), ("TOKIO_WORKER_THREADS", threads)];
        let output = desk.driftlab_with(&args, &env);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        let read = |name: &str| fs::read(desk.path(out).join(name)).unwrap();
        (read("metrics.json"), read("steps.parquet"))
    };
    let first = run("one", "1", "full");
    assert_eq!(first, run("two", "2", "full"));
    assert_eq!(first, run("eight", "8", "summary"));
    assert_eq!(first, run("off", "1", "off"));
    let other_seed = desk.driftlab(&["run", "a.toml", "--out", "seed", "--set", "seed=4"]);
    assert_eq!(code(&other_seed), 0);
    assert_ne!(first.1, fs::read(desk.path("seed/steps.parquet")).unwrap());
}

#[test]
fn a_map_that_drives_takes_the_others_along() {
    let desk = Desk::new(SMALL);
    let set = ["--set", "compare.drive=\"grid\"", "--set", "record.level=\"off\""];
    let result = json(&desk.driftlab(&[&["run", "a.toml", "--json"][..], &set].concat()));
    let maps = &result["metrics"]["maps"];
    assert_eq!(maps["grid"]["distance_m"], maps["relative"]["distance_m"]);
    assert_eq!(maps["grid"]["steps"], maps["relative"]["steps"]);
}

#[test]
fn a_run_that_is_killed_leaves_a_recording_that_opens() {
    use std::time::{Duration, Instant};
    let desk = Desk::new("[world.maze]\ncolumns = 60\nrows = 60\n[map.relative]\n");
    let mut run = std::process::Command::new(assert_cmd::cargo::cargo_bin("driftlab"))
        .current_dir(desk.folder.path())
        .args(["run", "a.toml", "--out", "r", "-q"])
        .spawn()
        .expect("it starts");
    let enough = || fs::metadata(desk.path("r/run.rrd")).is_ok_and(|file| file.len() > 300_000);
    let start = Instant::now();
    while !enough() && start.elapsed() < Duration::from_secs(8) {
        std::thread::sleep(Duration::from_millis(20));
    }
    assert!(run.try_wait().expect("it can be asked").is_none(), "it ended too early to be killed");
    run.kill().expect("it can be killed");
    run.wait().expect("it ends");
    assert_eq!(desk.listing(), ["a.toml", "r", "r/run.rrd"]);
    let result = json(&desk.driftlab(&["inspect", "r", "--json"]));
    assert_eq!((&result["metrics"], &result["has_layout"]), (&Value::Null, &true.into()));
    assert!(result["rows"].as_u64().is_some_and(|rows| rows > 100), "{}", result["rows"]);
}

#[test]
fn a_run_is_not_overwritten_without_force() {
    let desk = Desk::new(SMALL);
    let run = |more: &[&str]| {
        let fast = ["run", "a.toml", "--out", "r", "--set", "record.level=\"off\""];
        desk.driftlab(&[&fast[..], more].concat())
    };
    assert_eq!(code(&run(&[])), 0);
    let before = fs::read(desk.path("r/timing.json")).unwrap();
    let refused = run(&[]);
    assert_eq!(code(&refused), 2);
    assert!(stderr(&refused).contains("--force"), "{}", stderr(&refused));
    assert_eq!(before, fs::read(desk.path("r/timing.json")).unwrap());
    assert_eq!(code(&run(&["--force"])), 0);
    assert_ne!(before, fs::read(desk.path("r/timing.json")).unwrap());
}

#[test]
fn a_recording_goes_where_it_is_told() {
    let desk = Desk::new(SMALL);
    let run = |more: &[&str]| desk.driftlab(&[&["run", "a.toml", "--force"][..], more].concat());
    assert_eq!(code(&run(&["--record", "x.rrd"])), 0);
    assert!(desk.path("x.rrd").exists() && !desk.path("recordings/small/run.rrd").exists());
    let refused = desk.driftlab(&["run", "a.toml", "--out", "y", "--record", "x.rrd"]);
    assert_eq!(code(&refused), 2, "a recording is there already");
    let refused = run(&["--record", "none/x.rrd"]);
    assert_eq!(code(&refused), 2, "no such folder");
    let refused = run(&["--record", "z.rrd", "--set", "record.level=\"off\""]);
    assert_eq!(code(&refused), 2, "nothing would be recorded");
    assert!(!desk.path("y").exists());
}

#[test]
fn inspect_tells_what_a_run_recorded() {
    let desk = Desk::new(SMALL);
    let run = ["run", "a.toml", "--out", "r", "--set", "record.level=\"full\""];
    assert_eq!(code(&desk.driftlab(&run)), 0);
    let result = json(&desk.driftlab(&["inspect", "r", "--json"]));
    let metrics: Value =
        serde_json::from_slice(&fs::read(desk.path("r/metrics.json")).unwrap()).unwrap();
    assert_eq!(result["metrics"], metrics);
    assert_eq!(result["has_layout"], true);
    let names = |list: &str, key: &str| -> Vec<String> {
        let all = result[list].as_array().expect("a list");
        all.iter().map(|one| one[key].as_str().expect("a name").to_owned()).collect()
    };
    let timelines = names("timelines", "name");
    for name in ["step", "distance_mm", "sim_time", "event"] {
        assert!(timelines.contains(&name.to_owned()), "{timelines:?}");
    }
    for map in ["/relative", "/grid"] {
        assert!(names("entities", "path").iter().any(|path| path.starts_with(map)), "{map}");
        assert!(names("events", "map").contains(&map.to_owned()), "{map}");
    }
    let text = stdout(&desk.driftlab(&["inspect", "r/run.rrd"]));
    assert!(text.contains("distance_mm") && text.contains("believed_complete"), "{text}");
    let same = json(&desk.driftlab(&["inspect", "r", "--diff", "r", "--json"]));
    assert_eq!(same["differences"], Value::Array(Vec::new()));
    assert_eq!(same["first_difference"], Value::Null);
}

#[test]
fn two_recordings_are_told_apart() {
    let desk = Desk::new(SMALL);
    for (out, scale) in [("a", "odometry.scale=0.5"), ("b", "odometry.scale=1.0")] {
        assert_eq!(code(&desk.driftlab(&["run", "a.toml", "--out", out, "--set", scale])), 0);
    }
    let result = json(&desk.driftlab(&["inspect", "a", "--diff", "b", "--json"]));
    let all = result["differences"].as_array().expect("a list");
    let first = &result["first_difference"];
    assert!(all.contains(first), "{first}");
    assert_eq!(first["timeline"], "step");
    let steps = all.iter().filter(|one| one["timeline"] == "step");
    let least = steps.filter_map(|one| one["at"].as_i64()).min();
    assert!(least.is_some() && first["at"].as_i64() == least, "{first}");
    let metrics = |of: &str| -> Value {
        let text = fs::read(desk.path(of).join("metrics.json")).unwrap();
        serde_json::from_slice::<Value>(&text).unwrap()["maps"]["relative"]["distance_m"].clone()
    };
    let told = &result["metric_differences"]["relative.distance_m"];
    assert_eq!((&told["a"], &told["b"]), (&metrics("a"), &metrics("b")));
    let by = metrics("b").as_f64().zip(metrics("a").as_f64()).map(|(b, a)| b - a);
    assert_eq!(told["difference"].as_f64(), by);
    let text = stdout(&desk.driftlab(&["inspect", "a", "--diff", "b"]));
    assert!(text.starts_with("first difference at step "), "{text}");
    assert!(text.contains("relative.distance_m"), "{text}");
}

#[test]
fn every_bad_input_gets_one_message_and_leaves_nothing() {
    let desk = Desk::new("");
    desk.put("short.map", "type octile\nheight 2\nwidth 3\nmap\n@..\n..\n");
    desk.put("words.yaml", "image: floor.pgm\nresolution: small\norigin: [0, 0, 0]\n");
    let maps = "[map.relative]\n[map.grid]\n";
    let paper = format!("[world.paper]\nmap = \"maze\"\n{maps}");
    let cases: [(&str, String, &[&str]); 14] = [
        ("unknown key", format!("{paper}[sensor]\nrange = 5\n"), &[]),
        ("wrong type", format!("{paper}[sensor]\nrange_m = \"far\"\n"), &[]),
        ("impossible value", format!("{paper}[odometry]\nscale = -1\n"), &[]),
        ("two worlds", format!("{paper}[world.maze]\nrows = 3\n"), &[]),
        ("missing map file", format!("[world.moving_ai]\nfile = \"gone.map\"\n{maps}"), &[]),
        ("broken map file", format!("[world.moving_ai]\nfile = \"short.map\"\n{maps}"), &[]),
        ("broken yaml", format!("[world.map_server]\nyaml = \"words.yaml\"\n{maps}"), &[]),
        ("no TOML", "seed 3\n".into(), &[]),
        ("start in a wall", format!("[start]\nx_m = 0.5\n{paper}"), &[]),
        ("cells that make no grid", format!("{paper}[metrics]\ncell_m = 1e-6\n"), &[]),
        ("bad --set", paper.clone(), &["--set", "odometry.scale=\"much\""]),
        ("--world that is not there", paper.clone(), &["--world", "gone.pgm"]),
        ("--world that is no map", paper.clone(), &["--world", "a.toml"]),
        ("broken --world", paper, &["--world", "short.map"]),
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
    let missing = desk.driftlab(&["run", "none.toml"]);
    assert_eq!(code(&missing), 2);
    page.push_str(&format!("# missing config\n{}", stderr(&missing)));
    insta::with_settings!({ omit_expression => true }, { insta::assert_snapshot!(page) });
}

#[test]
fn a_folder_that_cannot_be_written_is_told_before_the_run() {
    let desk = Desk::new(SMALL);
    desk.put("file", "");
    for (out, reason) in [("file/r", "Not a directory"), ("file", "it is a file")] {
        let output = desk.driftlab(&["run", "a.toml", "--out", out]);
        assert_eq!(code(&output), 2, "{}", stderr(&output));
        let message = format!("error: {out}: cannot be written ({reason}");
        assert!(stderr(&output).starts_with(&message), "{}", stderr(&output));
        assert!(stderr(&output).trim_end().ends_with("expected a folder for the run"));
        assert_eq!(stderr(&output).lines().count(), 1, "{}", stderr(&output));
    }
    assert_eq!(desk.listing(), ["a.toml", "file"]);
}

#[test]
fn a_variant_that_the_command_line_replaces_is_told() {
    let desk = Desk::new(SMALL);
    let set = "world.paper.map=\"open\"";
    let output = desk.driftlab(&["config", "show", "a.toml", "--set", set]);
    let note = format!("note: --set {set}: world.paper replaces the config's world.maze\n");
    assert_eq!((code(&output), stderr(&output)), (0, note));
    let output = desk.driftlab(&["config", "show", "a.toml", "--set", "world.maze.rows=2"]);
    assert_eq!(stderr(&output), "");
}

#[test]
fn a_run_takes_as_many_steps_as_it_may() {
    let desk = Desk::new(SMALL);
    let sets = ["--set", "max_steps=5", "--set", "record.level=\"off\""];
    let result = json(&desk.driftlab(&[&["run", "a.toml", "--json"][..], &sets].concat()));
    for map in ["relative", "grid"] {
        let map = &result["metrics"]["maps"][map];
        assert_eq!((&map["steps"], &map["termination"]), (&5.into(), &"step_limit".into()));
    }
}

#[test]
fn map_files_are_explored_by_their_content() {
    let desk = Desk::new(SMALL);
    let row = "#...........#\n".replace('#', "@");
    let wall = format!("{}\n", "@".repeat(13));
    let map = format!("type octile\nheight 7\nwidth 13\nmap\n{wall}{}{wall}", row.repeat(5));
    desk.put("hall", &map);
    let result = json(&desk.driftlab(&["run", "a.toml", "--world", "hall", "--json"]));
    assert_eq!(result["metrics"]["maps"]["relative"]["cells_total"], 55);
    assert_eq!(result["metrics"]["maps"]["relative"]["coverage"], 1.0);
    let provenance = fs::read_to_string(desk.path("recordings/small/provenance.toml")).unwrap();
    assert!(provenance.contains("hall"), "{provenance}");
}

#[test]
fn config_shows_origins_defaults_and_schema() {
    let desk = Desk::new(SMALL);
    let shown = stdout(&desk.driftlab(&["config", "show", "a.toml", "--set", "sensor.rays=20"]));
    let line = |key: &str| shown.lines().find(|line| line.starts_with(key)).unwrap_or_default();
    assert!(line("seed").ends_with("# a.toml:4"), "{shown}");
    assert!(line("rays = 20").ends_with("# --set sensor.rays=20"), "{shown}");
    assert!(line("fov_deg").ends_with("# default"), "{shown}");
    let result = json(&desk.driftlab(&["config", "show", "a.toml", "--json"]));
    assert_eq!(result["config"]["world"]["maze"]["columns"], 3);
    assert_eq!(result["origins"]["world.maze.columns"], "a.toml:7");

    let page = |name: &str| fs::read_to_string(root().join("configs").join(name)).unwrap();
    let defaults = stdout(&desk.driftlab(&["config", "defaults"]));
    let hint = "write what the command prints into the file";
    assert_eq!(defaults, page("defaults.toml"), "configs/defaults.toml is old: {hint}");
    let schema = stdout(&desk.driftlab(&["config", "schema"]));
    assert_eq!(schema, page("schema.json"), "configs/schema.json is old: {hint}");
    let schema: Value = serde_json::from_str(&schema).unwrap();
    assert_eq!(json(&desk.driftlab(&["config", "schema", "--json"])), schema);
}

/// Every config of an experiment that the repository ships; those in `graph` are sweeps of graphs, those
/// in `depth` ladders of a depth image.
fn shipped() -> Vec<PathBuf> {
    let mut all = Vec::new();
    let mut folders = vec![root().join("configs")];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                let is_other = path.ends_with("graph") || path.ends_with("depth");
                folders.extend((!is_other).then_some(path));
            } else if path.extension().is_some_and(|extension| extension == "toml") {
                all.push(path);
            }
        }
    }
    all.sort();
    all
}

#[test]
fn every_shipped_config_is_good_and_says_what_it_shows() {
    let desk = Desk::new("");
    let configs = shipped();
    assert!(configs.len() >= 7, "{configs:?}");
    for path in configs {
        let name = path.to_string_lossy().into_owned();
        let output = desk.driftlab(&["config", "show", &name]);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        let text = fs::read_to_string(&path).unwrap();
        if path.file_name().is_some_and(|file| file == "defaults.toml") {
            continue;
        }
        let schema = text.lines().next().and_then(|line| line.strip_prefix("#:schema "));
        let schema = path.parent().unwrap().join(schema.expect("names the schema for editors"));
        assert!(schema.exists(), "{name}: {}", schema.display());
        assert!(
            text.lines().nth(2).is_some_and(|line| line.starts_with("# ")),
            "{name}: no header"
        );
        let table: toml::Table = text.parse().unwrap();
        let stem = path.file_stem().unwrap().to_string_lossy().into_owned();
        assert_eq!(table["name"].as_str(), Some(stem.as_str()), "{name}");
    }
}

#[test]
fn usage_is_told_with_exit_code_two() {
    let desk = Desk::new("");
    for args in [&["run"][..], &["fly"], &["run", "a.toml", "--colour"], &["view", "none.rrd"]] {
        let output = desk.driftlab(args);
        assert_eq!(code(&output), 2, "{args:?}");
        assert!(!stderr(&output).is_empty() && stdout(&output).is_empty(), "{args:?}");
    }
    for (text, reason) in [("", "it is empty"), ("short", "no message in its 5 bytes")] {
        desk.put("text.rrd", text);
        let output = desk.driftlab(&["inspect", "text.rrd"]);
        assert_eq!(code(&output), 2);
        assert!(stderr(&output).contains(reason), "{}", stderr(&output));
    }
    for args in [&["--help"][..], &["run", "--help"], &["--version"]] {
        let output = desk.driftlab(args);
        assert_eq!((code(&output), stderr(&output).as_str()), (0, ""), "{args:?}");
    }
    let scripts = json(&desk.driftlab(&["completions", "bash", "--json"]));
    assert!(scripts["script"].as_str().is_some_and(|script| script.contains("_driftlab")));
}

#[cfg(unix)]
#[test]
fn view_starts_the_viewer_or_says_how_to_get_it() {
    use std::os::unix::fs::PermissionsExt;
    let desk = Desk::new("");
    desk.put("a.rrd", "x");
    let none = desk.driftlab_with(&["view", "a.rrd"], &[("PATH", "/nowhere")]);
    assert_eq!(code(&none), 1);
    assert!(stderr(&none).contains("pip install rerun-sdk=="), "{}", stderr(&none));

    desk.put(
        "rerun",
        "#!/bin/sh\n[ \"$1\" = --version ] && echo 're 0.36.3 x' || echo \"$1\" > opened\n",
    );
    let mode = fs::Permissions::from_mode(0o755);
    fs::set_permissions(desk.path("rerun"), mode).unwrap();
    let path = desk.folder.path().to_string_lossy().into_owned();
    let started = desk.driftlab_with(&["view", "a.rrd"], &[("PATH", &path)]);
    assert_eq!((code(&started), stderr(&started).as_str()), (0, ""));
    assert_eq!(fs::read_to_string(desk.path("opened")).unwrap(), "a.rrd\n");
}
