//! A mesh under recovery.

use crate::tetrahedra::constraints::Constraints;
use crate::tetrahedra::mesh::{Exchange, Mesh, Ring};

/// The mesh, what it must contain, and what was done to it since the last commit.
#[derive(Clone, Debug, Default)]
pub(crate) struct Work {
    /// The tetrahedra.
    pub(crate) mesh: Mesh,
    /// What must appear.
    pub(crate) must: Constraints,
    /// Whether removals and searches make no nearly flat tetrahedra: while there is more to bring in.
    pub(crate) even: bool,
    /// Exchanges that may yet be undone.
    pub(crate) log: Vec<Exchange>,
    /// Points on constraints, in the order made.
    pub(crate) splits: Vec<crate::tetrahedra::steiner::Split>,
    /// Buffers of the edge removal.
    pub(crate) table: super::ring::Table,
    /// What flips found out before.
    pub(crate) known: super::known::Known,
    /// The search over small regions, between uses.
    pub(crate) search: crate::tetrahedra::reconnect::Search,
    /// Where the last search would have needed more room: the tetrahedra there.
    pub(crate) blamed: Vec<u32>,
    /// Rings that are not in use.
    pub(crate) rings: Vec<Ring>,
}

impl Work {
    /// Takes back everything since the log had `mark` entries.
    pub(crate) fn undo_to(&mut self, mark: usize) {
        while self.log.len() > mark {
            if let Some(exchange) = self.log.pop() {
                self.mesh.undo(&exchange);
                self.mesh.recycle(exchange);
            }
        }
    }

    /// Forgets what could be undone.
    pub(crate) fn settle(&mut self) {
        while let Some(exchange) = self.log.pop() {
            self.mesh.recycle(exchange);
        }
    }

    /// Takes back the points since there were `count`; no tetrahedron has them any more.
    pub(crate) fn drop_points(&mut self, count: usize) {
        if self.mesh.points.len() > count {
            self.mesh.points.truncate(count);
            self.mesh.at.truncate(count);
            self.known.forget();
        }
    }

    /// Exchanges tetrahedra and writes it down; false, with nothing changed, where they do not fit.
    pub(crate) fn exchange(&mut self, old: &[u32], new: &[[u32; 4]]) -> bool {
        match self.mesh.exchange(old, new) {
            Some(exchange) => {
                self.log.push(exchange);
                true
            }
            None => false,
        }
    }
}
