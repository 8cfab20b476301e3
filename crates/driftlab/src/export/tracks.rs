//! Trajectories and pose graphs for the programs that judge and optimise them.

use formats::log::{Stamp, spatial};
use formats::pose_graph::{self, AnyGraph, GraphFormat};
use formats::tum::{self, Trajectory};
use maps2d::correction::CorrectionParams;
use pose::Se2;
use posegraph::{EdgeKind, FactorGraph2};

use super::Fed;

/// The pose graph of a robot with its poses by odometry alone, and where the robot was at each scan.
#[derive(Clone, Debug)]
pub struct Tracks {
    noise: CorrectionParams,
    graph: FactorGraph2,
    odometry: Trajectory,
    reference: Trajectory,
}

impl Tracks {
    /// Nothing yet; `noise` is what the information matrices of edges come from.
    pub fn new(noise: CorrectionParams) -> Self {
        Self {
            noise,
            graph: FactorGraph2 { fixed: vec![0], ..FactorGraph2::default() },
            odometry: Trajectory::default(),
            reference: Trajectory::default(),
        }
    }

    /// Frame of a vertex in the frame of the first one, by odometry alone.
    pub fn odom_from_vertex(&self, vertex: usize) -> Se2 {
        self.graph.initial.get(vertex).copied().flatten().unwrap_or_default()
    }

    /// Vertices so far.
    pub fn vertices(&self) -> usize {
        self.graph.ids.len()
    }

    /// Takes what the maps were fed; before it is written anywhere else.
    pub fn fed(&mut self, at: Stamp, fed: &Fed) {
        match fed {
            Fed::Edges { vertex, edges } => {
                for known in self.graph.ids.len()..=vertex.0 as usize {
                    // The edge from the vertex before is the odometry that led here.
                    let led = edges
                        .iter()
                        .find(|edge| edge.kind == EdgeKind::Odometry && edge.b.0 as usize == known);
                    let pose = led.map_or_else(Se2::identity, |edge| {
                        self.odom_from_vertex(edge.a.0 as usize) * edge.a_from_b
                    });
                    self.graph.ids.push(known as u64);
                    self.graph.initial.push(Some(pose));
                }
                self.graph.factors.extend(edges.iter().map(|edge| self.noise.factor(edge)));
            }
            Fed::Scan { standing, .. } => {
                let odom_from_vertex = self.odom_from_vertex(standing.vertex.0 as usize);
                let odom_from_body = odom_from_vertex * standing.vertex_from_body;
                self.odometry.stamps_secs.push(at.secs());
                self.odometry.poses.push(spatial(&odom_from_body));
            }
            Fed::Decided { .. } => {}
        }
    }

    /// Notes where the robot truly is, or is best known to be.
    pub fn reference(&mut self, at: Stamp, map_from_body: &Se2) {
        self.reference.stamps_secs.push(at.secs());
        self.reference.poses.push(spatial(map_from_body));
    }

    /// The poses by odometry alone, one for each scan, as TUM.
    pub fn odometry_tum(&self) -> Vec<u8> {
        tum::write(&self.odometry)
    }

    /// The reference as TUM; `None` where there is none.
    pub fn reference_tum(&self) -> Option<Vec<u8>> {
        (!self.reference.poses.is_empty()).then(|| tum::write(&self.reference))
    }

    /// The pose graph as g2o: start values by odometry, the first vertex held.
    pub fn g2o(&self) -> Vec<u8> {
        pose_graph::write(&AnyGraph::Plane(self.graph.clone()), GraphFormat::G2o)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use posegraph::PoseGraph;
    use probe::{EdgeId, VertexId};

    #[test]
    fn odometry_is_chained_and_place_edges_are_not() {
        let mut graph = PoseGraph::new();
        let ids = [graph.add_vertex(), graph.add_vertex(), graph.add_vertex()];
        let step = Se2::new(1.0, 0.0, 0.5);
        let mut tracks = Tracks::new(CorrectionParams::default());
        let mut fed = |graph: &PoseGraph, vertex: VertexId, edges: &[EdgeId]| {
            let edges = edges.iter().map(|&id| *graph.edge(id)).collect();
            tracks.fed(Stamp::from_nanos(0), &Fed::Edges { vertex, edges });
        };
        fed(&graph, ids[0], &[]);
        let first = graph.add_edge(ids[0], ids[1], step, EdgeKind::Odometry).expect("an edge");
        fed(&graph, ids[1], &[first]);
        let second = graph.add_edge(ids[1], ids[2], step, EdgeKind::Odometry).expect("an edge");
        let place = graph.add_edge(ids[0], ids[2], step, EdgeKind::Place).expect("an edge");
        fed(&graph, ids[2], &[second, place]);
        assert_eq!(tracks.odom_from_vertex(2), step * step);
        let text = String::from_utf8(tracks.g2o()).expect("text");
        assert_eq!(text.matches("VERTEX_SE2").count(), 3);
        assert_eq!(text.matches("EDGE_SE2").count(), 3);
        assert!(tracks.reference_tum().is_none());
    }
}
