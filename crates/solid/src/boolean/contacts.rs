//! Between steps 2 and 3: whether operands are in general position.

use super::coincide::PARALLEL;
use crate::bvh::Aabb;
use crate::predicates::{in_triangle, orient3};
use crate::{Point3, Polyhedron};

/// Sets of faces so small that each is held against each.
const FEW_PAIRS: usize = 128;

/// Whether a vertex of one mesh lies exactly on a face of the other, or two faces lie in planes that are
/// alike within `eps_m` where they are near each other.
///
/// Where neither is so, surfaces only pass through each other: nothing coincides, no fold is left and
/// no part without volume. Faces are parted by halves; of each pair of sets only what touches the box of
/// the other stays, so that soon only faces along the curve are left. O(n log n) for n faces where
/// surfaces meet along curves.
pub(super) fn are_in_contact(a: &Polyhedron, b: &Polyhedron, eps_m: f64) -> bool {
    let boxes = |mesh: &Polyhedron| -> Vec<Aabb> {
        (0..mesh.faces().len()).map(|face| Aabb::around(mesh.corners(face)).grown(eps_m)).collect()
    };
    let (of_a, of_b) = (boxes(a), boxes(b));
    let all = |boxes: &[Aabb]| (0..boxes.len() as u32).collect::<Vec<u32>>();
    let mut waiting = vec![(all(&of_a), all(&of_b))];
    while let Some((mut some_a, mut some_b)) = waiting.pop() {
        let around = |faces: &[u32], boxes: &[Aabb]| {
            faces.iter().fold(Aabb::empty(), |sum, &face| sum.union(&boxes[face as usize]))
        };
        let (whole_a, whole_b) = (around(&some_a, &of_a), around(&some_b, &of_b));
        some_a.retain(|&face| of_a[face as usize].touches(&whole_b));
        some_b.retain(|&face| of_b[face as usize].touches(&whole_a));
        if some_a.len() * some_b.len() <= FEW_PAIRS {
            for &i in &some_a {
                for &j in &some_b {
                    let (i, j) = (i as usize, j as usize);
                    if of_a[i].touches(&of_b[j]) && meet_flat(a.corners(i), b.corners(j), eps_m) {
                        return true;
                    }
                }
            }
        } else if some_a.len() > some_b.len() {
            let [low, high] = halves(some_a, &of_a);
            waiting.extend([(low, some_b.clone()), (high, some_b)]);
        } else {
            let [low, high] = halves(some_b, &of_b);
            waiting.extend([(some_a.clone(), low), (some_a, high)]);
        }
    }
    false
}

/// Faces parted along the axis on which their middles are spread most: at the middle, or by
/// their numbers where that parts none.
fn halves(mut faces: Vec<u32>, boxes: &[Aabb]) -> [Vec<u32>; 2] {
    let middle = |face: u32| boxes[face as usize].middle();
    let (low, high) = faces.iter().fold(
        (Point3::from([f64::INFINITY; 3]), Point3::from([f64::NEG_INFINITY; 3])),
        |(low, high), &face| (low.inf(&middle(face)), high.sup(&middle(face))),
    );
    let axis = (high - low).imax();
    let at = 0.5 * (low[axis] + high[axis]);
    let (below, above): (Vec<u32>, Vec<u32>) =
        faces.iter().partition(|&&face| middle(face)[axis] < at);
    if below.is_empty() || above.is_empty() {
        let above = faces.split_off(faces.len() / 2);
        return [faces, above];
    }
    [below, above]
}

fn meet_flat(a: [&Point3; 3], b: [&Point3; 3], eps_m: f64) -> bool {
    let lies_on =
        |p: &Point3, on: [&Point3; 3]| orient3(on[0], on[1], on[2], p) == 0.0 && in_triangle(p, on);
    if a.iter().any(|p| lies_on(p, b)) || b.iter().any(|p| lies_on(p, a)) {
        return true;
    }
    let [n, m] = [a, b].map(|[p, q, r]| (q - p).cross(&(r - p)).try_normalize(0.0));
    let (Some(n), Some(m)) = (n, m) else { return true };
    let heights = b.map(|p| (p - a[0]).dot(&n));
    n.dot(&m).abs() > 1.0 - PARALLEL
        && heights.iter().any(|&h| h <= eps_m)
        && heights.iter().any(|&h| h >= -eps_m)
}
