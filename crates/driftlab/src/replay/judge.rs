//! What a replay came to: metrics and timing. Judged at the end, by nothing that a map decides with.

use formats::laser::relations::Relation;
use maps2d::relative::RelativeMap;
use maps2d::volume::VolumeParams;
use pose::Se2;
use posegraph::{EdgeKind, Scope, ScopeScratch};
use probe::VertexId;

use super::PlanarLog;
use super::between;
use super::consistency::{inconsistency, skeleton_of};
use super::course::Course;
use super::covered::covered;
use super::relations::{Estimates, Relations, relations};
use super::report::{PlaceToGo, ReplayMapMetrics, ReplayMetrics, ReplayTiming};
use super::sides::{Held, Side, Sides};
use crate::config::{Config, Replay};
use crate::run::{MapTiming, quantile};

/// What a replay is to be held against.
#[derive(Clone, Debug, Default)]
pub struct Asked {
    /// Published relative poses.
    pub relations: Option<Vec<Relation>>,
}

/// Places to go to that are told, at most: the longest frontiers.
const PLACES_TOLD: usize = 200;

/// Puts numbers on a course and fills in what its rows can only know at the end.
pub(super) fn judge(
    config: &Config,
    replay: &Replay,
    log: &PlanarLog,
    course: &mut Course,
    sides: &mut Sides,
    asked: &Asked,
) -> (ReplayMetrics, ReplayTiming) {
    let volume = config.relative_params().map_or_else(VolumeParams::default, |map| map.volume);
    let radius_m = config.map.relative.as_ref().map_or(10.0, |map| map.consolidation_radius_m);
    let areas = covered(course, &volume, replay.covered_cell_m);
    let by_odometry = course.by_odometry();
    for row in &mut course.rows {
        let vertex = row.vertex as usize;
        row.odom_from_keyframe = by_odometry.get(vertex).copied().unwrap_or_default();
        row.map_from_keyframe = course.optimised.get(vertex).copied().unwrap_or_default();
        // Of all vertices until then: the one that the scan was taken at may be an old one.
        let newest = row.vertices.saturating_sub(1) as usize;
        row.covered_m2 = areas.get(newest).copied().unwrap_or(0.0);
    }
    let held_against = asked.relations.as_ref().map(|all| against(log, course, sides, all));
    let over = held_against.as_ref().map(|told| told.of_two_scans.optimised);
    let closures = &course.closures;
    let distance_m = course.distance_m;
    let metrics = ReplayMetrics {
        name: config.name.clone(),
        seed: config.seed,
        keyframes: course.stops.len() as u64,
        scans: log.scans.len() as u64,
        distance_m,
        covered_m2: areas.last().copied().unwrap_or(0.0),
        loop_closures_proposed: closures.proposed,
        loop_closures_accepted: closures.accepted,
        loop_closures_rejected: closures.proposed.saturating_sub(closures.accepted),
        loop_closures_rejected_by_graph: closures.rejected_by_graph,
        verdicts: closures.verdicts.clone(),
        untracked: closures.untracked,
        relations_translation_m: over.and_then(|over| over.translation_m),
        relations_rotation_deg: over.and_then(|over| over.rotation_deg),
        relations: held_against,
        inconsistency: inconsistency(course, sides.graph(), &volume, radius_m, replay.deep_m),
        maps: sides
            .all
            .iter()
            .map(|side| (side.name.to_owned(), map_metrics(side, sides, course, distance_m)))
            .collect(),
    };
    (metrics, timing(log, course, sides))
}

fn map_metrics(side: &Side, sides: &Sides, course: &Course, distance_m: f64) -> ReplayMapMetrics {
    let map = side.held.map();
    let frontier = map.frontier();
    let places = sides.graph().edges().filter(|(_, edge)| edge.kind == EdgeKind::Place).count();
    let to_go = match &side.held {
        Held::Relative(map) => places_to_go(map, &course.optimised),
        Held::Other(_) => Vec::new(),
    };
    let done = frontier.open_m <= 0.0;
    ReplayMapMetrics {
        believed_complete: done,
        distance_m,
        steps: course.millis.len() as u64,
        scans: course.scans,
        place_edges: side.told.places_of(places as u64),
        frontier_left_m: frontier.open_m,
        frontier_ignored_m: frontier.ignored_m,
        frontier_places: frontier.places as u64,
        vertices: sides.graph().vertex_count() as u64,
        corrections: side.corrections.len() as u64,
        map_invalid: map.invalid(),
        termination: "end_of_log",
        places_to_go: to_go,
        ..ReplayMapMetrics::default()
    }
}

