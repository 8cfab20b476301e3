//! Axis-parallel boxes.

use crate::{Point3, Vector3};

/// An axis-parallel box, borders included; `low` exceeds `high` where it is empty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// The lowest coordinates, metres.
    pub low: Point3,
    /// The highest coordinates, metres.
    pub high: Point3,
}

impl Aabb {
    /// The box that holds nothing.
    pub fn empty() -> Self {
        let far = Vector3::repeat(f64::INFINITY);
        Self { low: Point3::from(far), high: Point3::from(-far) }
    }

    /// The smallest box around points.
    pub fn around<'a>(points: impl IntoIterator<Item = &'a Point3>) -> Self {
        points
            .into_iter()
            .fold(Self::empty(), |sum, p| Self { low: sum.low.inf(p), high: sum.high.sup(p) })
    }

    /// The smallest box around two.
    #[inline]
    pub fn union(&self, other: &Self) -> Self {
        Self { low: self.low.inf(&other.low), high: self.high.sup(&other.high) }
    }

    /// The box with a margin on each side, metres.
    #[inline]
    pub fn grown(&self, margin_m: f64) -> Self {
        let margin = Vector3::repeat(margin_m);
        Self { low: self.low - margin, high: self.high + margin }
    }

    /// Whether two boxes have a point in common.
    #[inline]
    pub fn touches(&self, other: &Self) -> bool {
        (0..3).all(|i| self.low[i] <= other.high[i] && other.low[i] <= self.high[i])
    }

    /// Whether the segment may have a point in common with the box: never no where it has.
    #[inline]
    pub fn may_touch_segment(&self, from: &Point3, to: &Point3) -> bool {
        let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
        for i in 0..3 {
            let (lowest, highest) = (from[i].min(to[i]), from[i].max(to[i]));
            if highest < self.low[i] || lowest > self.high[i] {
                return false;
            }
            let step = to[i] - from[i];
            if step == 0.0 {
                continue;
            }
            let (a, b) = ((self.low[i] - from[i]) / step, (self.high[i] - from[i]) / step);
            // A difference and a quotient are each right to 2^-53 of themselves, and the difference
            // to 2^-53 of its operands, which may be much larger: this covers both.
            let slack = 1e-14
                * (1.0 + (self.low[i].abs().max(self.high[i].abs()) + from[i].abs()) / step.abs());
            enter = enter.max(a.min(b) - slack);
            leave = leave.min(a.max(b) + slack);
        }
        // Infinite slack gives NaN, which `max` and `min` pass over: the box is kept.
        enter <= leave
    }

    /// The middle; half-way sums do not overflow inside the envelope.
    #[inline]
    pub(crate) fn middle(&self) -> Point3 {
        nalgebra::center(&self.low, &self.high)
    }
}
