//! Where an optimisation starts.

use posegraph::initial::{given, odometry, spanning_tree};
use posegraph::{FactorGraph, Manifold};

use super::args::Init;

impl Init {
    /// The name that is typed.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::File => "file",
            Self::Odometry => "odometry",
            Self::SpanningTree => "spanning-tree",
        }
    }
}

/// `map_from_body` of every vertex to start from, and the name of the start.
pub(super) fn start<P: Manifold<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    init: Option<Init>,
) -> (Vec<P>, &'static str) {
    let init = init.unwrap_or(Init::SpanningTree);
    let poses = match init {
        Init::File => given(graph),
        Init::Odometry => odometry(graph),
        Init::SpanningTree => spanning_tree(graph),
    };
    (poses, init.name())
}
