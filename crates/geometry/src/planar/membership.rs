//! Where a point lies: its sector by binary search over bearings, then one exact comparison.

use super::StarPolygon;
use crate::Point2;
use crate::predicates::{LARGEST, SMALLEST, cross, half_turn_or_more, nearer_on_ray, orient};

/// The sector of a direction: the bearings from vertex `index` to the next vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sector {
    /// The last vertex whose bearing, counted from vertex 0, is not beyond the direction's.
    pub index: usize,
    /// Whether the direction is exactly that vertex's.
    pub on_ray: bool,
}

impl StarPolygon {
    /// Whether a point lies strictly inside; points on the boundary do not.
    ///
    /// Exact, O(log n). On the ray through a vertex a point is inside when both edges there are
    /// chords and it is strictly nearer than the vertex. The origin is inside when there is no gap.
    /// A coordinate below the envelope counts as zero; points beyond it and NaN are outside.
    pub fn contains(&self, p: &Point2) -> bool {
        // A negated comparison, so that NaN is refused here.
        let reach = self.outer_radius;
        if !(p.x.abs() <= reach && p.y.abs() <= reach) {
            return false;
        }
        let p = flushed(p);
        let Some(sector) = self.sector_of(&p) else { return !self.has_gap };
        let i = sector.index;
        if self.gap_after[i] {
            return false;
        }
        if sector.on_ray {
            !self.gap_after[self.previous(i)] && nearer_on_ray(&p, &self.vertices[i])
        } else {
            orient(&self.vertices[i], &self.vertices[self.next(i)], &p) > 0.0
        }
    }

    /// The sector in which a point's bearing lies; none for the origin and for the empty polygon.
    ///
    /// Exact inside the envelope, O(log n).
    #[inline]
    pub fn sector_of(&self, p: &Point2) -> Option<Sector> {
        let first = self.vertices.first()?;
        if p.x == 0.0 && p.y == 0.0 {
            return None;
        }
        // Within half a turn the sign of the cross product orders bearings.
        let (mut low, mut high) = if half_turn_or_more(first, p) {
            (self.half, self.vertices.len())
        } else {
            (0, self.half)
        };
        while low < high {
            let middle = low + (high - low) / 2;
            let side = cross(&self.vertices[middle], p);
            if side > 0.0 {
                low = middle + 1;
            } else if side < 0.0 {
                high = middle;
            } else {
                return Some(Sector { index: middle, on_ray: true });
            }
        }
        // Vertex 0 is never beyond the direction, hence low >= 1.
        Some(Sector { index: low - 1, on_ray: false })
    }

    /// How far the inside reaches towards a direction, metres; 0 in gaps and along spokes.
    ///
    /// The direction need not be of length one. Measured, not decided: a rounding error of a few
    /// units in the last place for well-shaped chords. O(log n).
    pub fn radius_towards(&self, direction: &Point2) -> f64 {
        let Some(sector) = self.sector_of(direction) else { return 0.0 };
        let i = sector.index;
        if self.gap_after[i] || (sector.on_ray && self.gap_after[self.previous(i)]) {
            return 0.0;
        }
        let v = self.vertices[i];
        if sector.on_ray {
            return v.x.hypot(v.y);
        }
        let w = self.vertices[self.next(i)];
        let length = direction.x.hypot(direction.y);
        let unit = Point2::new(direction.x / length, direction.y / length);
        let along = cross(&unit, &Point2::from(w - v));
        if along > 0.0 { cross(&v, &w) / along } else { v.x.hypot(v.y).min(w.x.hypot(w.y)) }
    }
}

/// The point with coordinates below the envelope set to zero.
#[inline]
pub(super) fn flushed(p: &Point2) -> Point2 {
    let flush = |c: f64| if c.abs() < SMALLEST { 0.0 } else { c };
    Point2::new(flush(p.x), flush(p.y))
}

/// Whether no coordinate is beyond the envelope or NaN.
#[inline]
pub(super) fn bounded(p: &Point2) -> bool {
    p.x.abs() <= LARGEST && p.y.abs() <= LARGEST
}
