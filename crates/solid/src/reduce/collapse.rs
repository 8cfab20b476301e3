//! Steps 2, 5 and 7: one collapse, tested and done.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

use super::border;
use super::bound::Kept;
use super::quadric::Quadric;
use super::star::Mesh;
use crate::bvh::{Aabb, LiveBvh};
use crate::mesh::position_classes;
use crate::predicates::is_collinear;
use crate::validity::meet;
use crate::{Face, Point3, Polyhedron, Vector3};

/// The cosine of the largest angle by which a face may turn.
const TURN: f64 = 0.2;

/// Why a vertex was left where it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Refusal {
    Link,
    Label,
    Fold,
    Bound,
    Crossing,
}

/// A directed edge that waits, the cheapest first.
#[derive(Clone, Copy, Debug)]
pub(super) struct Waiting {
    cost: f64,
    pub(super) from: u32,
    pub(super) to: u32,
    stamp: u32,
}

impl PartialEq for Waiting {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl Eq for Waiting {}
impl PartialOrd for Waiting {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Waiting {
    fn cmp(&self, other: &Self) -> Ordering {
        let key = |w: &Self| (w.from, w.to, w.stamp);
        self.cost.total_cmp(&other.cost).then_with(|| key(self).cmp(&key(other)))
    }
}

/// A reduction in the middle of its work.
pub(super) struct Work {
    pub(super) mesh: Mesh,
    pub(super) kept: Kept,
    tree: LiveBvh,
    places: Vec<u32>,
    quadrics: Vec<Quadric>,
    origin: Point3,
    /// How often something changed around each vertex: what waits with an old count is stale.
    stamps: Vec<u32>,
    heap: BinaryHeap<Reverse<Waiting>>,
    bound_m: f64,
    /// Only edges no longer than this wait, metres.
    longest_m: f64,
}

impl Work {
    pub(super) fn new(mesh: &Polyhedron, bound_m: f64, longest_m: f64) -> Self {
        let origin =
            mesh.bounds().map_or(Point3::origin(), |(low, high)| nalgebra::center(&low, &high));
        let mut quadrics = vec![Quadric::default(); mesh.vertices().len()];
        for (face, corners) in mesh.faces().iter().enumerate() {
            let quadric = Quadric::of(mesh.corners(face), &origin);
            for &vertex in corners {
                quadrics[vertex as usize].add(&quadric);
            }
        }
        let boxes: Vec<Aabb> =
            (0..mesh.faces().len()).map(|face| Aabb::around(mesh.corners(face))).collect();
        let places = position_classes(mesh.vertices());
        let mesh = Mesh::of(mesh);
        let mut work = Self {
            kept: Kept::of(&mesh),
            tree: LiveBvh::new(&boxes),
            places,
            quadrics,
            origin,
            stamps: vec![0; mesh.vertices.len()],
            heap: BinaryHeap::new(),
            bound_m,
            longest_m,
            mesh,
        };
        for vertex in 0..work.mesh.vertices.len() as u32 {
            work.wait_from(vertex);
        }
        work
    }

    /// Puts the edges that lead away from a vertex into the heap.
    fn wait_from(&mut self, from: u32) {
        if self.mesh.at[from as usize].is_empty() {
            return;
        }
        for to in self.mesh.neighbours(from) {
            let [p, q] = [from, to].map(|vertex| self.mesh.vertices[vertex as usize]);
            let length = (p - q).norm();
            if length > self.longest_m {
                continue;
            }
            let mut both = self.quadrics[from as usize];
            both.add(&self.quadrics[to as usize]);
            // Of moves that cost nothing, short ones leave better faces.
            let cost = both.at(&q, &self.origin) + 1e-12 * length * length;
            let stamp = self.stamps[from as usize];
            self.heap.push(Reverse(Waiting { cost, from, to, stamp }));
        }
    }

    /// The cheapest edge that waits and is not stale.
    pub(super) fn next(&mut self) -> Option<Waiting> {
        loop {
            let Reverse(waiting) = self.heap.pop()?;
            if self.stamps[waiting.from as usize] == waiting.stamp {
                return Some(waiting);
            }
        }
    }

