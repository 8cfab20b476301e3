//! One map of a flight, as its rows and sums grow.

use explore::{Ending, FlightExplorer, FlightGiveUp, FlightReport, WaysTally};
use maps3d::Map3d;
use metrics::FlightWitness;

use super::accuracy::accuracy;
use super::drive::holds;
use super::stages::{Stages, peak_memory};
use super::{FlightMetrics, FlightRow, FlightTiming};
use crate::run::{CorrectionTiming, ending_name, quantile, state_name};

/// Memory is asked for every so many steps: the answer costs a walk over the map.
const MEMORY_EVERY: u64 = 32;

/// What one map cost so far.
#[derive(Default)]
pub(super) struct Costs {
    pub step_micros: Vec<f64>,
    pub look_micros: Vec<f64>,
    pub record_micros: Vec<f64>,
    pub corrections: Vec<CorrectionTiming>,
    pub bytes_peak: u64,
}

impl Costs {
    pub fn timing(&self, stages: &Stages, wall_secs: f64) -> FlightTiming {
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
pub(super) struct Rider {
    pub name: &'static str,
    pub rows: Vec<FlightRow>,
    pub costs: Costs,
    /// Distance at which nothing was left to explore, while that is so.
    done_at_m: Option<f64>,
}

impl Rider {
    pub fn new(name: &'static str) -> Self {
        Self { name, rows: Vec::new(), costs: Costs::default(), done_at_m: None }
    }

    pub fn step(
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

    pub fn metrics(
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
        let ways = if steers { explorer.ways() } else { WaysTally::default() };
        let accuracy = accuracy(map, witness, explorer.graph().vertex_count());
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
            free_iou: accuracy.free_iou,
            free_wrong_share: accuracy.wrong_share,
            paths: work.paths,
            paths_m: work.paths_m,
            path_shortening: (work.paths_m > 0.0).then(|| 1.0 - work.shortened_m / work.paths_m),
            ways_asked: ways.asked,
            ways_found: ways.found,
            ways_m: ways.found_m,
            ways_repeat_m: ways.repeat_m,
            ways_flown: ways.begun,
            ways_refused: ways.refused,
            odometry_error_m: (witness.world_from_body().translation - world_from_odom.translation)
                .norm(),
            termination: match holds(witness.robot().world(), witness) {
                true => ending_name(report.ending).to_owned(),
                false => "left_the_place".to_owned(),
            },
        }
    }
}
