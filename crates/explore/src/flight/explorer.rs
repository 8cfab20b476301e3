//! The loop in space: one robot, the map that steers it, and maps that ride along.

use maps3d::{FrontierPatch, Hovering, Map3d, MapTally};
use pose::Se3;
use posegraph::PoseGraph;
use probe::{IdVec, VertexId};
use sensing::FlyingRobot;
use std::collections::{BTreeMap, BTreeSet};

use super::later::Later;
use super::memory::{Target, Tries};
use super::panorama::{Lens, Panorama};
use super::viewpoint::Plan;
use super::ways::{Course, WaysTally};
use super::{FlightEvent, FlightGiveUp, FlightParams, FlightProbe};
use crate::{Ending, State};

/// What one step in space came to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlightReport {
    /// What the loop is doing now.
    pub state: State,
    /// How the run ended, once it has.
    pub ending: Option<Ending>,
    /// Where the robot believes that it hovers.
    pub hovering: Hovering,
    /// Odometry alone: the body in the frame of the first vertex.
    pub odom_from_body: Se3,
    /// What the steering map believes is left.
    pub tally: MapTally,
}

/// A flying robot's exploration: the pose graph, the maps, and what it is up to.
///
/// Sees observations and maps only; the truth is on the other side of [`FlyingRobot`].
pub struct FlightExplorer {
    pub(super) params: FlightParams,
    pub(super) graph: PoseGraph<Se3>,
    /// The first map steers; the others are fed the same looks and edges.
    pub(super) maps: Vec<Box<dyn Map3d + Send>>,
    pub(super) hovering: Hovering,
    /// Odometry alone, by vertex.
    pub(super) odometry: IdVec<VertexId, Se3>,
    pub(super) seen: IdVec<VertexId, Panorama>,
    pub(super) lens: Option<Lens>,
    pub(super) state: State,
    pub(super) started: bool,
    pub(super) ending: Option<Ending>,
    pub(super) steps: u64,
    pub(super) looks: u64,
    pub(super) refused_looks: u64,
    pub(super) place_edges: u64,
    pub(super) flown_m: f64,
    pub(super) backtracked_m: f64,
    pub(super) given_up: u64,
    /// By reason: area given up, and the largest piece, square metres.
    pub(super) given_up_by: BTreeMap<FlightGiveUp, (f64, f64)>,
    /// What is to be looked at from here, in the frame of the vertex.
    pub(super) targets: Vec<Target>,
    pub(super) looks_here: u32,
    /// Legs still to be flown, the last first.
    pub(super) way: Vec<(VertexId, f64)>,
    /// A way through views that is under way.
    pub(super) course: Option<Course>,
    pub(super) ways: WaysTally,
    /// What to do at the end of the way.
    pub(super) plan: Option<Plan>,
    pub(super) tries: Tries,
    /// By vertex: how often the robot came for its frontier in vain, and what was left.
    pub(super) visits: BTreeMap<VertexId, (u32, f64)>,
    pub(super) patches: Vec<FrontierPatch>,
    /// By vertex and place, what a straight flight keeps from everything.
    pub(super) margins_known: BTreeMap<(VertexId, [u64; 3]), u8>,
    pub(super) later: Later,
    /// Vertices whose frontier was held against farther views, by round.
    pub(super) held_farther: BTreeSet<(u32, VertexId)>,
}

