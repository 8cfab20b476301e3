//! Plane polygons, with holes, cut into triangles.
//!
//! 1. The outer loop is the one of largest area; its normal tells along which axis to look, and
//!    which way round is counter-clockwise.
//! 2. Each hole is joined to the outer loop by a bridge: the shortest pair of corners that see each
//!    other.
//! 3. Ears are cut off: a corner that turns left, whose triangle holds no other corner.
//!
//! Turns are exact signs in the projection; corners in the middle of a straight side stay corners.

use crate::predicates::{orient_dropping, sign};
use crate::{Face, Point3, Vector3};

/// A loop of corners seen along an axis, so that it runs counter-clockwise.
struct View<'a> {
    points: &'a [Point3],
    axis: usize,
    /// 1 where the projection keeps the sense of the facet, -1 where it turns it round.
    sense: i8,
}

impl View<'_> {
    fn turn(&self, a: u32, b: u32, c: u32) -> i8 {
        self.turn_at(a, b, &self.points[c as usize])
    }

    fn turn_at(&self, a: u32, b: u32, p: &Point3) -> i8 {
        let [a, b] = [a, b].map(|i| &self.points[i as usize]);
        self.sense * sign(orient_dropping(self.axis, a, b, p))
    }

    /// Whether corner `p` lies in the closed triangle `a`, `b`, `c`, which turns left.
    fn holds(&self, a: u32, b: u32, c: u32, p: u32) -> bool {
        self.turn(a, b, p) >= 0 && self.turn(b, c, p) >= 0 && self.turn(c, a, p) >= 0
    }

    fn area_vector(&self, corners: &[u32]) -> Vector3 {
        area_vector(self.points, corners)
    }

    /// Whether a point lies inside a loop, by crossings.
    fn inside(&self, corners: &[u32], p: &Point3) -> bool {
        let v = (self.axis + 2) % 3;
        let mut odd = false;
        for (i, &from) in corners.iter().enumerate() {
            let to = corners[(i + 1) % corners.len()];
            let [a, b] = [from, to].map(|i| &self.points[i as usize]);
            if (a[v] > p[v]) != (b[v] > p[v]) {
                // Left of a side that goes up is before it on the way to high u.
                let side = sign(orient_dropping(self.axis, a, b, p));
                odd ^= (side > 0) == (b[v] > a[v]);
            }
        }
        odd
    }

    /// Whether two corners see each other past all sides of the loops.
    fn sees(&self, from: u32, to: u32, loops: &[&[u32]]) -> bool {
        let between = |a: u32, b: u32, p: u32| {
            let [a, b, p] = [a, b, p].map(|i| &self.points[i as usize]);
            (0..3)
                .filter(|&i| i != self.axis)
                .all(|i| a[i].min(b[i]) <= p[i] && p[i] <= a[i].max(b[i]))
        };
        loops.iter().all(|corners| {
            corners.iter().enumerate().all(|(i, &a)| {
                let b = corners[(i + 1) % corners.len()];
                let on_way =
                    a != from && a != to && self.turn(from, to, a) == 0 && between(from, to, a);
                let crosses = ![a, b].contains(&from)
                    && ![a, b].contains(&to)
                    && self.turn(from, to, a) * self.turn(from, to, b) < 0
                    && self.turn(a, b, from) * self.turn(a, b, to) < 0;
                !on_way && !crosses
            })
        })
    }
}

/// Twice the area of a loop, along its normal (Newell).
fn area_vector(points: &[Point3], corners: &[u32]) -> Vector3 {
    let first = points[corners[0] as usize];
    let arm = |i: usize| points[corners[i] as usize] - first;
    (1..corners.len() - 1).fold(Vector3::zeros(), |sum, i| sum + arm(i).cross(&arm(i + 1)))
}

/// Triangles that cover a plane polygon, oriented like its outer loop.
///
/// `loops` hold indices into `points`, each at least three; sides must not cross. A loop other than
/// the outer one is a hole where one of the points `holes` lies in it; otherwise its inside is
/// covered, too, by triangles of its own. `None` where no outer loop has an area, or the sides cross
/// so that no ear is left. O(n²) for n corners.
pub fn triangulate_facet(
    points: &[Point3],
    loops: &[Vec<u32>],
    holes: &[Point3],
) -> Option<Vec<Face>> {
    if loops.iter().any(|corners| corners.len() < 3) {
        return None;
    }
    if let [corners] = loops
        && let [a, b, c] = *corners.as_slice()
    {
        return Some(vec![[a, b, c]]);
    }
    let area = |corners: &Vec<u32>| area_vector(points, corners).norm_squared();
    let outer = (0..loops.len()).max_by(|&i, &j| area(&loops[i]).total_cmp(&area(&loops[j])))?;
    let normal = area_vector(points, &loops[outer]);
    let axis = normal.iamax();
    if normal[axis] == 0.0 {
        return None;
    }
    let view = View { points, axis, sense: if normal[axis] > 0.0 { 1 } else { -1 } };
    let mut faces = Vec::new();
    let mut inner: Vec<Vec<u32>> = Vec::new();
    for (_, corners) in loops.iter().enumerate().filter(|&(i, _)| i != outer) {
        let mut corners = corners.clone();
        if view.area_vector(&corners).dot(&normal) > 0.0 {
            corners.reverse();
        }
        if !holes.iter().any(|hole| view.inside(&corners, hole)) {
            let own: Vec<u32> = corners.iter().rev().copied().collect();
            faces.extend(cut_ears(&view, own)?);
        }
        inner.push(corners);
    }
    let mut joined = loops[outer].clone();
    while !inner.is_empty() {
        let (which, bridged) = bridge(&view, &joined, &inner)?;
        inner.remove(which);
        joined = bridged;
    }
    faces.extend(cut_ears(&view, joined)?);
    Some(faces)
}

