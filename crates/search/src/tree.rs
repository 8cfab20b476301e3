//! What a search gives back: its settled nodes, which form a tree.

use probe::Id;

use crate::Scratch;

/// A node whose cost is final.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settled<N> {
    /// The node.
    pub node: N,
    /// Its cost from the start; the number of edges where the search does not read costs.
    pub cost: f64,
    /// The node before it on the path from the start; `None` at the start.
    pub parent: Option<N>,
}

/// The settled nodes of a search, borrowed from its [`Scratch`].
#[derive(Clone, Copy, Debug)]
pub struct Tree<'a, N> {
    pub(crate) scratch: &'a Scratch<N>,
}

impl<'a, N: Id> Tree<'a, N> {
    /// The settled nodes in the order in which they were settled; the start is the first.
    pub fn settled(&self) -> &'a [Settled<N>] {
        &self.scratch.settled
    }

    /// Number of settled nodes.
    pub fn len(&self) -> usize {
        self.scratch.settled.len()
    }

    /// Whether nothing is settled.
    pub fn is_empty(&self) -> bool {
        self.scratch.settled.is_empty()
    }

    /// The settled entry of `node`, or `None` if the search did not get there. O(1).
    pub fn get(&self, node: N) -> Option<Settled<N>> {
        let slot = self.scratch.known(node)?;
        self.scratch.settled.get(slot.position as usize).copied()
    }

    /// The cost of `node` from the start, or `None` if the search did not get there. O(1).
    pub fn cost(&self, node: N) -> Option<f64> {
        self.get(node).map(|settled| settled.cost)
    }

    /// The place of `node` in [`settled`](Self::settled), or `None`. O(1).
    pub fn position(&self, node: N) -> Option<usize> {
        let position = self.scratch.known(node)?.position as usize;
        (position < self.len()).then_some(position)
    }

    /// From `node` back to the start, both included; empty if the search did not get there.
    pub fn back_from(&self, node: N) -> Back<'a, N> {
        Back { tree: *self, next: self.get(node).map(|settled| settled.node) }
    }

    /// The path from the start to `node`, both included, or `None` if the search did not get there.
    pub fn path_to(&self, node: N) -> Option<Vec<N>> {
        let mut path: Vec<N> = self.back_from(node).collect();
        path.reverse();
        (!path.is_empty()).then_some(path)
    }
}

/// The nodes from one node of a [`Tree`] back to the start.
#[derive(Clone, Debug)]
pub struct Back<'a, N> {
    tree: Tree<'a, N>,
    next: Option<N>,
}

impl<N: Id> Iterator for Back<'_, N> {
    type Item = N;

    fn next(&mut self) -> Option<N> {
        let node = self.next?;
        self.next = self.tree.get(node).and_then(|settled| settled.parent);
        Some(node)
    }
}
