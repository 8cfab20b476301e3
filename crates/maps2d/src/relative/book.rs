//! What the ledgers refer to: who closed a part of a frontier, when, and along which path.

use std::collections::BTreeMap;

use posegraph::EdgeKind;
use probe::{EdgeId, IdVec, PathId, VertexId};

use super::Cause;

/// Why a part of a frontier edge is closed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Closing {
    /// Inside a volume, along a wall, or unreachable.
    pub cause: Cause,
    /// The volume that closed it.
    pub by: VertexId,
    /// When: the count of scans that the map had taken.
    pub step: u32,
    /// Along which path through the graph the two volumes were placed.
    pub path: PathId,
}

#[derive(Clone, Debug)]
struct Remembered {
    edges: Box<[EdgeId]>,
    volume: VertexId,
}

/// The paths that closings relied on, and which of them a place edge carries.
#[derive(Clone, Debug, Default)]
pub struct PathBook {
    paths: IdVec<PathId, Remembered>,
    /// Place edges only: odometry is never withdrawn.
    relying: BTreeMap<EdgeId, Vec<PathId>>,
    is_place: IdVec<EdgeId, bool>,
}

impl PathBook {
    /// Learns what kind of edge an id stands for.
    pub(crate) fn learn(&mut self, edge: EdgeId, kind: EdgeKind) {
        while self.is_place.next_id() < edge {
            self.is_place.push(false);
        }
        if self.is_place.next_id() == edge {
            self.is_place.push(kind == EdgeKind::Place);
        }
    }

    /// Remembers a path along which parts of the frontier of `volume` are closed.
    pub(crate) fn remember(&mut self, volume: VertexId, edges: Vec<EdgeId>) -> PathId {
        let path = self.paths.next_id();
        for &edge in &edges {
            if self.is_place.get(edge).copied().unwrap_or(false) {
                self.relying.entry(edge).or_default().push(path);
            }
        }
        self.paths.push(Remembered { edges: edges.into_boxed_slice(), volume })
    }

    /// The measured edges of a path, from the volume whose frontier was closed to the one that did.
    pub fn edges(&self, path: PathId) -> &[EdgeId] {
        self.paths.get(path).map_or(&[], |remembered| &remembered.edges)
    }

    /// The paths that walk a place edge, each with the volume whose frontier it served to close.
    pub(crate) fn relying_on(&self, edge: EdgeId) -> Vec<(PathId, VertexId)> {
        let paths = self.relying.get(&edge).map_or(&[][..], Vec::as_slice);
        paths.iter().map(|&path| (path, self.paths[path].volume)).collect()
    }

    /// Memory held on the heap, bytes.
    pub(crate) fn heap_bytes(&self) -> usize {
        let edges: usize = self.paths.len() * 8 * size_of::<EdgeId>();
        edges + self.paths.len() * size_of::<Remembered>() + self.is_place.len()
    }
}
