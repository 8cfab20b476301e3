//! One flying robot's run: a map that steers, maps that ride along, and what came of each.

use std::time::{Duration, Instant};

use explore::{Ending, FlightExplorer, FlightGiveUp, FlightParams, FlightReport};
use maps3d::Map3d;
use metrics::FlightWitness;
use sensing::FlyingRobot;
use worlds::{FlyerParams, SimFlyer, World3d};

use super::maps::{Side, map_of};
use super::stages::{Stages, peak_memory};
use super::timed::TimedFlyer;
use super::{FlightExperiment, FlightMetrics, FlightRow, FlightSeen, FlightTiming, FlightWatch};
use crate::run::{
    AtWork, CorrectionTiming, RunError, TimedProbe, ending_name, quantile, state_name,
};

/// Memory is asked for every so many steps: the answer costs a walk over the map.
const MEMORY_EVERY: u64 = 32;

/// What came of one map.
#[derive(Clone, Debug, PartialEq)]
pub struct FlightRun {
    /// The name of the map.
    pub name: &'static str,
    /// What it believed, and what was true.
    pub metrics: FlightMetrics,
    /// What it cost.
    pub timing: FlightTiming,
    /// Its steps.
    pub rows: Vec<FlightRow>,
}

/// Flies one robot to its end; the first of `kinds` steers, the others ride along.
///
/// The same experiment and kinds give the same metrics and rows, whoever watches.
///
/// # Errors
/// Where the watcher cannot go on, or where a map or the robot cannot be made.
pub fn fly<W: FlightWatch>(
    experiment: &FlightExperiment,
    kinds: &[&'static str],
    watch: &mut W,
    on_step: &mut dyn FnMut(&FlightRow),
) -> Result<Vec<FlightRun>, RunError>
where
    RunError: From<W::Error>,
{
    let started = Instant::now();
    let FlightExperiment { config, place, coverage } = experiment;
    let robot = SimFlyer::new(place.world.clone(), FlyerParams::from(config), config.seed)?;
    let mut witness = FlightWitness::new(robot, coverage.clone());
    let at_work = AtWork::new(kinds.len());
    let stages: Vec<Stages> = kinds.iter().map(|_| Stages::default()).collect();
    let mut maps: Vec<Box<dyn Map3d + Send>> = Vec::new();
    for (kind, stages) in kinds.iter().zip(&stages) {
        if let Some(map) = map_of(config, kind)? {
            let index = maps.len();
            maps.push(Box::new(Side::new(map, index, &at_work, stages)));
        }
    }
    let mut explorer = FlightExplorer::new(maps, FlightParams::from(config));
    let mut riders: Vec<Rider> = kinds.iter().map(|&kind| Rider::new(kind)).collect();

    watch.maps(&at_work);
    watch.place(&place.world, coverage)?;
    let mut step = 0;
    let report = loop {
        watch.step_begins(step, witness.tally().distance_m);
        let (report, own, watching) = timed_step(&mut explorer, &mut witness, watch, &at_work);
        let newly_seen = witness.take_newly_seen();
        for (index, rider) in riders.iter_mut().enumerate() {
            let map = explorer.maps()[index].as_ref();
            rider.step(step, &explorer, &report, map, &witness);
            rider.costs.step_micros.push(own[index].as_secs_f64() * 1e6);
            rider.costs.look_micros.extend(micros(&at_work.take_looks(index)));
            let corrections = at_work.take_corrections(index);
            let noted = corrections.iter().map(|one| one.as_secs_f64());
            rider.costs.corrections.extend(noted.map(|secs| CorrectionTiming { step, secs }));
        }
        let rows: Vec<&FlightRow> = riders.iter().filter_map(|rider| rider.rows.last()).collect();
        let end = FlightSeen {
            explorer: &explorer,
            report: &report,
            witness: &witness,
            newly_seen: &newly_seen,
            rows: &rows,
        };
        let start = Instant::now();
        watch.step_ends(&end)?;
        let record_micros = (watching + start.elapsed()).as_secs_f64() * 1e6;
        rows.first().copied().into_iter().for_each(&mut *on_step);
        for rider in &mut riders {
            rider.costs.record_micros.push(record_micros);
        }
        step += 1;
        if report.ending.is_some() || !holds(&place.world, &witness) {
            break report;
        }
    };

    let wall_secs = started.elapsed().as_secs_f64();
    let mut runs = Vec::with_capacity(riders.len());
    for (index, (mut rider, map)) in riders.into_iter().zip(explorer.maps()).enumerate() {
        rider.costs.bytes_peak = rider.costs.bytes_peak.max(map.bytes() as u64);
        let metrics = rider.metrics(index == 0, &explorer, &report, map.as_ref(), &witness);
        let timing = rider.costs.timing(&stages[index], wall_secs);
        runs.push(FlightRun { name: rider.name, metrics, timing, rows: rider.rows });
    }
    Ok(runs)
}

/// Whether the robot is where the place is: through a hole in a mesh it gets out, and would never come to an end
/// of the empty space there.
fn holds(world: &World3d, witness: &FlightWitness) -> bool {
    let (low, high) = world.bounds();
    let at = witness.world_from_body().translation;
    (0..3).all(|axis| (low[axis]..=high[axis]).contains(&at[axis]))
}

fn micros(all: &[Duration]) -> impl Iterator<Item = f64> + '_ {
    all.iter().map(|one| one.as_secs_f64() * 1e6)
}

