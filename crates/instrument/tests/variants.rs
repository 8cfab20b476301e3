//! Every variant that an algorithm declares shows up in a recording at level `full`.

mod support;

use std::collections::BTreeSet;

use explore::{GraphEvent, PlannerEvent};
use geometry::Point2;
use instrument::{Level, Recorder, Recording, declared_events, inspect};
use maps2d::active::Broken;
use maps2d::correction::{CorrectionEvent, CorrectionParams};
use maps2d::grid::{CorrectedGrid, GridMap, GridParams};
use maps2d::polygons::PolygonEvent;
use maps2d::relative::{RelativeMap, RelativeParams};
use maps2d::{ExplorationMap, Route, Standing};
use pose::Se2;
use posegraph::{EdgeKind, PoseGraph};
use probe::{Probe, VertexId};
use sensing::Scan;

/// A room's corner as seen from the middle of it: two walls, the rest open.
fn scan() -> Scan {
    let ranges_m = (0..16).map(|ray| if ray < 8 { 3.0 } else { f64::INFINITY }).collect();
    Scan::new(-1.0, 2.0 / 15.0, ranges_m, 5.0)
}

fn at(vertex: u32, heading_rad: f64) -> Standing {
    let vertex_from_body = Se2::from_angle(heading_rad);
    Standing { vertex: VertexId(vertex), vertex_from_body }
}

/// What ordinary runs do not meet: a place edge that turns out to be wrong.
fn withdraw_a_place(recorder: &mut Recorder) {
    let mut graph = PoseGraph::new();
    let mut map = RelativeMap::new(RelativeParams::default());
    for vertex in 0..12 {
        graph.add_vertex();
        let odom_from_vertex = Se2::new(f64::from(vertex), 0.0, 0.0);
        recorder.emit(GraphEvent::VertexAdded { vertex: VertexId(vertex), odom_from_vertex });
        if vertex > 0 {
            let step = Se2::new(1.0, 0.0, 0.0);
            let (a, b) = (VertexId(vertex - 1), VertexId(vertex));
            let edge = graph.add_edge(a, b, step, EdgeKind::Odometry).expect("an edge");
            map.edges_added(&graph, &[edge], recorder);
        }
        map.scanned(&at(vertex, 0.0), &scan(), recorder);
        map.scanned(&at(vertex, 0.5), &scan(), recorder);
    }
    let (a, b) = (VertexId(0), VertexId(11));
    let edge = graph.add_edge(a, b, Se2::new(0.3, 0.1, 0.2), EdgeKind::Place).expect("an edge");
    let a_from_b = graph.edge(edge).a_from_b;
    recorder.emit(GraphEvent::EdgeAdded { edge, kind: EdgeKind::Place, a, b, a_from_b });
    map.edges_added(&graph, &[edge], recorder);
    map.scanned(&at(11, 1.0), &scan(), recorder);
    graph.withdraw(edge).expect("a place edge");
    recorder.emit(GraphEvent::EdgeWithdrawn { edge });
    map.edge_withdrawn(&graph, edge, recorder);
    let mut grid = GridMap::new(GridParams::default());
    grid.scanned(&at(0, 0.0), &scan(), recorder);
    grid.poses_reestimated(&[Se2::new(0.5, 0.0, 0.1)], recorder);
    correct_a_grid(recorder);
    recorder.emit(PolygonEvent::Invalid { vertex: VertexId(0), why: Broken::Unpaired });
    recorder.emit(PolygonEvent::Followed { vertex: VertexId(0), found: 1 });
    recorder.emit(PolygonEvent::Untwisted { at: &[Point2::origin()], flipped: 1, removed: 0 });
    let standing = at(0, 0.0);
    let goal_in_body = Point2::new(1.0, 0.0);
    let why = explore::GiveUp::Blocked;
    recorder.emit(PlannerEvent::GoalGivenUp { standing, goal_in_body, why });
    let route = Route::Drive(vec![Point2::new(1.0, 0.0), Point2::new(1.0, 1.0)]);
    recorder.emit(PlannerEvent::RoutePlanned { standing, route: &route, length_m: 2.0 });
}

/// A correction that is taken, and one that cannot be.
fn correct_a_grid(recorder: &mut Recorder) {
    let mut graph = PoseGraph::new();
    let (a, b) = (graph.add_vertex(), graph.add_vertex());
    let mut map = CorrectedGrid::new(GridParams::default(), CorrectionParams::default());
    let kinds = [(EdgeKind::Odometry, 1.0), (EdgeKind::Place, 1.2)];
    let edges = kinds
        .map(|(kind, x_m)| graph.add_edge(a, b, Se2::new(x_m, 0.0, 0.0), kind).expect("an edge"));
    map.edges_added(&graph, &edges, recorder);
    map.scanned(&at(1, 0.0), &scan(), recorder);
    let no_graph = posegraph::FactorGraph2::default();
    let options = posegraph::Options::default();
    let report = posegraph::optimize(&no_graph, &[], &options).report;
    recorder.emit(CorrectionEvent::Refused { report: &report });
}

