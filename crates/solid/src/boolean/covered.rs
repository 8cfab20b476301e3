//! Step 5, first part: frontier faces are cut along the borders of what obstacle faces cover of them.

use std::collections::BTreeMap;

use super::coincide::Obstacles;
use super::surgery::Surgery;
use crate::{Label, Point3, Polyhedron};

/// Sides of obstacle faces that pass a corner of a frontier face nearer than this share of what
/// coincides pass through it.
const BORDER_SHARE: f64 = 1e-3;

/// So much of the largest coordinate is rounding.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// How near a border passes what it is taken to pass through, metres.
pub(super) fn border_m(eps_m: f64, reach_m: f64) -> f64 {
    (BORDER_SHARE * eps_m).max(ROUNDING * reach_m)
}

type Flat = [f64; 2];

/// How a face is seen along an axis: the projection that keeps most of it.
#[derive(Clone, Copy)]
struct Sight {
    axis: usize,
    /// 1 where what runs counter-clockwise is seen to do so, else -1.
    sense: f64,
}

impl Sight {
    fn see(self, p: &Point3) -> Flat {
        [p[(self.axis + 1) % 3], p[(self.axis + 2) % 3]]
    }
}

/// A side of a convex polygon: what is inside lies to its left.
#[derive(Clone, Copy)]
struct Side {
    from: Flat,
    /// Of length 1.
    inward: Flat,
}

impl Side {
    /// How far inside of the side a place is, metres as seen.
    fn depth(&self, [u, v]: Flat) -> f64 {
        (u - self.from[0]) * self.inward[0] + (v - self.from[1]) * self.inward[1]
    }
}

/// What an obstacle face covers of the plane of a frontier face, as seen: convex.
struct Cover {
    /// The obstacle face.
    face: u32,
    corners: Vec<Flat>,
    sides: Vec<Side>,
    /// Whether the sides are those of the face, in their order: nothing of it is too far up or down.
    whole: bool,
}

impl Cover {
    fn of(face: u32, corners: Vec<Flat>, whole: bool) -> Self {
        let [u, v] = corners[0];
        let arm = |p: &Flat| [p[0] - u, p[1] - v];
        let twice = |pair: &[Flat]| {
            let ([a, b], [c, d]) = (arm(&pair[0]), arm(&pair[1]));
            a * d - b * c
        };
        let sides = sides_of(&corners, corners.windows(2).map(twice).sum::<f64>().signum());
        let whole = whole && sides.len() == 3;
        Self { face, corners, sides, whole }
    }

    /// Whether it and a triangle have more in common than a strip of `border` along a side.
    fn overlaps(&self, triangle: &[Flat; 3], sense: f64, border: f64) -> bool {
        let beyond = |sides: &[Side], corners: &[Flat]| {
            sides.iter().any(|side| corners.iter().all(|&p| side.depth(p) <= border))
        };
        !beyond(&self.sides, triangle) && !beyond(&sides_of(triangle, sense), &self.corners)
    }
}

fn sides_of(corners: &[Flat], sense: f64) -> Vec<Side> {
    let ends = corners.iter().zip(corners.iter().cycle().skip(1));
    let side = |(&from, &to): (&Flat, &Flat)| {
        let along = [to[0] - from[0], to[1] - from[1]];
        let length = along[0].hypot(along[1]);
        let inward = [-along[1] * sense / length, along[0] * sense / length];
        (length > 0.0).then_some(Side { from, inward })
    };
    ends.filter_map(side).collect()
}

/// The part of a triangle whose heights, one for each corner, are at most `eps_m` up or down.
fn within_slab(corners: [&Point3; 3], heights: [f64; 3], eps_m: f64) -> Vec<Point3> {
    let mut polygon: Vec<(Point3, f64)> =
        corners.iter().zip(heights).map(|(&&p, height)| (p, height)).collect();
    for up in [1.0, -1.0] {
        let mut kept = Vec::with_capacity(polygon.len() + 1);
        for (i, &(p, h)) in polygon.iter().enumerate() {
            let (q, k) = polygon[(i + 1) % polygon.len()];
            if up * h <= eps_m {
                kept.push((p, h));
            }
            if (up * h <= eps_m) != (up * k <= eps_m) {
                let share = (up * eps_m - h) / (k - h);
                kept.push((p + (q - p) * share, up * eps_m));
            }
        }
        polygon = kept;
        if polygon.is_empty() {
            break;
        }
    }
    polygon.into_iter().map(|(p, _)| p).collect()
}

