//! Differences of plain rings whose corners are whole steps of a grid of the caller's.
//!
//! For who does many small overlays on a grid of its own and wants neither labels nor sources: corners
//! are taken as they are, memory is used again, and areas are whole numbers.

use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay::{Overlay, ShapeType};
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::i_float::int::point::IntPoint;
use i_overlay::i_shape::flat::buffer::FlatContoursBuffer;

/// The largest coordinate, steps: what the engine can add without overflow.
pub const MOST_STEPS: i32 = 1 << 29;

/// Closed chains of corners in whole steps, one after another.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct StepRings {
    points: Vec<[i32; 2]>,
    /// Where each ring ends.
    ends: Vec<u32>,
}

impl StepRings {
    /// No ring.
    pub fn new() -> Self {
        Self::default()
    }

    /// Forgets all rings and keeps the memory.
    pub fn clear(&mut self) {
        self.points.clear();
        self.ends.clear();
    }

    /// Whether there is no ring.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// Number of corners of all rings.
    pub fn corner_count(&self) -> usize {
        self.points.len()
    }

    /// Adds a ring.
    pub fn push(&mut self, ring: impl IntoIterator<Item = [i32; 2]>) {
        self.points.extend(ring);
        self.ends.push(self.points.len() as u32);
    }

    /// The rings, in order.
    pub fn rings(&self) -> impl ExactSizeIterator<Item = &[[i32; 2]]> + '_ {
        (0..self.ends.len()).map(|i| {
            let from = if i == 0 { 0 } else { self.ends[i - 1] as usize };
            &self.points[from..self.ends[i] as usize]
        })
    }

    /// Twice the signed area, square steps: of results, that of the region.
    pub fn twice_area(&self) -> i64 {
        self.rings().map(twice_area).sum()
    }
}

/// Twice the signed area of a ring, square steps; positive counter-clockwise.
///
/// Exact for coordinates up to [`MOST_STEPS`] in rings of up to a few corners, and up to 2^20 in any.
pub fn twice_area(ring: &[[i32; 2]]) -> i64 {
    let Some(&[ox, oy]) = ring.first() else { return 0 };
    let from = |p: [i32; 2]| (i64::from(p[0] - ox), i64::from(p[1] - oy));
    let cross = |pair: &[[i32; 2]]| {
        let ((ax, ay), (bx, by)) = (from(pair[0]), from(pair[1]));
        ax * by - ay * bx
    };
    ring.windows(2).map(cross).sum()
}

/// Overlays of plain rings, with the memory of the ones before.
pub struct StepOverlay {
    engine: Overlay<i32>,
    buffer: FlatContoursBuffer<i32>,
}

impl Default for StepOverlay {
    fn default() -> Self {
        let buffer = FlatContoursBuffer { points: Vec::new(), ranges: Vec::new() };
        Self { engine: Overlay::new(64), buffer }
    }
}

impl StepOverlay {
    /// What is in `subject` and not in `clip`: outer rings counter-clockwise, each followed by its
    /// holes, clockwise. `out` is overwritten.
    ///
    /// Corners lie on the grid: where edges cross between its points, the corner goes to the nearest.
    /// A point is inside of either where its rings wind around it. Coordinates go up to
    /// [`MOST_STEPS`]; larger ones give a wrong result. Cost: O(n log n) for n edges and few crossings.
    pub fn difference(&mut self, subject: &StepRings, clip: &StepRings, out: &mut StepRings) {
        self.run(subject, clip, OverlayRule::Difference, out);
    }

    /// What is in both; as [`difference`](Self::difference).
    pub fn intersection(&mut self, a: &StepRings, b: &StepRings, out: &mut StepRings) {
        self.run(a, b, OverlayRule::Intersect, out);
    }

    /// What is in any of the rings; as [`difference`](Self::difference).
    pub fn union(&mut self, rings: &StepRings, out: &mut StepRings) {
        self.run(rings, &StepRings::new(), OverlayRule::Subject, out);
    }

    fn run(&mut self, a: &StepRings, b: &StepRings, rule: OverlayRule, out: &mut StepRings) {
        self.engine.clear();
        for (rings, kind) in [(a, ShapeType::Subject), (b, ShapeType::Clip)] {
            for ring in rings.rings() {
                let corners = ring.iter().map(|&[x, y]| IntPoint::new(x, y));
                self.engine.add_path_iter(corners, kind);
            }
        }
        self.engine.overlay_into(rule, FillRule::NonZero, &mut self.buffer);
        out.clear();
        for range in &self.buffer.ranges {
            out.push(self.buffer.points[range.clone()].iter().map(|p| [p.x, p.y]));
        }
    }
}

impl std::fmt::Debug for StepOverlay {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("StepOverlay").finish_non_exhaustive()
    }
}

impl Clone for StepOverlay {
    /// Fresh memory: what an overlay keeps is no state.
    fn clone(&self) -> Self {
        Self::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(at: i32, side: i32) -> [[i32; 2]; 4] {
        [[at, at], [at + side, at], [at + side, at + side], [at, at + side]]
    }

    #[test]
    fn a_hole_is_a_ring_the_other_way_round() {
        let (mut a, mut b, mut out) = (StepRings::new(), StepRings::new(), StepRings::new());
        a.push(square(0, 10));
        b.push(square(3, 4));
        let mut overlay = StepOverlay::default();
        overlay.difference(&a, &b, &mut out);
        let areas: Vec<i64> = out.rings().map(twice_area).collect();
        assert_eq!(areas, [200, -32]);
        assert_eq!(out.twice_area(), 168);
        overlay.intersection(&a, &b, &mut out);
        assert_eq!(out.twice_area(), 32);
        b.push(square(5, 10));
        overlay.union(&b, &mut out);
        assert_eq!(out.twice_area(), 2 * (16 + 100 - 4));
        overlay.difference(&b, &b, &mut out);
        assert!(out.is_empty() && out.corner_count() == 0);
    }
}
