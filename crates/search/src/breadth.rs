//! Breadth first: everything in the order of the number of edges from the start.

use probe::{Off, Probe};

use crate::graph::{check_node, check_target};
use crate::{Graph, Scratch, SearchError, Settled, Tree};

/// What the breadth-first search did, step by step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BreadthEvent<N> {
    /// A node was met for the first time.
    Reached {
        /// The node that the edge leaves; `None` at the start.
        from: Option<N>,
        /// The new node.
        node: N,
        /// Number of edges from the start.
        hops: usize,
    },
    /// All edges of a node were looked at.
    Expanded {
        /// The node.
        node: N,
    },
    /// No node is left within the limit; the search ends.
    Exhausted {
        /// How many nodes were reached.
        reached: usize,
    },
}

/// All nodes within `max_hops` edges of `start`; `cost` in the result counts edges.
///
/// The order, the parents and the numbers are those of [`dijkstra`](crate::dijkstra) with every
/// edge at cost 1: by number of edges, then by id. Costs of edges are not read, so closed edges
/// count too. O(m + n log n) for n nodes and m edges reached.
///
/// # Errors
///
/// `start` or the target of an edge is no node of the graph.
pub fn breadth_first<'a, G: Graph>(
    graph: &G,
    start: G::Node,
    max_hops: usize,
    scratch: &'a mut Scratch<G::Node>,
) -> Result<Tree<'a, G::Node>, SearchError> {
    breadth_first_with(graph, start, max_hops, scratch, &mut Off)
}

/// [`breadth_first`], observed.
pub fn breadth_first_with<'a, G: Graph>(
    graph: &G,
    start: G::Node,
    max_hops: usize,
    scratch: &'a mut Scratch<G::Node>,
    probe: &mut impl Probe<BreadthEvent<G::Node>>,
) -> Result<Tree<'a, G::Node>, SearchError> {
    let bound = graph.node_bound();
    scratch.begin(bound);
    check_node(start, bound)?;
    scratch.open(start, 0.0, start);
    scratch.settle(start);
    probe.emit(BreadthEvent::Reached { from: None, node: start, hops: 0 });

    // The settled list is the queue: one level is a range of it.
    let mut level = 0..1;
    let mut hops = 0;
    while hops < max_hops && !level.is_empty() {
        hops += 1;
        let next = level.end;
        for position in level {
            let from = scratch.settled[position].node;
            expand(graph, from, hops, bound, scratch, probe)?;
            probe.emit(BreadthEvent::Expanded { node: from });
        }
        scratch.settled[next..].sort_unstable_by_key(|reached: &Settled<_>| reached.node);
        scratch.renumber(next);
        level = next..scratch.settled.len();
    }
    probe.emit(BreadthEvent::Exhausted { reached: scratch.settled.len() });
    Ok(scratch.tree())
}

fn expand<G: Graph>(
    graph: &G,
    from: G::Node,
    hops: usize,
    bound: usize,
    scratch: &mut Scratch<G::Node>,
    probe: &mut impl Probe<BreadthEvent<G::Node>>,
) -> Result<(), SearchError> {
    let mut refused = Ok(());
    graph.for_each_edge(from, |to, _| {
        if refused.is_err() {
            return;
        }
        refused = check_target(from, to, bound);
        if refused.is_err() || scratch.known(to).is_some() {
            return;
        }
        scratch.open(to, hops as f64, from);
        scratch.settle(to);
        probe.emit(BreadthEvent::Reached { from: Some(from), node: to, hops });
    });
    refused
}
