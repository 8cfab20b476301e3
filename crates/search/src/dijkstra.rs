//! Dijkstra's search: everything in the order of its cost from the start.

use probe::{Id, Off, Probe};

use crate::graph::{check_edge, check_node};
use crate::scratch::{OPEN, Queued};
use crate::{Graph, Scratch, SearchError, Settled, Tree};

/// What Dijkstra's search did, step by step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DijkstraEvent<N> {
    /// A node was met for the first time, or more cheaply than before.
    Relaxed {
        /// The node that the edge leaves.
        from: N,
        /// The node whose cost went down.
        to: N,
        /// Its cost before; `None` when it was new.
        before: Option<f64>,
        /// Its cost now.
        cost: f64,
    },
    /// An edge led beyond the limit and was not followed.
    BeyondLimit {
        /// The node that the edge leaves.
        from: N,
        /// The node that it leads to.
        to: N,
        /// What that node would have cost.
        cost: f64,
    },
    /// A node became the cheapest open one: its cost is final.
    Settled {
        /// The node.
        node: N,
        /// Its cost from the start.
        cost: f64,
        /// The node before it; `None` at the start.
        parent: Option<N>,
    },
    /// A settled node was not the goal, and all its edges were looked at.
    Expanded {
        /// The node.
        node: N,
    },
    /// The settled node is the goal; the search ends.
    Found {
        /// The goal.
        goal: N,
        /// Its cost from the start.
        cost: f64,
    },
    /// No open node is left; the search ends.
    Exhausted {
        /// How many nodes were settled.
        settled: usize,
    },
}

/// The answer of a search for the nearest goal.
#[derive(Clone, Copy, Debug)]
pub struct Nearest<'a, N> {
    /// All that was settled on the way, the goal last.
    pub tree: Tree<'a, N>,
    /// The nearest goal, or `None` if there is none within the limit.
    pub goal: Option<Settled<N>>,
}

/// The least cost of every node that can be reached from `start`.
///
/// Open nodes of equal cost are settled by ascending id; of several parents that give the least
/// cost the one that was settled first is kept. Costs O((n + m) log m) for n nodes and m edges
/// reached. A path whose cost overflows to infinity counts as closed.
///
/// # Errors
///
/// `start` or the target of an edge is no node of the graph; an edge costs NaN or less than 0.
/// Only edges that leave settled nodes are looked at.
pub fn dijkstra<'a, G: Graph>(
    graph: &G,
    start: G::Node,
    scratch: &'a mut Scratch<G::Node>,
) -> Result<Tree<'a, G::Node>, SearchError> {
    dijkstra_with(graph, start, scratch, &mut Off)
}

/// [`dijkstra`], observed.
pub fn dijkstra_with<'a, G: Graph>(
    graph: &G,
    start: G::Node,
    scratch: &'a mut Scratch<G::Node>,
    probe: &mut impl Probe<DijkstraEvent<G::Node>>,
) -> Result<Tree<'a, G::Node>, SearchError> {
    dijkstra_within_with(graph, start, f64::INFINITY, scratch, probe)
}

/// The nodes whose least cost from `start` is at most `limit`: the head of what [`dijkstra`] gives.
///
/// Costs O(k log k) for k edges that leave settled nodes, whatever the size of the graph.
///
/// # Errors
///
/// Those of [`dijkstra`]; `limit` is NaN or less than 0.
pub fn dijkstra_within<'a, G: Graph>(
    graph: &G,
    start: G::Node,
    limit: f64,
    scratch: &'a mut Scratch<G::Node>,
) -> Result<Tree<'a, G::Node>, SearchError> {
    dijkstra_within_with(graph, start, limit, scratch, &mut Off)
}

/// [`dijkstra_within`], observed.
pub fn dijkstra_within_with<'a, G: Graph>(
    graph: &G,
    start: G::Node,
    limit: f64,
    scratch: &'a mut Scratch<G::Node>,
    probe: &mut impl Probe<DijkstraEvent<G::Node>>,
) -> Result<Tree<'a, G::Node>, SearchError> {
    run(graph, start, limit, |_| false, scratch, probe)?;
    Ok(scratch.tree())
}

