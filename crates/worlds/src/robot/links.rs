//! How far apart a robot believes its places along its own graph.

use std::cmp::Ordering;
use std::collections::{BTreeMap, BinaryHeap};

use probe::{Id, VertexId};

/// Ways between named places, of which the shortest counts.
#[derive(Clone, Debug, Default)]
pub(crate) struct Links {
    links: Vec<BTreeMap<u32, f64>>,
    reach: Reach,
}

/// Distances of the last bounded search; a stamp per vertex saves clearing them.
#[derive(Clone, Debug, Default)]
struct Reach {
    round: u32,
    stamp: Vec<u32>,
    distance_m: Vec<f64>,
}

impl Links {
    /// Joins two places by a way of that length.
    pub(crate) fn link(&mut self, a: VertexId, b: VertexId, length_m: f64) {
        if a == b {
            return;
        }
        let most = a.index().max(b.index());
        if self.links.len() <= most {
            self.links.resize(most + 1, BTreeMap::new());
        }
        for (from, to) in [(a, b), (b, a)] {
            let known = self.links[from.index()].entry(to.0).or_insert(length_m);
            *known = known.min(length_m);
        }
    }

    /// Searches the graph from `from` for everything nearer than `limit_m` along it; asked of by
    /// [`reached`](Self::reached) until the next search. Cost: what lies within the limit.
    pub(crate) fn search(&mut self, from: VertexId, limit_m: f64) {
        let reach = &mut self.reach;
        let count = self.links.len().max(from.index() + 1);
        self.links.resize(count, BTreeMap::new());
        reach.stamp.resize(count, 0);
        reach.distance_m.resize(count, 0.0);
        reach.round += 1;
        let mut open = BinaryHeap::new();
        if limit_m > 0.0 {
            reach.stamp[from.index()] = reach.round;
            reach.distance_m[from.index()] = 0.0;
            open.push(Open { distance_m: 0.0, vertex: from.0 });
        }
        while let Some(Open { distance_m, vertex }) = open.pop() {
            if distance_m > reach.distance_m[vertex as usize] {
                continue;
            }
            for (&next, &length_m) in &self.links[vertex as usize] {
                let through_m = distance_m + length_m;
                let known = reach.stamp[next as usize] == reach.round;
                if through_m < limit_m && !(known && reach.distance_m[next as usize] <= through_m) {
                    reach.stamp[next as usize] = reach.round;
                    reach.distance_m[next as usize] = through_m;
                    open.push(Open { distance_m: through_m, vertex: next });
                }
            }
        }
    }

    /// Whether the last search reached a vertex.
    pub(crate) fn reached(&self, vertex: VertexId) -> bool {
        self.reach.round > 0 && self.reach.stamp.get(vertex.index()) == Some(&self.reach.round)
    }
}

/// An entry of the queue, the nearest first; ties by id.
#[derive(PartialEq)]
struct Open {
    distance_m: f64,
    vertex: u32,
}

impl Eq for Open {}

impl Ord for Open {
    fn cmp(&self, other: &Self) -> Ordering {
        other.distance_m.total_cmp(&self.distance_m).then(other.vertex.cmp(&self.vertex))
    }
}

impl PartialOrd for Open {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
