//! Steps 3 and 4: flat faces, and pairs of faces that meet where they should not.

use std::ops::ControlFlow;

use nalgebra::Vector3;

use super::faces_meet::meet;
use crate::bvh::{Aabb, Bvh};
use crate::mesh::position_classes;
use crate::predicates::is_collinear;
use crate::query::distance_to_triangle;
use crate::{Point3, Polyhedron};

/// How two faces meet that should not.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Contact {
    /// They pass through each other.
    Cross,
    /// They have a point in common, and neither passes through the other.
    Touch,
    /// They lie in one plane and have an area in common.
    Overlap,
}

/// Two faces that have more in common than corners and edges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// The faces, ascending.
    pub faces: [u32; 2],
    /// How they meet.
    pub contact: Contact,
    /// Near where they meet, to rounding.
    pub at: Point3,
}

/// The faces whose corners lie exactly on one line, ascending.
pub(crate) fn flat_faces(mesh: &Polyhedron) -> Vec<u32> {
    (0..mesh.faces().len() as u32).filter(|&face| is_flat(mesh, face)).collect()
}

fn is_flat(mesh: &Polyhedron, face: u32) -> bool {
    let [a, b, c] = mesh.corners(face as usize);
    is_collinear(a, b, c)
}

/// The pairs of faces that have more in common than corners and edges at the same places, at most
/// `limit` of them, ascending; exact.
///
/// Flat faces are left out: they are found by themselves. O(n log n) where few boxes touch; faces far
/// larger than most are held against their planes, too.
pub fn crossings(mesh: &Polyhedron, limit: usize) -> Vec<Crossing> {
    crossings_of(mesh, &flat_faces(mesh), limit)
}

