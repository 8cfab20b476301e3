//! What may be chosen, who listens, and what must not depend on it.

use std::collections::BTreeSet;
use std::sync::Arc;

use explore::{
    Ending, ExploreParams, Explorer, GraphEvent, PlannerEvent, Policy, RapidParams, State,
};
use maps2d::ExplorationMap;
use maps2d::grid::{GridMap, GridParams};
use probe::Off;
use worlds::{DriveParams, SimRobot, World2d, paper, thesis};

use super::ending::{Drawn, Run, drift, explore, relative};
use super::sketch::{Sketch, Spot, play};

fn rooms() -> Arc<World2d> {
    Drawn::Rooms { columns: 2, rows: 2, seed: 3 }.world()
}

#[test]
fn whoever_listens_each_step_is_the_same_bit_for_bit() {
    let world = rooms();
    let heard = explore(&world, relative(), drift(1.0), ExploreParams::default(), 5);
    assert!(heard.heard.volumes > 0 && heard.heard.consolidations > 0);

    let mut robot = SimRobot::new(world, drift(1.0), 5);
    let mut explorer = Explorer::new(relative(), ExploreParams::default());
    for report in &heard.reports {
        let unheard = explorer.step(&mut robot, &mut Off);
        assert_eq!(format!("{unheard:?}"), format!("{report:?}"));
    }
    assert_eq!(format!("{:?}", robot.tally()), format!("{:?}", heard.robot.tally()));
}

#[test]
fn the_same_seed_gives_the_same_run_and_another_another() {
    let run = |seed| explore(&rooms(), relative(), drift(1.0), ExploreParams::default(), seed);
    let bits = |run: &Run| format!("{:?}", run.reports);
    assert_eq!(bits(&run(5)), bits(&run(5)));
    assert_ne!(bits(&run(5)), bits(&run(6)));
}

#[test]
fn a_map_that_rides_along_changes_nothing() {
    let alone = explore(&rooms(), relative(), drift(1.0), ExploreParams::default(), 5);
    let mut maps = relative();
    maps.push(Box::new(GridMap::new(GridParams::default())));
    let both = explore(&rooms(), maps, drift(1.0), ExploreParams::default(), 5);
    assert_eq!(both.reports, alone.reports);
    let grid: &dyn ExplorationMap = both.explorer.maps()[1].as_ref();
    assert_eq!(grid.kind(), "grid");
    assert!(grid.bytes() > 0);
}

#[test]
fn teleporting_completes_and_makes_each_way_one_step() {
    let run = |teleport| {
        let policy = Policy::Rapid(RapidParams { teleport, ..RapidParams::default() });
        let params = ExploreParams { policy, ..ExploreParams::default() };
        explore(&Arc::new(paper::maze()), relative(), drift(1.0), params, 1)
    };
    let on_ways = |run: &Run| run.reports.iter().filter(|r| r.state == State::Deliberate).count();
    let (jumping, driving) = (run(true), run(false));
    for run in [&jumping, &driving] {
        assert_eq!(run.ending(), Some(Ending::Complete));
        assert_eq!(run.robot.tally().collisions, 0);
        assert!(run.heard.legs > run.heard.routes, "some ways have several legs");
        assert!(run.explorer.backtracking_share() > 0.0, "ways are charged");
        assert_eq!(run.explorer.scans() + 1, run.explorer.steps(), "all steps scan but the last");
    }
    assert_eq!(on_ways(&jumping), jumping.heard.routes);
    assert!(on_ways(&driving) > driving.heard.routes);
}

#[test]
fn snapping_to_near_vertices_completes_with_fewer_of_them() {
    let run = |snap_radius_m| {
        let drive = DriveParams { snap_radius_m, ..DriveParams::default() };
        let robot = worlds::RobotParams { drive, ..drift(1.0) };
        explore(&Arc::new(thesis::first()), relative(), robot, ExploreParams::default(), 1)
    };
    let (snapped, free) = (run(Some(0.5)), run(None));
    for run in [&snapped, &free] {
        assert_eq!(run.ending(), Some(Ending::Complete));
        assert_eq!(run.robot.tally().collisions, 0);
    }
    let per_move =
        |run: &Run| run.explorer.graph().vertex_count() as f64 / run.robot.tally().forwards as f64;
    assert!(per_move(&free) > 1.0, "each move founds a vertex, and the start is one");
    assert!(per_move(&snapped) < 1.0, "some moves end on a known one");
}

#[test]
fn every_event_of_the_policy_is_told() {
    let world = Arc::new(paper::forest_house());
    let run = explore(&world, relative(), drift(1.0), ExploreParams::default(), 1);
    let mut walled_in = Sketch::new(vec![Spot::new(2.0, 0.0)]);
    walled_in.clearance = |_, _| 0.0;
    let given_up = play(walled_in, RapidParams::default());
    let told: BTreeSet<_> = run.heard.planner.union(&given_up.heard.planner).copied().collect();
    assert_eq!(told, PlannerEvent::VARIANTS.iter().copied().collect());
    // The loop itself never takes an edge back.
    let graph = GraphEvent::VARIANTS.iter().filter(|variant| **variant != "EdgeWithdrawn");
    for variant in graph {
        assert!(run.heard.graph.contains(variant), "{variant}");
    }
}