/// Step 2: the loop with its nearest hole joined to it.
fn bridge(view: &View<'_>, outer: &[u32], inner: &[Vec<u32>]) -> Option<(usize, Vec<u32>)> {
    let loops: Vec<&[u32]> =
        std::iter::once(outer).chain(inner.iter().map(Vec::as_slice)).collect();
    let mut ways: Vec<(f64, usize, usize, usize)> = Vec::new();
    for (which, hole) in inner.iter().enumerate() {
        for (i, &from) in outer.iter().enumerate() {
            for (j, &to) in hole.iter().enumerate() {
                let [a, b] = [from, to].map(|corner| &view.points[corner as usize]);
                ways.push(((b - a).norm_squared(), which, i, j));
            }
        }
    }
    ways.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2, a.3).cmp(&(b.1, b.2, b.3))));
    let &(_, which, i, j) =
        ways.iter().find(|&&(_, which, i, j)| view.sees(outer[i], inner[which][j], &loops))?;
    let hole = &inner[which];
    let mut joined = outer[..=i].to_vec();
    joined.extend(hole[j..].iter().chain(&hole[..=j]));
    joined.extend(&outer[i..]);
    Some((which, joined))
}

/// Step 3: ears cut off until a triangle is left.
fn cut_ears(view: &View<'_>, mut corners: Vec<u32>) -> Option<Vec<Face>> {
    let mut faces = Vec::with_capacity(corners.len());
    while corners.len() > 3 {
        let n = corners.len();
        let is_ear = |i: &usize| {
            let (a, b, c) = (corners[(i + n - 1) % n], corners[*i], corners[(i + 1) % n]);
            a != c
                && view.turn(a, b, c) > 0
                && corners.iter().all(|&p| [a, b, c].contains(&p) || !view.holds(a, b, c, p))
        };
        let i = (0..n).find(is_ear)?;
        faces.push([corners[(i + n - 1) % n], corners[i], corners[(i + 1) % n]]);
        corners.remove(i);
    }
    let [a, b, c] = *corners.as_slice() else { return None };
    if view.turn(a, b, c) <= 0 {
        return None;
    }
    faces.push([a, b, c]);
    Some(faces)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(points: &[Point3], faces: &[Face]) -> f64 {
        let half = |f: &Face| 0.5 * area_vector(points, f);
        faces.iter().map(|face| half(face).z).sum()
    }

    fn flat(points: &[[f64; 2]]) -> Vec<Point3> {
        points.iter().map(|[x, y]| Point3::new(*x, *y, 0.25 * x)).collect()
    }

    #[test]
    fn a_comb_is_covered_once() {
        let points = flat(&[
            [0.0, 0.0],
            [5.0, 0.0],
            [5.0, 3.0],
            [4.0, 3.0],
            [4.0, 1.0],
            [3.0, 1.0],
            [3.0, 3.0],
            [2.0, 3.0],
            [2.0, 1.0],
            [1.0, 1.0],
            [1.0, 3.0],
            [0.0, 3.0],
            [0.0, 1.5],
        ]);
        let corners: Vec<u32> = (0..13).collect();
        let faces =
            triangulate_facet(&points, std::slice::from_ref(&corners), &[]).expect("simple");
        assert_eq!(faces.len(), 11);
        assert!((area(&points, &faces) - 11.0).abs() < 1e-12);
        let turned: Vec<u32> = corners.into_iter().rev().collect();
        let faces = triangulate_facet(&points, &[turned], &[]).expect("simple");
        assert!((area(&points, &faces) + 11.0).abs() < 1e-12, "oriented like the loop");
    }

    #[test]
    fn holes_stay_open_and_other_loops_are_covered() {
        let points = flat(&[
            [0.0, 0.0],
            [6.0, 0.0],
            [6.0, 3.0],
            [0.0, 3.0],
            [1.0, 1.0],
            [2.0, 1.0],
            [2.0, 2.0],
            [1.0, 2.0],
            [4.0, 1.0],
            [5.0, 1.0],
            [5.0, 2.0],
            [4.0, 2.0],
        ]);
        let loops = [vec![0, 1, 2, 3], vec![4, 5, 6, 7], vec![8, 9, 10, 11]];
        let hole = Point3::new(1.5, 1.5, 0.375);
        let faces = triangulate_facet(&points, &loops, &[hole]).expect("simple");
        assert!((area(&points, &faces) - 17.0).abs() < 1e-12);
        let both = [hole, Point3::new(4.5, 1.2, 1.125)];
        let faces = triangulate_facet(&points, &loops, &both).expect("simple");
        assert!((area(&points, &faces) - 16.0).abs() < 1e-12);
        assert_eq!(faces.len(), 4 + 8 + 2 * 2 - 2);
    }

    #[test]
    fn crossing_sides_are_refused() {
        let points = flat(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]);
        assert_eq!(triangulate_facet(&points, &[vec![0, 1, 2, 3]], &[]), None);
    }
}
