//! One recorder: its state, the steps, and when rows are sent.

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use maps2d::Standing;
use metrics::{Coverage, Witness};
use pose::Se2;
use probe::VertexId;
use rerun::RecordingStream;
use worlds::World2d;

use super::belief::Belief;
use super::correction::Corrected;
use super::graph::Graph;
use super::happened::Happened;
use super::places::Places;
use super::planner::Planner;
use super::quarrel::Quarrels;
use super::truth::Truth;
use crate::columns::{Now, Numbers, Rgba, eye, fixed_pose};
use crate::{Centre, Every, Family, InstrumentError, Level, MapOptions};

/// Rows are sent when this many steps are held,
const HELD_STEPS: u32 = 512;
/// or this much memory,
const HELD_BYTES: usize = 4 << 20;
/// or when the oldest row is this old: what a killed run may lose.
const HELD_FOR: Duration = Duration::from_millis(1000);

/// Listens to everything that one robot and its maps tell, and writes it to the recording.
///
/// It is a [`probe::Probe`] of every event family; it only reads. Between
/// [`begin_step`](Self::begin_step) and [`end_step`](Self::end_step) rows are kept in memory; they
/// are sent in columns every so often, and the file opens with everything that was sent. Several
/// recorders of one recording may work in different threads. A recorder at [`Level::Off`] does
/// nothing. Errors of writing are reported by `end_step`.
pub struct Recorder {
    pub(super) inner: Option<Box<Inner>>,
}

/// The truth and the numbers at the end of a step.
#[derive(Clone, Copy, Debug)]
pub struct StepEnd<'a> {
    /// Where the robot believes that it stands.
    pub standing: Standing,
    /// Distance driven so far, metres.
    pub distance_m: f64,
    /// Time since the start, seconds.
    pub sim_time_secs: f64,
    /// The truth, in a simulation.
    pub witness: Option<&'a Witness>,
    /// The cells first seen at this step, as indices into the coverage.
    pub newly_seen: &'a [usize],
    /// What is plotted: a name (part of an entity path) and a number each.
    pub numbers: &'a [(&'a str, f64)],
}

pub(super) struct Inner {
    stream: RecordingStream,
    name: String,
    colour: Rgba,
    centre: Centre,
    pub level: Level,
    pub every: Every,
    pub now: Now,
    distance_m: f64,
    sim_time_secs: f64,
    pub places: Places,
    pub standing: Standing,
    world_from_start: Se2,
    pub belief: Belief,
    pub graph: Graph,
    pub corrected: Corrected,
    pub planner: Planner,
    pub happened: Happened,
    pub quarrels: Quarrels,
    truth: Truth,
    numbers: BTreeMap<String, Numbers>,
    held_steps: u32,
    last_sent: Instant,
}

impl Recorder {
    /// A recorder that does nothing.
    pub fn off() -> Self {
        Self { inner: None }
    }

    pub(crate) fn new(
        stream: RecordingStream,
        map: &MapOptions,
        colour: Rgba,
        level: Level,
        every: Every,
    ) -> Self {
        if level == Level::Off {
            return Self::off();
        }
        let name = map.name.as_str();
        let standing = Standing { vertex: VertexId(0), vertex_from_body: Se2::identity() };
        Self {
            inner: Some(Box::new(Inner {
                belief: Belief::new(name, map.centre == Centre::Robot),
                graph: Graph::new(name),
                corrected: Corrected::new(name),
                planner: Planner::new(name),
                happened: Happened::new(name),
                quarrels: Quarrels::new(name, map.centre),
                truth: Truth::new(name),
                name: name.to_owned(),
                stream,
                colour,
                centre: map.centre,
                level,
                every,
                now: Now::default(),
                distance_m: 0.0,
                sim_time_secs: 0.0,
                places: Places::default(),
                standing,
                world_from_start: Se2::identity(),
                numbers: BTreeMap::new(),
                held_steps: 0,
                last_sent: Instant::now(),
            })),
        }
    }

    /// Draws the place once, before the first step: walls, and the cells that count.
    ///
    /// # Errors
    /// Where the recording cannot be written.
    pub fn place(&mut self, world: &World2d, coverage: &Coverage) -> Result<(), InstrumentError> {
        let Some(inner) = &mut self.inner else { return Ok(()) };
        inner.world_from_start = world.world_from_start();
        eye(&inner.stream, &format!("{}/eye", inner.name))?;
        fixed_pose(&inner.stream, &format!("{}/graph", inner.name), &inner.world_from_start)?;
        if inner.centre == Centre::Start {
            let path = format!("{}/belief", inner.name);
            fixed_pose(&inner.stream, &path, &inner.world_from_start)?;
        }
        inner.truth.place(&inner.stream, world, coverage)?;
        // Rows are sent past the batcher: what they hang on must not come later.
        let _ = inner.stream.flush_async();
        Ok(())
    }

    /// Starts a step; all events until [`end_step`](Self::end_step) belong to it.
    ///
    /// Steps, distances (metres) and times (seconds) must not fall.
    pub fn begin_step(&mut self, step: u64, distance_m: f64, sim_time_secs: f64) {
        if let Some(inner) = &mut self.inner {
            inner.now.step = step as i64;
            inner.set_distance(distance_m, sim_time_secs);
            let now = inner.now;
            inner.quarrels.begin_step(&now);
        }
    }

