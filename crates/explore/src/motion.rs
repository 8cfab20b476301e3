//! What the robot can be made to do, each ending with a scan that all maps get.

use pose::Se2;
use posegraph::EdgeKind;
use probe::{EdgeId, VertexId};
use sensing::Robot;

use crate::{ExploreProbe, Explorer, GraphEvent, PlannerEvent};

impl Explorer {
    /// Turns without a scan.
    pub(crate) fn turn(
        &mut self,
        robot: &mut dyn Robot,
        angle_rad: f64,
        probe: &mut dyn ExploreProbe,
    ) {
        let odometry = robot.turn(angle_rad);
        self.standing.vertex_from_body =
            self.standing.vertex_from_body * odometry.before_from_after;
        probe.emit(PlannerEvent::Turned { angle_rad });
    }

    /// Scans where the robot stands; the scan belongs to the vertex there.
    pub(crate) fn scan(&mut self, robot: &mut dyn Robot, probe: &mut dyn ExploreProbe) {
        let scan = robot.scan();
        self.scans += 1;
        for map in &mut self.maps {
            map.scanned(&self.standing, &scan, &mut *probe);
        }
    }

    /// Drives straight ahead, founds a vertex there, recognises places and scans.
    pub(crate) fn forward(
        &mut self,
        robot: &mut dyn Robot,
        distance_m: f64,
        probe: &mut dyn ExploreProbe,
    ) {
        let odometry = robot.forward(distance_m);
        self.driven_m += odometry.distance_m;
        probe.emit(PlannerEvent::Drove { distance_m: odometry.distance_m });
        match odometry.snapped {
            Some((vertex, vertex_from_body)) => {
                self.standing.vertex = vertex;
                self.standing.vertex_from_body = vertex_from_body;
                self.odom_from_vertex = self.odometry_of(vertex);
            }
            None => {
                let here_from_there = self.standing.vertex_from_body * odometry.before_from_after;
                self.found_vertex(robot, Some(here_from_there), probe);
            }
        }
        self.scan(robot, probe);
    }

    /// Repeats one link of the graph; scans at its end unless told not to.
    pub(crate) fn repeat(
        &mut self,
        robot: &mut dyn Robot,
        to: VertexId,
        length_m: f64,
        scan: bool,
        probe: &mut dyn ExploreProbe,
    ) {
        let from = self.standing.vertex;
        let repeated = robot.repeat(to, length_m);
        self.driven_m += repeated.distance_m;
        self.backtracked_m += repeated.distance_m;
        self.standing.vertex = repeated.vertex;
        self.standing.vertex_from_body = repeated.vertex_from_body;
        self.odom_from_vertex = self.odometry_of(repeated.vertex);
        probe.emit(PlannerEvent::LegRepeated { from, to, length_m: repeated.distance_m });
        if scan {
            self.scan(robot, probe);
        }
    }

    /// Adds the vertex where the robot stands, its odometry edge, and the places it recognises.
    pub(crate) fn found_vertex(
        &mut self,
        robot: &mut dyn Robot,
        here_from_there: Option<Se2>,
        probe: &mut dyn ExploreProbe,
    ) {
        let before = self.standing.vertex;
        let vertex = self.graph.add_vertex();
        robot.mark(vertex);
        let odom_from_vertex = match here_from_there {
            Some(step) => self.odometry_of(before) * step,
            None => Se2::identity(),
        };
        self.odometry.push(odom_from_vertex);
        self.odom_from_vertex = odom_from_vertex;
        self.standing.vertex = vertex;
        self.standing.vertex_from_body = Se2::identity();
        probe.emit(GraphEvent::VertexAdded { vertex, odom_from_vertex });
        let mut edges: Vec<EdgeId> = Vec::new();
        if let Some(step) = here_from_there {
            edges.extend(self.add_edge(before, vertex, step, EdgeKind::Odometry, probe));
        }
        for place in robot.recognize() {
            let kind = EdgeKind::Place;
            let edge = self.add_edge(place.vertex, vertex, place.known_from_current, kind, probe);
            self.place_edges += u64::from(edge.is_some());
            edges.extend(edge);
        }
        if self.maps.first().is_some_and(|map| map.has_frontier_by_vertex()) {
            let radius_m = self.params.policy.rapid().step_m;
            self.rapid.haunts.found(&self.graph, vertex, &edges, radius_m);
        }
        for map in &mut self.maps {
            map.edges_added(&self.graph, &edges, &mut *probe);
        }
    }

    /// Adds an edge to the graph; one that the graph refuses is left out.
    fn add_edge(
        &mut self,
        a: VertexId,
        b: VertexId,
        a_from_b: Se2,
        kind: EdgeKind,
        probe: &mut dyn ExploreProbe,
    ) -> Option<EdgeId> {
        let edge = self.graph.add_edge(a, b, a_from_b, kind).ok()?;
        probe.emit(GraphEvent::EdgeAdded { edge, kind, a, b, a_from_b });
        Some(edge)
    }

    fn odometry_of(&self, vertex: VertexId) -> Se2 {
        self.odometry.get(vertex).copied().unwrap_or_default()
    }
}
