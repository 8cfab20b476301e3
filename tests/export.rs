//! What a run leaves for other programs, and what can be made of it again.

mod desk;

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use desk::{Desk, code, json, root, stderr};
use driftlab::config::{Loaded, Overrides};
use driftlab::export::{ExportFolder, Fed, refeed, tell};
use driftlab::run::{Experiment, Exporting, StepSeen, Watch, drive};
use explore::{GraphEvent, PlannerEvent};
use formats::log::{Content, ContentKind, Log, LogReader, ReadOptions};
use maps2d::ExplorationMap;
use maps2d::correction::CorrectionEvent;
use maps2d::grid::GridEvent;
use maps2d::polygons::PolygonEvent;
use maps2d::relative::{ConsolidationEvent, RelativeMap, VolumeState};
use maps2d::volume::VolumeEvent;
use metrics::Coverage;
use posegraph::PoseGraph;
use probe::{Off, Probe, VertexId};
use worlds::World2d;

fn read(path: &Path) -> Log {
    let bytes = fs::read(path).expect("the file is there");
    LogReader::new(&bytes[..], &ReadOptions::default()).expect("an MCAP file").into_log()
}

const MAZE: &str = r#"
schema = 1
name = "little"
max_steps = 40
[world.paper]
map = "maze"
[sensor]
fov_deg = 115.0
range_m = 5.0
rays = 16
[places]
radius_m = 5.0
[map.relative]
[planner.rapid]
[record]
level = "off"
"#;

/// Everything about the volumes of a map: geometry, labels with their reasons, what is retired.
fn told(volumes: &BTreeMap<VertexId, VolumeState>) -> Vec<String> {
    volumes.iter().map(|(vertex, state)| format!("{vertex} {state:?}")).collect()
}

fn volumes(map: &RelativeMap) -> BTreeMap<VertexId, VolumeState> {
    map.volumes().map(|(vertex, state)| (vertex, state.clone())).collect()
}

/// Keeps what the relative map of a run came to.
#[derive(Default)]
struct Listener {
    volumes: BTreeMap<VertexId, VolumeState>,
}

macro_rules! deaf {
    ($($event:ty),+) => {$(
        impl Probe<$event> for Listener {
            fn emit(&mut self, _event: $event) {}
        }
    )+};
}

deaf!(
    VolumeEvent<'_>,
    GridEvent<'_>,
    CorrectionEvent<'_>,
    PolygonEvent<'_>,
    GraphEvent,
    PlannerEvent<'_>
);

impl Probe<ConsolidationEvent<'_>> for Listener {
    fn emit(&mut self, event: ConsolidationEvent<'_>) {
        if let ConsolidationEvent::Settled { map, .. } = event {
            self.volumes = volumes(map);
        }
    }
}

impl Watch for Listener {
    type Error = driftlab::run::RunError;

    fn place(&mut self, _world: &World2d, _coverage: &Coverage) -> Result<(), Self::Error> {
        Ok(())
    }

    fn step_begins(&mut self, _step: u64, _distance_m: f64, _sim_time_secs: f64) {}

    fn step_ends(&mut self, _end: &StepSeen<'_>) -> Result<(), Self::Error> {
        Ok(())
    }
}

