//! What the relative map tells.

use geometry::planar::Interval;
use pose::Se2;
use posegraph::{Scope, Skeleton};
use probe::{EdgeId, VertexId};

use super::RelativeMap;
use crate::volume::FrontierEdge;

/// Why a part of a frontier edge was closed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Cause {
    /// It lies inside another volume: free (\[ISRR19\] 4.3).
    Inside,
    /// It lies along a wall that another volume saw, nearer than the named distance.
    Wall,
    /// The robot went there as near as it may, looked, and nothing more could be seen.
    Unreachable,
}

/// Why a part of a frontier edge was opened again.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReopenCause {
    /// The place edge that the closing relied on was withdrawn.
    EdgeWithdrawn(EdgeId),
    /// The volume that closed it got more rays, and has to close it anew.
    VolumeReplaced(VertexId),
    /// All was closed that counted: the last look asks for more certainty.
    LastLook,
}

/// Steps of frontier consolidation (\[ISRR19\] 4.3).
#[derive(Clone, Copy, Debug)]
pub enum ConsolidationEvent<'a> {
    /// The scope was gathered: all vertices within the radius of the root along the graph, each
    /// placed along its shortest path.
    ScopeTaken {
        /// The scope; its first row is the root.
        scope: &'a Scope,
        /// The links that the paths of the scope walk.
        skeleton: &'a Skeleton,
    },
    /// The open frontier of one volume was compared with another volume.
    PairCompared {
        /// The volume whose frontier was looked at.
        volume: VertexId,
        /// The volume that it was held against.
        against: VertexId,
        /// Frame of `against` in the frame of `volume`, along the shortest path.
        volume_from_against: Se2,
        /// Frontier length that this closed, metres.
        closed_m: f64,
    },
    /// A part of a frontier edge was closed.
    Closed {
        /// The volume that the edge belongs to.
        volume: VertexId,
        /// The edge, in the frame of its volume.
        edge: &'a FrontierEdge,
        /// The part, as parameters along the edge.
        span: Interval,
        /// Why.
        cause: Cause,
        /// The volume that did it.
        by: VertexId,
        /// The measured edges of the path between the two.
        path: &'a [EdgeId],
    },
    /// A part of a frontier edge was opened again.
    Reopened {
        /// The volume that the edge belongs to.
        volume: VertexId,
        /// The edge, in the frame of its volume.
        edge: &'a FrontierEdge,
        /// The part, as parameters along the edge.
        span: Interval,
        /// Why.
        cause: ReopenCause,
    },
    /// A volume that added nothing was taken out of later comparisons.
    Retired {
        /// The volume.
        volume: VertexId,
    },
    /// Retired volumes were taken in again, because an edge was withdrawn.
    Restored {
        /// The volume.
        volume: VertexId,
    },
    /// All that one scan or edge set off is done.
    Settled {
        /// The map, to be read.
        map: &'a RelativeMap,
        /// The vertex that the robot stands on.
        standing: VertexId,
    },
}

probe::variants!(
    ConsolidationEvent<'_>:
    ScopeTaken, PairCompared, Closed, Reopened, Retired, Restored, Settled
);
