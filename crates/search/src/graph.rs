//! What a search needs to know about a graph.

use probe::Id;

use crate::SearchError;

/// A directed graph with a cost on every edge and nodes that are dense indices.
///
/// Undirected graphs list every edge from both ends. Nothing is asked of the order in which edges
/// are listed: results do not depend on it. Parallel edges and loops are allowed.
pub trait Graph {
    /// The id of a node.
    type Node: Id;

    /// A number above the index of every node; scratch memory is sized by it.
    fn node_bound(&self) -> usize;

    /// Calls `visit(to, cost)` once for every edge that leaves `from`.
    ///
    /// A cost is at least 0; infinity closes the edge; NaN and negative costs are refused by every
    /// search that reads costs.
    fn for_each_edge(&self, from: Self::Node, visit: impl FnMut(Self::Node, f64));
}

impl<G: Graph> Graph for &G {
    type Node = G::Node;

    fn node_bound(&self) -> usize {
        (**self).node_bound()
    }

    fn for_each_edge(&self, from: Self::Node, visit: impl FnMut(Self::Node, f64)) {
        (**self).for_each_edge(from, visit);
    }
}

/// Refuses a start or goal that the graph cannot have.
pub(crate) fn check_node<N: Id>(node: N, bound: usize) -> Result<(), SearchError> {
    if node.index() < bound {
        Ok(())
    } else {
        Err(SearchError::NodeOutOfRange { node: node.index(), bound })
    }
}

/// Refuses an edge that leads out of the graph.
pub(crate) fn check_target<N: Id>(from: N, to: N, bound: usize) -> Result<(), SearchError> {
    if to.index() < bound {
        Ok(())
    } else {
        Err(SearchError::EdgeOutOfRange { from: from.index(), to: to.index(), bound })
    }
}

/// Refuses an edge that leads out of the graph or whose cost is NaN or negative.
pub(crate) fn check_edge<N: Id>(
    from: N,
    to: N,
    cost: f64,
    bound: usize,
) -> Result<(), SearchError> {
    check_target(from, to, bound)?;
    if cost >= 0.0 {
        Ok(())
    } else {
        Err(SearchError::Cost { from: from.index(), to: to.index(), cost })
    }
}
