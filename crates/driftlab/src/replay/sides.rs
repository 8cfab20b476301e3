//! The maps that a log feeds side by side, each with the graph that its kind stands on.

use std::time::{Duration, Instant};

use explore::GraphEvent;
use formats::log::DecisionMessage;
use instrument::Recorder;
use maps2d::relative::RelativeMap;
use maps2d::{ExplorationMap, MapProbe, Standing};
use pose::Se2;
use posegraph::{EdgeKind, PoseGraph};
use probe::{EdgeId, Probe, VertexId};
use sensing::Scan;

use crate::config::Config;
use crate::export::tell;
use crate::run::{AtWork, CorrectionTiming, TimedProbe, TruePoses, map_of};

/// Memory is asked for every so many keyframes: the answer costs a walk over the map.
const MEMORY_EVERY: u64 = 64;

/// What a map is told of where vertices are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Told {
    /// All that was measured: steps and recognised places.
    Measured,
    /// The log's odometry, and nothing else.
    Wheels,
    /// Steps, and from time to time the optimised poses of all vertices.
    Settled,
}

impl Told {
    /// What maps of a kind are told where the graph is made from scans.
    fn of_kind(kind: &str) -> Self {
        match kind {
            "grid" => Self::Wheels,
            "grid_corrected" | "corrected_polygons" => Self::Settled,
            _ => Self::Measured,
        }
    }

    /// How many of the recognised places reach such a map, as edges or by way of optimised poses.
    pub fn places_of(self, recognised: u64) -> u64 {
        match self {
            Self::Measured | Self::Settled => recognised,
            Self::Wheels => 0,
        }
    }
}

/// An edge before it is in a graph.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct NewEdge {
    pub a: VertexId,
    pub b: VertexId,
    pub kind: EdgeKind,
    pub a_from_b: Se2,
}

/// A map; the relative one can be looked into.
pub(super) enum Held {
    Relative(Box<RelativeMap>),
    Other(Box<dyn ExplorationMap + Send>),
}

impl Held {
    pub fn map(&self) -> &dyn ExplorationMap {
        match self {
            Self::Relative(map) => map.as_ref(),
            Self::Other(map) => map.as_ref(),
        }
    }

    fn map_mut(&mut self) -> &mut dyn ExplorationMap {
        match self {
            Self::Relative(map) => map.as_mut(),
            Self::Other(map) => map.as_mut(),
        }
    }
}

/// One map, and what it cost so far.
pub(super) struct Side {
    pub name: &'static str,
    pub held: Held,
    pub told: Told,
    pub recorder: Recorder,
    /// Time of each keyframe, microseconds.
    pub micros: Vec<f64>,
    pub corrections: Vec<CorrectionTiming>,
    pub bytes_peak: u64,
    spent: Duration,
}

impl Side {
    /// Does a piece of the map's work, and takes its time without what listening took.
    fn work(&mut self, step: u64, work: impl FnOnce(&mut dyn ExplorationMap, &mut dyn MapProbe)) {
        let before = self.held.map().corrections();
        let at_work = AtWork::new(0);
        let mut heard = TimedProbe::new(&mut self.recorder, &at_work, 0);
        let start = Instant::now();
        work(self.held.map_mut(), &mut heard);
        let spent = start.elapsed().saturating_sub(heard.spent);
        self.spent += spent;
        if self.held.map().corrections() > before {
            self.corrections.push(CorrectionTiming { step, secs: spent.as_secs_f64() });
        }
    }
}

/// All maps of a replay.
pub(super) struct Sides {
    pub all: Vec<Side>,
    step: u64,
    measured: PoseGraph,
    wheels: PoseGraph,
    steps: PoseGraph,
}

