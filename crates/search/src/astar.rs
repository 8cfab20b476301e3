//! A*: Dijkstra's search, drawn towards the goal by an estimate of what is left.

use probe::{Id, Off, Probe};

use crate::graph::{check_edge, check_node};
use crate::scratch::{OPEN, Queued};
use crate::{Graph, Scratch, SearchError, Settled};

/// What A* did, step by step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AstarEvent<N> {
    /// A node was met for the first time, or more cheaply than before: it is in the open set.
    Relaxed {
        /// The node that the edge leaves.
        from: N,
        /// The node whose cost went down.
        to: N,
        /// Its cost before; `None` when it was new.
        before: Option<f64>,
        /// Its cost from the start now.
        cost: f64,
        /// The estimate of what is left from it to the goal.
        estimate: f64,
    },
    /// A node of the closed set went back to the open set, because a cheaper way to it was found.
    Reopened {
        /// The node.
        node: N,
    },
    /// The most promising open node was moved to the closed set and its edges were looked at.
    Expanded {
        /// The node.
        node: N,
        /// Its cost from the start.
        cost: f64,
        /// The estimate of what is left from it to the goal.
        estimate: f64,
        /// The node before it; `None` at the start.
        parent: Option<N>,
    },
    /// The most promising open node is a goal; the search ends.
    Found {
        /// The goal.
        goal: N,
        /// Its cost from the start.
        cost: f64,
    },
    /// No open node is left: no goal can be reached.
    Exhausted {
        /// How many expansions there were.
        expanded: usize,
    },
}

/// A cheapest way to a goal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Route<'a, N> {
    /// From the start to the goal, both included.
    pub nodes: &'a [N],
    /// The sum of the edges' costs.
    pub cost: f64,
    /// How many expansions it took; a node that was opened again counts again.
    pub expanded: usize,
}

/// A cheapest way from `start` to `goal`, or `None` if there is none.
///
/// `estimate` must be admissible: never more than the true cost that is left. It need not be
/// consistent; nodes are opened again where it is not. It is asked once for each node met;
/// infinity means "the goal cannot be reached from here". Open nodes of equal promise are taken by
/// ascending estimate, then by ascending id. Costs O((n + m) log m) for n nodes and m edges met
/// where the estimate is consistent.
///
/// An estimate in floating point may exceed the truth by a rounding error; the route then exceeds
/// the cheapest by no more than that.
///
/// # Errors
///
/// `start`, `goal` or the target of an edge is no node of the graph; an edge or an estimate is NaN
/// or less than 0.
pub fn astar<'a, G: Graph>(
    graph: &G,
    start: G::Node,
    goal: G::Node,
    estimate: impl FnMut(G::Node) -> f64,
    scratch: &'a mut Scratch<G::Node>,
) -> Result<Option<Route<'a, G::Node>>, SearchError> {
    astar_with(graph, start, goal, estimate, scratch, &mut Off)
}

/// [`astar`], observed.
pub fn astar_with<'a, G: Graph>(
    graph: &G,
    start: G::Node,
    goal: G::Node,
    estimate: impl FnMut(G::Node) -> f64,
    scratch: &'a mut Scratch<G::Node>,
    probe: &mut impl Probe<AstarEvent<G::Node>>,
) -> Result<Option<Route<'a, G::Node>>, SearchError> {
    check_node(goal, graph.node_bound())?;
    astar_where_with(graph, start, |node| node == goal, estimate, scratch, probe)
}

/// A cheapest way from `start` to whichever of `goals` is nearest, or `None` if none can be reached.
///
/// `estimate(node, goal)` must be admissible for each goal; the least over all goals is used, so
/// each node met costs O(goals).
///
/// # Errors
///
/// Those of [`astar`].
pub fn astar_nearest<'a, G: Graph>(
    graph: &G,
    start: G::Node,
    goals: &[G::Node],
    estimate: impl FnMut(G::Node, G::Node) -> f64,
    scratch: &'a mut Scratch<G::Node>,
) -> Result<Option<Route<'a, G::Node>>, SearchError> {
    astar_nearest_with(graph, start, goals, estimate, scratch, &mut Off)
}

/// [`astar_nearest`], observed.
pub fn astar_nearest_with<'a, G: Graph>(
    graph: &G,
    start: G::Node,
    goals: &[G::Node],
    mut estimate: impl FnMut(G::Node, G::Node) -> f64,
    scratch: &'a mut Scratch<G::Node>,
    probe: &mut impl Probe<AstarEvent<G::Node>>,
) -> Result<Option<Route<'a, G::Node>>, SearchError> {
    for &goal in goals {
        check_node(goal, graph.node_bound())?;
    }
    let least = |node| {
        goals.iter().fold(f64::INFINITY, |least, &goal| {
            let one = estimate(node, goal);
            // `f64::min` would drop a NaN, which has to be reported.
            if least.is_nan() || one >= least { least } else { one }
        })
    };
    astar_where_with(graph, start, |node| goals.contains(&node), least, scratch, probe)
}