/// One step, the time of each map, the first with that of the policy, and the time of whoever watches.
fn timed_step<W: FlightWatch>(
    explorer: &mut FlightExplorer,
    witness: &mut FlightWitness,
    watch: &mut W,
    at_work: &AtWork,
) -> (FlightReport, Vec<Duration>, Duration) {
    let count = explorer.maps().len();
    let robot: &mut dyn FlyingRobot = witness;
    let mut robot = TimedFlyer::new(robot);
    let mut probe = TimedProbe::new(watch, at_work, count);
    let start = Instant::now();
    let report = explorer.step(&mut robot, &mut probe);
    let whole = start.elapsed().saturating_sub(robot.spent + probe.spent);
    let mut own: Vec<Duration> =
        (0..count).map(|map| at_work.take(map).saturating_sub(probe.spent_on[map])).collect();
    let of_others: Duration = own.iter().skip(1).sum();
    if let Some(first) = own.first_mut() {
        *first = whole.saturating_sub(of_others);
    }
    (report, own, probe.spent)
}

/// What one map cost so far.
#[derive(Default)]
struct Costs {
    step_micros: Vec<f64>,
    look_micros: Vec<f64>,
    record_micros: Vec<f64>,
    corrections: Vec<CorrectionTiming>,
    bytes_peak: u64,
}

impl Costs {
    fn timing(&self, stages: &Stages, wall_secs: f64) -> FlightTiming {
        FlightTiming {
            step_micros_median: quantile(&self.step_micros, 0.5),
            step_micros_p99: quantile(&self.step_micros, 0.99),
            look_micros_median: quantile(&self.look_micros, 0.5),
            look_micros_p99: quantile(&self.look_micros, 0.99),
            record_micros_median: quantile(&self.record_micros, 0.5),
            record_micros_p99: quantile(&self.record_micros, 0.99),
            correction_secs: self.corrections.iter().fold(0.0, |sum, one| sum + one.secs),
            corrections: self.corrections.clone(),
            map_bytes_peak: self.bytes_peak,
            map_bytes_per_look: self.bytes_peak as f64 / self.look_micros.len().max(1) as f64,
            stages: stages.timing(),
            peak_rss_bytes: peak_memory(),
            wall_secs,
        }
    }
}

/// One map of a flight, as its rows and sums grow.
struct Rider {
    name: &'static str,
    rows: Vec<FlightRow>,
    costs: Costs,
    /// Distance at which nothing was left to explore, while that is so.
    done_at_m: Option<f64>,
}

impl Rider {
    fn new(name: &'static str) -> Self {
        Self { name, rows: Vec::new(), costs: Costs::default(), done_at_m: None }
    }

