//! Runs in simulated places: each ends, complete and without a collision.

use std::sync::Arc;

use explore::{Ending, ExploreParams, Explorer, Policy, RapidParams, StepReport};
use maps2d::ExplorationMap;
use maps2d::grid::{GridMap, GridParams};
use maps2d::relative::{RelativeMap, RelativeParams};
use proptest::prelude::*;
use worlds::generate::{MazeParams, PillarsParams, RoomsParams, maze, pillars, rooms};
use worlds::{RobotParams, SimRobot, World2d};

use super::heard::Heard;

/// A small place that a generator draws.
#[derive(Clone, Copy, Debug)]
pub enum Drawn {
    Maze { columns: usize, rows: usize, seed: u64 },
    Rooms { columns: usize, rows: usize, seed: u64 },
    Pillars { count: usize, seed: u64 },
}

impl Drawn {
    pub fn world(self) -> Arc<World2d> {
        let world = match self {
            Self::Maze { columns, rows, seed } => {
                maze(&MazeParams { columns, rows, seed, loops: 0.1, ..MazeParams::default() })
            }
            Self::Rooms { columns, rows, seed } => {
                rooms(&RoomsParams { columns, rows, seed, ..RoomsParams::default() })
            }
            Self::Pillars { count, seed } => pillars(&PillarsParams {
                width_m: 14.0,
                height_m: 14.0,
                count,
                seed,
                ..PillarsParams::default()
            }),
        };
        Arc::new(world.expect("the parameters are sound"))
    }
}

fn places() -> impl Strategy<Value = Drawn> {
    prop_oneof![
        (1..4usize, 1..4usize, any::<u64>()).prop_map(|(columns, rows, seed)| Drawn::Maze {
            columns,
            rows,
            seed
        }),
        (1..3usize, 1..3usize, any::<u64>()).prop_map(|(columns, rows, seed)| Drawn::Rooms {
            columns,
            rows,
            seed
        }),
        (0..5usize, any::<u64>()).prop_map(|(count, seed)| Drawn::Pillars { count, seed }),
    ]
}

/// The paper's policy, or ours, which looks around first.
fn policy(survey: bool) -> Policy {
    match survey {
        false => Policy::Rapid(RapidParams::default()),
        true => Policy::Survey(RapidParams { look_first: true, ..RapidParams::default() }),
    }
}

pub fn drift(alpha: f64) -> RobotParams {
    let mut params = RobotParams::default();
    params.odometry.scale = alpha;
    params
}

pub fn relative() -> Vec<Box<dyn ExplorationMap + Send>> {
    vec![Box::new(RelativeMap::new(RelativeParams::default()))]
}

/// A run to its end: each step's report, the explorer, the robot.
pub struct Run {
    pub reports: Vec<StepReport>,
    pub explorer: Explorer,
    pub robot: SimRobot,
    pub heard: Heard,
}

impl Run {
    pub fn ending(&self) -> Option<Ending> {
        self.reports.last().and_then(|report| report.ending)
    }
}

pub fn explore(
    world: &Arc<World2d>,
    maps: Vec<Box<dyn ExplorationMap + Send>>,
    robot: RobotParams,
    params: ExploreParams,
    seed: u64,
) -> Run {
    let mut robot = SimRobot::new(Arc::clone(world), robot, seed);
    let mut explorer = Explorer::new(maps, params);
    let mut heard = Heard::default();
    let mut reports = Vec::new();
    loop {
        let report = explorer.step(&mut robot, &mut heard);
        reports.push(report);
        if report.ending.is_some() {
            return Run { reports, explorer, robot, heard };
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]

    #[test]
    fn every_run_ends_complete_without_a_collision(
        place in places(),
        alpha in prop_oneof![Just(0.0), Just(1.0), 0.0..1.0_f64],
        seed in any::<u64>(),
        survey in any::<bool>(),
    ) {
        let params = ExploreParams { policy: policy(survey), max_steps: 5_000 };
        let run = explore(&place.world(), relative(), drift(alpha), params, seed);
        prop_assert_eq!(run.ending(), Some(Ending::Complete));
        let frontier = run.explorer.report().frontier;
        prop_assert_eq!((frontier.open_m, frontier.places), (0.0, 0));
        prop_assert_eq!(run.robot.tally().collisions, 0);
        // The loop's own counts are those of the robot.
        prop_assert_eq!(run.explorer.scans(), run.robot.tally().scans);
        prop_assert_eq!(run.explorer.steps(), run.reports.len() as u64);
    }

    #[test]
    fn the_grid_without_drift_ends_complete(place in places(), survey in any::<bool>()) {
        let params = ExploreParams { policy: policy(survey), max_steps: 5_000 };
        let maps: Vec<Box<dyn ExplorationMap + Send>> =
            vec![Box::new(GridMap::new(GridParams::default()))];
        let run = explore(&place.world(), maps, drift(0.0), params, 1);
        prop_assert_eq!(run.ending(), Some(Ending::Complete));
        prop_assert_eq!(run.robot.tally().collisions, 0);
    }

    #[test]
    fn a_step_limit_ends_a_run_as_not_complete(
        place in places(),
        seed in any::<u64>(),
        share in 0.0..1.0_f64,
    ) {
        let world = place.world();
        let whole = explore(&world, relative(), drift(1.0), ExploreParams::default(), seed);
        // The last step only says that the run is over.
        let max_steps = 1 + (share * (whole.reports.len() - 2) as f64) as u64;
        let params = ExploreParams { max_steps, ..ExploreParams::default() };
        let cut = explore(&world, relative(), drift(1.0), params, seed);
        prop_assert_eq!(cut.ending(), Some(Ending::StepLimit));
        prop_assert_eq!(cut.reports.len() as u64, max_steps);
        let same = max_steps as usize - 1;
        prop_assert_eq!(&cut.reports[..same], &whole.reports[..same], "until then nothing differs");
    }
}

#[test]
fn after_the_end_nothing_happens_any_more() {
    let world = Drawn::Maze { columns: 2, rows: 1, seed: 1 }.world();
    let mut run = explore(&world, relative(), drift(1.0), ExploreParams::default(), 1);
    let (last, tally) = (run.explorer.report(), run.robot.tally().clone());
    assert_eq!(last.ending, Some(Ending::Complete));
    assert_eq!(run.explorer.step(&mut run.robot, &mut run.heard), last);
    assert_eq!(*run.robot.tally(), tally);
}

/// Looking around, the grid once sent the robot to and fro here for ever: each of two places made
/// the frontier by the other look better.
#[test]
fn two_rooms_in_which_the_grid_went_to_and_fro() {
    let place = Drawn::Rooms { columns: 2, rows: 1, seed: 6 };
    let params = ExploreParams { policy: policy(true), max_steps: 5_000 };
    let maps: Vec<Box<dyn ExplorationMap + Send>> =
        vec![Box::new(GridMap::new(GridParams::default()))];
    let run = explore(&place.world(), maps, drift(0.0), params, 1);
    assert_eq!(run.ending(), Some(Ending::Complete));
}
