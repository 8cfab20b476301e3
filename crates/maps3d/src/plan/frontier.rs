//! Step 3: points that stand for frontier faces.

use solid::Point3;

use super::bottleneck::{Passage, passage};
use super::space::{FrontierFace, Space, middle_of};
use crate::PlanOptions;

/// Parts that one edge of a frontier face is cut into, at most.
const MOST_CUTS: usize = 16;

/// A point on a frontier face: a goal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrontierNode {
    /// Where; it lies in the closed tetrahedron, exactly, and on the face to rounding.
    pub at: Point3,
    /// Its face, in the order of [`Space::frontier`].
    pub face: u32,
    /// The tetrahedron that has the face.
    pub tetrahedron: u32,
    /// Area of the face, square metres.
    pub area_m2: f64,
}

/// The points of all frontier faces (\[Mos15\] 4.4.2), and how many a ball cannot reach.
///
/// A face is cut into n² equal triangles, n large enough that none has an edge longer than the spacing;
/// the middle of each is a point, or where the ball does not fit there, a point of it where it does.
pub(super) fn nodes(space: &Space, options: &PlanOptions) -> (Vec<FrontierNode>, usize) {
    let mut nodes = Vec::new();
    let mut narrow = 0;
    for (index, face) in space.frontier().iter().enumerate() {
        let [a, b, c] = space.points(face.corners);
        let area_m2 = (b - a).cross(&(c - a)).norm() / 2.0;
        if area_m2 < options.least_area_m2 {
            continue;
        }
        let longest =
            [(a, b), (b, c), (c, a)].iter().map(|(p, q)| (p - q).norm()).fold(0.0, f64::max);
        let cuts = (longest / options.spacing_m).ceil().clamp(1.0, MOST_CUTS as f64) as usize;
        let point = |i: usize, j: usize| {
            a + (b - a) * (i as f64 / cuts as f64) + (c - a) * (j as f64 / cuts as f64)
        };
        for i in 0..cuts {
            for j in 0..cuts - i {
                let lower = [point(i, j), point(i + 1, j), point(i, j + 1)];
                let upper = [point(i + 1, j + 1), point(i, j + 1), point(i + 1, j)];
                let both = [Some(lower), (i + j + 1 < cuts).then_some(upper)];
                for part in both.into_iter().flatten() {
                    match reached(space, face, &part, options.radius_m) {
                        Some(at) => nodes.push(FrontierNode {
                            at,
                            face: index as u32,
                            tetrahedron: face.tetrahedron,
                            area_m2,
                        }),
                        None => narrow += 1,
                    }
                }
            }
        }
    }
    (nodes, narrow)
}

/// A point of a part of a face where a ball fits.
fn reached(
    space: &Space,
    face: &FrontierFace,
    part: &[Point3; 3],
    radius_m: f64,
) -> Option<Point3> {
    let middle = middle_of([&part[0], &part[1], &part[2]]);
    let at = if radius_m == 0.0 {
        middle
    } else {
        match passage(part, radius_m, space.obstacles()) {
            Passage::Open(at) => at,
            Passage::Unknown => middle,
            Passage::Shut => return None,
        }
    };
    Some(held(space, face.tetrahedron, at))
}

/// The point, or one beside it that lies in the closed tetrahedron, exactly.
pub(super) fn held(space: &Space, tetrahedron: u32, at: Point3) -> Point3 {
    if space.holds(tetrahedron, &at) {
        return at;
    }
    let inner = space.middle(tetrahedron);
    let mut share = 1e-15;
    while share < 1.0 {
        let moved = at + (inner - at) * share;
        if space.holds(tetrahedron, &moved) {
            return moved;
        }
        share *= 8.0;
    }
    inner
}

/// Pairs of points of one face that are next to each other, and nearest pairs of neighbouring faces.
pub(super) fn neighbours(space: &Space, nodes: &[FrontierNode]) -> Vec<(u32, u32)> {
    let mut pairs = Vec::new();
    // Nodes of one face follow each other.
    let mut ranges: Vec<(u32, u32)> = Vec::new();
    for (i, node) in nodes.iter().enumerate() {
        match ranges.last_mut() {
            Some((first, end)) if nodes[*first as usize].face == node.face => *end = i as u32 + 1,
            _ => ranges.push((i as u32, i as u32 + 1)),
        }
    }
    let mut edges: Vec<([u32; 2], usize)> = Vec::new();
    for (range, &(first, end)) in ranges.iter().enumerate() {
        for i in first..end {
            let nearest = |later: bool| {
                let others = (first..end).filter(move |&j| j != i && (j > i) == later);
                others.min_by(|&j, &k| {
                    let to = |j: u32| (nodes[j as usize].at - nodes[i as usize].at).norm_squared();
                    to(j).total_cmp(&to(k)).then(j.cmp(&k))
                })
            };
            pairs.extend(
                [nearest(false), nearest(true)].into_iter().flatten().map(|j| (i.min(j), i.max(j))),
            );
        }
        let [a, b, c] = space.frontier()[nodes[first as usize].face as usize].corners;
        edges.extend([[a, b], [b, c], [c, a]].map(|[p, q]| ([p.min(q), p.max(q)], range)));
    }
    edges.sort_unstable();
    for pair in edges.windows(2) {
        let [(edge, r), (other, s)] = [pair[0], pair[1]];
        if edge != other {
            continue;
        }
        let apart =
            |&(i, j): &(u32, u32)| (nodes[i as usize].at - nodes[j as usize].at).norm_squared();
        let all = (ranges[r].0..ranges[r].1)
            .flat_map(|i| (ranges[s].0..ranges[s].1).map(move |j| (i, j)));
        let nearest = all.min_by(|a, b| apart(a).total_cmp(&apart(b)).then(a.cmp(b)));
        pairs.extend(nearest.map(|(i, j)| (i.min(j), i.max(j))));
    }
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}
