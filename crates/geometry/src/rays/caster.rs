//! Many segments under one tree.

use parry2d_f64::bounding_volume::Aabb;
use parry2d_f64::math::Vector;
use parry2d_f64::partitioning::{Bvh, BvhBuildStrategy, BvhNode};

use super::segment::{LEAK_TOLERANCE_M, disc_hit, point_distance, ray_hit, segment_distance};
use crate::{Point2, Vector2};

/// Segments of the plane, ready to be asked for hits and distances.
///
/// All points are in one frame, metres. Immutable after construction and `Sync`: share it by
/// `Arc`. Answers depend on the segments alone, not on threads or on the order of questions. Each
/// segment counts as longer by 1 nm at both ends, so that rays do not leak where two segments
/// meet. Segments with an end that is not finite are left out.
pub struct SegmentCaster {
    segments: Vec<(Point2, Point2)>,
    tree: Bvh,
}

impl SegmentCaster {
    /// Builds the tree: O(n log n) time, O(n) memory.
    pub fn new(segments: &[(Point2, Point2)]) -> Self {
        let finite = |p: &Point2| p.x.is_finite() && p.y.is_finite();
        let segments: Vec<(Point2, Point2)> =
            segments.iter().filter(|(a, b)| finite(a) && finite(b)).copied().collect();
        // Boxes are padded by more than the tolerance, so that pruning never loses a hit.
        let pad = 4.0 * LEAK_TOLERANCE_M;
        let boxes: Vec<Aabb> = segments
            .iter()
            .map(|(a, b)| {
                Aabb::new(
                    Vector::new(a.x.min(b.x) - pad, a.y.min(b.y) - pad),
                    Vector::new(a.x.max(b.x) + pad, a.y.max(b.y) + pad),
                )
            })
            .collect();
        let tree = Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes);
        Self { segments, tree }
    }

    /// The segments, in the order in which they were given.
    pub fn segments(&self) -> &[(Point2, Point2)] {
        &self.segments
    }

    /// Distance along the ray to the nearest segment, if it is below `max_m`.
    ///
    /// `direction` is a unit vector. A ray that starts on a segment hits it at 0. O(log n) for
    /// ordinary scenes.
    pub fn cast(&self, origin: &Point2, direction: &Vector2, max_m: f64) -> Option<f64> {
        let ray = BoxRay::new(origin, direction);
        self.best(
            max_m,
            |node, limit| ray.entry(node, limit, 0.0),
            |a, b| ray_hit(origin, direction, a, b),
        )
    }

    /// Distance from `from` to the first segment met on the way to `to`, `to` itself included.
    pub fn first_hit(&self, from: &Point2, to: &Point2) -> Option<f64> {
        self.sweep(from, to, 0.0)
    }

    /// Whether any segment touches the straight way between two points.
    pub fn blocked(&self, from: &Point2, to: &Point2) -> bool {
        self.first_hit(from, to).is_some()
    }

    /// Distance that a disc moves from `from` towards `to` until it touches a segment, if it does
    /// so before or at `to`.
    ///
    /// A disc that touches a segment from the start is stopped at 0 if it would move nearer to
    /// it, and not held if it moves away. `radius_m` may be 0; then a point on a segment is held.
    pub fn sweep(&self, from: &Point2, to: &Point2, radius_m: f64) -> Option<f64> {
        let way = to - from;
        let length_m = way.norm();
        if length_m == 0.0 {
            return None;
        }
        let direction = way / length_m;
        let ray = BoxRay::new(from, &direction);
        let limit_m = length_m + LEAK_TOLERANCE_M;
        self.best(
            limit_m,
            |node, limit| ray.entry(node, limit, radius_m),
            |a, b| disc_hit(from, &direction, radius_m, a, b),
        )
        .map(|along_m| along_m.min(length_m))
    }

    /// Distance from a point to the nearest segment; infinite where there is none.
    pub fn distance_to(&self, point: &Point2) -> f64 {
        self.best(
            f64::MAX,
            |node, _| box_gap(node, point, point),
            |a, b| Some(point_distance(point, a, b)),
        )
        .unwrap_or(f64::INFINITY)
    }

    /// Least distance from any point of the straight way between two points to a segment;
    /// infinite where there is none, 0 where the way is blocked.
    pub fn clearance(&self, from: &Point2, to: &Point2) -> f64 {
        self.best(
            f64::MAX,
            |node, _| box_gap(node, from, to),
            |a, b| Some(segment_distance(from, to, a, b)),
        )
        .unwrap_or(f64::INFINITY)
    }

    /// The least leaf cost below `limit`.
    fn best(
        &self,
        limit: f64,
        box_cost: impl Fn(&BvhNode, f64) -> f64,
        leaf_cost: impl Fn(&Point2, &Point2) -> Option<f64>,
    ) -> Option<f64> {
        self.tree
            .find_best(limit, box_cost, |leaf, _| {
                let (a, b) = &self.segments[leaf as usize];
                leaf_cost(a, b)
            })
            .map(|(_, cost)| cost)
    }
}

impl std::fmt::Debug for SegmentCaster {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("SegmentCaster").field("segments", &self.segments.len()).finish()
    }
}

/// A ray prepared for many box tests.
struct BoxRay {
    origin: Point2,
    inverse: Vector2,
}

impl BoxRay {
    fn new(origin: &Point2, direction: &Vector2) -> Self {
        Self { origin: *origin, inverse: Vector2::new(1.0 / direction.x, 1.0 / direction.y) }
    }

    /// Distance to where the ray enters the box grown by `grow`, at least 0; `f64::MAX` if never.
    #[inline]
    fn entry(&self, node: &BvhNode, limit: f64, grow: f64) -> f64 {
        let (mins, maxs) = (node.mins(), node.maxs());
        let (x1, x2) = slab(self.origin.x, self.inverse.x, mins.x - grow, maxs.x + grow);
        let (y1, y2) = slab(self.origin.y, self.inverse.y, mins.y - grow, maxs.y + grow);
        let near = x1.max(y1).max(0.0);
        let far = x2.min(y2).min(limit);
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
fn box_gap(node: &BvhNode, from: &Point2, to: &Point2) -> f64 {
    let (mins, maxs) = (node.mins(), node.maxs());
    let dx = (mins.x - from.x.max(to.x)).max(from.x.min(to.x) - maxs.x).max(0.0);
    let dy = (mins.y - from.y.max(to.y)).max(from.y.min(to.y) - maxs.y).max(0.0);
    (dx * dx + dy * dy).sqrt()
}
