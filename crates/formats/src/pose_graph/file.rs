//! A graph of either dimension.

use posegraph::{FactorGraph2, FactorGraph3};

use super::report::GraphFileReport;

/// A pose graph of the plane or of space.
#[derive(Clone, Debug, PartialEq)]
pub enum AnyGraph {
    /// Poses with three degrees of freedom.
    Plane(FactorGraph2),
    /// Poses with six degrees of freedom.
    Space(FactorGraph3),
}

impl AnyGraph {
    /// Number of vertices.
    pub fn vertices(&self) -> usize {
        match self {
            Self::Plane(graph) => graph.ids.len(),
            Self::Space(graph) => graph.ids.len(),
        }
    }

    /// Number of edges.
    pub fn edges(&self) -> usize {
        match self {
            Self::Plane(graph) => graph.factors.len(),
            Self::Space(graph) => graph.factors.len(),
        }
    }

    /// 2 or 3.
    pub fn dimensions(&self) -> usize {
        match self {
            Self::Plane(_) => 2,
            Self::Space(_) => 3,
        }
    }
}

/// A graph file as it was read.
#[derive(Clone, Debug, PartialEq)]
pub struct GraphFile {
    /// The graph; ids ascend.
    pub graph: AnyGraph,
    /// What the file held beside it.
    pub report: GraphFileReport,
}