    /// Draws `from` into `to` if all tests allow it.
    pub(super) fn attempt(&mut self, from: u32, to: u32) -> Result<(), Refusal> {
        if !self.mesh.link_holds(from, to) {
            return Err(Refusal::Link);
        }
        let shift = border::shift_m(&self.mesh, from, to).ok_or(Refusal::Label)?;
        let border = shift + self.kept.border_m[from as usize];
        if shift > 0.0 && border > self.bound_m {
            return Err(Refusal::Bound);
        }
        let old = self.mesh.at[from as usize].clone();
        let (gone, moved): (Vec<u32>, Vec<u32>) =
            old.iter().partition(|&&face| self.mesh.faces[face as usize].contains(&to));
        let new: Vec<Face> = moved
            .iter()
            .map(|&face| self.mesh.faces[face as usize].map(|v| if v == from { to } else { v }))
            .collect();
        if moved
            .iter()
            .zip(&new)
            .any(|(&face, &new)| self.folds(self.mesh.faces[face as usize], new))
        {
            return Err(Refusal::Fold);
        }
        let placed = self.kept.place(&self.mesh, from, &old, &new, self.bound_m);
        let (placed, greatest) = placed.ok_or(Refusal::Bound)?;
        if self.crosses(&old, &new) {
            return Err(Refusal::Crossing);
        }
        self.kept.settle(&old, &moved, &placed, greatest);
        if shift > 0.0 {
            let at_to = &mut self.kept.border_m[to as usize];
            *at_to = at_to.max(border);
        }
        self.carry_out(from, to, &gone, &moved, &new);
        Ok(())
    }

    /// Whether a face becomes flat or turns too far; one that was thinner than the bound may turn, the
    /// exact test for crossings decides there.
    fn folds(&self, old: Face, new: Face) -> bool {
        let normal = |face: Face| -> (Vector3, f64) {
            let [a, b, c] = self.mesh.corners(face);
            let longest = (b - a).norm().max((c - b).norm()).max((a - c).norm());
            ((b - a).cross(&(c - a)), longest)
        };
        let [a, b, c] = self.mesh.corners(new);
        if is_collinear(a, b, c) {
            return true;
        }
        let ((was, longest), (is, _)) = (normal(old), normal(new));
        let thin = was.norm() <= self.bound_m.min(1e-6) * longest;
        !thin && was.dot(&is) < TURN * was.norm() * is.norm()
    }

    /// Whether a new face meets another one, or one that stays, beyond common corners and edges.
    fn crosses(&self, old: &[u32], new: &[Face]) -> bool {
        let places = |face: Face| face.map(|vertex| self.places[vertex as usize]);
        let meets = |a: Face, b: Face| {
            let (of_a, of_b) = (self.mesh.corners(a), self.mesh.corners(b));
            meet(of_a, places(a), of_b, places(b)).is_some()
        };
        for (index, &face) in new.iter().enumerate() {
            if new[..index].iter().any(|&other| meets(face, other)) {
                return true;
            }
            let mut crosses = false;
            self.tree.each_touching(&Aabb::around(self.mesh.corners(face)), |other| {
                crosses = crosses
                    || (!old.contains(&other) && meets(face, self.mesh.faces[other as usize]));
            });
            if crosses {
                return true;
            }
        }
        false
    }

    fn carry_out(&mut self, from: u32, to: u32, gone: &[u32], moved: &[u32], new: &[Face]) {
        for &face in gone {
            self.mesh.alive[face as usize] = false;
            self.tree.remove(face);
            for vertex in self.mesh.faces[face as usize] {
                self.mesh.at[vertex as usize].retain(|&other| other != face);
            }
        }
        self.mesh.count -= gone.len();
        for (&face, &corners) in moved.iter().zip(new) {
            self.mesh.faces[face as usize] = corners;
            self.mesh.at[to as usize].push(face);
            self.tree.set(face, &Aabb::around(self.mesh.corners(corners)));
        }
        self.mesh.at[from as usize].clear();
        let drawn = self.quadrics[from as usize];
        self.quadrics[to as usize].add(&drawn);
        self.stamps[from as usize] += 1;
        let mut near = self.mesh.neighbours(to);
        near.push(to);
        for vertex in near {
            self.stamps[vertex as usize] += 1;
            self.wait_from(vertex);
        }
    }
}
