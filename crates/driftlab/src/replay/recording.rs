//! What the recording of a replay is shown: keyframes, optimised poses, frontier that is left.

use std::path::Path;
use std::time::{Duration, Instant};

use geometry::Point2;
use instrument::{
    InstrumentError, KeyframeSeen, MapOptions, ReplayOptions, ReplayRecording, SettledSeen,
};
use maps2d::relative::RelativeMap;
use places::{Added, Recognizer};
use pose::Se2;
use posegraph::{Scope, ScopeScratch};
use probe::VertexId;

use super::consistency::skeleton_of;
use super::course::Course;
use super::sides::Sides;
use super::{PlanarLog, ReplayError};
use crate::config::{Config, plain_toml};
use crate::run::{AtWork, RunError, TimedProbe, every_of, level_of};

/// Relative placement is shown within this distance along the graph, metres, at most.
const SCOPE_MOST_M: f64 = 20.0;

/// Opens the recording of a replay; at level `off` no file is made.
///
/// `about` is what the text page says first.
///
/// # Errors
/// Where the file cannot be created.
pub fn start_replay_recording(
    config: &Config,
    log: &PlanarLog,
    path: &Path,
    about: &str,
) -> Result<ReplayRecording, ReplayError> {
    let range_m = config.sensor.range_m;
    let (mut low, mut high) = (Point2::origin(), Point2::origin());
    if let Some(first) = log.scans.first() {
        for scan in &log.scans {
            let at = first.odom_from_sensor.inverse_mul(&scan.odom_from_sensor).translation;
            low = Point2::new(low.x.min(at.x), low.y.min(at.y));
            high = Point2::new(high.x.max(at.x), high.y.max(at.y));
        }
    }
    let reach = Point2::new(range_m, range_m).coords;
    let kinds = config.map.keys();
    Ok(ReplayRecording::create(ReplayOptions {
        path: path.to_owned(),
        name: config.name.clone(),
        level: level_of(config.record.level),
        every: every_of(&config.record.every),
        maps: kinds.into_iter().map(MapOptions::of_kind).collect(),
        about: about.to_owned(),
        config: plain_toml(config).map_err(RunError::from)?,
        bounds_in_odom: (low - reach, high + reach),
        sight_m: scope_m(config) + range_m,
    })?)
}

fn scope_m(config: &Config) -> f64 {
    let map = config.map.relative.as_ref();
    map.map_or(10.0, |map| map.consolidation_radius_m).min(SCOPE_MOST_M)
}

/// The recording while a log passes by.
pub(super) struct Shown<'a> {
    pub recording: &'a mut ReplayRecording,
    scope_m: f64,
    /// Keyframes that were shown.
    count: usize,
}

impl<'a> Shown<'a> {
    pub fn new(config: &Config, recording: &'a mut ReplayRecording) -> Self {
        Self { recording, scope_m: scope_m(config), count: 0 }
    }

    /// Lets place recognition take a keyframe while the recording listens; what it took without that.
    pub fn places(
        &mut self,
        work: impl FnOnce(&mut TimedProbe<'_, ReplayRecording>) -> Added,
    ) -> (Added, Duration) {
        let at_work = AtWork::new(0);
        let mut heard = TimedProbe::new(&mut *self.recording, &at_work, 0);
        let start = Instant::now();
        let added = work(&mut heard);
        let spent = start.elapsed().saturating_sub(heard.spent);
        (added, spent)
    }

    /// Shows the vertices that are new.
    pub fn keyframes(
        &mut self,
        course: &Course,
        recognizer: Option<&Recognizer>,
        sides: &Sides,
    ) -> Result<(), InstrumentError> {
        if !self.recording.is_on() {
            return Ok(());
        }
        for vertex in self.count..course.stops.len() {
            let pose = |vertex: usize| {
                let first = &course.stops[0].odom_from_sensor;
                first.inverse_mul(&course.stops[vertex].odom_from_sensor)
            };
            let odom_from_keyframe = pose(vertex);
            let step = vertex.checked_sub(1).map(|last| {
                let heard = recognizer.and_then(|recognizer| recognizer.steps().get(last));
                let by_odometry = pose(last).inverse_mul(&odom_from_keyframe);
                heard.map_or(by_odometry, |step| step.from_from_to)
            });
            let samples = course.views.get(vertex).map(|view| view.as_slice()).unwrap_or_default();
            let returns: Vec<Point2> =
                samples.iter().filter(|ray| ray.hit).map(|ray| ray.end_in_anchor).collect();
            let skeleton = skeleton_of(sides.graph(), self.scope_m);
            let (mut scope, mut scratch) = (Scope::default(), ScopeScratch::default());
            scratch.place(&skeleton, VertexId(vertex as u32), self.scope_m, &mut scope);
            let around: Vec<(usize, Se2, Option<usize>)> = scope
                .placed()
                .iter()
                .map(|row| {
                    let parent = row.parent.map(|parent| parent as usize);
                    (row.vertex.0 as usize, row.root_from_vertex, parent)
                })
                .collect();
            self.recording.keyframe(&KeyframeSeen {
                returns: &returns,
                odom_from_keyframe,
                last_from_keyframe: step.unwrap_or_default(),
                around: &around,
            })?;
        }
        self.count = course.stops.len();
        Ok(())
    }

    /// Shows optimised poses, and the frontier that is left where they have it.
    pub fn settled(&mut self, map_from_keyframe: &[Se2], relative: Option<&RelativeMap>) {
        if !self.recording.is_on() {
            return;
        }
        let mut frontier: Vec<(Point2, Point2)> = Vec::new();
        for (vertex, state) in relative.into_iter().flat_map(RelativeMap::volumes) {
            let Some(pose) = map_from_keyframe.get(vertex.0 as usize) else { continue };
            for part in state.chains.iter().filter(|chain| chain.counts).flat_map(|c| &c.parts) {
                let edge = &state.volume.frontier[part.edge];
                let ends = [edge.at(part.span.from), edge.at(part.span.to)];
                frontier.push((pose.transform(&ends[0]), pose.transform(&ends[1])));
            }
        }
        self.recording.settled(&SettledSeen { map_from_keyframe, frontier_in_map: &frontier });
    }
}