/// A run with all its drift, to its end, exported and read back, gives the same volumes and labels to the last
/// bit.
#[test]
fn an_exported_run_feeds_the_same_map_again() {
    let desk = Desk::new(MAZE);
    let sets = vec!["max_steps=20000".to_owned()];
    let overrides = Overrides { sets, world: None };
    let loaded = Loaded::read(&desk.path("a.toml"), &overrides).expect("a config");
    let Experiment { config, place, coverage } = Experiment::prepare(&loaded).expect("a place");
    let mut folder = ExportFolder::create(&desk.path("out")).expect("a folder");
    let exports = folder.robot("relative", config.edge_noise()).expect("a file");
    let kinds = ["relative"];
    let mut watch = Exporting::new(Listener::default(), Some(exports), &kinds);
    drive(&config, &place.world, &coverage, &kinds, &mut watch, &mut |_| ()).expect("a disk");
    let (run, exports) = watch.into_parts();
    folder.take(exports.expect("it was asked for")).expect("a disk");
    folder.finish().expect("a disk");

    let log = read(&desk.path("out/relative.mcap"));
    let mut map = RelativeMap::new(config.relative_params().expect("it is configured"));
    let mut graph = PoseGraph::new();
    let (mut places, mut decisions) = (0, 0);
    for fed in refeed(&log).expect("the log of a run") {
        match fed {
            Fed::Edges { vertex, edges } => {
                while graph.vertex_count() <= vertex.0 as usize {
                    graph.add_vertex();
                }
                places += edges.len().saturating_sub(1);
                let add = |edge: &posegraph::Edge| {
                    graph.add_edge(edge.a, edge.b, edge.a_from_b, edge.kind).expect("an edge")
                };
                let ids: Vec<_> = edges.iter().map(add).collect();
                map.edges_added(&graph, &ids, &mut Off);
            }
            Fed::Scan { standing, scan } => map.scanned(&standing, &scan, &mut Off),
            Fed::Decided { map: kind, decision } => {
                decisions += 1;
                tell(&mut map, &kind, &decision, &mut Off);
            }
        }
    }
    assert!(places > 0, "places were recognised on the way");
    assert!(decisions > 1, "goals were given up, and there was a last look");
    assert!(map.volumes().any(|(_, state)| state.ledgers.iter().any(|l| !l.closed().is_empty())));
    let (own, theirs) = (told(&volumes(&map)), told(&run.volumes));
    assert_eq!(own.len(), theirs.len());
    for (own, theirs) in own.iter().zip(&theirs) {
        assert_eq!(own, theirs);
    }
}

/// The same through the commands: what is left of the frontier, and where, is the same number.
#[test]
fn an_exported_run_is_replayed_to_the_same_frontier() {
    let desk = Desk::new(MAZE);
    // On the way there is frontier that counts, and goals were given up.
    for steps in [60, 400] {
        let set = format!("max_steps={steps}");
        let args = ["run", "a.toml", "--json", "--force", "--export", "out", "--set", &set];
        let run = json(&desk.driftlab(&args));
        let config =
            MAZE.replace("[world.paper]\nmap = \"maze\"", "[replay]").replace("max_steps = 40", "");
        desk.put("replay.toml", &config.replace("[planner.rapid]", ""));
        let args =
            ["replay", "out/relative.mcap", "replay.toml", "--json", "--force", "--out", "again"];
        let again = json(&desk.driftlab(&args));
        let (run, again) =
            (&run["metrics"]["maps"]["relative"], &again["metrics"]["maps"]["relative"]);
        for name in ["frontier_left_m", "frontier_ignored_m", "scans", "place_edges"] {
            assert!(run[name].is_number(), "{name}: {run}");
            assert_eq!(run[name], again[name], "{name} after {steps} steps");
        }
        assert!(run["frontier_left_m"].as_f64() > Some(0.0));
    }
}

/// A grid gives up by itself what no way leads to; its log has that, too.
#[test]
fn a_grid_that_is_done_is_done_again_in_its_replay() {
    let desk = Desk::new(&MAZE.replace("[map.relative]", "[map.grid]\ncell_m = 1.0"));
    let set = "max_steps=20000";
    let run = json(&desk.driftlab(&["run", "a.toml", "--json", "--export", "out", "--set", set]));
    let config = fs::read_to_string(desk.path("a.toml")).expect("a config");
    let config = config.replace("[world.paper]\nmap = \"maze\"", "[replay]");
    let config = config.replace("max_steps = 40", "").replace("[planner.rapid]", "");
    desk.put("replay.toml", &config);
    let args = ["replay", "out/grid.mcap", "replay.toml", "--json", "--out", "again"];
    let again = json(&desk.driftlab(&args));
    let (run, again) = (&run["metrics"]["maps"]["grid"], &again["metrics"]["maps"]["grid"]);
    assert_eq!(run["believed_complete"], true, "{run}");
    assert!(run["frontier_ignored_m"].as_f64() > Some(0.0), "{run}");
    for name in ["believed_complete", "frontier_left_m", "frontier_ignored_m", "scans"] {
        assert_eq!(run[name], again[name], "{name}");
    }
}