    fn step(
        &mut self,
        step: u64,
        explorer: &FlightExplorer,
        report: &FlightReport,
        map: &dyn Map3d,
        witness: &FlightWitness,
    ) {
        let tally = witness.tally();
        let left = map.tally();
        if left.open_m2 > 0.0 {
            self.done_at_m = None;
        } else {
            self.done_at_m.get_or_insert(tally.distance_m);
        }
        if step.is_multiple_of(MEMORY_EVERY) {
            self.costs.bytes_peak = self.costs.bytes_peak.max(map.bytes() as u64);
        }
        self.rows.push(FlightRow {
            step,
            map: self.name.to_owned(),
            distance_m: tally.distance_m,
            state: state_name(report.state),
            world_from_body: witness.world_from_body(),
            odom_from_body: witness.robot().world().world_from_start() * report.odom_from_body,
            coverage: witness.coverage().fraction(),
            frontier_open_m2: left.open_m2,
            frontier_ignored_m2: left.sliver_m2 + left.given_up_m2,
            frontier_places: left.patches as u64,
            map_faces: left.faces as u64,
            map_volumes: left.volumes as u64,
            vertices: explorer.graph().vertex_count() as u64,
            place_edges: explorer.place_edges(),
            looks: explorer.looks(),
            collisions: tally.collisions,
            bumps: tally.bumps,
        });
    }

    fn metrics(
        &self,
        steers: bool,
        explorer: &FlightExplorer,
        report: &FlightReport,
        map: &dyn Map3d,
        witness: &FlightWitness,
    ) -> FlightMetrics {
        // The map that steers says when it is done; one that rides along believes so once it has
        // nothing left, however far the robot goes on.
        let believed_complete = match steers {
            true => report.ending == Some(Ending::Complete),
            false => self.done_at_m.is_some(),
        };
        let verdict = witness.verdict(believed_complete);
        let tally = witness.tally();
        let left = map.tally();
        let work = map.work();
        let world_from_odom = witness.robot().world().world_from_start() * report.odom_from_body;
        // What was given up, and why, is of the map that steers.
        let given_up = |why: FlightGiveUp| match steers {
            true => explorer.given_up_m2(why),
            false => (0.0, 0.0),
        };
        let seen_nowhere_m2 = given_up(FlightGiveUp::Unreachable).0;
        let unreachable_m2 =
            (seen_nowhere_m2 + given_up(FlightGiveUp::Hidden).0).min(left.given_up_m2);
        let (_, ignored_piece_m2) = given_up(FlightGiveUp::NothingNew);
        FlightMetrics {
            believed_complete: verdict.believed_complete,
            coverage: verdict.coverage,
            false_completion: verdict.false_completion,
            distance_m: verdict.distance_m,
            d_max_m: if steers { verdict.d_max_m } else { verdict.d_max_m.and(self.done_at_m) },
            d_exp_m: verdict.d_exp_m,
            no_frontier_m: match steers {
                true => verdict.believed_complete.then_some(verdict.distance_m),
                false => self.done_at_m,
            },
            steps: explorer.steps(),
            looks: explorer.looks(),
            refused_looks: explorer.refused_looks(),
            place_edges: explorer.place_edges(),
            collisions: tally.collisions,
            bumps: tally.bumps,
            min_clearance_m: tally.min_clearance_m,
            cells_total: verdict.cells_total as u64,
            cells_reachable: verdict.cells_reachable as u64,
            frontier_left_m2: left.open_m2,
            frontier_ignored_m2: left.sliver_m2 + (left.given_up_m2 - unreachable_m2).max(0.0),
            frontier_ignored_largest_m2: left.largest_sliver_m2.max(ignored_piece_m2),
            frontier_given_up_m2: left.given_up_m2,
            frontier_unreachable_m2: unreachable_m2,
            given_up: explorer.given_up(),
            backtracking_share: explorer.backtracking_share(),
            turning_rad: tally.turning_rad,
            vertices: explorer.graph().vertex_count() as u64,
            map_volumes: left.volumes as u64,
            map_faces: left.faces as u64,
            map_tetrahedra: (work.tetrahedra > 0).then_some(work.tetrahedra as u64),
            corrections: work.corrections,
            map_invalid: work.refused,
            paths: work.paths,
            paths_m: work.paths_m,
            path_shortening: (work.paths_m > 0.0).then(|| 1.0 - work.shortened_m / work.paths_m),
            odometry_error_m: (witness.world_from_body().translation - world_from_odom.translation)
                .norm(),
            termination: match holds(witness.robot().world(), witness) {
                true => ending_name(report.ending).to_owned(),
                false => "left_the_place".to_owned(),
            },
        }
    }
}
