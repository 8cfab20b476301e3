//! Step 5: where vertices are, by odometry alone or corrected.

use pose::Se3;
use posegraph::{Edge, EdgeKind, Factor, FactorGraph3, Manifold, PoseGraph, optimize};
use probe::{EdgeId, IdVec, VertexId};

use super::{UnionCorrection, UnionEvent};
use crate::Map3dProbe;

/// Noise is never taken for less than this, metres and radians: weights stay finite.
const LEAST_SIGMA: f64 = 1e-4;

/// Poses of all vertices in the frame `map`: odometry from the last correction on.
#[derive(Clone, Debug, Default)]
pub(super) struct Poses {
    map_from_vertex: IdVec<VertexId, Se3>,
}

impl Poses {
    /// `map_from_vertex`, or the identity for a vertex that is not known.
    pub fn of(&self, vertex: VertexId) -> Se3 {
        self.map_from_vertex.get(vertex).copied().unwrap_or_default()
    }

    /// By vertex.
    pub fn all(&self) -> &[Se3] {
        self.map_from_vertex.as_slice()
    }

    /// Makes room for a vertex; one without edges lies at the origin.
    pub fn cover(&mut self, vertex: VertexId) {
        while self.map_from_vertex.next_id() <= vertex {
            self.map_from_vertex.push(Se3::identity());
        }
    }

    /// Takes poses as they are; those that are not finite are left out.
    pub fn set(&mut self, map_from_vertex: &[Se3]) {
        for (i, pose) in map_from_vertex.iter().enumerate().filter(|(_, pose)| pose.is_finite()) {
            let vertex = VertexId(i as u32);
            self.cover(vertex);
            self.map_from_vertex[vertex] = *pose;
        }
    }

    /// Places new vertices by their odometry edges; tells how many place edges there are among the new ones.
    pub fn extend(&mut self, graph: &PoseGraph<Se3>, edges: &[EdgeId]) -> usize {
        let mut places = 0;
        for &edge in edges {
            let edge = graph.edge(edge);
            self.cover(edge.a.max(edge.b));
            match edge.kind {
                EdgeKind::Odometry => {
                    self.map_from_vertex[edge.b] = self.map_from_vertex[edge.a] * edge.a_from_b;
                }
                EdgeKind::Place => places += 1,
            }
        }
        places
    }

    /// Optimises the whole graph as it stands; says whether poses were taken.
    pub fn correct(
        &mut self,
        graph: &PoseGraph<Se3>,
        correction: &UnionCorrection,
        new_places: usize,
        probe: &mut dyn Map3dProbe,
    ) -> bool {
        let count = self.map_from_vertex.len();
        let known = |edge: &&Edge<Se3>| !edge.withdrawn && (edge.a.max(edge.b).0 as usize) < count;
        let factors = graph.edges().map(|(_, edge)| edge).filter(known);
        let problem = FactorGraph3 {
            ids: (0..count as u64).collect(),
            initial: vec![None; count],
            fixed: if count > 0 { vec![0] } else { Vec::new() },
            factors: factors.map(|edge| correction.factor(edge)).collect(),
        };
        let before = self.map_from_vertex.as_slice();
        let solution = optimize(&problem, before, &correction.optimizer);
        if solution.poses.len() != count || !solution.poses.iter().all(Manifold::is_finite) {
            probe.emit(UnionEvent::NotCorrected { report: &solution.report });
            return false;
        }
        let pairs = before.iter().zip(&solution.poses);
        let moved_max_m =
            pairs.map(|(a, b)| (a.translation - b.translation).norm()).fold(0.0, f64::max);
        let (after, report) = (&solution.poses[..], &solution.report);
        probe.emit(UnionEvent::Corrected { new_places, before, after, moved_max_m, report });
        self.map_from_vertex = solution.poses.into_iter().collect();
        true
    }

    /// Memory held on the heap, bytes.
    pub fn heap_bytes(&self) -> usize {
        self.map_from_vertex.len() * size_of::<Se3>()
    }
}

impl UnionCorrection {
    fn factor(&self, edge: &Edge<Se3>) -> Factor<Se3, 6> {
        let (metres, radians) = match edge.kind {
            EdgeKind::Odometry => {
                let root = edge.length_m.sqrt();
                (self.sigma_translation * root, self.sigma_rotation_rad * root)
            }
            EdgeKind::Place => (self.place_sigma_m, self.place_sigma_rotation_rad),
        };
        let weight = |sigma: f64| sigma.max(LEAST_SIGMA).powi(-2);
        // g2o's error of a rotation is half of its angle.
        let (along, about) = (weight(metres), 4.0 * weight(radians));
        let mut information = nalgebra::SMatrix::<f64, 6, 6>::zeros();
        for i in 0..3 {
            (information[(i, i)], information[(i + 3, i + 3)]) = (along, about);
        }
        Factor {
            from: edge.a.0 as usize,
            to: edge.b.0 as usize,
            from_from_to: edge.a_from_b,
            information,
        }
    }
}