impl FlightExplorer {
    /// An explorer that has not started yet; the first of `maps` steers.
    pub fn new(maps: Vec<Box<dyn Map3d + Send>>, params: FlightParams) -> Self {
        Self {
            params,
            graph: PoseGraph::new(),
            maps,
            hovering: Hovering { vertex: VertexId(0), vertex_from_body: Se3::identity() },
            odometry: IdVec::new(),
            seen: IdVec::new(),
            lens: None,
            state: State::Reactive,
            started: false,
            ending: None,
            steps: 0,
            looks: 0,
            refused_looks: 0,
            place_edges: 0,
            flown_m: 0.0,
            backtracked_m: 0.0,
            given_up: 0,
            given_up_by: BTreeMap::new(),
            targets: Vec::new(),
            looks_here: 0,
            way: Vec::new(),
            course: None,
            ways: WaysTally::default(),
            plan: None,
            tries: Tries::default(),
            visits: BTreeMap::new(),
            patches: Vec::new(),
            margins_known: BTreeMap::new(),
            later: Later::default(),
            held_farther: BTreeSet::new(),
        }
    }

    /// Does one action: a turn with a look, a flight with a look, or a leg of a way.
    ///
    /// The first step founds the first vertex. After the end of the run nothing happens any more.
    pub fn step(
        &mut self,
        robot: &mut dyn FlyingRobot,
        probe: &mut dyn FlightProbe,
    ) -> FlightReport {
        if self.ending.is_none() {
            self.steps += 1;
            if self.started {
                self.act(robot, probe);
            } else {
                self.started = true;
                self.found_vertex(robot, None, probe);
                self.look(robot, probe);
            }
            if self.ending.is_none() && self.steps >= self.params.max_steps {
                self.finish(Ending::StepLimit, probe);
            }
        }
        self.report()
    }

    /// What the last step came to.
    pub fn report(&self) -> FlightReport {
        let odom_from_vertex = self.odometry.get(self.hovering.vertex).copied().unwrap_or_default();
        FlightReport {
            state: self.state,
            ending: self.ending,
            hovering: self.hovering,
            odom_from_body: odom_from_vertex * self.hovering.vertex_from_body,
            tally: self.maps.first().map_or_else(MapTally::default, |map| map.tally()),
        }
    }

    /// The pose graph.
    pub fn graph(&self) -> &PoseGraph<Se3> {
        &self.graph
    }

    /// The maps; the first steers.
    pub fn maps(&self) -> &[Box<dyn Map3d + Send>] {
        &self.maps
    }

    /// The maps, to be asked; what is done to the first one steers.
    pub fn maps_mut(&mut self) -> &mut [Box<dyn Map3d + Send>] {
        &mut self.maps
    }

    /// Steps taken, the first included.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Depth images taken.
    pub fn looks(&self) -> u64 {
        self.looks
    }

    /// Depth images that a map could make nothing of, and left out.
    pub fn refused_looks(&self) -> u64 {
        self.refused_looks
    }

    /// Place edges added.
    pub fn place_edges(&self) -> u64 {
        self.place_edges
    }

    /// Pieces of frontier given up.
    pub fn given_up(&self) -> u64 {
        self.given_up
    }

    /// Area of the frontier that was given up for a reason, and of the largest piece of it, square metres.
    pub fn given_up_m2(&self, why: FlightGiveUp) -> (f64, f64) {
        self.given_up_by.get(&why).copied().unwrap_or_default()
    }

    /// Ways through views: sought, found, flown.
    pub fn ways(&self) -> WaysTally {
        self.ways
    }

    /// Share of the distance that was flown along known ways.
    pub fn backtracking_share(&self) -> f64 {
        if self.flown_m > 0.0 { self.backtracked_m / self.flown_m } else { 0.0 }
    }

    /// Odometry alone: each vertex in the frame of the first.
    pub fn odom_from_vertices(&self) -> &[Se3] {
        self.odometry.as_slice()
    }

    pub(super) fn change_state(&mut self, to: State, probe: &mut dyn FlightProbe) {
        if self.state != to {
            probe.emit(FlightEvent::StateChanged { from: self.state, to });
            self.state = to;
        }
    }

    pub(super) fn finish(&mut self, ending: Ending, probe: &mut dyn FlightProbe) {
        self.change_state(State::Done, probe);
        self.ending = Some(ending);
        probe.emit(FlightEvent::Finished { ending });
    }
}