#[test]
fn each_robot_leaves_its_log_its_trajectories_and_its_graph() {
    let desk = Desk::new(&format!("{MAZE}[map.grid]\ncell_m = 1.0\n"));
    let args = ["run", "a.toml", "--out", "run", "--export", "out", "--json"];
    let told = json(&desk.driftlab(&args));
    let mut names: Vec<String> = fs::read_dir(desk.path("out"))
        .expect("a folder")
        .map(|entry| entry.expect("an entry").file_name().into_string().expect("UTF-8"))
        .collect();
    names.sort();
    let of =
        |kind: &str| ["g2o", "mcap", "odom.tum", "truth.tum"].map(|end| format!("{kind}.{end}"));
    assert_eq!(names, [of("grid"), of("relative")].concat());
    for kind in ["grid", "relative"] {
        let scans = told["metrics"]["maps"][kind]["scans"].as_u64().expect("a count");
        let info = json(&desk.driftlab(&["log", "info", &format!("out/{kind}.mcap"), "--json"]));
        let topics = info["topics"].as_array().expect("topics");
        for (name, schema) in [
            ("/scan", "sensor_msgs/msg/LaserScan"),
            ("/exact/scan", "foxglove.LaserScan"),
            ("/odom", "nav_msgs/msg/Odometry"),
            ("/graph/standing", "driftlab.Standing"),
        ] {
            let topic = topics.iter().find(|topic| topic["name"] == name).expect(name);
            assert_eq!((&topic["schema"], &topic["messages"]), (&schema.into(), &scans.into()));
        }
        let scene = topics.iter().filter(|topic| topic["schema"] == "foxglove.SceneUpdate").count();
        assert_eq!(scene, if kind == "relative" { 2 } else { 1 }, "a grid has no volumes");
        let odometry =
            fs::read_to_string(desk.path(&format!("out/{kind}.odom.tum"))).expect("text");
        assert_eq!(odometry.lines().count() as u64, scans);
        let stamps: Vec<f64> = odometry
            .lines()
            .map(|line| line.split(' ').next().expect("a stamp").parse().expect("a number"))
            .collect();
        assert!(stamps.is_sorted_by(|a, b| a < b), "no two poses at one time");
        let graph = json(&desk.driftlab(&["graph", "info", &format!("out/{kind}.g2o"), "--json"]));
        assert_eq!(graph["components"], 1);
        let compared =
            ["graph", "compare", &format!("out/{kind}.truth.tum"), &format!("out/{kind}.odom.tum")];
        assert_eq!(code(&desk.driftlab(&compared)), 0);
    }
    // The same run leaves the same bytes.
    let again = ["run", "a.toml", "--out", "run2", "--export", "out2", "-q"];
    assert_eq!(code(&desk.driftlab(&again)), 0);
    for name in names {
        let (one, two) = (desk.path("out").join(&name), desk.path("out2").join(&name));
        assert!(fs::read(one).expect("a file") == fs::read(two).expect("a file"), "{name}");
    }
}

#[test]
fn an_export_replaces_nothing_unless_forced_and_leaves_nothing_when_refused() {
    let desk = Desk::new(MAZE);
    let run = ["run", "a.toml", "-q", "--set", "max_steps=3", "--out", "run", "--export", "out"];
    assert_eq!(code(&desk.driftlab(&run)), 0);
    let before = desk.listing();
    let again = ["run", "a.toml", "-q", "--out", "other", "--export", "out"];
    let refused = desk.driftlab(&again);
    assert_eq!(code(&refused), 2);
    assert!(stderr(&refused).contains("relative.mcap: the file exists already"), "{refused:?}");
    let into_file = ["run", "a.toml", "-q", "--out", "other", "--export", "a.toml"];
    assert_eq!(code(&desk.driftlab(&into_file)), 2);
    assert_eq!(desk.listing(), before);
    assert_eq!(code(&desk.driftlab(&[&run[..], &["--force"]].concat())), 0);
    assert_eq!(desk.listing(), before);
}

/// The sample in the repository is what its page says.
#[test]
fn the_sample_is_small_and_whole() {
    let path = root().join("recordings/samples/maze.mcap");
    assert!(fs::metadata(&path).expect("the sample").len() < 2_000_000);
    let log = read(&path);
    assert_eq!((log.damage.as_ref(), &log.warnings[..]), (None, &[][..]));
    assert_eq!(log.topics_of(ContentKind::Scan).count(), 1);
    let fed = refeed(&log).expect("the log of a run");
    let scans = fed.iter().filter(|fed| matches!(fed, Fed::Scan { .. })).count();
    let edges = |message: &&formats::log::Message| matches!(message.content, Content::Edge(_));
    assert!(scans > 100 && log.messages.iter().filter(edges).count() > 100);
}
