//! How the pose graph grew, drawn by odometry alone.

use geometry::Point2;
use posegraph::EdgeKind;
use probe::{EdgeId, Id, VertexId};
use rerun::RecordingStream;

use super::places::Places;
use crate::InstrumentError;
use crate::columns::{Growing, Lines, Now, Points};
use crate::palette;

/// Rows of `graph/..`.
pub(super) struct Graph {
    vertices: Growing<Points>,
    odometry: Growing<Lines>,
    places: Growing<Lines>,
    withdrawn: Growing<Lines>,
    scope: Lines,
    route: Lines,
    robot: Lines,
    ends: Vec<Option<(VertexId, VertexId)>>,
    links: Vec<(Point2, Point2)>,
    scope_is_new: bool,
    /// Place edges that are not withdrawn, for the plots.
    pub place_edges: usize,
}

impl Graph {
    pub fn new(name: &str) -> Self {
        let lines = |what: &str, radius: f32, order: f32| {
            let path = format!("{name}/graph/{what}");
            Growing::new(move |part| Lines::new(format!("{path}/{part}"), radius, order))
        };
        let vertices = format!("{name}/graph/vertices");
        Self {
            odometry: lines("odometry", -0.9, 10.0),
            places: lines("places", -0.6, 9.0),
            withdrawn: lines("withdrawn", -1.4, 12.0),
            vertices: Growing::new(move |part| {
                Points::new(format!("{vertices}/{part}"), -1.8, 11.0)
            }),
            scope: Lines::new(format!("{name}/graph/scope_tree"), -2.6, 5.0),
            route: Lines::new(format!("{name}/graph/route"), -2.2, 20.0),
            robot: Lines::new(format!("{name}/graph/robot"), -1.6, 40.0),
            ends: Vec::new(),
            links: Vec::new(),
            scope_is_new: false,
            place_edges: 0,
        }
    }

    pub fn vertex(&mut self, vertex: VertexId, places: &Places) {
        let at = Point2::from(places.by_odometry(vertex).translation);
        self.vertices.push(&at, &at, palette::ODOMETRY);
    }

    pub fn edge(&mut self, edge: EdgeId, kind: EdgeKind, a: VertexId, b: VertexId, at: &Places) {
        let [from, to] = [a, b].map(|v| Point2::from(at.by_odometry(v).translation));
        match kind {
            EdgeKind::Odometry => self.odometry.push(&from, &to, palette::ODOMETRY),
            EdgeKind::Place => {
                self.place_edges += 1;
                self.places.push(&from, &to, palette::PLACE);
            }
        }
        if self.ends.len() <= edge.index() {
            self.ends.resize(edge.index() + 1, None);
        }
        self.ends[edge.index()] = Some((a, b));
    }

    pub fn withdraw(&mut self, edge: EdgeId, places: &Places) {
        if let Some((a, b)) = self.ends.get(edge.index()).copied().flatten() {
            let [from, to] = [a, b].map(|v| Point2::from(places.by_odometry(v).translation));
            self.withdrawn.push(&from, &to, palette::WITHDRAWN);
            self.place_edges -= 1;
        }
    }

    /// The ends of an edge that was added.
    pub fn ends(&self, edge: EdgeId) -> Option<(VertexId, VertexId)> {
        self.ends.get(edge.index()).copied().flatten()
    }

    /// Takes over the tree of the scope; the last one of a step is drawn.
    pub fn scope(&mut self, links: impl Iterator<Item = (Point2, Option<Point2>)>) {
        self.links.clear();
        self.links.extend(links.filter_map(|(at, parent)| Some((at, parent?))));
        self.scope_is_new = true;
    }

    /// Takes over the way that was planned.
    pub fn route(&mut self, way: impl IntoIterator<Item = Point2>) {
        self.route.strip(way, palette::ROUTE);
    }

    /// Leaves the step out; what was added is drawn with the next one that is not.
    pub fn skip_step(&mut self) {
        self.route.forget();
    }

    /// Ends the step.
    pub fn end_step(&mut self, odom_from_body: &pose::Se2, now: &Now) {
        self.vertices.end_row(now);
        self.odometry.end_row(now);
        self.places.end_row(now);
        self.withdrawn.end_row(now);
        if std::mem::take(&mut self.scope_is_new) {
            for (from, to) in &self.links {
                self.scope.segment(from, to, palette::SCOPE);
            }
            self.scope.end_row(now);
        }
        self.route.end_row(now);
        super::draw_robot(&mut self.robot, odom_from_body);
        self.robot.end_row(now);
    }

    pub fn held_bytes(&self) -> usize {
        self.vertices.held_bytes()
            + self.odometry.held_bytes()
            + self.places.held_bytes()
            + self.scope.held_bytes()
    }

    pub fn send(&mut self, stream: &RecordingStream) -> Result<(), InstrumentError> {
        self.vertices.send(stream)?;
        self.odometry.send(stream)?;
        self.places.send(stream)?;
        self.withdrawn.send(stream)?;
        self.scope.send(stream)?;
        self.route.send(stream)?;
        self.robot.send(stream)
    }
}
