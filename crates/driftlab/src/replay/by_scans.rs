//! A graph made of the scans: keyframes, steps that the scans correct, places that they recognise.

use std::collections::BTreeSet;
use std::time::{Duration, Instant};

use maps2d::Standing;
use places::{Added, Driven, Measured, PlaceParams, Recognizer, Verdict};
use pose::Se2;
use posegraph::EdgeKind;
use probe::VertexId;

use super::course::{Closures, Course, Stop};
use super::fits::scan_at;
use super::given::{GivenMatch, Moment};
use super::session::{Progress, Watched};
use super::sides::{NewEdge, Sides, Told};
use super::{PlanarLog, ReplayError};
use crate::config::{Config, Replay};

/// Drives through the log.
pub(super) fn by_scans(
    config: &Config,
    replay: &Replay,
    log: &PlanarLog,
    given: Option<&[GivenMatch]>,
    sides: &mut Sides,
    watched: &mut Watched<'_>,
) -> Result<(Course, Recognizer), ReplayError> {
    let params = PlaceParams::from(replay);
    let recognizer = match given {
        Some(_) => Recognizer::tracking_only(params),
        None => Recognizer::new(params),
    };
    let given = Given::new(log, given.unwrap_or_default());
    let mut front = Front {
        config,
        replay,
        log,
        given,
        recognizer,
        course: Course::default(),
        driven: Driven::default(),
        distance_m: 0.0,
        settled_at: 0,
        settled_closures: 0,
    };
    let mut last: Option<usize> = None;
    for (index, scan) in log.scans.iter().enumerate() {
        if scan.scan.is_empty() {
            continue;
        }
        if let Some(last) = last {
            let step = log.scans[last].odom_from_sensor.inverse_mul(&scan.odom_from_sensor);
            front.driven.last_from_new = front.driven.last_from_new * step;
            front.driven.distance_m += step.distance();
            front.driven.turned_rad += step.angle().abs();
            front.distance_m += step.distance();
        }
        let first = last.is_none();
        last = Some(index);
        let due = first
            || params.keyframes.is_due(&front.driven.last_from_new)
            || front.given.wanted.contains(&index);
        if due {
            front.keyframe(index, sides, watched)?;
        }
    }
    Ok(front.finish(sides, watched))
}

/// What of a log has passed by.
struct Front<'a> {
    config: &'a Config,
    replay: &'a Replay,
    log: &'a PlanarLog,
    given: Given<'a>,
    recognizer: Recognizer,
    course: Course,
    driven: Driven,
    distance_m: f64,
    /// Keyframe at which corrected maps got poses last, and the closures that were known then.
    settled_at: usize,
    settled_closures: usize,
}

