//! The listener of one flying robot and its map.

use maps3d::Hovering;
use metrics::{FlightWitness, VoxelCoverage};
use pose::Se3;
use probe::{IdVec, VertexId};
use worlds::World3d;

use super::FlightOptions;
use super::graph::Graph;
use super::ink::{Ink, placed};
use super::search::Searches;
use super::truth::{Truth, body};
use super::views::{ClosedFaces, Views};
use super::{looks, planner, union};
use crate::stage::Stage;
use crate::{Every, Family, InstrumentError, Level};

/// What there is at the end of a step of a flight.
pub struct FlightStep<'a> {
    /// Where the robot believes that it hovers.
    pub hovering: Hovering,
    /// Odometry alone: the body in the frame of the first vertex.
    pub odom_from_body: Se3,
    /// Distance flown, metres.
    pub distance_m: f64,
    /// The truth; none for a real robot.
    pub witness: Option<&'a FlightWitness>,
    /// The voxels first seen in this step.
    pub newly_seen: &'a [usize],
    /// What is plotted.
    pub numbers: &'a [(&'static str, f64)],
}

/// The recorder of one map of a flight: a probe, and what is drawn at the end of each step.
///
/// Truth is drawn in the world frame. Belief is drawn where the map believes: around the vertex where the
/// robot hovers for a map without a global frame, else from the true start.
pub struct FlightRecorder {
    pub(super) ink: Ink,
    pub(super) level: Level,
    every: Every,
    pub(super) around_robot: bool,
    step: u64,
    event: i64,
    pub(super) world_from_start: Se3,
    pub(super) odom_from_vertex: IdVec<VertexId, Se3>,
    pub(super) graph: Graph,
    pub(super) graph_grew: bool,
    truth: Truth,
    pub(super) views: Views,
    pub(super) closed: Option<ClosedFaces>,
    pub(super) planned: bool,
    pub(super) searches: Searches,
    /// Where the robot hovers.
    pub(super) here: VertexId,
}

impl FlightRecorder {
    pub(super) fn new(stage: Option<Stage>, name: &str, options: &FlightOptions) -> Self {
        Self {
            ink: Ink::new(stage, name),
            level: options.level,
            every: options.every,
            around_robot: FlightOptions::is_around_robot(name),
            step: 0,
            event: -1,
            world_from_start: Se3::identity(),
            odom_from_vertex: IdVec::new(),
            graph: Graph::default(),
            graph_grew: false,
            truth: Truth::default(),
            views: Views::default(),
            closed: None,
            planned: false,
            searches: Searches::new(FlightOptions::is_around_robot(name)),
            here: VertexId(0),
        }
    }

    /// Whether a family is recorded at this step, by the rule of the options.
    pub(super) fn takes(&self, family: Family) -> bool {
        self.ink.is_on() && self.every.takes(family, self.step)
    }

    /// Draws the place, once and before the first step.
    ///
    /// # Errors
    /// [`InstrumentError::Rows`].
    pub fn place(
        &mut self,
        world: &World3d,
        coverage: &VoxelCoverage,
    ) -> Result<(), InstrumentError> {
        self.world_from_start = world.world_from_start();
        if self.ink.is_on() {
            self.truth.place(&mut self.ink, world, coverage);
            body(&mut self.ink, "truth/robot", 0.2);
            body(&mut self.ink, "belief/robot", 0.2);
            if !self.around_robot {
                union::place(&mut self.ink, &self.world_from_start);
            }
        }
        self.ink.take_refusal()
    }

    /// Instead of a place: the images come from a log, of which nobody knows more. Once, before the first step.
    pub fn without_place(&mut self) {
        if self.ink.is_on() {
            body(&mut self.ink, "belief/robot", 0.05);
        }
    }

    /// A step starts; all events until its end belong to it.
    pub fn begin_step(&mut self, step: u64, distance_m: f64) {
        self.step = step;
        #[expect(clippy::cast_possible_truncation, reason = "millimetres of a flight")]
        self.ink.times(&[("step", step as i64), ("distance_mm", (distance_m * 1e3) as i64)]);
        if self.planned {
            planner::wipe(&mut self.ink);
            self.planned = false;
        }
        self.searches.wipe(&mut self.ink);
    }

    /// Goes to the next event of the timeline `event`.
    pub(super) fn next_event(&mut self) {
        self.event += 1;
        self.ink.times(&[("event", self.event)]);
    }

    /// Draws what there is at the end of a step.
    ///
    /// # Errors
    /// [`InstrumentError::Rows`].
    pub fn end_step(&mut self, end: &FlightStep<'_>) -> Result<(), InstrumentError> {
        if !self.ink.is_on() {
            return Ok(());
        }
        #[expect(clippy::cast_possible_truncation, reason = "millimetres of a flight")]
        self.ink.times(&[("distance_mm", (end.distance_m * 1e3) as i64)]);
        if self.takes(Family::Truth) {
            if let Some(witness) = end.witness {
                self.truth.step(&mut self.ink, witness, end.newly_seen);
            }
            for (name, value) in end.numbers {
                self.ink.plot(name, *value);
            }
            self.ink.plot("distance_m", end.distance_m);
        }
        if self.takes(Family::PoseGraph) && std::mem::take(&mut self.graph_grew) {
            self.graph.draw(&mut self.ink);
        }
        if self.around_robot {
            self.ink.plot("views_in_scope", self.views.in_scope() as f64);
        }
        self.here = end.hovering.vertex;
        let drawn_from_body =
            self.drawn_from_vertex(end.hovering.vertex) * end.hovering.vertex_from_body;
        self.ink.draw("belief/robot", &placed(&drawn_from_body));
        self.ink.take_refusal()
    }

    /// A vertex in the frame in which the belief is drawn: by the last scope, for a map around the robot.
    pub(super) fn drawn_from_vertex(&self, vertex: VertexId) -> Se3 {
        match self.around_robot {
            true => self.views.root_from_vertex(vertex).unwrap_or_default(),
            false => {
                let odom = self.odom_from_vertex.get(vertex).copied().unwrap_or_default();
                self.world_from_start * odom
            }
        }
    }

    /// Draws what the camera sees, where it is, and that the last view belongs there.
    pub(super) fn looked(
        &mut self,
        hovering: &Hovering,
        vertex_from_camera: &Se3,
        image: &sensing::DepthImage,
    ) {
        looks::image(&mut self.ink, image);
        let drawn_from_vertex = self.drawn_from_vertex(hovering.vertex);
        let drawn_from_camera = drawn_from_vertex * *vertex_from_camera;
        looks::camera(&mut self.ink, "belief/camera", &drawn_from_camera, image);
        looks::place_look(&mut self.ink, &drawn_from_vertex, vertex_from_camera);
    }

    /// Sends everything that is still held.
    ///
    /// # Errors
    /// [`InstrumentError::Rows`].
    pub fn send(&mut self) -> Result<(), InstrumentError> {
        self.ink.take_refusal()
    }
}
