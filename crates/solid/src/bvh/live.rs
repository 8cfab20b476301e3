//! A tree whose boxes change.

use super::{Aabb, Bvh};

const NONE: u32 = u32::MAX;

/// A tree whose boxes move: what has moved is found where it is, at the price of boxes above it that
/// only ever grow.
#[derive(Clone, Debug)]
pub struct LiveBvh {
    tree: Bvh,
    /// Where each item is in the tree's order.
    place_of: Vec<u32>,
    /// The leaf of each place.
    leaf_of: Vec<u32>,
    /// The node above each node.
    parent_of: Vec<u32>,
}

impl LiveBvh {
    /// A tree over boxes; O(n log n).
    pub fn new(boxes: &[Aabb]) -> Self {
        let tree = Bvh::new(boxes);
        let mut place_of = vec![NONE; boxes.len()];
        for (place, &item) in tree.items.iter().enumerate() {
            place_of[item as usize] = place as u32;
        }
        let mut leaf_of = vec![NONE; boxes.len()];
        let mut parent_of = vec![NONE; tree.nodes.len()];
        for (index, node) in tree.nodes.iter().enumerate() {
            if node.count == 0 {
                parent_of[index + 1] = index as u32;
                parent_of[node.next as usize] = index as u32;
            } else {
                let start = node.next as usize;
                leaf_of[start..start + node.count as usize].fill(index as u32);
            }
        }
        Self { tree, place_of, leaf_of, parent_of }
    }

    /// Moves a box; O(log n), and nothing above it where it stays inside.
    pub fn set(&mut self, item: u32, aabb: &Aabb) {
        let place = self.place_of[item as usize] as usize;
        self.tree.boxes[place] = *aabb;
        let mut node = self.leaf_of[place];
        while node != NONE {
            let grown = self.tree.nodes[node as usize].aabb.union(aabb);
            if grown == self.tree.nodes[node as usize].aabb {
                return;
            }
            self.tree.nodes[node as usize].aabb = grown;
            node = self.parent_of[node as usize];
        }
    }

    /// Takes a box out: it is not found again until it is set again.
    pub fn remove(&mut self, item: u32) {
        let place = self.place_of[item as usize] as usize;
        self.tree.boxes[place] = Aabb::empty();
    }

    /// Calls `found` with every box that touches `aabb`.
    pub fn each_touching(&self, aabb: &Aabb, found: impl FnMut(u32)) {
        self.tree.each_touching(aabb, found);
    }
}
