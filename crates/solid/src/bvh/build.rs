//! Step 1: the tree.

use super::Aabb;
use crate::{Point3, Polyhedron};

/// Boxes per leaf.
const LEAF: usize = 4;

/// A node; the first child of an inner node comes right after it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub(super) aabb: Aabb,
    /// Leaf: where its items start. Inner node: its second child.
    pub(super) next: u32,
    /// Number of items of a leaf; 0 for an inner node.
    pub(super) count: u32,
}

/// A tree of boxes.
#[derive(Clone, Debug, Default)]
pub struct Bvh {
    pub(super) nodes: Vec<Node>,
    /// Indices of boxes, leaf by leaf.
    pub(super) items: Vec<u32>,
    /// The boxes, in the order of `items`.
    pub(super) boxes: Vec<Aabb>,
}

impl Bvh {
    /// A tree over boxes; O(n log n).
    pub fn new(boxes: &[Aabb]) -> Self {
        let mut items: Vec<u32> = (0..boxes.len() as u32).collect();
        let mut nodes = Vec::with_capacity(boxes.len());
        // Ranges still to be split, and the parent whose second child each becomes.
        let mut waiting = vec![(0, boxes.len(), None)];
        while let Some((start, end, parent)) = waiting.pop() {
            if start == end {
                continue;
            }
            if let Some(parent) = parent {
                let here = nodes.len() as u32;
                let parent: &mut Node = &mut nodes[parent];
                parent.next = here;
            }
            let range = &mut items[start..end];
            let aabb = range.iter().fold(Aabb::empty(), |sum, &i| sum.union(&boxes[i as usize]));
            if range.len() <= LEAF {
                nodes.push(Node { aabb, next: start as u32, count: range.len() as u32 });
                continue;
            }
            let middle_of = |i: u32| boxes[i as usize].middle();
            let middles: Vec<_> = range.iter().map(|&i| middle_of(i)).collect();
            let spread = Aabb::around(&middles);
            let axis = (spread.high - spread.low).imax();
            let half = range.len() / 2;
            range.select_nth_unstable_by(half, |&i, &j| {
                middle_of(i)[axis].total_cmp(&middle_of(j)[axis]).then(i.cmp(&j))
            });
            let here = nodes.len();
            nodes.push(Node { aabb, next: 0, count: 0 });
            waiting.push((start + half, end, Some(here)));
            waiting.push((start, start + half, None));
        }
        let boxes = items.iter().map(|&i| boxes[i as usize]).collect();
        Self { nodes, items, boxes }
    }

    /// The lowest and the highest coordinates of all boxes; `None` without boxes.
    pub fn bounds(&self) -> Option<(Point3, Point3)> {
        self.nodes.first().map(|root| (root.aabb.low, root.aabb.high))
    }

    /// Memory held on the heap, bytes.
    pub fn heap_bytes(&self) -> usize {
        size_of_val(&self.nodes[..]) + size_of_val(&self.items[..]) + size_of_val(&self.boxes[..])
    }

    /// A tree over the faces of a mesh.
    pub fn of_faces(mesh: &Polyhedron) -> Self {
        let boxes: Vec<Aabb> =
            (0..mesh.faces().len()).map(|face| Aabb::around(mesh.corners(face))).collect();
        Self::new(&boxes)
    }
}
