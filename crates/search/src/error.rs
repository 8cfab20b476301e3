//! What a search refuses.

/// Why a search gave no answer. An unreachable goal is an answer, not an error.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SearchError {
    /// A start or a goal is no node of the graph.
    #[error("node {node} is not in the graph, whose nodes are below {bound}")]
    NodeOutOfRange {
        /// Index of the node asked for.
        node: usize,
        /// The graph's node bound.
        bound: usize,
    },
    /// An edge leads to something that is no node of the graph.
    #[error("the edge {from} -> {to} leaves the graph, whose nodes are below {bound}")]
    EdgeOutOfRange {
        /// Index of the node that the edge leaves.
        from: usize,
        /// Index that the edge leads to.
        to: usize,
        /// The graph's node bound.
        bound: usize,
    },
    /// An edge costs less than nothing, or NaN.
    #[error("the edge {from} -> {to} costs {cost}; a cost must be 0 or more")]
    Cost {
        /// Index of the node that the edge leaves.
        from: usize,
        /// Index of the node that the edge leads to.
        to: usize,
        /// Its cost.
        cost: f64,
    },
    /// The bound of a bounded search is negative or NaN.
    #[error("the search is limited to cost {limit}; a limit must be 0 or more")]
    Limit {
        /// The limit asked for.
        limit: f64,
    },
    /// A heuristic returned a negative number or NaN.
    #[error("the estimate for node {node} is {estimate}; an estimate must be 0 or more")]
    Estimate {
        /// Index of the node.
        node: usize,
        /// What the heuristic said.
        estimate: f64,
    },
}
