//! What can be wrong with a request to a pose graph.

use probe::{EdgeId, VertexId};

/// A request that the graph cannot serve.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PoseGraphError {
    /// The vertex was never added.
    #[error("vertex {vertex} is not in the graph, which holds {len} vertices")]
    UnknownVertex {
        /// The vertex asked for.
        vertex: VertexId,
        /// Number of vertices that the graph holds.
        len: usize,
    },
    /// The edge was never added.
    #[error("edge {edge} is not in the graph, which holds {len} edges")]
    UnknownEdge {
        /// The edge asked for.
        edge: EdgeId,
        /// Number of edges that the graph holds.
        len: usize,
    },
    /// An edge must join two different vertices.
    #[error("an edge from {vertex} to itself says nothing about poses")]
    SelfEdge {
        /// The vertex at both ends.
        vertex: VertexId,
    },
    /// The relative pose has a part that is not a number.
    #[error("the relative pose of {a} and {b} is not finite")]
    NotFinite {
        /// Where the edge starts.
        a: VertexId,
        /// Where the edge ends.
        b: VertexId,
    },
    /// Only place edges can be withdrawn: odometry is how the robot got there.
    #[error("edge {edge} is odometry and cannot be withdrawn")]
    NotAPlaceEdge {
        /// The edge asked for.
        edge: EdgeId,
    },
    /// The edge was withdrawn before.
    #[error("edge {edge} is withdrawn already")]
    AlreadyWithdrawn {
        /// The edge asked for.
        edge: EdgeId,
    },
    /// A factor leads to a vertex that is not there, or from a vertex to itself.
    #[error("a factor from {from} to {to} does not join two of {len} vertices")]
    FactorEnds {
        /// Index of the vertex it starts from.
        from: usize,
        /// Index of the vertex it leads to.
        to: usize,
        /// Number of vertices.
        len: usize,
    },
    /// A factor or pose has a part that is not a number.
    #[error("the measurement from {from} to {to} is not finite")]
    FactorNotFinite {
        /// Index of the vertex it starts from.
        from: usize,
        /// Index of the vertex it leads to.
        to: usize,
    },
    /// There is no such factor, or it was withdrawn before.
    #[error("factor {factor} is not among the {len} that were added, or is withdrawn already")]
    UnknownFactor {
        /// Index of the factor asked for.
        factor: usize,
        /// Number of factors that were ever added.
        len: usize,
    },
    /// The factors leave poses undetermined, so that these have no covariance.
    #[error("{directions} directions of the poses are not determined by any factor")]
    Undetermined {
        /// Number of directions without information.
        directions: usize,
    },
    /// There are not as many poses as vertices.
    #[error("there are {poses} poses for {vertices} vertices")]
    PosesMissing {
        /// Number of poses.
        poses: usize,
        /// Number of vertices.
        vertices: usize,
    },
}
