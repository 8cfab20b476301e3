//! How far obstacle faces are from points and segments.

use solid::bvh::{Aabb, Bvh};
use solid::query::closest_on_triangle;
use solid::{Point3, Vector3};

/// Where a segment comes nearest to an obstacle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Near {
    /// How far, metres.
    pub distance_m: f64,
    /// The point of the segment.
    pub on_segment: Point3,
    /// The point of the obstacle.
    pub on_obstacle: Point3,
    /// The obstacle face, in the order in which they were given.
    pub face: u32,
}

/// Obstacle faces in a tree of boxes.
#[derive(Clone, Debug, Default)]
pub struct Obstacles {
    triangles: Vec<[Point3; 3]>,
    tree: Bvh,
}

impl Obstacles {
    /// Gets ready; O(n log n).
    pub fn new(triangles: Vec<[Point3; 3]>) -> Self {
        let boxes: Vec<Aabb> = triangles.iter().map(Aabb::around).collect();
        Self { tree: Bvh::new(&boxes), triangles }
    }

    /// The faces.
    pub fn triangles(&self) -> &[[Point3; 3]] {
        &self.triangles
    }

    /// Distance of a point from the nearest face, if that is less than `reach_m`; metres.
    pub fn within(&self, point: &Point3, reach_m: f64) -> Option<f64> {
        // Boxes that hold the nearest face are small where faces are many.
        [0.125, 0.25, 0.5, 1.0].iter().find_map(|share| self.within_box(point, share * reach_m))
    }

    fn within_box(&self, point: &Point3, reach_m: f64) -> Option<f64> {
        let mut least = reach_m * reach_m;
        let mut found = false;
        self.tree.each_touching(&Aabb::around([point]).grown(reach_m), |face| {
            let [a, b, c] = &self.triangles[face as usize];
            let squared = (point - closest_on_triangle(point, [a, b, c])).norm_squared();
            if squared < least {
                (least, found) = (squared, true);
            }
        });
        found.then(|| least.sqrt())
    }

    /// Where a segment comes nearest to a face, if it comes nearer than `reach_m`.
    pub fn near_segment(&self, from: &Point3, to: &Point3, reach_m: f64) -> Option<Near> {
        let length = (to - from).norm();
        // Boxes around short pieces hold few faces.
        let pieces = (length / (2.0 * reach_m).max(length / 64.0)).ceil().clamp(1.0, 64.0);
        let mut best: Option<Near> = None;
        let at = |i: f64| if i >= pieces { *to } else { from + (to - from) * (i / pieces) };
        let mut i = 0.0;
        while i < pieces {
            let (a, b) = (at(i), at(i + 1.0));
            self.tree.each_touching(&Aabb::around([&a, &b]).grown(reach_m), |face| {
                let least = best.map_or(reach_m, |near| near.distance_m);
                let triangle = &self.triangles[face as usize];
                let (on_segment, on_obstacle) = between(&a, &b, triangle);
                let distance_m = (on_segment - on_obstacle).norm();
                let first =
                    best.is_some_and(|near| near.distance_m == distance_m && face < near.face);
                if distance_m < least || first {
                    best = Some(Near { distance_m, on_segment, on_obstacle, face });
                }
            });
            i += 1.0;
        }
        best
    }

    /// The points of a segment and of a face that are nearest to each other, to rounding.
    pub fn pair(&self, from: &Point3, to: &Point3, face: u32) -> (Point3, Point3) {
        between(from, to, &self.triangles[face as usize])
    }
}

/// The nearest points of a segment and a triangle, to rounding.
pub(crate) fn between(p: &Point3, q: &Point3, triangle: &[Point3; 3]) -> (Point3, Point3) {
    let [a, b, c] = triangle;
    if let Some(at) = crossing(p, q, triangle) {
        return (at, at);
    }
    let mut best = (*p, closest_on_triangle(p, [a, b, c]));
    let mut least = (best.0 - best.1).norm_squared();
    let mut offer = |pair: (Point3, Point3)| {
        let squared = (pair.0 - pair.1).norm_squared();
        if squared < least {
            (least, best) = (squared, pair);
        }
    };
    offer((*q, closest_on_triangle(q, [a, b, c])));
    for (from, to) in [(a, b), (b, c), (c, a)] {
        offer(of_segments(p, q, from, to));
    }
    best
}

/// Where a segment passes a triangle, to rounding; `None` where it does not, or runs in its plane.
pub(super) fn crossing(p: &Point3, q: &Point3, [a, b, c]: &[Point3; 3]) -> Option<Point3> {
    let (u, v) = (b - a, c - a);
    let normal = u.cross(&v);
    let (above_p, above_q) = (normal.dot(&(p - a)), normal.dot(&(q - a)));
    if above_p * above_q > 0.0 || above_p == above_q {
        return None;
    }
    let at = p + (q - p) * (above_p / (above_p - above_q));
    let inside = |s: &Point3, t: &Point3| normal.dot(&(t - s).cross(&(at - s))) >= 0.0;
    (inside(a, b) && inside(b, c) && inside(c, a)).then_some(at)
}

/// The nearest points of two segments, to rounding (Ericson 2005, 5.1.9).
fn of_segments(p: &Point3, q: &Point3, r: &Point3, s: &Point3) -> (Point3, Point3) {
    let (u, v, w): (Vector3, Vector3, Vector3) = (q - p, s - r, p - r);
    let (uu, vv, uv) = (u.norm_squared(), v.norm_squared(), u.dot(&v));
    let (uw, vw) = (u.dot(&w), v.dot(&w));
    let share = |above: f64, below: f64| {
        if below > 0.0 { (above / below).clamp(0.0, 1.0) } else { 0.0 }
    };
    let mut along = share(uv * vw - uw * vv, uu * vv - uv * uv);
    let mut across = share(uv * along + vw, vv);
    // Where the second had to be clamped, the first is to be found anew.
    along = share(uv * across - uw, uu);
    across = if vv > 0.0 { ((uv * along + vw) / vv).clamp(0.0, 1.0) } else { across };
    (p + u * along, r + v * across)
}
