//! Vertices around one, along the graph.

use std::cmp::Ordering;
use std::collections::{BTreeMap, BinaryHeap};

use pose::Se3;
use posegraph::PoseGraph;
use probe::VertexId;

/// A vertex, placed along its shortest path.
#[derive(Clone, Copy, Debug)]
pub(super) struct Near {
    pub(super) vertex: VertexId,
    pub(super) root_from_vertex: Se3,
    pub(super) distance_m: f64,
    before: VertexId,
}

/// Vertices within `radius_m` along the graph, the nearest first; the root is the first.
pub(super) fn nearby(graph: &PoseGraph<Se3>, root: VertexId, radius_m: f64) -> Vec<Near> {
    let mut best: BTreeMap<VertexId, f64> = BTreeMap::new();
    let mut settled: BTreeMap<VertexId, usize> = BTreeMap::new();
    let mut found: Vec<Near> = Vec::new();
    let mut open = BinaryHeap::new();
    let start =
        Near { vertex: root, root_from_vertex: Se3::identity(), distance_m: 0.0, before: root };
    open.push(Open(start));
    while let Some(Open(near)) = open.pop() {
        if settled.contains_key(&near.vertex) {
            continue;
        }
        settled.insert(near.vertex, found.len());
        found.push(near);
        for (_, edge) in graph.edges_of(near.vertex) {
            let (next, here_from_next) = edge.from_end(near.vertex);
            let distance_m = near.distance_m + edge.length_m;
            let known = best.get(&next).copied().unwrap_or(f64::INFINITY);
            if distance_m <= radius_m && distance_m < known && !settled.contains_key(&next) {
                best.insert(next, distance_m);
                let root_from_vertex = near.root_from_vertex * here_from_next;
                open.push(Open(Near {
                    vertex: next,
                    root_from_vertex,
                    distance_m,
                    before: near.vertex,
                }));
            }
        }
    }
    found
}

/// The legs from the root to one of the vertices found, the last leg first.
pub(super) fn legs_to(found: &[Near], goal: VertexId) -> Vec<(VertexId, f64)> {
    let of = |vertex: VertexId| found.iter().find(|near| near.vertex == vertex);
    let mut legs = Vec::new();
    let mut at = of(goal);
    while let Some(near) = at.filter(|near| near.before != near.vertex) {
        let before = of(near.before);
        legs.push((near.vertex, near.distance_m - before.map_or(0.0, |b| b.distance_m)));
        at = before;
    }
    legs
}

/// An entry of the queue, the nearest first; ties by id.
struct Open(Near);

impl PartialEq for Open {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Open {}

impl Ord for Open {
    fn cmp(&self, other: &Self) -> Ordering {
        let (a, b) = (&self.0, &other.0);
        b.distance_m.total_cmp(&a.distance_m).then(b.vertex.cmp(&a.vertex))
    }
}

impl PartialOrd for Open {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