impl Sides {
    /// The maps of a config. With the log's own graph every map is told all of it, as in the run.
    pub fn new(
        config: &Config,
        own_graph: bool,
        mut recorder: impl FnMut(&'static str) -> Recorder,
    ) -> Self {
        let mut all = Vec::new();
        for name in config.map.keys() {
            let held = match config.relative_params().filter(|_| name == "relative") {
                Some(params) => Held::Relative(Box::new(RelativeMap::new(params))),
                None => match map_of(config, name, &TruePoses::default()) {
                    Some(map) => Held::Other(map),
                    None => continue,
                },
            };
            let told = if own_graph { Told::Measured } else { Told::of_kind(name) };
            all.push(Side {
                name,
                held,
                told,
                recorder: recorder(name),
                micros: Vec::new(),
                corrections: Vec::new(),
                bytes_peak: 0,
                spent: Duration::ZERO,
            });
        }
        let empty = PoseGraph::new;
        Self { all, step: 0, measured: empty(), wheels: empty(), steps: empty() }
    }

    /// Everything that was measured.
    pub fn graph(&self) -> &PoseGraph {
        &self.measured
    }

    /// The relative map, if it is one of them.
    pub fn relative(&self) -> Option<&RelativeMap> {
        self.all.iter().find_map(|side| match &side.held {
            Held::Relative(map) => Some(map.as_ref()),
            Held::Other(_) => None,
        })
    }

    /// Starts a step: distance in metres, time in seconds since the start of the log.
    pub fn begin(&mut self, step: u64, distance_m: f64, time_secs: f64) {
        self.step = step;
        for side in &mut self.all {
            side.recorder.begin_step(step, distance_m, time_secs);
        }
    }

    /// Adds a vertex to every graph; `odom_from_vertex` is where the log's odometry has it.
    pub fn vertex(&mut self, odom_from_vertex: Se2) -> VertexId {
        let vertex = self.measured.add_vertex();
        self.wheels.add_vertex();
        self.steps.add_vertex();
        for side in &mut self.all {
            side.recorder.emit(GraphEvent::VertexAdded { vertex, odom_from_vertex });
        }
        vertex
    }

    /// Adds edges that have one vertex in common to what is told, and tells the maps.
    pub fn edges(&mut self, told: Told, edges: &[NewEdge]) {
        let graph = match told {
            Told::Measured => &mut self.measured,
            Told::Wheels => &mut self.wheels,
            Told::Settled => &mut self.steps,
        };
        let mut ids: Vec<EdgeId> = Vec::new();
        for NewEdge { a, b, kind, a_from_b } in edges.iter().copied() {
            // What the graph refuses is no measurement.
            let Ok(edge) = graph.add_edge(a, b, a_from_b, kind) else { continue };
            ids.push(edge);
            for side in self.all.iter_mut().filter(|side| side.told == told) {
                side.recorder.emit(GraphEvent::EdgeAdded { edge, kind, a, b, a_from_b });
            }
        }
        for side in self.all.iter_mut().filter(|side| side.told == told) {
            side.work(self.step, |map, probe| map.edges_added(graph, &ids, probe));
        }
    }

    /// Whether any map lives by optimised poses.
    pub fn lives_by_poses(&self) -> bool {
        self.all.iter().any(|side| side.told == Told::Settled)
    }

    /// Hands the optimised poses of all vertices to the maps that live by them.
    pub fn settled(&mut self, map_from_vertex: &[Se2]) {
        for side in self.all.iter_mut().filter(|side| side.told == Told::Settled) {
            let start = side.spent;
            side.work(self.step, |map, probe| map.poses_reestimated(map_from_vertex, probe));
            let secs = (side.spent - start).as_secs_f64();
            side.corrections.push(CorrectionTiming { step: self.step, secs });
        }
    }

    /// Hands a scan to every map.
    pub fn scanned(&mut self, standing: &Standing, scan: &Scan) {
        for side in &mut self.all {
            side.work(self.step, |map, probe| map.scanned(standing, scan, probe));
        }
    }

    /// Tells the map that was told so in the run what the policy decided.
    pub fn decided(&mut self, message: &DecisionMessage) {
        for side in self.all.iter_mut().filter(|side| side.name == &*message.map) {
            side.work(self.step, |map, probe| tell(map, &message.map, &message.decision, probe));
        }
    }

    /// Ends the step: what it cost each map. Returns the time of the relative map, else of the first.
    pub fn end(&mut self) -> Duration {
        let ask_memory = self.step.is_multiple_of(MEMORY_EVERY);
        let told = self.all.iter().position(|side| matches!(side.held, Held::Relative(_)));
        let of_first = self.all.get(told.unwrap_or(0)).map_or(Duration::ZERO, |side| side.spent);
        for side in &mut self.all {
            side.micros.push(std::mem::take(&mut side.spent).as_secs_f64() * 1e6);
            if ask_memory {
                side.bytes_peak = side.bytes_peak.max(side.held.map().bytes() as u64);
            }
        }
        of_first
    }
}
