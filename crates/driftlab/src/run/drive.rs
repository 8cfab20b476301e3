//! One robot's run: a map that steers, maps that ride along, and what came of each.

use std::sync::Arc;
use std::time::{Duration, Instant};

use explore::{Ending, ExploreParams, Explorer, State, StepReport};
use maps2d::ExplorationMap;
use metrics::{Accuracy, Coverage, Witness};
use pose::Se2;
use posegraph::EdgeKind;
use probe::VertexId;
use worlds::{RobotParams, SimRobot, World2d};

use super::AtWork;
use super::disagree::{CAUSES, Disagreement, disagreement};
use super::sides::{Side, Telling, TruePoses, map_of};
use super::timed::{TimedProbe, TimedRobot};
use super::{CorrectionTiming, MapMetrics, MapTiming, StepRow, StepSeen, Watch, quantile};
use crate::config::Config;
use crate::export::Feed;

/// Memory is asked for every so many steps: the answer costs a walk over the map.
const MEMORY_EVERY: u64 = 128;

/// What came of one map.
#[derive(Clone, Debug, PartialEq)]
pub struct MapRun {
    /// The name of the map.
    pub name: &'static str,
    /// What it believed, and what was true.
    pub metrics: MapMetrics,
    /// What it cost.
    pub timing: MapTiming,
    /// Its steps.
    pub rows: Vec<StepRow>,
    /// Where the maps of its robot first disagreed about a frontier, for each cause; the same for all
    /// of them.
    pub disagreements: Vec<Disagreement>,
}