pub(super) fn crossings_of(mesh: &Polyhedron, flat: &[u32], limit: usize) -> Vec<Crossing> {
    let place_of = position_classes(mesh.vertices());
    let places = |face: u32| mesh.faces()[face as usize].map(|vertex| place_of[vertex as usize]);
    let mut found = Vec::new();
    if limit == 0 {
        return found;
    }
    let mut look = |a: u32, b: u32| {
        let is_flat = |face: u32| flat.binary_search(&face).is_ok();
        if !is_flat(a) && !is_flat(b) {
            let meeting =
                meet(mesh.corners(a as usize), places(a), mesh.corners(b as usize), places(b));
            if let Some((contact, at)) = meeting {
                found.push(Crossing { faces: [a.min(b), a.max(b)], contact, at });
            }
        }
        if found.len() < limit { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    };
    let Split { long, short } = Split::of(mesh);
    let tree_of =
        |faces: &[u32]| Bvh::new(&faces.iter().map(|&face| around(mesh, face)).collect::<Vec<_>>());
    let few = tree_of(&short);
    let broken = few.pairs(|a, b| look(short[a as usize], short[b as usize])).is_break()
        || tree_of(&long).pairs(|a, b| look(long[a as usize], long[b as usize])).is_break()
        || long.iter().any(|&face| {
            let slab = Slab::of(mesh.corners(face as usize));
            let aabb = around(mesh, face);
            let touches = |candidate: &Aabb| candidate.touches(&aabb) && slab.touches(candidate);
            few.walk(touches, |other| look(face, short[other as usize])).is_break()
        });
    debug_assert!(broken == (found.len() >= limit));
    found.sort_by_key(|crossing| crossing.faces);
    found
}

/// Where one of the faces `some` is flat, or has more in common with any face than corners and edges at the same
/// places: at most `limit` places, as they are found; whether there is one is exact, where it is to rounding.
///
/// O((n + k) log k) for k of n faces where few boxes touch.
pub(crate) fn crossed(mesh: &Polyhedron, some: &[u32], limit: usize) -> Vec<Point3> {
    let flat = some.iter().filter(|&&face| is_flat(mesh, face));
    let mut found: Vec<Point3> =
        flat.map(|&face| *mesh.corners(face as usize)[0]).take(limit).collect();
    if found.len() >= limit {
        return found;
    }
    let tree = Bvh::new(&some.iter().map(|&face| around(mesh, face)).collect::<Vec<_>>());
    let mut look = |a: u32, b: u32| {
        found.extend(meeting(mesh, a, b));
        if found.len() < limit { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    };
    let mut listed = vec![false; mesh.faces().len()];
    for &face in some {
        listed[face as usize] = true;
    }
    let whole = some.iter().fold(Aabb::empty(), |sum, &face| sum.union(&around(mesh, face)));
    let mut others = (0..mesh.faces().len() as u32).filter(|&face| !listed[face as usize]);
    let broken = tree.pairs(|a, b| look(some[a as usize], some[b as usize])).is_break()
        || others.any(|face| {
            let aabb = around(mesh, face);
            aabb.touches(&whole)
                && tree
                    .walk(
                        |candidate| candidate.touches(&aabb),
                        |index| look(face, some[index as usize]),
                    )
                    .is_break()
        });
    debug_assert!(broken == (found.len() >= limit));
    found
}

/// Where two faces have more in common than corners and edges at the same places.
fn meeting(mesh: &Polyhedron, a: u32, b: u32) -> Option<Point3> {
    let (p, q) = (mesh.corners(a as usize), mesh.corners(b as usize));
    // The places of the second are those of the first where they are the same.
    let place = |j: usize| p.iter().position(|&at| at == q[j]).unwrap_or(3 + j) as u32;
    meet(p, [0, 1, 2], q, [0, 1, 2].map(place)).map(|(_, at)| at)
}

/// Whether two of the faces within `within_m` of one of some places have more in common than corners and edges at
/// the same places. O((n + m) log m + k) for m places and k pairs of faces at the same one.
pub(crate) fn meets_itself_at(mesh: &Polyhedron, places: &[Point3], within_m: f64) -> bool {
    let boxes: Vec<Aabb> = places.iter().map(|at| Aabb::around([at]).grown(within_m)).collect();
    let tree = Bvh::new(&boxes);
    let mut near: Vec<(u32, u32)> = Vec::new();
    for face in 0..mesh.faces().len() as u32 {
        tree.each_touching(&around(mesh, face), |at| {
            let corners = mesh.corners(face as usize);
            if distance_to_triangle(&places[at as usize], corners) <= within_m {
                near.push((at, face));
            }
        });
    }
    near.sort_unstable();
    near.chunk_by(|a, b| a.0 == b.0).any(|at| {
        at.iter()
            .enumerate()
            .any(|(i, &(_, a))| at[..i].iter().any(|&(_, b)| meeting(mesh, a, b).is_some()))
    })
}

fn around(mesh: &Polyhedron, face: u32) -> Aabb {
    Aabb::around(mesh.corners(face as usize))
}

/// Faces with boxes far larger than those of most, and the others.
///
/// Their boxes touch those of faces that are nowhere near, thousands each: a face from the camera to
/// the border of its image is such a one. Their planes tell more.
struct Split {
    long: Vec<u32>,
    short: Vec<u32>,
}

impl Split {
    fn of(mesh: &Polyhedron) -> Self {
        let size = |face: u32| {
            let aabb = around(mesh, face);
            (aabb.high - aabb.low).norm()
        };
        let count = mesh.faces().len() as u32;
        let mean = (0..count).map(size).sum::<f64>() / f64::from(count.max(1));
        let (long, short) = (0..count).partition(|&face| size(face) > 8.0 * mean);
        Self { long, short }
    }
}

/// What lies within rounding of the plane of a face.
struct Slab {
    normal: Vector3<f64>,
    through: Point3,
    /// The largest coordinate of the face.
    reach: f64,
}

impl Slab {
    fn of([a, b, c]: [&Point3; 3]) -> Self {
        let normal = (b - a).cross(&(c - a));
        let reach = [a, b, c].iter().map(|p| p.coords.amax()).fold(0.0, f64::max);
        Self { normal, through: *a, reach }
    }

    /// Whether a box may touch the plane: never wrongly denied.
    fn touches(&self, aabb: &Aabb) -> bool {
        let half = (aabb.high - aabb.low) / 2.0;
        let away = self.normal.dot(&(aabb.middle() - self.through));
        let radius = self.normal.abs().dot(&half);
        let reach = self.reach + aabb.high.coords.amax().max(aabb.low.coords.amax());
        // The normal is off by some units in the last place of products of coordinates.
        let rounding = 1e-12 * reach * (self.normal.lp_norm(1) + self.reach * self.reach);
        // No number is never apart.
        let apart = away.abs() > radius + rounding;
        !apart
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Label;

    /// Small triangles among a few long ones, against a look at every pair.
    #[test]
    fn no_pair_is_missed_whatever_the_sizes() {
        let mut seed = 11_u32;
        let mut next = move |n: u32| {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from((seed >> 8) % n)
        };
        let mut met = 0;
        for round in 0..20 {
            let (mut vertices, mut faces) = (Vec::new(), Vec::new());
            for face in 0..120_u32 {
                // Whole numbers: corners coincide, faces lie in one plane.
                let (reach, step) = if face % 30 == 0 { (40, 1.0) } else { (3, 0.5) };
                let from = Point3::new(next(9), next(9), next(9)) * f64::from(face % 30 != 0);
                for _ in 0..3 {
                    let off = Vector3::new(next(reach), next(reach), next(reach)) * step;
                    vertices.push(from + off);
                }
                faces.push([3 * face, 3 * face + 1, 3 * face + 2]);
            }
            let labels = vec![Label::Obstacle; faces.len()];
            let mesh = Polyhedron::try_new(vertices, faces, labels).expect("valid");
            let flat = flat_faces(&mesh);
            let place_of = position_classes(mesh.vertices());
            let places = |face: usize| mesh.faces()[face].map(|v| place_of[v as usize]);
            let mut expected = Vec::new();
            for a in 0..120 {
                for b in a + 1..120 {
                    let meeting = meet(mesh.corners(a), places(a), mesh.corners(b), places(b));
                    let is_flat = [a, b].iter().any(|&face| flat.contains(&(face as u32)));
                    if !is_flat && meeting.is_some() {
                        expected.push([a as u32, b as u32]);
                    }
                }
            }
            let found: Vec<_> = crossings(&mesh, usize::MAX).iter().map(|c| c.faces).collect();
            assert_eq!(found, expected, "{round}");
            met += found.len();
        }
        assert!(met > 50, "{met}");
    }
}
