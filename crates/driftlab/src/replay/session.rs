//! The whole replay: maps fed, keyframe by keyframe, then judged.

use std::time::Instant;

use instrument::{ReplayRecording, StepEnd};
use maps2d::Standing;
use places::Recognizer;
use pose::Se2;

use super::by_graph::by_graph;
use super::by_scans::by_scans;
use super::course::Course;
use super::given::GivenMatch;
use super::judge::{Asked, judge};
use super::recording::Shown;
use super::report::{ReplayMetrics, ReplayTiming};
use super::sides::Sides;
use super::steps::ReplayRow;
use super::{PlanarLog, ReplayError};
use crate::config::Config;
use crate::run::{RunError, to_json};

/// What came of a replay.
#[derive(Clone, Debug)]
pub struct Replayed {
    /// The keyframes with all that was measured between them.
    pub course: Course,
    /// `metrics.json`.
    pub metrics: ReplayMetrics,
    /// `timing.json`.
    pub timing: ReplayTiming,
    /// What each accepted closure says, if they were found or given: known and current keyframe,
    /// pose, deviation along the worst axis in metres, and of the heading in radians.
    pub closures: Vec<(usize, usize, Se2, f64, f64)>,
}

/// How far a replay is.
pub(super) struct Progress<'a> {
    pub recognizer: Option<&'a Recognizer>,
    /// Share of the log that passed by.
    pub share: f64,
    pub step: u64,
    pub distance_m: f64,
    pub time_secs: f64,
    pub standing: Standing,
}

/// Who looks on while a log passes by.
pub(super) struct Watched<'a> {
    /// The recording.
    pub shown: Shown<'a>,
    /// Told how far it is: the share of the log, and a row of the keyframe.
    pub on_keyframe: &'a mut dyn FnMut(f64, &ReplayRow),
}

impl Watched<'_> {
    /// A keyframe begins: all events until its end belong to it.
    pub fn begin(&mut self, step: u64, distance_m: f64, time_secs: f64) {
        self.shown.recording.begin(step, distance_m, time_secs);
    }

    /// A keyframe ended: notes a row for each map.
    pub fn keyframe(
        &mut self,
        now: &Progress<'_>,
        course: &mut Course,
        sides: &mut Sides,
    ) -> Result<(), ReplayError> {
        let vertices = sides.graph().vertex_count() as u64;
        let edges = sides.graph().edge_count() as u64;
        let place_edges = match now.recognizer {
            Some(recognizer) => recognizer.closures().len() as u64,
            None => edges - (vertices - 1).min(edges),
        };
        let first = course.rows.len();
        for side in &mut sides.all {
            let frontier = side.held.map().frontier();
            course.rows.push(ReplayRow {
                step: now.step,
                map: side.name,
                distance_m: now.distance_m,
                time_secs: now.time_secs,
                vertex: u64::from(now.standing.vertex.0),
                odom_from_keyframe: Se2::identity(),
                map_from_keyframe: Se2::identity(),
                covered_m2: 0.0,
                frontier_open_m: frontier.open_m,
                frontier_ignored_m: frontier.ignored_m,
                frontier_places: frontier.places as u64,
                vertices,
                place_edges: side.told.places_of(place_edges),
            });
            side.recorder.end_step(&StepEnd {
                standing: now.standing,
                distance_m: now.distance_m,
                sim_time_secs: now.time_secs,
                witness: None,
                newly_seen: &[],
                numbers: &[
                    ("frontier_open_m", frontier.open_m),
                    ("frontier_ignored_m", frontier.ignored_m),
                ],
            })?;
        }
        self.shown.keyframes(course, now.recognizer, sides)?;
        // Of the map that was told most: not every map hears of places.
        let told = course.rows[first..].iter().max_by_key(|row| row.place_edges);
        if let Some(row) = told {
            (self.on_keyframe)(now.share, row);
        }
        Ok(())
    }
}

/// Replays a planar log; the outcome but for the timing follows from config, log and matches alone.
///
/// `given` takes the place of recognition; the recording listens, and is finished. `on_keyframe` is told the share of the log that passed by.
///
/// # Errors
/// Where the config asks for what no log has, and where the recording cannot be written.
pub fn replay(
    config: &Config,
    log: &PlanarLog,
    given: Option<&[GivenMatch]>,
    asked: &Asked,
    mut recording: ReplayRecording,
    on_keyframe: &mut dyn FnMut(f64, &ReplayRow),
) -> Result<Replayed, ReplayError> {
    let started = Instant::now();
    let settings = config.replay.clone().unwrap_or_default();
    let own_graph = log.graph.is_some() && given.is_none();
    let mut sides = Sides::new(config, own_graph, |name| recording.recorder(name));
    let mut watched = Watched { shown: Shown::new(config, &mut recording), on_keyframe };
    let (mut course, recognizer) = match &log.graph {
        Some(steps) if own_graph => (by_graph(config, log, steps, &mut sides, &mut watched)?, None),
        _ => {
            let (course, recognizer) =
                by_scans(config, &settings, log, given, &mut sides, &mut watched)?;
            (course, Some(recognizer))
        }
    };
    let (metrics, mut timing) = judge(config, &settings, log, &mut course, &mut sides, asked);
    let closures = recognizer.iter().flat_map(|recognizer| recognizer.closures()).map(|closure| {
        let measured = &closure.measured;
        let sigma_m = measured.covariance.fixed_view::<2, 2>(0, 0).symmetric_eigenvalues().max();
        let sigma_rad = measured.covariance[(2, 2)];
        let sigmas = [sigma_m, sigma_rad].map(|variance: f64| variance.max(0.0).sqrt());
        (measured.from, measured.to, measured.from_from_to, sigmas[0], sigmas[1])
    });
    let closures = closures.collect();
    for mut side in std::mem::take(&mut sides.all) {
        side.recorder.send()?;
    }
    recording.finish(&to_json(&metrics).map_err(RunError::from)?)?;
    timing.wall_secs = started.elapsed().as_secs_f64();
    Ok(Replayed { course, metrics, timing, closures })
}
