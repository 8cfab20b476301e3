//! Depth first: down the lowest unvisited neighbour, back when there is none.

use probe::{Off, Probe};

use crate::graph::{check_node, check_target};
use crate::{Graph, Scratch, SearchError, Tree};

/// What the depth-first search did, step by step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DepthEvent<N> {
    /// A node was entered.
    Entered {
        /// The node.
        node: N,
        /// The node that it was entered from; `None` at the start.
        parent: Option<N>,
        /// Number of tree edges from the start.
        depth: usize,
    },
    /// Everything below a node was visited.
    Left {
        /// The node.
        node: N,
    },
    /// The start was left; the search ends.
    Exhausted {
        /// How many nodes were entered.
        entered: usize,
    },
}

/// The result of a depth-first search.
#[derive(Clone, Copy, Debug)]
pub struct DepthFirst<'a, N> {
    /// The nodes as they were entered (preorder); `cost` is the depth in this tree, which need not
    /// be the least number of edges.
    pub tree: Tree<'a, N>,
    /// The nodes as they were left (postorder): reversed, a topological order where there is no
    /// cycle.
    pub left: &'a [N],
}

/// What is still to be done with a node.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Pending<N> {
    Enter { node: N, parent: N, depth: usize },
    Leave(N),
}

/// Everything that can be reached from `start`, neighbours by ascending id.
///
/// Iterative: a long chain does not overflow the stack. Costs of edges are not read, so closed
/// edges count too. O(n + m log m) for n nodes and m edges reached, O(m) memory.
///
/// # Errors
///
/// `start` or the target of an edge is no node of the graph.
pub fn depth_first<'a, G: Graph>(
    graph: &G,
    start: G::Node,
    scratch: &'a mut Scratch<G::Node>,
) -> Result<DepthFirst<'a, G::Node>, SearchError> {
    depth_first_with(graph, start, scratch, &mut Off)
}

/// [`depth_first`], observed.
pub fn depth_first_with<'a, G: Graph>(
    graph: &G,
    start: G::Node,
    scratch: &'a mut Scratch<G::Node>,
    probe: &mut impl Probe<DepthEvent<G::Node>>,
) -> Result<DepthFirst<'a, G::Node>, SearchError> {
    let bound = graph.node_bound();
    scratch.begin(bound);
    check_node(start, bound)?;
    scratch.stack.push(Pending::Enter { node: start, parent: start, depth: 0 });
    while let Some(pending) = scratch.stack.pop() {
        match pending {
            Pending::Leave(node) => {
                scratch.nodes.push(node);
                probe.emit(DepthEvent::Left { node });
            }
            Pending::Enter { node, .. } if scratch.known(node).is_some() => {}
            Pending::Enter { node, parent, depth } => {
                scratch.open(node, depth as f64, parent);
                let parent = scratch.settle(node).parent;
                probe.emit(DepthEvent::Entered { node, parent, depth });
                scratch.stack.push(Pending::Leave(node));
                push_neighbours(graph, node, depth + 1, bound, scratch)?;
            }
        }
    }
    probe.emit(DepthEvent::Exhausted { entered: scratch.settled.len() });
    Ok(DepthFirst { tree: scratch.tree(), left: &scratch.nodes })
}

/// Pushes the unvisited neighbours of `from` so that the lowest id comes up first.
fn push_neighbours<G: Graph>(
    graph: &G,
    from: G::Node,
    depth: usize,
    bound: usize,
    scratch: &mut Scratch<G::Node>,
) -> Result<(), SearchError> {
    let first = scratch.stack.len();
    let mut refused = Ok(());
    graph.for_each_edge(from, |to, _| {
        if refused.is_err() {
            return;
        }
        refused = check_target(from, to, bound);
        if refused.is_ok() && scratch.known(to).is_none() {
            scratch.stack.push(Pending::Enter { node: to, parent: from, depth });
        }
    });
    scratch.stack[first..].sort_unstable_by_key(|pending| match *pending {
        Pending::Enter { node, .. } | Pending::Leave(node) => std::cmp::Reverse(node),
    });
    refused
}
