//! Which vertices of the pose graph are near enough (\[Zie18\] 2.7.1, eq. 2.8).

use std::collections::{BTreeSet, VecDeque};

use posegraph::PoseGraph;
use probe::{EdgeId, IdVec, VertexId};

/// The edges of the graph by vertex.
#[derive(Clone, Debug, Default)]
pub(super) struct Links {
    of: IdVec<VertexId, Vec<(VertexId, f64, EdgeId)>>,
}

impl Links {
    pub fn cover(&mut self, vertex: VertexId) {
        while self.of.next_id() <= vertex {
            self.of.push(Vec::new());
        }
    }

    pub fn add(&mut self, graph: &PoseGraph, id: EdgeId) {
        let edge = graph.edge(id);
        self.cover(edge.a.max(edge.b));
        self.of[edge.a].push((edge.b, edge.length_m, id));
        self.of[edge.b].push((edge.a, edge.length_m, id));
    }

    pub fn remove(&mut self, id: EdgeId) {
        for vertex in self.of.ids() {
            self.of[vertex].retain(|link| link.2 != id);
        }
    }

    /// All vertices at most so many edges away.
    pub fn within(&self, root: VertexId, edges: usize) -> BTreeSet<VertexId> {
        let mut met = BTreeSet::from([root]);
        let mut queue = VecDeque::from([(root, 0)]);
        while let Some((vertex, distance)) = queue.pop_front() {
            if distance == edges {
                continue;
            }
            for &(to, ..) in self.of.get(vertex).map_or(&[][..], Vec::as_slice) {
                if met.insert(to) {
                    queue.push_back((to, distance + 1));
                }
            }
        }
        met
    }

    /// The way with the fewest edges to a vertex that is a goal: the vertices after the root, each
    /// with the length of the edge that leads to it (2.9.3).
    pub fn way(
        &self,
        root: VertexId,
        is_goal: impl Fn(VertexId) -> bool,
    ) -> Option<Vec<(VertexId, f64)>> {
        let mut parent: Vec<Option<(VertexId, f64)>> = vec![None; self.of.len()];
        let mut met = BTreeSet::from([root]);
        let mut queue = VecDeque::from([root]);
        while let Some(vertex) = queue.pop_front() {
            if is_goal(vertex) {
                let mut legs = Vec::new();
                let mut at = vertex;
                while let Some((before, length_m)) = parent.get(at.0 as usize).copied().flatten() {
                    legs.push((at, length_m));
                    at = before;
                }
                legs.reverse();
                return Some(legs);
            }
            for &(to, length_m, _) in self.of.get(vertex).map_or(&[][..], Vec::as_slice) {
                if met.insert(to) {
                    parent[to.0 as usize] = Some((vertex, length_m));
                    queue.push_back(to);
                }
            }
        }
        None
    }

    pub fn heap_bytes(&self) -> usize {
        self.of.iter().map(|links| links.len() * size_of::<(VertexId, f64, EdgeId)>()).sum()
    }
}
