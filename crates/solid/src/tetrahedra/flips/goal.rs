//! What flips are made for, and how far off it is.

use crate::tetrahedra::constraints::{Meets, meets};
use crate::tetrahedra::mesh::Mesh;

/// What stands in the way of what is counted by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Goal {
    /// This segment shall become an edge: faces that it meets are in the way.
    Segment([u32; 2]),
    /// This triangle shall become a face: edges that pass it are in the way.
    Facet([u32; 3]),
    /// An edge shall go, whatever comes: nothing is in the way.
    Gone,
}

impl Goal {
    /// 1 where a face is in the way.
    #[inline]
    pub(crate) fn of_face(&self, mesh: &Mesh, face: [u32; 3]) -> i32 {
        match self {
            Self::Segment(ends) => i32::from(meets(mesh, *ends, face) != Meets::Not),
            Self::Facet(_) | Self::Gone => 0,
        }
    }

    /// 1 where an edge is in the way.
    #[inline]
    pub(crate) fn of_edge(&self, mesh: &Mesh, u: u32, v: u32) -> i32 {
        match self {
            Self::Facet(corners) => i32::from(meets(mesh, [u, v], *corners) != Meets::Not),
            Self::Segment(_) | Self::Gone => 0,
        }
    }
}
