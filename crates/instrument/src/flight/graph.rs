//! The pose graph, each vertex where odometry alone puts it.

use geometry::Point3;
use pose::Se3;
use posegraph::EdgeKind;
use probe::{IdVec, VertexId};

use super::ink::{Ink, dots, lines};
use crate::palette;

/// What is drawn under `graph/`, in the world frame, from the true start.
#[derive(Default)]
pub(super) struct Graph {
    world_from_vertex: IdVec<VertexId, Se3>,
    odometry: Vec<Vec<Point3>>,
    places: Vec<Vec<Point3>>,
}

impl Graph {
    pub(super) fn vertex(&mut self, world_from_vertex: Se3) {
        self.world_from_vertex.push(world_from_vertex);
    }

    pub(super) fn edge(&mut self, kind: EdgeKind, a: VertexId, b: VertexId) {
        let at = |vertex| self.world_from_vertex.get(vertex).map(|pose| pose.translation.into());
        let (Some(a), Some(b)) = (at(a), at(b)) else { return };
        match kind {
            EdgeKind::Odometry => self.odometry.push(vec![a, b]),
            EdgeKind::Place => self.places.push(vec![a, b]),
        }
    }

    /// Draws the graph as it is now.
    pub(super) fn draw(&self, ink: &mut Ink) {
        let at: Vec<Point3> =
            self.world_from_vertex.as_slice().iter().map(|p| p.translation.into()).collect();
        ink.draw("graph/vertices", &dots(&at, &[palette::ODOMETRY], 2.5));
        ink.draw("graph/odometry", &lines(&self.odometry, palette::ODOMETRY, 1.0));
        ink.draw("graph/places", &lines(&self.places, palette::PLACE, 1.2));
    }
}
