//! Step 3, of a symmetric difference: two differences get the same vertices along the curve where the surfaces
//! of the operands meet.
//!
//! Each difference by itself is what the engine makes of it: a corner that lies next to a line may be left out of
//! one and not of the other. Then one touches the other where they should meet edge to edge.

use std::collections::{HashMap, HashSet};

use super::changed::{Mixed, key};
use super::surgery::Surgery;
use crate::bvh::{Aabb, Bvh};
use crate::{Point3, Polyhedron};

/// The places of vertices of two differences, laid side by side, that neither an operand nor the other difference
/// has, by the vertex. O(n), expected.
fn alone(mesh: &Polyhedron, operands: &[&Polyhedron]) -> Vec<Point3> {
    let mut known: HashSet<u64, Mixed> = HashSet::with_hasher(Mixed::default());
    known.extend(operands.iter().flat_map(|operand| operand.vertices()).map(key));
    let keys: Vec<u64> = mesh.vertices().iter().map(key).collect();
    let mut uses: HashMap<u64, usize, Mixed> = HashMap::with_hasher(Mixed::default());
    for &key in keys.iter().filter(|key| !known.contains(key)) {
        *uses.entry(key).or_default() += 1;
    }
    let all = mesh.vertices().iter().zip(&keys);
    all.filter(|(_, key)| uses.get(key) == Some(&1)).map(|(&place, _)| place).collect()
}

/// Two differences, laid side by side, with corners where one of them has a vertex within `within_m` of an edge of
/// the other; and the faces at such places, ascending.
///
/// O(n) for n faces, expected, where both have the same vertices along the curve; else O(n) for each that is to
/// be put on one edge.
pub(super) fn matched(
    mesh: Polyhedron,
    operands: &[&Polyhedron],
    within_m: f64,
) -> (Polyhedron, Vec<u32>) {
    let places = alone(&mesh, operands);
    if places.is_empty() {
        return (mesh, Vec::new());
    }
    let mut surgery = Surgery::of(mesh);
    let mut waiting = places.clone();
    while !waiting.is_empty() {
        let left = waiting.len();
        waiting = divided(&mut surgery, waiting, within_m);
        if waiting.len() == left {
            break;
        }
    }
    let mesh = surgery.done();
    let keys: HashSet<u64, Mixed> = places.iter().map(key).collect();
    let is_one = |&v: &u32| keys.contains(&key(&mesh.vertices()[v as usize]));
    let all = mesh.faces().iter().enumerate();
    let at = all.filter(|(_, face)| face.iter().any(is_one)).map(|(face, _)| face as u32).collect();
    (mesh, at)
}

/// Divides the side next to each place, one place for each side; the places that are left.
fn divided(surgery: &mut Surgery, places: Vec<Point3>, within_m: f64) -> Vec<Point3> {
    let tree = Bvh::new(&places.iter().map(|p| Aabb::around([p])).collect::<Vec<_>>());
    let mut nearest = vec![(f64::INFINITY, u32::MAX); places.len()];
    for side in 0..3 * surgery.faces.len() as u32 {
        let [from, to] = surgery.ends(side);
        // Its other face has it, too.
        if from > to {
            continue;
        }
        let [from, to] = [from, to].map(|v| &surgery.vertices[v as usize]);
        tree.each_touching(&Aabb::around([from, to]).grown(within_m), |index| {
            let place = &places[index as usize];
            let off_m = (place - from).cross(&(to - from)).norm() / (to - from).norm();
            let best = &mut nearest[index as usize];
            let is_corner = surgery.beside(side).any(|face| surgery.corners(face).contains(&place));
            if !is_corner && off_m <= within_m && off_m < best.0 {
                *best = (off_m, side);
            }
        });
    }
    let mut touched = HashSet::with_hasher(Mixed::default());
    let mut left = Vec::new();
    for (place, (_, side)) in places.into_iter().zip(nearest) {
        if side == u32::MAX {
            continue;
        }
        let beside: Vec<u32> = surgery.beside(side).collect();
        if beside.iter().any(|face| touched.contains(face)) {
            left.push(place);
        } else if surgery.divides(side, &place) {
            surgery.divide_side(side, place);
            touched.extend(beside);
        }
    }
    left
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Label, check};

    /// Two wedges that share an edge, from `ends[0]` to `ends[1]`; one has a corner on it.
    fn wedges(ends: [Point3; 2], at: Point3) -> Polyhedron {
        let [from, to] = ends;
        let aside = |x: f64, y: f64| Point3::new(x, y, 0.3);
        let (left, back) = (aside(-2.0, 0.4), aside(-2.0, -0.5));
        let (right, front) = (aside(3.0, 0.4), aside(3.0, -0.5));
        let vertices = vec![from, to, left, back, from, to, right, front, at];
        let first = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
        // The second has the corner, number 8, on its edge from 4 to 5.
        let second = [[4, 8, 6], [8, 5, 6], [4, 7, 8], [8, 7, 5], [4, 6, 7], [5, 7, 6]];
        let faces: Vec<_> = first.into_iter().chain(second).collect();
        let labels = vec![Label::Obstacle; faces.len()];
        Polyhedron::try_new(vertices, faces, labels).expect("two wedges")
    }

    fn all_but_the_last(mesh: &Polyhedron) -> Polyhedron {
        let places = mesh.vertices()[..mesh.vertices().len() - 1].to_vec();
        Polyhedron::try_new(places, vec![], vec![]).expect("places")
    }

    #[test]
    fn a_corner_that_one_of_two_differences_lacks_is_put_on_its_edge() {
        let ends = [Point3::new(0.1, 0.05, -1.3), Point3::new(0.3, -0.07, 1.7)];
        let mut spoilt = 0;
        for step in 1..40 {
            let at = ends[0] + (ends[1] - ends[0]) * (f64::from(step) / 40.0);
            let mesh = wedges(ends, at);
            let before = check(&mesh);
            assert!(before.closed && before.manifold, "{:?}", before.defects);
            spoilt += usize::from(before.self_intersecting);
            let operand = mesh.clone();
            assert_eq!(matched(mesh.clone(), &[&operand], 1e-12).0, mesh, "all are known");
            let known = all_but_the_last(&mesh);
            let (whole, at) = matched(mesh, &[&known], 1e-12);
            assert!(check(&whole).is_valid(), "{step}: {:?}", check(&whole).defects);
            assert_eq!((whole.faces().len(), whole.vertices().len()), (12, 10));
            assert_eq!(at.len(), 8, "two faces became four on each side");
        }
        assert!(spoilt > 0, "rounding spoils some: {spoilt}");
    }

    #[test]
    fn a_corner_far_from_all_edges_stays_alone() {
        let ends = [Point3::new(0.0, 0.0, -1.0), Point3::new(0.0, 0.0, 1.0)];
        let mesh = wedges(ends, Point3::new(1e-6, 0.0, 0.1));
        let known = all_but_the_last(&mesh);
        assert_eq!(matched(mesh.clone(), &[&known], 1e-12).0, mesh);
    }
}
