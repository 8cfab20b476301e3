//! Poses from outside, for maps that are to be judged without drift.

use std::fmt::Debug;

use pose::Se2;
use probe::VertexId;

/// An estimate that a map is given: from a tracking system, or from a simulator for a baseline
/// (\[Zie18\] 3.3).
pub trait GivenPoses: Debug + Send + Sync {
    /// The frame of a vertex in the map's frame, once it is known.
    fn map_from_vertex(&self, vertex: VertexId) -> Option<Se2>;
}
