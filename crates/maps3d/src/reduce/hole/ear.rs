//! Ear clipping.

use crate::image::Pixel;
use crate::triangulate::orient;

use super::Piece;

/// What is known of each corner that is left.
#[derive(Clone, Debug, Default)]
pub(super) struct Ears {
    next: Vec<u16>,
    previous: Vec<u16>,
    /// Squared length of the diagonal that cuts the corner off; `u64::MAX` where it is no ear.
    cost: Vec<u64>,
}

fn squared([ax, ay]: Pixel, [bx, by]: Pixel) -> u64 {
    let (dx, dy) = (u64::from(ax.abs_diff(bx)), u64::from(ay.abs_diff(by)));
    dx * dx + dy * dy
}

/// Cuts off the ear with the shortest diagonal until a triangle is left (\[Mos15\] 3.6.1).
///
/// A corner is an ear when it turns strictly and no other corner lies in its closed triangle, so no
/// flat triangle is made; a polygon that is not flat always has one. O(n^2) for most holes.
pub(super) fn clip(polygon: &[Pixel], ears: &mut Ears, pieces: &mut Vec<Piece>) {
    let n = polygon.len();
    if n == 4 {
        // Of the two diagonals the shorter that lies inside.
        let inside = |a: usize, b: usize, c: usize, d: usize| {
            orient(polygon[a], polygon[b], polygon[c]) > 0
                && orient(polygon[a], polygon[c], polygon[d]) > 0
        };
        let (first, second) = (inside(0, 1, 2, 3), inside(1, 2, 3, 0));
        let shorter = squared(polygon[0], polygon[2]) <= squared(polygon[1], polygon[3]);
        if first && (shorter || !second) {
            pieces.extend([[0, 1, 2], [0, 2, 3]]);
        } else {
            pieces.extend([[1, 2, 3], [1, 3, 0]]);
        }
        return;
    }
    ears.next.clear();
    ears.next.extend((0..n).map(|i| ((i + 1) % n) as u16));
    ears.previous.clear();
    ears.previous.extend((0..n).map(|i| ((i + n - 1) % n) as u16));
    ears.cost.clear();
    ears.cost.resize(n, u64::MAX);
    for corner in 0..n as u16 {
        ears.cost[usize::from(corner)] = ears.cost_of(polygon, corner);
    }
    let mut start = 0_u16;
    for left in (4..=n).rev() {
        let mut ear = ears.cheapest(start, left);
        if ears.cost[usize::from(ear)] == u64::MAX {
            // What stood in the way of an ear may have been cut off meanwhile.
            let mut corner = start;
            for _ in 0..left {
                ears.cost[usize::from(corner)] = ears.cost_of(polygon, corner);
                corner = ears.next[usize::from(corner)];
            }
            ear = ears.cheapest(start, left);
        }
        let (before, after) = (ears.previous[usize::from(ear)], ears.next[usize::from(ear)]);
        pieces.push([before, ear, after]);
        ears.next[usize::from(before)] = after;
        ears.previous[usize::from(after)] = before;
        ears.cost[usize::from(before)] = ears.cost_of(polygon, before);
        ears.cost[usize::from(after)] = ears.cost_of(polygon, after);
        start = before;
    }
    let after = ears.next[usize::from(start)];
    pieces.push([start, after, ears.next[usize::from(after)]]);
}

impl Ears {
    fn cheapest(&self, start: u16, left: usize) -> u16 {
        let mut best = start;
        let mut corner = start;
        for _ in 1..left {
            corner = self.next[usize::from(corner)];
            if self.cost[usize::from(corner)] < self.cost[usize::from(best)] {
                best = corner;
            }
        }
        best
    }

    fn cost_of(&self, polygon: &[Pixel], corner: u16) -> u64 {
        let (before, after) = (self.previous[usize::from(corner)], self.next[usize::from(corner)]);
        let [a, b, c] = [before, corner, after].map(|i| polygon[usize::from(i)]);
        if orient(a, b, c) <= 0 {
            return u64::MAX;
        }
        let mut other = self.next[usize::from(after)];
        while other != before {
            let p = polygon[usize::from(other)];
            if orient(c, a, p) >= 0 && orient(a, b, p) >= 0 && orient(b, c, p) >= 0 {
                return u64::MAX;
            }
            other = self.next[usize::from(other)];
        }
        squared(a, c)
    }
}
