//! Many triangles under one tree.

use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::Vector;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy, BvhNode};

use super::triangle::{SPACE_LEAK_M, Triangle, ball_hit, nearest_point, ray_hit, segment_distance};
use crate::{Point3, Vector3};

/// Rays that are worth a thread of their own.
const RAYS_PER_THREAD: usize = 2048;

/// Triangles of space, ready to be asked for hits and distances.
///
/// All points are in one frame, metres; the triangles may be any soup, both sides count. Immutable after
/// construction and `Sync`: share it by `Arc`. Answers depend on the triangles alone, not on threads or
/// on the order of questions. Each triangle counts as wider by 1 nm, so that rays do not leak where two
/// meet. Triangles with a corner that is not finite, or that does not exist, are left out.
pub struct MeshCaster {
    triangles: Vec<Triangle>,
    tree: Bvh,
}

impl MeshCaster {
    /// Builds the tree: O(n log n) time, O(n) memory.
    pub fn new(vertices: &[Point3], triangles: &[[u32; 3]]) -> Self {
        let corners = |triangle: &[u32; 3]| -> Option<Triangle> {
            let [a, b, c] = triangle.map(|at| vertices.get(at as usize).copied());
            let corners = [a?, b?, c?];
            corners.iter().all(|p| p.iter().all(|x| x.is_finite())).then_some(corners)
        };
        let triangles: Vec<Triangle> = triangles.iter().filter_map(corners).collect();
        // Boxes are padded by more than the tolerance, so that pruning never loses a hit.
        let pad = 4.0 * SPACE_LEAK_M;
        let boxes: Vec<Aabb> = triangles
            .iter()
            .map(|[a, b, c]| {
                let (low, high) = (a.inf(b).inf(c), a.sup(b).sup(c));
                Aabb::new(
                    Vector::new(low.x - pad, low.y - pad, low.z - pad),
                    Vector::new(high.x + pad, high.y + pad, high.z + pad),
                )
            })
            .collect();
        let tree = Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes);
        Self { triangles, tree }
    }

    /// The triangles that count, in the order in which they were given.
    pub fn triangles(&self) -> &[[Point3; 3]] {
        &self.triangles
    }

    /// Distance along the ray to the nearest triangle, if it is below `max_m`.
    ///
    /// `direction` is a unit vector. A ray that starts on a triangle hits it at 0. O(log n) for ordinary
    /// scenes.
    pub fn cast(&self, origin: &Point3, direction: &Vector3, max_m: f64) -> Option<f64> {
        let ray = BoxRay::new(origin, direction);
        self.best(
            max_m,
            |node, limit| ray.entry(node, limit, 0.0),
            |corners| ray_hit(origin, direction, corners),
        )
    }

    /// [`cast`](Self::cast) for many unit directions from one origin; infinite where nothing is hit.
    ///
    /// The work is shared among as many threads as the machine has and the rays are worth; what comes out
    /// does not depend on them.
    pub fn cast_all(&self, origin: &Point3, directions: &[Vector3], max_m: f64) -> Vec<f64> {
        let mut hits_m = vec![f64::INFINITY; directions.len()];
        let most = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
        let threads = directions.len().div_ceil(RAYS_PER_THREAD).clamp(1, most);
        let cast = |directions: &[Vector3], hits_m: &mut [f64]| {
            for (direction, hit_m) in directions.iter().zip(hits_m) {
                *hit_m = self.cast(origin, direction, max_m).unwrap_or(f64::INFINITY);
            }
        };
        if threads == 1 {
            cast(directions, &mut hits_m);
            return hits_m;
        }
        let share = directions.len().div_ceil(threads);
        std::thread::scope(|scope| {
            for (directions, hits_m) in directions.chunks(share).zip(hits_m.chunks_mut(share)) {
                scope.spawn(move || cast(directions, hits_m));
            }
        });
        hits_m
    }

    /// Whether any triangle touches the straight way between two points.
    pub fn blocked(&self, from: &Point3, to: &Point3) -> bool {
        self.sweep(from, to, 0.0).is_some()
    }

    /// Distance that a ball moves from `from` towards `to` until it touches a triangle, if it does so
    /// before or at `to`.
    ///
    /// A ball that touches a triangle from the start is stopped at 0 if it would move nearer to it, and
    /// not held if it moves away. `radius_m` may be 0; then a point on a triangle is held.
    pub fn sweep(&self, from: &Point3, to: &Point3, radius_m: f64) -> Option<f64> {
        let way = to - from;
        let length_m = way.norm();
        if length_m == 0.0 {
            return None;
        }
        let direction = way / length_m;
        let ray = BoxRay::new(from, &direction);
        self.best(
            length_m + SPACE_LEAK_M,
            |node, limit| ray.entry(node, limit, radius_m),
            |corners| ball_hit(from, &direction, radius_m, corners),
        )
        .map(|along_m| along_m.min(length_m))
    }

    /// Distance from a point to the nearest triangle; infinite where there is none.
    pub fn distance_to(&self, point: &Point3) -> f64 {
        self.best(
            f64::MAX,
            |node, _| box_gap(node, point, point),
            |corners| Some((point - nearest_point(point, corners)).norm()),
        )
        .unwrap_or(f64::INFINITY)
    }

    /// Least distance from any point of the straight way between two points to a triangle; infinite
    /// where there is none, 0 where the way is blocked.
    pub fn clearance(&self, from: &Point3, to: &Point3) -> f64 {
        self.best(
            f64::MAX,
            |node, _| box_gap(node, from, to),
            |corners| Some(segment_distance(from, to, corners)),
        )
        .unwrap_or(f64::INFINITY)
    }

    /// The least leaf cost below `limit`.
    fn best(
        &self,
        limit: f64,
        box_cost: impl Fn(&BvhNode, f64) -> f64,
        leaf_cost: impl Fn(&Triangle) -> Option<f64>,
    ) -> Option<f64> {
        self.tree
            .find_best(limit, box_cost, |leaf, _| leaf_cost(&self.triangles[leaf as usize]))
            .map(|(_, cost)| cost)
    }
}