impl Front<'_> {
    fn keyframe(
        &mut self,
        index: usize,
        sides: &mut Sides,
        watched: &mut Watched<'_>,
    ) -> Result<(), ReplayError> {
        let logged = &self.log.scans[index];
        let driven = std::mem::take(&mut self.driven);
        let scan = self.config.sensor.in_view(logged.scan.clone());
        let step = self.course.stops.len() as u64;
        let time_secs = logged.stamp_secs - self.log.scans[0].stamp_secs;
        sides.begin(step, self.distance_m, time_secs);
        watched.begin(step, self.distance_m, time_secs);

        let own = scan.clone();
        let (mut added, mut spent) =
            watched.shown.places(|probe| self.recognizer.add_with(own, &driven, probe));
        self.course.stops.push(Stop {
            scan: index,
            stamp_secs: logged.stamp_secs,
            distance_m: self.distance_m,
            odom_from_sensor: logged.odom_from_sensor,
        });
        let start = Instant::now();
        self.take_given(index, &mut added, watched);
        spent += start.elapsed();

        let first = self.log.scans[self.course.stops[0].scan].odom_from_sensor;
        let vertex = sides.vertex(first.inverse_mul(&logged.odom_from_sensor));
        self.tell(vertex, &added, &driven, sides);
        let standing = Standing { vertex, vertex_from_body: Se2::identity() };
        let scan = self.config.sensor.within_range(&scan);
        self.course.saw(&standing, &scan);
        sides.scanned(&standing, &scan);
        let poses = self.settle(sides, watched.shown.recording.is_on());
        let on_map = sides.end();
        self.course.cost(spent, on_map);
        self.course.gated.push(added.gated as u64);
        self.course.closures.proposed += added.proposed as u64;
        self.course.closures.accepted += added.closures.len() as u64;
        watched.keyframe(
            &Progress {
                recognizer: Some(&self.recognizer),
                share: (index + 1) as f64 / self.log.scans.len() as f64,
                step,
                distance_m: self.distance_m,
                time_secs,
                standing,
            },
            &mut self.course,
            sides,
        )?;
        if let Some(poses) = poses {
            watched.shown.settled(&poses, sides.relative());
        }
        Ok(())
    }

    /// Hands in the places that were given for this keyframe.
    fn take_given(&mut self, index: usize, added: &mut Added, watched: &mut Watched<'_>) {
        let newest = self.course.stops.len() - 1;
        for (known, given) in self.given.of(index, newest, &self.course.stops) {
            added.proposed += 1;
            let from_from_to = given.known_from_current;
            let covariance = given.covariance;
            let measured = Measured { from: known, to: newest, from_from_to, covariance };
            if self.recognizer.given(&measured) {
                added.closures.extend(self.recognizer.closures().last());
                watched.shown.recording.closed(known, newest);
            }
        }
    }

    /// Tells the maps of the step and of the closures, those of one keyframe at a time.
    fn tell(&self, vertex: VertexId, added: &Added, driven: &Driven, sides: &mut Sides) {
        let edge = |measured: &Measured, kind| NewEdge {
            a: VertexId(measured.from as u32),
            b: VertexId(measured.to as u32),
            kind,
            a_from_b: measured.from_from_to,
        };
        let mut own: Vec<NewEdge> = Vec::new();
        if let Some(step) = &added.step {
            let step = edge(step, EdgeKind::Odometry);
            sides.edges(Told::Wheels, &[NewEdge { a_from_b: driven.last_from_new, ..step }]);
            sides.edges(Told::Settled, &[step]);
            own.push(step);
        }
        let mut closures: Vec<NewEdge> =
            added.closures.iter().map(|closure| edge(&closure.measured, EdgeKind::Place)).collect();
        closures.sort_by_key(|closure| closure.b);
        own.extend(closures.iter().filter(|closure| closure.b == vertex));
        sides.edges(Told::Measured, &own);
        closures.retain(|closure| closure.b != vertex);
        for waited in closures.chunk_by(|one, other| one.b == other.b) {
            sides.edges(Told::Measured, waited);
        }
    }

    /// Optimises for the maps that live by it, and for the recording, where enough has come since it was
    /// done last.
    fn settle(&mut self, sides: &mut Sides, shown: bool) -> Option<Vec<Se2>> {
        let keyframes = self.recognizer.keyframes().len();
        let due = keyframes - self.settled_at >= self.replay.settle_every as usize;
        let closures = self.recognizer.closures().len();
        let asked = sides.lives_by_poses() || shown;
        if !(due && closures > self.settled_closures && asked) {
            return None;
        }
        let poses = self.recognizer.settled().map_from_keyframe;
        sides.settled(&poses);
        (self.settled_at, self.settled_closures) = (keyframes, closures);
        Some(poses)
    }

    fn finish(mut self, sides: &mut Sides, watched: &mut Watched<'_>) -> (Course, Recognizer) {
        let recognizer = self.recognizer;
        let settled = recognizer.settled();
        if recognizer.closures().len() > self.settled_closures {
            sides.settled(&settled.map_from_keyframe);
        }
        watched.shown.settled(&settled.map_from_keyframe, sides.relative());
        let tally = recognizer.tally();
        let course = &mut self.course;
        course.distance_m = course.stops.last().map_or(0.0, |stop| stop.distance_m);
        course.factors = recognizer.graph();
        course.tracked = recognizer.chained();
        course.optimised = settled.map_from_keyframe;
        let verdicts = Verdict::ALL.iter().zip(tally.verdicts);
        course.closures = Closures {
            rejected_by_graph: settled.rejected.len() as u64,
            verdicts: verdicts.map(|(verdict, count)| (verdict.name(), count)).collect(),
            untracked: tally.untracked,
            ..std::mem::take(&mut course.closures)
        };
        let map_bytes = sides.relative().map_or(0, maps2d::ExplorationMap::bytes);
        course.bytes = (recognizer.bytes() + map_bytes) as u64;
        (self.course, recognizer)
    }
}

/// Place matches by the scans that they speak of.
struct Given<'a> {
    /// Scans that become keyframes because a match speaks of them.
    wanted: BTreeSet<usize>,
    /// Known scan, current scan, and the match.
    by_scan: Vec<(usize, usize, &'a GivenMatch)>,
    by_keyframe: Vec<(usize, usize, &'a GivenMatch)>,
}

impl<'a> Given<'a> {
    fn new(log: &PlanarLog, matches: &'a [GivenMatch]) -> Self {
        let near = |secs: f64| scan_at(log, secs);
        let mut given =
            Self { wanted: BTreeSet::new(), by_scan: Vec::new(), by_keyframe: Vec::new() };
        for one in matches {
            match (one.known, one.current) {
                (Moment::Stamp(known), Moment::Stamp(current)) => {
                    if let (Some(known), Some(current)) = (near(known), near(current)) {
                        given.wanted.extend([known, current]);
                        given.by_scan.push((known, current, one));
                    }
                }
                (Moment::Keyframe(known), Moment::Keyframe(current)) => {
                    given.by_keyframe.push((known as usize, current as usize, one));
                }
                _ => {}
            }
        }
        given
    }

    /// The matches whose later scan is this one, each with the keyframe of the known one.
    fn of(&self, scan: usize, keyframe: usize, stops: &[Stop]) -> Vec<(usize, &'a GivenMatch)> {
        let by_scan = self.by_scan.iter().filter(|one| one.1 == scan).filter_map(|one| {
            let known = stops.binary_search_by_key(&one.0, |stop| stop.scan).ok()?;
            Some((known, one.2))
        });
        let by_keyframe = self.by_keyframe.iter().filter(|one| one.1 == keyframe);
        by_scan.chain(by_keyframe.map(|one| (one.0, one.2))).collect()
    }
}

/// Time without anything in it, for keyframes that nobody recognises at.
pub(super) const NO_TIME: Duration = Duration::ZERO;