    /// Ends a step: draws the state as it is now, and sends rows if it is time to.
    ///
    /// # Errors
    /// Where rows do not fit together, which would be a bug of ours.
    pub fn end_step(&mut self, end: &StepEnd<'_>) -> Result<(), InstrumentError> {
        match &mut self.inner {
            Some(inner) => inner.end_step(end),
            None => Ok(()),
        }
    }

    /// Sends all rows that are still held.
    ///
    /// # Errors
    /// Where rows do not fit together, which would be a bug of ours.
    pub fn send(&mut self) -> Result<(), InstrumentError> {
        match &mut self.inner {
            Some(inner) => inner.send(),
            None => Ok(()),
        }
    }
}

impl Drop for Recorder {
    fn drop(&mut self) {
        // What a run that ended early left behind; an error has nobody to go to any more.
        let _ = self.send();
    }
}

impl Inner {
    /// Whether events of a family are written down at this step.
    pub fn full(&self, family: Family) -> bool {
        self.level == Level::Full && self.every.takes(family, self.now.step as u64)
    }

    /// Whether the state of a family is drawn at this step.
    pub fn takes(&self, family: Family) -> bool {
        self.every.takes(family, self.now.step as u64)
    }

    fn set_distance(&mut self, distance_m: f64, sim_time_secs: f64) {
        self.distance_m = distance_m;
        self.sim_time_secs = sim_time_secs;
        self.now.distance_mm = (distance_m * 1e3).round() as i64;
        self.now.sim_time_ns = (sim_time_secs * 1e9).round() as i64;
    }

    /// The robot drove: events that follow in this step are farther and later, at 1 m/s.
    pub fn drove(&mut self, distance_m: f64) {
        self.set_distance(self.distance_m + distance_m, self.sim_time_secs + distance_m);
    }

    fn end_step(&mut self, end: &StepEnd<'_>) -> Result<(), InstrumentError> {
        self.set_distance(end.distance_m, end.sim_time_secs);
        self.standing = end.standing;
        let now = self.now;
        let belief_from_body = self.places.of_body(&self.standing);
        let belief_from_vertex = self.places.of(self.standing.vertex);
        let world_from_belief = match (self.centre, end.witness) {
            (Centre::Robot, Some(witness)) => {
                Some(witness.world_from_body() * belief_from_body.inverse())
            }
            _ => None,
        };
        // The picture keeps the directions that the robot believes in, so that it does not spin.
        let belief_from_eye = Se2 {
            rotation: self.world_from_start.rotation.inverse(),
            translation: belief_from_vertex.translation,
        };
        self.belief.end_step(
            &belief_from_body,
            &belief_from_eye,
            world_from_belief.as_ref(),
            self.takes(Family::Grid),
            &now,
        );
        let by_odometry = self.places.by_odometry(self.standing.vertex);
        if self.takes(Family::PoseGraph) {
            self.graph.end_step(&(by_odometry * self.standing.vertex_from_body), &now);
            self.corrected.end_step(&now);
        } else {
            self.graph.skip_step();
            self.corrected.skip_step();
        }
        if self.takes(Family::Planner) {
            self.planner.end_step(&now);
        } else {
            self.planner.skip_step();
        }
        if let Some(witness) = end.witness {
            self.truth.step(witness, end.newly_seen);
            if self.takes(Family::Truth) {
                self.truth.end_step(witness, &now);
            }
        }
        if self.takes(Family::Truth) {
            self.plot("distance_m", end.distance_m);
            self.plot("volumes_in_scope", self.belief.volumes_in_scope as f64);
            self.plot("place_edges", self.graph.place_edges as f64);
            if let Some(last) = self.corrected.take_plots() {
                self.plot("correction_iterations", last.iterations as f64);
                self.plot("correction_moved_m", last.moved_max_m);
            }
            if let Some(witness) = end.witness {
                self.plot("bumps", witness.tally().bumps as f64);
                self.plot("collisions", witness.tally().collisions as f64);
            }
            for (name, number) in end.numbers {
                self.plot(name, *number);
            }
        }
        self.held_steps += 1;
        let is_time = self.held_steps >= HELD_STEPS
            || self.held_bytes() >= HELD_BYTES
            || self.last_sent.elapsed() >= HELD_FOR;
        if is_time { self.send() } else { Ok(()) }
    }

    fn plot(&mut self, name: &str, number: f64) {
        if !self.numbers.contains_key(name) {
            let path = format!("{}/metrics/{name}", self.name);
            let numbers = Numbers::new(&path, format!("{} {name}", self.name), self.colour);
            self.numbers.insert(name.to_owned(), numbers);
        }
        if let Some(numbers) = self.numbers.get_mut(name) {
            numbers.push(number, &self.now);
        }
    }

    fn held_bytes(&self) -> usize {
        self.belief.held_bytes()
            + self.graph.held_bytes()
            + self.corrected.held_bytes()
            + self.happened.held_bytes()
            + self.truth.held_bytes()
    }

    fn send(&mut self) -> Result<(), InstrumentError> {
        self.held_steps = 0;
        self.last_sent = Instant::now();
        self.truth.send(&self.stream)?;
        self.belief.send(&self.stream)?;
        self.graph.send(&self.stream)?;
        self.corrected.send(&self.stream)?;
        self.planner.send(&self.stream)?;
        self.happened.send(&self.stream)?;
        self.quarrels.send(&self.stream)?;
        self.numbers.values_mut().try_for_each(|numbers| numbers.send(&self.stream))
    }
}
