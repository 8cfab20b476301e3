//! A stretch of a segment.

/// A stretch of a segment by its parameters: `0 <= from <= to <= 1`, 0 at the segment's first point.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Interval {
    /// The parameter where the stretch begins.
    pub from: f64,
    /// The parameter where it ends.
    pub to: f64,
}

impl Interval {
    /// The whole segment.
    pub const WHOLE: Self = Self { from: 0.0, to: 1.0 };

    /// The stretch from `from` to `to`.
    pub const fn new(from: f64, to: f64) -> Self {
        Self { from, to }
    }

    /// The share of the segment that the stretch covers.
    pub fn share(&self) -> f64 {
        self.to - self.from
    }

    /// The parameter half-way.
    pub fn middle(&self) -> f64 {
        0.5 * (self.from + self.to)
    }

    /// Whether the stretch has no length.
    pub fn is_empty(&self) -> bool {
        self.from >= self.to
    }

    /// The part that two stretches share, if it has a length.
    pub fn overlap(&self, other: &Self) -> Option<Self> {
        let shared = Self { from: self.from.max(other.from), to: self.to.min(other.to) };
        (!shared.is_empty()).then_some(shared)
    }
}
