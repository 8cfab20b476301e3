//! Between steps 2 and 3: whether operands are in general position.

use std::ops::ControlFlow;

use super::coincide::PARALLEL;
use crate::bvh::Aabb;
use crate::predicates::{in_triangle, orient3};
use crate::query::distance_to_triangle;
use crate::{Point3, Polyhedron, Vector3};

/// Sets of faces so small that each is held against each.
const FEW_PAIRS: usize = 128;

/// So much of the largest coordinate is what rounding leaves of a contact: a turn, then a boolean.
const ROUNDING: f64 = 1024.0 * f64::EPSILON;

/// How the surfaces of two operands lie to each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Contacts {
    /// They only pass through each other: nothing coincides, no fold is left and no part without volume.
    None,
    /// Vertices of one lie exactly on faces of the other, or faces lie in planes that are alike within what
    /// coincides.
    Sharp,
    /// As before, but for rounding: which of two faces is in front may differ from corner to corner.
    Rounded,
}

/// How the surfaces of two meshes lie to each other; faces in planes that are alike within `eps_m` are in contact
/// where they are near each other.
pub(super) fn contacts(a: &Polyhedron, b: &Polyhedron, eps_m: f64) -> Contacts {
    let rounding_m = rounding_m(&[a, b]);
    let mut worst = Contacts::None;
    let _ = each_near(a, b, eps_m, |one, other| {
        worst = worst.max(meeting(one, other, eps_m, rounding_m));
        if worst == Contacts::Rounded { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    worst
}

/// Whether faces of two meshes are in planes that are alike within `eps_m`, and farther apart than rounding:
/// one mesh has layers that an earlier move left.
pub(super) fn are_layered(a: &Polyhedron, b: &Polyhedron, eps_m: f64) -> bool {
    let rounding_m = rounding_m(&[a, b]);
    each_near(a, b, eps_m, |one, other| {
        let Some([n, m]) = normals([one, other]) else { return ControlFlow::Continue(()) };
        let heights = other.map(|p| (p - one[0]).dot(&n).abs());
        let most = heights.into_iter().fold(0.0, f64::max);
        if n.dot(&m).abs() > 1.0 - PARALLEL && most > rounding_m && most <= eps_m {
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    })
    .is_break()
}

/// What is rounding at the largest coordinate of some meshes, metres.
pub(super) fn rounding_m(meshes: &[&Polyhedron]) -> f64 {
    let bounds = meshes.iter().filter_map(|mesh| mesh.bounds());
    let reach = bounds.map(|(low, high)| low.coords.amax().max(high.coords.amax()));
    ROUNDING * reach.fold(0.0, f64::max)
}

type Corners<'a> = [&'a Point3; 3];

/// Directions that two faces look in; `None` where one is flat.
fn normals(faces: [Corners<'_>; 2]) -> Option<[Vector3; 2]> {
    let [n, m] = faces.map(|[p, q, r]| (q - p).cross(&(r - p)).try_normalize(0.0));
    Some([n?, m?])
}

/// Calls `found` with the faces of two meshes whose boxes are no farther apart than about `eps_m`; stops where it
/// breaks, and tells.
///
/// Faces are parted by halves; of each pair of sets only what touches the box of the other stays, so that soon
/// only faces along the curve are left. O(n log n) for n faces where surfaces meet along curves.
fn each_near<'a>(
    a: &'a Polyhedron,
    b: &'a Polyhedron,
    eps_m: f64,
    mut found: impl FnMut(Corners<'a>, Corners<'a>) -> ControlFlow<()>,
) -> ControlFlow<()> {
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
                    if of_a[i].touches(&of_b[j]) {
                        found(a.corners(i), b.corners(j))?;
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
    ControlFlow::Continue(())
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

fn meeting(a: Corners<'_>, b: Corners<'_>, eps_m: f64, rounding_m: f64) -> Contacts {
    let Some([n, m]) = normals([a, b]) else { return Contacts::Sharp };
    let above_a = b.map(|p| (p - a[0]).dot(&n));
    let above_b = a.map(|p| (p - b[0]).dot(&m));
    let mut found = Contacts::None;
    for (points, heights, on) in [(b, above_a, a), (a, above_b, b)] {
        for (p, height) in points.into_iter().zip(heights) {
            // The height is off by less than what is rounding here.
            if height.abs() <= 2.0 * rounding_m && distance_to_triangle(p, on) <= rounding_m {
                let sharp = orient3(on[0], on[1], on[2], p) == 0.0 && in_triangle(p, on);
                found = found.max(if sharp { Contacts::Sharp } else { Contacts::Rounded });
            }
        }
    }
    let alike = n.dot(&m).abs() > 1.0 - PARALLEL
        && above_a.iter().any(|&h| h <= eps_m)
        && above_a.iter().any(|&h| h >= -eps_m);
    if !alike {
        return found;
    }
    let in_plane = |p: &Point3| orient3(a[0], a[1], a[2], p) == 0.0;
    let rounded = above_a.iter().all(|h| h.abs() <= rounding_m) && !b.into_iter().all(in_plane);
    found.max(if rounded { Contacts::Rounded } else { Contacts::Sharp })
}
