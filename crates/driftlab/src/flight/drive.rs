//! One flying robot's run: a map that steers, maps that ride along, and what came of each.

use std::time::{Duration, Instant};

use explore::{FlightExplorer, FlightParams, FlightReport};
use maps3d::Map3d;
use metrics::FlightWitness;
use sensing::FlyingRobot;
use worlds::{FlyerParams, SimFlyer, World3d};

use super::maps::{Side, map_of};
use super::rider::Rider;
use super::stages::Stages;
use super::timed::TimedFlyer;
use super::{FlightExperiment, FlightMetrics, FlightRow, FlightSeen, FlightTiming, FlightWatch};
use crate::run::{AtWork, CorrectionTiming, RunError, TimedProbe};

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
pub(super) fn holds(world: &World3d, witness: &FlightWitness) -> bool {
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
