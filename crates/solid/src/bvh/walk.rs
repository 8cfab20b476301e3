//! Step 2: questions to the tree.

use std::ops::ControlFlow;

use super::build::Node;
use super::{Aabb, Bvh};
use crate::Point3;

impl Bvh {
    /// Calls `found` with every box that touches `aabb`.
    pub fn each_touching(&self, aabb: &Aabb, mut found: impl FnMut(u32)) {
        let _ = self.walk(
            |candidate| candidate.touches(aabb),
            |item| {
                found(item);
                ControlFlow::Continue(())
            },
        );
    }

    /// Calls `found` with every box that the segment may touch.
    pub fn each_on_segment(&self, from: &Point3, to: &Point3, mut found: impl FnMut(u32)) {
        let _ = self.walk(
            |candidate| candidate.may_touch_segment(from, to),
            |item| {
                found(item);
                ControlFlow::Continue(())
            },
        );
    }

    /// Calls `found` with every box for which `touches` holds, as it must for all boxes around that
    /// one; stops where `found` breaks, and tells.
    pub(crate) fn walk(
        &self,
        touches: impl Fn(&Aabb) -> bool,
        mut found: impl FnMut(u32) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let mut waiting: Vec<u32> = if self.nodes.is_empty() { vec![] } else { vec![0] };
        while let Some(index) = waiting.pop() {
            let node = &self.nodes[index as usize];
            if !touches(&node.aabb) {
                continue;
            }
            if node.count == 0 {
                waiting.push(node.next);
                waiting.push(index + 1);
                continue;
            }
            for place in items(node) {
                if touches(&self.boxes[place]) {
                    found(self.items[place])?;
                }
            }
        }
        ControlFlow::Continue(())
    }

    /// Calls `found` with every pair of different boxes that touch, the smaller index first, each
    /// pair once; stops where `found` breaks.
    pub fn each_pair(&self, found: impl FnMut(u32, u32) -> ControlFlow<()>) {
        let _ = self.pairs(found);
    }

    /// [`each_pair`](Self::each_pair), telling whether it was stopped.
    pub(crate) fn pairs(
        &self,
        mut found: impl FnMut(u32, u32) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        self.pairs_with(self, true, &mut found)
    }

    /// Calls `found` with every box of this tree and box of `other` that touch.
    pub fn each_pair_with(&self, other: &Self, mut found: impl FnMut(u32, u32)) {
        let _ = self.pairs_with(other, false, &mut |ours, theirs| {
            found(ours, theirs);
            ControlFlow::Continue(())
        });
    }

    fn pairs_with(
        &self,
        other: &Self,
        same: bool,
        found: &mut impl FnMut(u32, u32) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        if self.nodes.is_empty() || other.nodes.is_empty() {
            return ControlFlow::Continue(());
        }
        let mut waiting = vec![(0_u32, 0_u32)];
        while let Some((a, b)) = waiting.pop() {
            let (node_a, node_b) = (&self.nodes[a as usize], &other.nodes[b as usize]);
            if !node_a.aabb.touches(&node_b.aabb) {
                continue;
            }
            match (node_a.count, node_b.count) {
                (0, 0) if same && a == b => {
                    waiting.extend([(a + 1, a + 1), (a + 1, node_a.next)]);
                    waiting.push((node_a.next, node_a.next));
                }
                (0, 0) => {
                    let first = [(a + 1, b + 1), (a + 1, node_b.next)];
                    waiting.extend(first);
                    waiting.extend([(node_a.next, b + 1), (node_a.next, node_b.next)]);
                }
                (0, _) => waiting.extend([(a + 1, b), (node_a.next, b)]),
                (_, 0) => waiting.extend([(a, b + 1), (a, node_b.next)]),
                _ => self.leaf_pairs(other, same && a == b, same, a, b, found)?,
            }
        }
        ControlFlow::Continue(())
    }

    /// The pairs of two leaves, or of one with itself.
    fn leaf_pairs(
        &self,
        other: &Self,
        one_leaf: bool,
        same_tree: bool,
        a: u32,
        b: u32,
        found: &mut impl FnMut(u32, u32) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        for i in items(&self.nodes[a as usize]) {
            for j in items(&other.nodes[b as usize]) {
                if (one_leaf && j <= i) || !self.boxes[i].touches(&other.boxes[j]) {
                    continue;
                }
                let (first, second) = (self.items[i], other.items[j]);
                if same_tree && second < first {
                    found(second, first)?;
                } else {
                    found(first, second)?;
                }
            }
        }
        ControlFlow::Continue(())
    }
}

/// The places of a leaf's items.
fn items(leaf: &Node) -> std::ops::Range<usize> {
    let start = leaf.next as usize;
    start..start + leaf.count as usize
}