#[test]
fn every_declared_variant_is_in_a_full_recording() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.rrd");
    let world = worlds::paper::maze();
    let maps = ["relative", "grid", "corrected_polygons", "active_area", "extended", "script"];
    let options = support::options(&path, Level::Full, &maps, &world);
    let recording = Recording::create(options).expect("a new file");
    let world = std::sync::Arc::new(world);
    for kind in &maps[..5] {
        let mut recorder = recording.recorder(kind);
        support::explore(&mut recorder, kind, &world, 450);
    }
    let mut recorder = recording.recorder("script");
    withdraw_a_place(&mut recorder);
    recorder.send().expect("rows fit together");
    recording.finish(&serde_json::json!({ "steps": 450 })).expect("a disk");

    let found = inspect(&path).expect("readable");
    assert_eq!(found.damage, None);
    assert_eq!(found.metrics, Some(serde_json::json!({ "steps": 450 })));
    let recorded: BTreeSet<(&str, &str)> =
        found.events.iter().map(|e| (e.family.as_str(), e.variant.as_str())).collect();
    let declared: BTreeSet<(&str, &str)> = declared_events()
        .into_iter()
        .flat_map(|(family, variants)| variants.iter().map(move |v| (family.name(), *v)))
        .collect();
    let missing: Vec<_> = declared.difference(&recorded).collect();
    assert!(missing.is_empty(), "declared, but not recorded: {missing:?}");
    assert_eq!(recorded.difference(&declared).count(), 0);

    // `event` counts every event of a map once, and no two rows of text share a number.
    for (map, count) in [("/relative", 0), ("/grid", 0), ("/corrected_polygons", 0), ("/script", 0)]
    {
        let of_map: u64 = found.events.iter().filter(|e| e.map == map).map(|e| e.count).sum();
        assert!(of_map > count, "{map}");
    }
    let last = found.timelines.iter().find(|t| t.name == "event").map(|t| t.last);
    let most = ["/relative", "/grid", "/corrected_polygons", "/script"]
        .map(|map| found.events.iter().filter(|e| e.map == map).map(|e| e.count).sum::<u64>());
    assert_eq!(last, most.iter().max().map(|&count| count as i64));
}

/// The families in which a family-wise `every` leaves out what it should, and nothing else.
#[test]
fn families_are_thinned_on_their_own() {
    use instrument::{Every, Family};
    let folder = tempfile::tempdir().expect("a folder");
    let world = std::sync::Arc::new(worlds::paper::open());
    let count = |every: Every, name: &str| {
        let path = folder.path().join(name);
        let mut options = support::options(&path, Level::Full, &["relative"], &world);
        options.every = every;
        let recording = Recording::create(options).expect("a new file");
        let mut recorder = recording.recorder("relative");
        support::explore(&mut recorder, "relative", &world, 40);
        drop(recorder);
        recording.finish(&serde_json::json!({})).expect("a disk");
        let found = inspect(&path).expect("readable");
        let of = |family: &str| -> u64 {
            found.events.iter().filter(|e| e.family == family).map(|e| e.count).sum()
        };
        (of("sensing"), of("consolidation"), of("planner"))
    };
    let all = count(Every::STEP, "all.rrd");
    let thin = count(Every::STEP.with(Family::Sensing, 10), "thin.rrd");
    assert!(thin.0 * 5 < all.0, "{thin:?} of {all:?}");
    assert_eq!((thin.1, thin.2), (all.1, all.2));
    let thinner = count(Every::STEP.with(Family::Consolidation, 1000), "thinner.rrd");
    assert!(thinner.1 * 10 < all.1, "{thinner:?} of {all:?}");
    assert_eq!((thinner.0, thinner.2), (all.0, all.2));
}

/// Leaving out steps of any family leaves rows that fit together.
#[test]
fn any_family_may_be_thinned() {
    use instrument::{Every, Family};
    let folder = tempfile::tempdir().expect("a folder");
    let world = std::sync::Arc::new(worlds::paper::open());
    for family in Family::ALL {
        for level in [Level::Summary, Level::Full] {
            let path = folder.path().join("run.rrd");
            let maps = ["relative", "grid"];
            let mut options = support::options(&path, level, &maps, &world);
            options.every = Every::STEP.with(family, 7);
            let recording = Recording::create(options).expect("a new file");
            for kind in maps {
                let mut recorder = recording.recorder(kind);
                support::explore(&mut recorder, kind, &world, 16);
                recorder.send().expect("rows fit together");
            }
            recording.finish(&serde_json::json!({})).expect("a disk");
            assert_eq!(inspect(&path).expect("readable").damage, None);
        }
    }
}