/// The covers that divide a frontier face, and how it is seen.
fn covers(
    mesh: &Polyhedron,
    face: usize,
    obstacles: &Obstacles<'_>,
    eps_m: f64,
) -> Option<(Sight, f64, Vec<Cover>)> {
    let scaled = mesh.scaled_normal(face);
    let normal = scaled.try_normalize(0.0)?;
    let corners = mesh.corners(face);
    let axis = normal.iamax();
    let sight = Sight { axis, sense: normal[axis].signum() };
    let reach_m = corners.iter().map(|p| p.coords.amax()).fold(0.0, f64::max);
    let border = border_m(eps_m, reach_m);
    let seen = corners.map(|p| sight.see(p));
    let mut covers = Vec::new();
    let mut whole = false;
    obstacles.each_near(corners, &normal, eps_m, |number, other| {
        let heights = other.map(|p| (p - corners[0]).dot(&normal));
        let part = within_slab(other, heights, eps_m);
        if part.len() < 3 {
            return;
        }
        let within = heights.iter().all(|height| height.abs() <= eps_m);
        let cover = Cover::of(number, part.iter().map(|p| sight.see(p)).collect(), within);
        if cover.overlaps(&seen, sight.sense, border) {
            whole |= cover.sides.iter().all(|side| seen.iter().all(|&p| side.depth(p) >= -border));
            covers.push(cover);
        }
    });
    // What lies within one obstacle face is not cut.
    (!whole && !covers.is_empty()).then_some((sight, border, covers))
}

/// The mesh with its frontier faces cut so that each is covered wholly or nowhere by obstacle faces
/// within `eps_m` that look the same way; the same mesh where none is covered in part.
///
/// New corners lie on edges, to rounding, and are corners of both faces there. O((f + o) log o + p) for
/// f frontier faces, o obstacle faces and p pairs of them that are near each other.
pub(super) fn cut(mesh: Polyhedron, obstacles: &Obstacles<'_>, eps_m: f64) -> Polyhedron {
    let frontier = mesh.labels().iter().enumerate().filter(|(_, label)| **label == Label::Frontier);
    let divided: Vec<_> = frontier
        .filter_map(|(face, _)| Some((face as u32, covers(&mesh, face, obstacles, eps_m)?)))
        .collect();
    if divided.is_empty() {
        return mesh;
    }
    let across = obstacles.across();
    let mut pieces = Pieces { surgery: Surgery::of(mesh), of_root: BTreeMap::new() };
    for (face, (sight, border, covers)) in &divided {
        let mut whole: Vec<u32> =
            covers.iter().filter(|cover| cover.whole).map(|cover| cover.face).collect();
        whole.sort_unstable();
        // Where another face of the same obstacle goes on there is no border.
        let goes_on = |cover: &Cover, side: usize| {
            cover.whole && whole.binary_search(&across[cover.face as usize][side]).is_ok()
        };
        for cover in covers {
            let border_sides = (0..cover.sides.len()).filter(|&side| !goes_on(cover, side));
            border_sides.for_each(|side| pieces.cut(*face, *sight, *border, cover, side));
        }
    }
    pieces.surgery.done()
}

/// A mesh that is being cut.
struct Pieces {
    surgery: Surgery,
    /// The pieces of faces that were divided, by the face.
    of_root: BTreeMap<u32, Vec<u32>>,
}

impl Pieces {
    /// Cuts the pieces of a face that a cover overlaps along one of its sides.
    fn cut(&mut self, root: u32, sight: Sight, border: f64, cover: &Cover, side: usize) {
        let side = cover.sides[side];
        let mut waiting = self.of_root.get(&root).cloned().unwrap_or_else(|| vec![root]);
        while let Some(piece) = waiting.pop() {
            let seen = self.surgery.corners(piece).map(|p| sight.see(p));
            if !cover.overlaps(&seen, sight.sense, border) {
                continue;
            }
            if let Some(new) = self.cut_once(piece, seen.map(|p| side.depth(p)), border) {
                // Of the face across only what belongs to this root is looked at again.
                let ours = |f: &u32| self.surgery.root_of[*f as usize] == root;
                waiting.extend(new.into_iter().filter(ours));
            }
        }
    }

    /// Divides a piece, and what is across, where a side of it passes from one side of a line to the
    /// other; the faces that became of them.
    fn cut_once(&mut self, piece: u32, depths: [f64; 3], border: f64) -> Option<Vec<u32>> {
        for i in 0..3 {
            let (here, there) = (depths[i], depths[(i + 1) % 3]);
            if here.abs() <= border || there.abs() <= border || (here > 0.0) == (there > 0.0) {
                continue;
            }
            let side = 3 * piece + i as u32;
            let [from, to] = self.surgery.ends(side).map(|v| self.surgery.vertices[v as usize]);
            let share = here / (here - there);
            let at = from + (to - from) * share;
            if !self.surgery.divides(side, &at) {
                continue;
            }
            let mut changed: Vec<u32> = self.surgery.beside(side).collect();
            let before = self.surgery.faces.len() as u32;
            self.surgery.divide_side(side, at);
            for new in before..self.surgery.faces.len() as u32 {
                let root = self.surgery.root_of[new as usize];
                self.of_root.entry(root).or_insert_with(|| vec![root]).push(new);
                changed.push(new);
            }
            return Some(changed);
        }
        None
    }
}