/// The nearest node that satisfies `is_goal`, within `limit`; of equally near ones the lowest id,
/// where no edge costs 0.
///
/// `is_goal` is asked once for every settled node, in that order, `start` first; an infinite
/// `limit` searches everything.
///
/// # Errors
///
/// Those of [`dijkstra_within`].
pub fn dijkstra_nearest<'a, G: Graph>(
    graph: &G,
    start: G::Node,
    limit: f64,
    is_goal: impl FnMut(G::Node) -> bool,
    scratch: &'a mut Scratch<G::Node>,
) -> Result<Nearest<'a, G::Node>, SearchError> {
    dijkstra_nearest_with(graph, start, limit, is_goal, scratch, &mut Off)
}

/// [`dijkstra_nearest`], observed.
pub fn dijkstra_nearest_with<'a, G: Graph>(
    graph: &G,
    start: G::Node,
    limit: f64,
    is_goal: impl FnMut(G::Node) -> bool,
    scratch: &'a mut Scratch<G::Node>,
    probe: &mut impl Probe<DijkstraEvent<G::Node>>,
) -> Result<Nearest<'a, G::Node>, SearchError> {
    let goal = run(graph, start, limit, is_goal, scratch, probe)?;
    Ok(Nearest { tree: scratch.tree(), goal })
}

fn run<G: Graph>(
    graph: &G,
    start: G::Node,
    limit: f64,
    mut is_goal: impl FnMut(G::Node) -> bool,
    scratch: &mut Scratch<G::Node>,
    probe: &mut impl Probe<DijkstraEvent<G::Node>>,
) -> Result<Option<Settled<G::Node>>, SearchError> {
    let bound = graph.node_bound();
    scratch.begin(bound);
    check_node(start, bound)?;
    if limit.is_nan() || limit < 0.0 {
        return Err(SearchError::Limit { limit });
    }
    scratch.open(start, 0.0, start);
    scratch.heap.push(queued(start, 0.0));
    while let Some(Queued { node, .. }) = scratch.heap.pop() {
        // A node is queued again whenever its cost goes down; the first entry to come up counts.
        if scratch.known(node).is_none_or(|slot| slot.position != OPEN) {
            continue;
        }
        let settled = scratch.settle(node);
        let Settled { cost, parent, .. } = settled;
        probe.emit(DijkstraEvent::Settled { node, cost, parent });
        if is_goal(node) {
            probe.emit(DijkstraEvent::Found { goal: node, cost });
            return Ok(Some(settled));
        }
        expand(graph, settled, bound, limit, scratch, probe)?;
        probe.emit(DijkstraEvent::Expanded { node });
    }
    probe.emit(DijkstraEvent::Exhausted { settled: scratch.settled.len() });
    Ok(None)
}

/// Looks at every edge that leaves a settled node.
fn expand<G: Graph>(
    graph: &G,
    settled: Settled<G::Node>,
    bound: usize,
    limit: f64,
    scratch: &mut Scratch<G::Node>,
    probe: &mut impl Probe<DijkstraEvent<G::Node>>,
) -> Result<(), SearchError> {
    let from = settled.node;
    let mut refused = Ok(());
    graph.for_each_edge(from, |to, edge_cost| {
        if refused.is_err() {
            return;
        }
        refused = check_edge(from, to, edge_cost, bound);
        if refused.is_err() {
            return;
        }
        let cost = settled.cost + edge_cost;
        let before = scratch.known(to).map(|slot| slot.cost);
        // Infinity improves nothing: a closed edge does not make its target known.
        if cost >= before.unwrap_or(f64::INFINITY) {
            return;
        }
        if cost > limit {
            probe.emit(DijkstraEvent::BeyondLimit { from, to, cost });
            return;
        }
        scratch.open(to, cost, from);
        scratch.heap.push(queued(to, cost));
        probe.emit(DijkstraEvent::Relaxed { from, to, before, cost });
    });
    refused
}

fn queued<N: Id>(node: N, cost: f64) -> Queued<N> {
    Queued { key: cost.to_bits(), tie: 0, node }
}
