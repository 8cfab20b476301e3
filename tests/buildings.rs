//! Floor plans that others drew, explored with the shipped config, where a folder of them is at hand.

use std::io::Write;
use std::path::{Path, PathBuf};

use driftlab::config::{Loaded, Overrides, world_kind_of_file};
use driftlab::run::{Experiment, drive};
use probe::Off;

/// A file below the folder `maps` of `$DRIFTLAB_DATA`, else of the test data beside the project.
fn floor_plan(name: &str) -> Option<PathBuf> {
    let folder = match std::env::var_os("DRIFTLAB_DATA") {
        Some(folder) => PathBuf::from(folder),
        None => Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data"),
    };
    let file = folder.join("maps").join(name);
    if file.is_file() {
        return Some(file);
    }
    // Said past the test harness, which would swallow it.
    let text = "SKIPPED: no such floor plan; DRIFTLAB_DATA names the test data's folder";
    writeln!(std::io::stderr(), "{text}: {}", file.display()).expect("stderr takes text");
    None
}

/// The shipped config with a maze of corridors of 1 m between walls of 1 m in place of its rooms.
fn narrow_maze(side: usize) -> String {
    let building = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../configs/maps/building.toml");
    let text = std::fs::read_to_string(building).expect("the shipped config");
    let rooms = "[world.rooms]\ncolumns = 4\nrows    = 3\n";
    assert!(text.contains(rooms), "the config names its rooms otherwise now");
    let maze =
        format!("[world.maze]\ncolumns = {side}\nrows = {side}\ncorridor_m = 1.0\nwall_m = 1.0\n");
    text.replace(rooms, &maze)
}

/// The robot sees past two corners of such a maze: frontier that it can reach only from elsewhere,
/// cut up by many volumes that look at it from nearly the same place.
#[test]
fn a_maze_of_narrow_corridors_is_complete_and_true() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("maze.toml");
    std::fs::write(&file, narrow_maze(6)).expect("a disk");
    let sets = vec!["odometry.scale=0.0".to_owned()];
    let loaded = Loaded::read(&file, &Overrides { sets, world: None }).expect("a config");
    let Experiment { config, place, coverage } = Experiment::prepare(&loaded).expect("a place");
    let runs = drive(&config, &place.world, &coverage, &["relative"], &mut Off, &mut |_| ());
    let run = runs.expect("nobody watches, so nobody fails").remove(0).metrics;
    assert!(run.believed_complete, "{run:?}");
    assert_eq!(run.coverage, 1.0, "{run:?}");
    assert_eq!(run.collisions, 0, "{run:?}");
}

/// Explores a floor plan without noise: nothing may be left, and nothing may be missed.
fn is_complete_and_true(name: &str, more_sets: &[&str]) {
    let Some(file) = floor_plan(name) else { return };
    let building = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../configs/maps/building.toml");
    let sets = [&["odometry.scale=0.0"], more_sets].concat();
    let sets = sets.into_iter().map(str::to_owned).collect();
    let kind = world_kind_of_file(&file).expect("a map");
    let overrides = Overrides { sets, world: Some((file, kind)) };
    let loaded = Loaded::read(&building, &overrides).expect("a config");
    let Experiment { config, place, coverage } = Experiment::prepare(&loaded).expect("a place");
    let runs = drive(&config, &place.world, &coverage, &["relative"], &mut Off, &mut |_| ());
    let run = runs.expect("nobody watches, so nobody fails").remove(0).metrics;
    assert!(run.believed_complete, "{name}: {run:?}");
    assert!(run.cells_reachable > 100, "{name}: {run:?}");
    assert_eq!(run.coverage, 1.0, "{name}: {run:?}");
    assert_eq!((run.collisions, run.bumps), (0, 0), "{name}: {run:?}");
    assert_eq!(run.frontier_left_m, 0.0, "{name}: {run:?}");
}

#[test]
fn rooms_of_a_simulator_are_complete_and_true() {
    is_complete_and_true("stage/simple_rooms.png", &[]);
}

#[test]
fn a_cave_is_complete_and_true() {
    is_complete_and_true("stage/cave.png", &[]);
}

#[test]
fn a_depot_is_complete_and_true_with_half_the_rays() {
    is_complete_and_true("nav2/depot.yaml", &["sensor.rays=90"]);
}

#[test]
#[ignore = "takes some 13 s in the dev profile"]
fn a_depot_is_complete_and_true() {
    is_complete_and_true("nav2/depot.yaml", &[]);
}

#[test]
fn a_house_is_complete_and_true() {
    is_complete_and_true("aws_house/map.yaml", &[]);
}
