//! The loop: one robot, the map that steers it, and maps that ride along.

use maps2d::{Candidate, ExplorationMap, Frontier, Standing};
use pose::Se2;
use posegraph::PoseGraph;
use probe::{IdVec, VertexId};
use sensing::Robot;

use crate::{Ending, ExploreParams, ExploreProbe, PlannerEvent, State};

/// What one step came to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepReport {
    /// What the loop is doing now.
    pub state: State,
    /// How the run ended, once it has.
    pub ending: Option<Ending>,
    /// Where the robot believes that it stands.
    pub standing: Standing,
    /// Odometry alone: the body in the frame of the first vertex.
    pub odom_from_body: Se2,
    /// What the steering map believes is left.
    pub frontier: Frontier,
}

/// A robot's exploration: the pose graph, the maps, and what the policy is up to.
///
/// Sees observations and maps only; the truth is on the other side of [`Robot`].
pub struct Explorer {
    pub(crate) params: ExploreParams,
    pub(crate) graph: PoseGraph,
    /// The first map steers; the others are fed the same scans and edges.
    pub(crate) maps: Vec<Box<dyn ExplorationMap + Send>>,
    pub(crate) standing: Standing,
    /// Odometry alone, by vertex.
    pub(crate) odometry: IdVec<VertexId, Se2>,
    pub(crate) odom_from_vertex: Se2,
    pub(crate) state: State,
    pub(crate) started: bool,
    pub(crate) ending: Option<Ending>,
    pub(crate) steps: u64,
    pub(crate) scans: u64,
    pub(crate) place_edges: u64,
    pub(crate) backtracked_m: f64,
    pub(crate) driven_m: f64,
    pub(crate) rapid: crate::rapid::Memory,
    pub(crate) candidates: Vec<Candidate>,
}

impl Explorer {
    /// An explorer that has not started yet; the first of `maps` steers.
    pub fn new(maps: Vec<Box<dyn ExplorationMap + Send>>, params: ExploreParams) -> Self {
        Self {
            params,
            graph: PoseGraph::new(),
            maps,
            standing: Standing { vertex: VertexId(0), vertex_from_body: Se2::identity() },
            odometry: IdVec::new(),
            odom_from_vertex: Se2::identity(),
            state: State::Reactive,
            started: false,
            ending: None,
            steps: 0,
            scans: 0,
            place_edges: 0,
            backtracked_m: 0.0,
            driven_m: 0.0,
            rapid: crate::rapid::Memory::default(),
            candidates: Vec::new(),
        }
    }

    /// Does one action that ends with a scan: a planned turn, a move, or a leg of a way.
    ///
    /// The first step founds the first vertex. After the end of the run nothing happens any more.
    pub fn step(&mut self, robot: &mut dyn Robot, probe: &mut dyn ExploreProbe) -> StepReport {
        if self.ending.is_none() {
            self.steps += 1;
            if !self.started {
                self.started = true;
                self.found_vertex(robot, None, probe);
                self.scan(robot, probe);
            } else {
                self.act(robot, probe);
            }
            if self.ending.is_none() && self.steps >= self.params.max_steps {
                self.finish(Ending::StepLimit, probe);
            }
        }
        self.report()
    }

    /// What the last step came to.
    pub fn report(&self) -> StepReport {
        StepReport {
            state: self.state,
            ending: self.ending,
            standing: self.standing,
            odom_from_body: self.odom_from_vertex * self.standing.vertex_from_body,
            frontier: self.maps.first().map_or_else(Frontier::default, |map| map.frontier()),
        }
    }

    /// The pose graph.
    pub fn graph(&self) -> &PoseGraph {
        &self.graph
    }

    /// The maps; the first steers.
    pub fn maps(&self) -> &[Box<dyn ExplorationMap + Send>] {
        &self.maps
    }

    /// The maps, to be asked; what is done to the first one steers.
    pub fn maps_mut(&mut self) -> &mut [Box<dyn ExplorationMap + Send>] {
        &mut self.maps
    }

    /// Steps taken, the first included.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Scans taken.
    pub fn scans(&self) -> u64 {
        self.scans
    }

    /// Place edges added.
    pub fn place_edges(&self) -> u64 {
        self.place_edges
    }

    /// Share of the distance that was driven along known ways.
    pub fn backtracking_share(&self) -> f64 {
        if self.driven_m > 0.0 { self.backtracked_m / self.driven_m } else { 0.0 }
    }

    pub(crate) fn change_state(&mut self, to: State, probe: &mut dyn ExploreProbe) {
        if self.state != to {
            probe.emit(PlannerEvent::StateChanged { from: self.state, to });
            self.state = to;
        }
    }

    pub(crate) fn finish(&mut self, ending: Ending, probe: &mut dyn ExploreProbe) {
        self.change_state(State::Done, probe);
        self.ending = Some(ending);
        probe.emit(PlannerEvent::Finished { ending });
    }

    fn act(&mut self, robot: &mut dyn Robot, probe: &mut dyn ExploreProbe) {
        self.act_rapid(robot, probe);
    }
}
