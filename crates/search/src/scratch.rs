//! The memory of a search, kept between calls.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use probe::Id;

use crate::{Settled, Tree};

/// `Slot::position` of a node that is discovered but not settled.
pub(crate) const OPEN: u32 = u32::MAX;

/// What a search knows about one node; valid only while `stamp` is the current generation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slot<N> {
    pub cost: f64,
    /// The node itself at the start.
    pub parent: N,
    /// Place in the settled list, or [`OPEN`].
    pub position: u32,
    stamp: u32,
}

/// An entry of the priority queue; the greatest is the one to settle next.
///
/// Costs are kept as bits: for numbers that are not negative the order is the same, and it is total.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Queued<N> {
    /// What decides first: cost so far, for A* plus the estimate.
    pub key: u64,
    /// What decides among equal keys: 0, for A* the estimate.
    pub tie: u64,
    pub node: N,
}

impl<N: Id> Ord for Queued<N> {
    #[inline]
    fn cmp(&self, other: &Self) -> Ordering {
        (other.key, other.tie, other.node).cmp(&(self.key, self.tie, self.node))
    }
}

impl<N: Id> PartialOrd for Queued<N> {
    #[inline]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// The reusable memory of all searches over graphs with nodes `N`, and the owner of the last result.
///
/// Dense arrays are stamped with the generation of the search that wrote them, so that a search
/// starts without clearing: it costs what it touches. Nothing is allocated once the arrays have
/// grown to the graph and the lists to the largest result so far. About 24 bytes for each node of
/// the graph.
#[derive(Clone, Debug)]
pub struct Scratch<N> {
    slots: Vec<Slot<N>>,
    generation: u32,
    pub(crate) heap: BinaryHeap<Queued<N>>,
    pub(crate) settled: Vec<Settled<N>>,
    /// A*: the estimate of every slot of this generation.
    pub(crate) estimates: Vec<f64>,
    /// Depth first: what is still to be entered or left.
    pub(crate) stack: Vec<crate::depth::Pending<N>>,
    /// Depth first: nodes in the order in which they were left. A*: the route found.
    pub(crate) nodes: Vec<N>,
}

impl<N: Id> Scratch<N> {
    /// Empty; grows to the first graph that it meets.
    pub const fn new() -> Self {
        Self {
            slots: Vec::new(),
            generation: 0,
            heap: BinaryHeap::new(),
            settled: Vec::new(),
            estimates: Vec::new(),
            stack: Vec::new(),
            nodes: Vec::new(),
        }
    }

    /// Ready for graphs of `nodes` nodes.
    pub fn with_capacity(nodes: usize) -> Self {
        let mut scratch = Self::new();
        scratch.slots.reserve(nodes);
        scratch
    }

    /// The settled nodes of the last search that began, for A* its closed set.
    ///
    /// A node that A* opened again is listed once for every expansion; look-ups give the last.
    pub fn tree(&self) -> Tree<'_, N> {
        Tree { scratch: self }
    }

    /// Starts a search over a graph with nodes below `bound`: all nodes become unknown.
    pub(crate) fn begin(&mut self, bound: usize) {
        if self.generation == u32::MAX {
            // Old stamps would come round again.
            for slot in &mut self.slots {
                slot.stamp = 0;
            }
            self.generation = 0;
        }
        self.generation += 1;
        if self.slots.len() < bound {
            let blank =
                Slot { cost: f64::INFINITY, parent: N::from_index(0), position: OPEN, stamp: 0 };
            self.slots.resize(bound, blank);
        }
        self.heap.clear();
        self.settled.clear();
        self.stack.clear();
        self.nodes.clear();
    }

    /// What this search knows about `node`, if it has met it.
    #[inline]
    pub(crate) fn known(&self, node: N) -> Option<&Slot<N>> {
        self.slots.get(node.index()).filter(|slot| slot.stamp == self.generation)
    }

    /// Notes that `node` is reached from `parent` at `cost` and is not settled.
    #[inline]
    pub(crate) fn open(&mut self, node: N, cost: f64, parent: N) {
        self.slots[node.index()] = Slot { cost, parent, position: OPEN, stamp: self.generation };
    }

    /// Settles a known node: appends it to the list.
    #[inline]
    pub(crate) fn settle(&mut self, node: N) -> Settled<N> {
        let slot = &mut self.slots[node.index()];
        slot.position = self.settled.len() as u32;
        let parent = (slot.parent != node).then_some(slot.parent);
        let settled = Settled { node, cost: slot.cost, parent };
        self.settled.push(settled);
        settled
    }

    /// After the list was put in another order from `first` on: makes the positions true again.
    pub(crate) fn renumber(&mut self, first: usize) {
        for position in first..self.settled.len() {
            self.slots[self.settled[position].node.index()].position = position as u32;
        }
    }
}

impl<N: Id> Default for Scratch<N> {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use probe::VertexId;

    use super::*;
    use crate::{Graph, dijkstra_within};

    struct Ring;

    impl Graph for Ring {
        type Node = VertexId;

        fn node_bound(&self) -> usize {
            1000
        }

        fn for_each_edge(&self, from: VertexId, mut visit: impl FnMut(VertexId, f64)) {
            visit(VertexId((from.0 + 1) % 1000), 1.0);
            visit(VertexId((from.0 + 999) % 1000), 1.0);
        }
    }

    #[test]
    fn a_warm_scratch_does_not_grow() {
        let mut scratch = Scratch::with_capacity(1000);
        let capacities = |scratch: &Scratch<VertexId>| {
            (scratch.slots.capacity(), scratch.heap.capacity(), scratch.settled.capacity())
        };
        let mut after_first = None;
        for start in 0..50 {
            let tree = dijkstra_within(&Ring, VertexId(start * 20), 25.0, &mut scratch)
                .expect("a ring has valid costs");
            assert_eq!(tree.len(), 51);
            let now = capacities(&scratch);
            assert_eq!(*after_first.get_or_insert(now), now);
        }
    }

    #[test]
    fn the_last_generation_does_not_bring_old_nodes_back() {
        let mut scratch = Scratch::new();
        scratch.begin(2);
        scratch.open(VertexId(1), 1.0, VertexId(0));
        scratch.generation = u32::MAX;
        scratch.begin(2);
        assert_eq!(scratch.generation, 1, "wrapped to the generation of the first search");
        assert!(scratch.known(VertexId(1)).is_none());
    }
}