/// The frontier that is left, as places where the person should have gone; the longest first.
pub(super) fn places_to_go(map: &RelativeMap, map_from_vertex: &[Se2]) -> Vec<PlaceToGo> {
    let mut all: Vec<PlaceToGo> = Vec::new();
    for (vertex, state) in map.volumes() {
        let Some(pose) = map_from_vertex.get(vertex.0 as usize) else { continue };
        for chain in state.chains.iter().filter(|chain| chain.counts) {
            let Some(part) = chain.parts.get(chain.parts.len() / 2) else { continue };
            let edge = &state.volume.frontier[part.edge];
            let at = pose.transform(&edge.at(part.span.middle()));
            let keyframe = u64::from(vertex.0);
            all.push(PlaceToGo { x_m: at.x, y_m: at.y, length_m: chain.length_m, keyframe });
        }
    }
    all.sort_by(|a, b| b.length_m.total_cmp(&a.length_m).then(a.keyframe.cmp(&b.keyframe)));
    all.truncate(PLACES_TOLD);
    all
}

/// Holds every estimate against relations.
fn against(log: &PlanarLog, course: &Course, sides: &Sides, all: &[Relation]) -> Relations {
    let by_odometry = course.by_odometry();
    let of = |poses: &[Se2]| between::of_scans(log, course, poses);
    let (odometry, tracked, optimised) =
        (of(&by_odometry), of(&course.tracked), of(&course.optimised));
    let skeleton = skeleton_of(sides.graph(), f64::INFINITY);
    let (mut scope, mut scratch) = (Scope::default(), ScopeScratch::default());
    let keyframe_at = |secs: f64| {
        let keyframe = if course.standings.is_empty() {
            course.stops.partition_point(|stop| stop.stamp_secs <= secs).saturating_sub(1)
        } else {
            let scan = log.scans.partition_point(|scan| scan.stamp_secs <= secs);
            course.standings.get(scan.saturating_sub(1))?.vertex.0 as usize
        };
        let pose = between::at(log, &tracked, secs)?;
        Some((keyframe, course.tracked.get(keyframe)?.inverse_mul(&pose)))
    };
    let relative = |from: f64, to: f64| {
        let (root, root_from_from) = keyframe_at(from)?;
        let (other, other_from_to) = keyframe_at(to)?;
        if scope.root() != Some(VertexId(root as u32)) {
            scratch.place(&skeleton, VertexId(root as u32), f64::INFINITY, &mut scope);
        }
        let row = scope.placed().iter().find(|row| row.vertex.0 as usize == other)?;
        Some(root_from_from.inverse() * row.root_from_vertex * other_from_to)
    };
    let estimates = Estimates { odometry: &odometry, tracked: &tracked, optimised: &optimised };
    relations(log, all, &estimates, relative)
}

fn timing(log: &PlanarLog, course: &Course, sides: &mut Sides) -> ReplayTiming {
    let millis = &course.millis;
    let tenth = (millis.len() / 10).max(1).min(millis.len());
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len().max(1) as f64;
    let gated: Vec<f64> = course.gated.iter().map(|&count| count as f64).collect();
    let maps = sides.all.iter().map(|side| {
        let secs: Vec<f64> = side.corrections.iter().map(|one| one.secs * 1e6).collect();
        let of_corrections = |q| (!secs.is_empty()).then(|| quantile(&secs, q));
        let timing = MapTiming {
            step_micros_median: quantile(&side.micros, 0.5),
            step_micros_p99: quantile(&side.micros, 0.99),
            record_micros_median: 0.0,
            record_micros_p99: 0.0,
            correction_micros_median: of_corrections(0.5),
            correction_micros_p99: of_corrections(0.99),
            correction_secs: side.corrections.iter().map(|one| one.secs).sum(),
            corrections: side.corrections.clone(),
            map_bytes_peak: side.bytes_peak.max(side.held.map().bytes() as u64),
            wall_secs: side.micros.iter().sum::<f64>() * 1e-6,
        };
        (side.name.to_owned(), timing)
    });
    ReplayTiming {
        wall_secs: 0.0,
        log_secs: log.span_secs(),
        keyframe_millis_median: quantile(millis, 0.5),
        keyframe_millis_p99: quantile(millis, 0.99),
        keyframe_millis_first_tenth: mean(&millis[..tenth]),
        keyframe_millis_last_tenth: mean(&millis[millis.len() - tenth..]),
        candidates_first_tenth: mean(&gated[..tenth.min(gated.len())]),
        candidates_last_tenth: mean(&gated[gated.len() - tenth.min(gated.len())..]),
        bytes_per_keyframe: course.bytes as f64 / course.stops.len().max(1) as f64,
        maps: maps.collect(),
    }
}