/// A cheapest way from `start` to the nearest node that satisfies `is_goal`.
///
/// `estimate` must not exceed the true cost to the nearest such node; it is 0 at a goal. `is_goal`
/// is asked whenever a node comes up for expansion.
///
/// # Errors
///
/// Those of [`astar`].
pub fn astar_where<'a, G: Graph>(
    graph: &G,
    start: G::Node,
    is_goal: impl FnMut(G::Node) -> bool,
    estimate: impl FnMut(G::Node) -> f64,
    scratch: &'a mut Scratch<G::Node>,
) -> Result<Option<Route<'a, G::Node>>, SearchError> {
    astar_where_with(graph, start, is_goal, estimate, scratch, &mut Off)
}

/// [`astar_where`], observed.
pub fn astar_where_with<'a, G: Graph>(
    graph: &G,
    start: G::Node,
    mut is_goal: impl FnMut(G::Node) -> bool,
    mut estimate: impl FnMut(G::Node) -> f64,
    scratch: &'a mut Scratch<G::Node>,
    probe: &mut impl Probe<AstarEvent<G::Node>>,
) -> Result<Option<Route<'a, G::Node>>, SearchError> {
    let bound = graph.node_bound();
    scratch.begin(bound);
    check_node(start, bound)?;
    if scratch.estimates.len() < bound {
        scratch.estimates.resize(bound, 0.0);
    }
    let left = checked(start, estimate(start))?;
    if left < f64::INFINITY {
        scratch.open(start, 0.0, start);
        scratch.estimates[start.index()] = left;
        scratch.heap.push(queued(start, 0.0, left));
    }
    while let Some(Queued { node, .. }) = scratch.heap.pop() {
        // A node is queued again whenever its cost goes down; the first entry to come up counts.
        if scratch.known(node).is_none_or(|slot| slot.position != OPEN) {
            continue;
        }
        let closed = scratch.settle(node);
        let Settled { cost, parent, .. } = closed;
        if is_goal(node) {
            probe.emit(AstarEvent::Found { goal: node, cost });
            return Ok(Some(trace(closed, scratch)));
        }
        expand(graph, closed, bound, &mut estimate, scratch, probe)?;
        let left = scratch.estimates[node.index()];
        probe.emit(AstarEvent::Expanded { node, cost, estimate: left, parent });
    }
    probe.emit(AstarEvent::Exhausted { expanded: scratch.settled.len() });
    Ok(None)
}

/// Looks at every edge that leaves a closed node.
fn expand<G: Graph>(
    graph: &G,
    closed: Settled<G::Node>,
    bound: usize,
    estimate: &mut impl FnMut(G::Node) -> f64,
    scratch: &mut Scratch<G::Node>,
    probe: &mut impl Probe<AstarEvent<G::Node>>,
) -> Result<(), SearchError> {
    let from = closed.node;
    let mut refused = Ok(());
    graph.for_each_edge(from, |to, edge_cost| {
        if refused.is_ok() {
            refused = relax(closed, to, edge_cost, bound, estimate, scratch, probe);
        }
    });
    refused
}

fn relax<N: Id>(
    closed: Settled<N>,
    to: N,
    edge_cost: f64,
    bound: usize,
    estimate: &mut impl FnMut(N) -> f64,
    scratch: &mut Scratch<N>,
    probe: &mut impl Probe<AstarEvent<N>>,
) -> Result<(), SearchError> {
    let from = closed.node;
    check_edge(from, to, edge_cost, bound)?;
    let cost = closed.cost + edge_cost;
    let known = scratch.known(to).copied();
    let before = known.map(|slot| slot.cost);
    // Infinity improves nothing: a closed edge does not make its target known.
    if cost >= before.unwrap_or(f64::INFINITY) {
        return Ok(());
    }
    let left = match known {
        Some(_) => scratch.estimates[to.index()],
        None => checked(to, estimate(to))?,
    };
    if left == f64::INFINITY {
        return Ok(());
    }
    if known.is_some_and(|slot| slot.position != OPEN) {
        probe.emit(AstarEvent::Reopened { node: to });
    }
    scratch.estimates[to.index()] = left;
    scratch.open(to, cost, from);
    scratch.heap.push(queued(to, cost, left));
    probe.emit(AstarEvent::Relaxed { from, to, before, cost, estimate: left });
    Ok(())
}

/// Walks from the goal to the start along the parents.
fn trace<N: Id>(goal: Settled<N>, scratch: &mut Scratch<N>) -> Route<'_, N> {
    let mut next = Some(goal.node);
    while let Some(node) = next {
        scratch.nodes.push(node);
        next = scratch.known(node).map(|slot| slot.parent).filter(|&parent| parent != node);
    }
    scratch.nodes.reverse();
    Route { nodes: &scratch.nodes, cost: goal.cost, expanded: scratch.settled.len() - 1 }
}

fn checked<N: Id>(node: N, estimate: f64) -> Result<f64, SearchError> {
    if estimate >= 0.0 {
        // Adding 0 turns -0 into 0, whose bits sort first.
        Ok(estimate + 0.0)
    } else {
        Err(SearchError::Estimate { node: node.index(), estimate })
    }
}

fn queued<N: Id>(node: N, cost: f64, estimate: f64) -> Queued<N> {
    Queued { key: (cost + estimate).to_bits(), tie: estimate.to_bits(), node }
}
