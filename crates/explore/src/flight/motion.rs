//! What the robot can be made to do.

use geometry::Point3;
use maps3d::{Hovering, Look};
use pose::Se3;
use posegraph::EdgeKind;
use probe::{EdgeId, VertexId};
use sensing::FlyingRobot;

use super::panorama::{Lens, Panorama};
use super::{FlightEvent, FlightExplorer, FlightProbe};

impl FlightExplorer {
    /// Turns to a yaw in the frame of the vertex.
    pub(super) fn turn_to(
        &mut self,
        robot: &mut dyn FlyingRobot,
        yaw_rad: f64,
        probe: &mut dyn FlightProbe,
    ) {
        let now_rad = self.yaw_rad();
        let by_rad = pose::wrap_angle(yaw_rad - now_rad);
        if by_rad.abs() > 1e-9 {
            let flight = robot.turn(by_rad);
            self.hovering.vertex_from_body =
                self.hovering.vertex_from_body * flight.before_from_after;
            probe.emit(FlightEvent::Turned { yaw_rad: by_rad });
        }
    }

    /// The yaw of the body in the frame of the vertex, radians.
    pub(super) fn yaw_rad(&self) -> f64 {
        self.hovering.vertex_from_body.rotation.euler_angles().2
    }

    /// Takes a depth image where the robot hovers and hands it to all maps.
    pub(super) fn look(&mut self, robot: &mut dyn FlyingRobot, probe: &mut dyn FlightProbe) {
        let image = robot.look();
        let body_from_camera = robot.body_from_camera();
        let vertex_from_camera = self.hovering.vertex_from_body * body_from_camera;
        self.looks += 1;
        self.looks_here += 1;
        let farthest = image.depths_m.iter().copied().filter(|d| d.is_finite()).fold(0.0, f32::max);
        let before_m = self.lens.map_or(0.0, |lens| lens.far_m);
        self.lens = Some(Lens {
            body_from_camera,
            camera: image.camera,
            columns: image.columns,
            rows: image.rows(),
            far_m: before_m.max(farthest.into()),
        });
        let hovering = self.hovering;
        probe.emit(FlightEvent::Looked { hovering, vertex_from_camera, image: &image });
        let yaw_rad = self.yaw_rad();
        if let Some(seen) = self.seen.get_mut(hovering.vertex) {
            seen.add(yaw_rad, vertex_from_camera, &image);
        }
        let vertex = hovering.vertex;
        // Another look changes what is known of flights from here, and of no others.
        let of_vertex = (vertex, [u64::MIN; 3])..=(vertex, [u64::MAX; 3]);
        let stale: Vec<_> = self.margins_known.range(of_vertex).map(|(key, _)| *key).collect();
        for key in stale {
            self.margins_known.remove(&key);
        }
        let look = Look { vertex: hovering.vertex, vertex_from_camera, image: &image };
        for map in &mut self.maps {
            self.refused_looks += u64::from(map.looked(&look, &mut *probe).is_err());
        }
    }

    /// Flies straight to a place in the frame of the vertex, founds a vertex there and recognises places.
    pub(super) fn fly_to(
        &mut self,
        robot: &mut dyn FlyingRobot,
        place_in_vertex: &Point3,
        probe: &mut dyn FlightProbe,
    ) {
        let by_in_body = self.hovering.vertex_from_body.inverse_transform(place_in_vertex).coords;
        let flight = robot.fly(&by_in_body);
        self.flown_m += flight.distance_m;
        probe.emit(FlightEvent::Flew { distance_m: flight.distance_m });
        let here_from_there = self.hovering.vertex_from_body * flight.before_from_after;
        self.found_vertex(robot, Some(here_from_there), probe);
    }

    /// Repeats one link of the graph.
    pub(super) fn repeat(
        &mut self,
        robot: &mut dyn FlyingRobot,
        to: VertexId,
        length_m: f64,
        probe: &mut dyn FlightProbe,
    ) {
        let from = self.hovering.vertex;
        let returned = robot.repeat(to, length_m);
        self.flown_m += returned.distance_m;
        self.backtracked_m += returned.distance_m;
        self.hovering =
            Hovering { vertex: returned.vertex, vertex_from_body: returned.vertex_from_body };
        self.looks_here = 0;
        self.targets.clear();
        probe.emit(FlightEvent::LegRepeated { from, to, length_m: returned.distance_m });
    }

    /// Adds the vertex where the robot hovers, its odometry edge, and the places it recognises.
    pub(super) fn found_vertex(
        &mut self,
        robot: &mut dyn FlyingRobot,
        here_from_there: Option<Se3>,
        probe: &mut dyn FlightProbe,
    ) {
        let before = self.hovering.vertex;
        let vertex = self.graph.add_vertex();
        robot.mark(vertex);
        let odom_from_vertex = match here_from_there {
            Some(step) => self.odometry.get(before).copied().unwrap_or_default() * step,
            None => Se3::identity(),
        };
        self.odometry.push(odom_from_vertex);
        self.seen.push(Panorama::default());
        self.hovering = Hovering { vertex, vertex_from_body: Se3::identity() };
        self.looks_here = 0;
        probe.emit(FlightEvent::VertexAdded { vertex, odom_from_vertex });
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
        for map in &mut self.maps {
            map.edges_added(&self.graph, &edges, &mut *probe);
        }
    }

    /// Adds an edge to the graph; one that the graph refuses is left out.
    fn add_edge(
        &mut self,
        a: VertexId,
        b: VertexId,
        a_from_b: Se3,
        kind: EdgeKind,
        probe: &mut dyn FlightProbe,
    ) -> Option<EdgeId> {
        let edge = self.graph.add_edge(a, b, a_from_b, kind).ok()?;
        probe.emit(FlightEvent::EdgeAdded { edge, kind, a, b, a_from_b });
        Some(edge)
    }
}
