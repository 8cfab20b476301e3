//! Which vertices of the pose graph are near enough (\[Zie18\] 2.7.1, eq. 2.8).

use std::collections::VecDeque;

use posegraph::PoseGraph;
use probe::{EdgeId, IdVec, VertexId};

/// The vertices of the active area.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Area {
    /// By the number of edges from the root.
    vertices: Vec<VertexId>,
    holds: Vec<bool>,
}

impl Area {
    pub fn contains(&self, vertex: VertexId) -> bool {
        self.holds.get(vertex.0 as usize).copied().unwrap_or(false)
    }

    /// Those nearest to the robot first.
    pub fn vertices(&self) -> &[VertexId] {
        &self.vertices
    }

    fn insert(&mut self, vertex: VertexId) -> bool {
        let index = vertex.0 as usize;
        if self.holds.len() <= index {
            self.holds.resize(index + 1, false);
        }
        let new = !std::mem::replace(&mut self.holds[index], true);
        if new {
            self.vertices.push(vertex);
        }
        new
    }
}

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
    pub fn within(&self, root: VertexId, edges: usize) -> Area {
        let mut area = Area::default();
        area.insert(root);
        let mut queue = VecDeque::from([(root, 0)]);
        while let Some((vertex, distance)) = queue.pop_front() {
            if distance == edges {
                continue;
            }
            for &(to, ..) in self.of.get(vertex).map_or(&[][..], Vec::as_slice) {
                if area.insert(to) {
                    queue.push_back((to, distance + 1));
                }
            }
        }
        area
    }

    /// The way with the fewest edges to a vertex that is a goal: the vertices after the root, each
    /// with the length of the edge that leads to it (2.9.3).
    pub fn way(
        &self,
        root: VertexId,
        is_goal: impl Fn(VertexId) -> bool,
    ) -> Option<Vec<(VertexId, f64)>> {
        let mut parent: Vec<Option<(VertexId, f64)>> = vec![None; self.of.len()];
        let mut met = Area::default();
        met.insert(root);
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