impl std::fmt::Debug for MeshCaster {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("MeshCaster").field("triangles", &self.triangles.len()).finish()
    }
}

/// A ray prepared for many box tests.
struct BoxRay {
    origin: Point3,
    inverse: Vector3,
}

impl BoxRay {
    fn new(origin: &Point3, direction: &Vector3) -> Self {
        Self { origin: *origin, inverse: direction.map(|x| 1.0 / x) }
    }

    /// Distance to where the ray enters the box grown by `grow`, at least 0; `f64::MAX` if never.
    #[inline]
    fn entry(&self, node: &BvhNode, limit: f64, grow: f64) -> f64 {
        let (mins, maxs) = (node.mins(), node.maxs());
        let (origin, inverse) = (&self.origin, &self.inverse);
        let (x1, x2) = slab(origin.x, inverse.x, mins.x - grow, maxs.x + grow);
        let (y1, y2) = slab(origin.y, inverse.y, mins.y - grow, maxs.y + grow);
        let (z1, z2) = slab(origin.z, inverse.z, mins.z - grow, maxs.z + grow);
        let near = x1.max(y1).max(z1).max(0.0);
        let far = x2.min(y2).min(z2).min(limit);
        if near <= far { near } else { f64::MAX }
    }
}

/// Where a line enters and leaves one slab of a box.
#[inline]
fn slab(origin: f64, inverse: f64, low: f64, high: f64) -> (f64, f64) {
    if inverse.is_infinite() {
        // Parallel: within the slab everywhere or nowhere; 0 · ∞ would be NaN on its border.
        return if origin >= low && origin <= high {
            (f64::NEG_INFINITY, f64::INFINITY)
        } else {
            (f64::INFINITY, f64::NEG_INFINITY)
        };
    }
    let (t1, t2) = ((low - origin) * inverse, (high - origin) * inverse);
    if t1 < t2 { (t1, t2) } else { (t2, t1) }
}

/// A lower bound of the distance between a segment and anything in the box: the gap between their
/// boxes.
#[inline]
fn box_gap(node: &BvhNode, from: &Point3, to: &Point3) -> f64 {
    let (mins, maxs) = (node.mins(), node.maxs());
    let gap = |low: f64, high: f64, a: f64, b: f64| (low - a.max(b)).max(a.min(b) - high).max(0.0);
    let x = gap(mins.x, maxs.x, from.x, to.x);
    let y = gap(mins.y, maxs.y, from.y, to.y);
    let z = gap(mins.z, maxs.z, from.z, to.z);
    (x * x + y * y + z * z).sqrt()
}