/// Runs one robot to its end; the first of `kinds` steers, the others ride along.
///
/// The same config, place and kinds give the same metrics and rows, whoever watches.
///
/// # Errors
/// Where the watcher cannot go on.
pub fn drive<W: Watch>(
    config: &Config,
    world: &Arc<World2d>,
    coverage: &Coverage,
    kinds: &[&'static str],
    watch: &mut W,
    on_step: &mut dyn FnMut(&StepRow),
) -> Result<Vec<MapRun>, W::Error> {
    let started = Instant::now();
    let robot = SimRobot::new(Arc::clone(world), RobotParams::from(config), config.seed);
    let mut witness = Witness::new(robot, coverage.clone());
    let truth = TruePoses::default();
    let built = kinds.iter().filter_map(|kind| map_of(config, kind, &truth));
    let at_work = AtWork::new(kinds.len());
    let feed = Feed::new(watch.wants_feed());
    let maps = built.enumerate().map(|(index, map)| -> Box<dyn ExplorationMap + Send> {
        // All maps are fed the same.
        let feed = if index == 0 { feed.clone() } else { Feed::default() };
        Box::new(Side::new(map, index, &at_work, feed))
    });
    let mut explorer = Explorer::new(maps.collect(), ExploreParams::from(config));
    let mut riders: Vec<Rider> = kinds.iter().map(|&kind| Rider::new(kind)).collect();
    let mut costs = Costs::new(riders.len());

    let mut quarrels: Vec<Disagreement> = Vec::new();
    watch.maps(&at_work);
    watch.place(world, coverage)?;
    let mut step = 0;
    let report = loop {
        let before_m = witness.tally().distance_m;
        watch.step_begins(step, before_m, before_m);
        let mut robot = Telling { witness: &mut witness, truth: &truth };
        let (report, mut cost) = timed_step(&mut explorer, &mut robot, watch, &at_work);
        let newly_seen = witness.take_newly_seen();
        let fed = feed.take();
        for (rider, map) in riders.iter_mut().zip(explorer.maps()) {
            rider.step(step, &explorer, &report, map.as_ref(), &witness);
        }
        let told = quarrels.len();
        if kinds.len() > 1 && told < CAUSES {
            let maps = explorer.maps_mut();
            quarrels.extend(disagreement(step, &report, kinds, maps, &witness, &quarrels));
            // Asking is nobody's step.
            (0..kinds.len()).for_each(|map| _ = at_work.take(map));
        }
        let rows: Vec<&StepRow> = riders.iter().filter_map(|rider| rider.rows.last()).collect();
        let end = StepSeen {
            explorer: &explorer,
            report: &report,
            fed: &fed,
            witness: &witness,
            newly_seen: &newly_seen,
            rows: &rows,
            disagreement: quarrels.get(told),
        };
        let start = Instant::now();
        watch.step_ends(&end)?;
        cost.watching += start.elapsed();
        rows.first().copied().into_iter().for_each(&mut *on_step);
        costs.add(step, &cost);
        step += 1;
        if report.ending.is_some() {
            break report;
        }
    };

    let wall_secs = started.elapsed().as_secs_f64();
    let mut runs = Vec::with_capacity(riders.len());
    for (index, (mut rider, map)) in riders.into_iter().zip(explorer.maps()).enumerate() {
        rider.bytes_peak = rider.bytes_peak.max(map.bytes() as u64);
        let steers = index == 0;
        runs.push(MapRun {
            name: rider.name,
            metrics: rider.metrics(steers, &explorer, &report, map.as_ref(), &witness),
            timing: costs.timing(index, rider.bytes_peak, wall_secs),
            rows: rider.rows,
            disagreements: quarrels.clone(),
        });
    }
    Ok(runs)
}

/// One step, and what it cost.
fn timed_step<W: Watch>(
    explorer: &mut Explorer,
    robot: &mut dyn sensing::Robot,
    watch: &mut W,
    at_work: &AtWork,
) -> (StepReport, Cost) {
    let count = explorer.maps().len();
    let mut robot = TimedRobot::new(robot);
    let mut probe = TimedProbe::new(watch, at_work, count);
    let start = Instant::now();
    let report = explorer.step(&mut robot, &mut probe);
    let (simulating, watching) = (robot.spent, probe.spent);
    let whole = start.elapsed().saturating_sub(simulating + watching);
    let mut own: Vec<Duration> =
        (0..count).map(|map| at_work.take(map).saturating_sub(probe.spent_on[map])).collect();
    // What is nobody's is the policy's, which the first map keeps busy.
    let of_others: Duration = own.iter().skip(1).sum();
    if let Some(first) = own.first_mut() {
        *first = whole.saturating_sub(of_others);
    }
    let corrections = (0..count).map(|map| at_work.take_corrections(map)).collect();
    (report, Cost { own, corrections, watching })
}

/// The time of one step.
struct Cost {
    /// Of each map, and of the policy that the first of them steers.
    own: Vec<Duration>,
    /// Of the corrections of each map.
    corrections: Vec<Vec<Duration>>,
    /// Of whoever watches.
    watching: Duration,
}

/// The times of all steps, microseconds.
struct Costs {
    own: Vec<Vec<f64>>,
    corrections: Vec<Vec<CorrectionTiming>>,
    watching: Vec<f64>,
}

impl Costs {
    fn new(maps: usize) -> Self {
        Self {
            own: vec![Vec::new(); maps],
            corrections: vec![Vec::new(); maps],
            watching: Vec::new(),
        }
    }

    fn add(&mut self, step: u64, cost: &Cost) {
        for (all, own) in self.own.iter_mut().zip(&cost.own) {
            all.push(own.as_secs_f64() * 1e6);
        }
        for (all, own) in self.corrections.iter_mut().zip(&cost.corrections) {
            all.extend(own.iter().map(|one| CorrectionTiming { step, secs: one.as_secs_f64() }));
        }
        self.watching.push(cost.watching.as_secs_f64() * 1e6);
    }

    fn timing(&self, map: usize, map_bytes_peak: u64, wall_secs: f64) -> MapTiming {
        let corrections = &self.corrections[map];
        let micros: Vec<f64> = corrections.iter().map(|one| one.secs * 1e6).collect();
        let of_corrections = |q| (!micros.is_empty()).then(|| quantile(&micros, q));
        MapTiming {
            correction_micros_median: of_corrections(0.5),
            correction_micros_p99: of_corrections(0.99),
            correction_secs: corrections.iter().fold(0.0, |sum, one| sum + one.secs),
            corrections: corrections.clone(),
            step_micros_median: quantile(&self.own[map], 0.5),
            step_micros_p99: quantile(&self.own[map], 0.99),
            record_micros_median: quantile(&self.watching, 0.5),
            record_micros_p99: quantile(&self.watching, 0.99),
            map_bytes_peak,
            wall_secs,
        }
    }
}

/// One map of a run, as its rows and sums grow.
struct Rider {
    name: &'static str,
    rows: Vec<StepRow>,
    bytes_peak: u64,
    /// Distance at which nothing was left to explore, while that is so.
    done_at_m: Option<f64>,
}

impl Rider {
    fn new(name: &'static str) -> Self {
        Self { name, rows: Vec::new(), bytes_peak: 0, done_at_m: None }
    }

    fn step(
        &mut self,
        step: u64,
        explorer: &Explorer,
        report: &StepReport,
        map: &dyn ExplorationMap,
        witness: &Witness,
    ) {
        let tally = witness.tally();
        let frontier = map.frontier();
        if frontier.open_m > 0.0 {
            self.done_at_m = None;
        } else {
            self.done_at_m.get_or_insert(tally.distance_m);
        }
        if step.is_multiple_of(MEMORY_EVERY) {
            self.bytes_peak = self.bytes_peak.max(map.bytes() as u64);
        }
        self.rows.push(StepRow {
            step,
            map: self.name.to_owned(),
            distance_m: tally.distance_m,
            sim_time_secs: tally.distance_m,
            state: state_name(report.state),
            world_from_body: witness.world_from_body(),
            odom_from_body: witness.robot().world().world_from_start() * report.odom_from_body,
            coverage: witness.coverage().fraction(),
            frontier_open_m: frontier.open_m,
            frontier_ignored_m: frontier.ignored_m,
            frontier_places: frontier.places as u64,
            vertices: explorer.graph().vertex_count() as u64,
            place_edges: explorer.place_edges(),
            scans: tally.scans,
            collisions: tally.collisions,
            bumps: tally.bumps,
        });
    }

    fn metrics(
        &self,
        steers: bool,
        explorer: &Explorer,
        report: &StepReport,
        map: &dyn ExplorationMap,
        witness: &Witness,
    ) -> MapMetrics {
        // The map that steers says when it is done; one that rides along believes so once it has
        // nothing left, however far the robot goes on.
        let believed_complete = match steers {
            true => report.ending == Some(Ending::Complete),
            false => self.done_at_m.is_some(),
        };
        let verdict = witness.verdict(believed_complete);
        let done_at_m = if steers { verdict.d_max_m } else { verdict.d_max_m.and(self.done_at_m) };
        let tally = witness.tally();
        let frontier = map.frontier();
        let graph = explorer.graph();
        let place_edges = graph.edges().filter(|(_, edge)| edge.kind == EdgeKind::Place).count();
        debug_assert_eq!(place_edges as u64, explorer.place_edges(), "edges are counted twice");
        let robot = witness.robot();
        let truth: Vec<Se2> = (0..graph.vertex_count() as u32)
            .map_while(|vertex| robot.world_from_vertex(VertexId(vertex)))
            .collect();
        let accuracy = map
            .global()
            .map(|belief| Accuracy::of(robot.world(), witness.coverage(), &belief, &truth));
        MapMetrics {
            believed_complete: verdict.believed_complete,
            coverage: verdict.coverage,
            false_completion: verdict.false_completion,
            distance_m: verdict.distance_m,
            d_max_m: done_at_m,
            d_exp_m: verdict.d_exp_m,
            all_seen_m: self.rows.iter().find(|row| row.coverage >= 1.0).map(|row| row.distance_m),
            no_frontier_m: if steers {
                verdict.believed_complete.then_some(verdict.distance_m)
            } else {
                self.done_at_m
            },
            steps: explorer.steps(),
            scans: tally.scans,
            place_edges: place_edges as u64,
            collisions: tally.collisions,
            bumps: tally.bumps,
            min_clearance_m: tally.min_clearance_m,
            cells_total: verdict.cells_total as u64,
            cells_reachable: verdict.cells_reachable as u64,
            frontier_left_m: frontier.open_m,
            frontier_ignored_m: frontier.ignored_m,
            backtracking_share: explorer.backtracking_share(),
            turning_rad: tally.turning_rad,
            vertices: graph.vertex_count() as u64,
            corrections: map.corrections(),
            map_invalid: map.invalid(),
            free_iou: accuracy.map(|a| a.free_iou),
            wall_distance_m: accuracy.and_then(|a| a.wall_distance_m),
            ate_m: accuracy.and_then(|a| a.ate_m),
            termination: ending_name(report.ending).to_owned(),
        }
    }
}

/// The name of a state in tables.
pub(crate) fn state_name(state: State) -> &'static str {
    match state {
        State::Reactive => "reactive",
        State::Deliberate => "deliberate",
        State::Done => "done",
    }
}

/// How a run ended, in a word.
pub(crate) fn ending_name(ending: Option<Ending>) -> &'static str {
    match ending {
        Some(Ending::Complete) => "complete",
        Some(Ending::StepLimit) => "step_limit",
        Some(Ending::Stuck) => "stuck",
        None => "running",
    }
}
