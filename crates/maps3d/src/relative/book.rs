//! What the ledgers refer to: who closed a part of a face, when, and along which path.

use std::collections::BTreeMap;

use posegraph::EdgeKind;
use probe::{EdgeId, IdVec, PathId};

/// Why a part of a frontier face was closed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Cause {
    /// It lies inside another volume: free (\[ISRR19\] 4.3, 4.4).
    Inside,
    /// It lies along an obstacle that another view saw, nearer than the named distance.
    Wall,
    /// It lies behind such an obstacle, within twice that distance or by no more than drift may have moved it, and was
    /// about to be given up.
    Behind,
}

/// Number of a closing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ClosingId(pub u32);

/// One view closed frontier of another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closing {
    /// Inside a volume, or along a wall.
    pub cause: Cause,
    /// The view whose frontier it was.
    pub view: u32,
    /// The view that closed it.
    pub by: u32,
    /// When: the count of looks that the map had taken.
    pub step: u32,
    /// Along which path through the graph the two views were placed.
    pub path: PathId,
    /// How far behind obstacles it closed, metres; of [`Cause::Behind`] alone, else 0.
    pub behind_m: f32,
}

/// The closings, the paths that they relied on, and which of these a place edge carries.
#[derive(Clone, Debug, Default)]
pub struct Book {
    closings: Vec<Closing>,
    paths: IdVec<PathId, Box<[EdgeId]>>,
    /// Place edges only: odometry is never withdrawn.
    relying: BTreeMap<EdgeId, Vec<ClosingId>>,
    is_place: IdVec<EdgeId, bool>,
}

impl Book {
    /// Learns what kind of edge an id stands for.
    pub(super) fn learn(&mut self, edge: EdgeId, kind: EdgeKind) {
        while self.is_place.next_id() < edge {
            self.is_place.push(false);
        }
        if self.is_place.next_id() == edge {
            self.is_place.push(kind == EdgeKind::Place);
        }
    }

    /// Whether an edge that was learned is a place edge.
    pub(super) fn is_place(&self, edge: EdgeId) -> bool {
        self.is_place.get(edge).copied().unwrap_or(false)
    }

    /// Remembers a path from the vertex whose frontier is closed to that of the view that closes it.
    pub(super) fn remember(&mut self, edges: Vec<EdgeId>) -> PathId {
        self.paths.push(edges.into())
    }

    /// Writes a closing down.
    pub(super) fn close(&mut self, closing: Closing) -> ClosingId {
        let id = ClosingId(self.closings.len() as u32);
        self.closings.push(closing);
        for edge in &self.paths[closing.path] {
            if self.is_place.get(*edge).copied().unwrap_or(false) {
                self.relying.entry(*edge).or_default().push(id);
            }
        }
        id
    }

    /// A closing that this book gave out.
    pub fn closing(&self, id: ClosingId) -> &Closing {
        &self.closings[id.0 as usize]
    }

    /// The measured edges of a path, from the view whose frontier was closed to the one that did.
    pub fn edges(&self, path: PathId) -> &[EdgeId] {
        self.paths.get(path).map_or(&[], |edges| edges)
    }

    /// The closings that walk a place edge.
    pub fn relying_on(&self, edge: EdgeId) -> &[ClosingId] {
        self.relying.get(&edge).map_or(&[], Vec::as_slice)
    }

    /// Memory held on the heap, bytes.
    pub(super) fn heap_bytes(&self) -> usize {
        let paths: usize = self.paths.iter().map(|path| size_of_val(&**path)).sum();
        let relying: usize = self.relying.values().map(|ids| 4 * ids.capacity() + 48).sum();
        self.closings.capacity() * size_of::<Closing>()
            + paths
            + self.paths.len() * size_of::<Box<[EdgeId]>>()
            + relying
            + self.is_place.len()
    }
}
