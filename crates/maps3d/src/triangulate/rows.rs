//! The pixels of a triangle, row by row.

use std::cmp::Ordering;

use crate::image::Pixel;

/// A stretch of pixels of one row, both ends included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Span {
    pub row: usize,
    pub first: usize,
    pub last: usize,
}

/// The pixels inside a triangle of positive turn or on its sides, in exact whole numbers.
///
/// Rows without a pixel are left out. A pixel on a side shared by two triangles is in both. Two
/// divisions per side, none per row.
pub(crate) fn rows_of([a, b, c]: [Pixel; 3]) -> Rows {
    let row = i32::from(a[1].min(b[1]).min(c[1]));
    let mut rows = Rows {
        row,
        bottom: i32::from(a[1].max(b[1]).max(c[1])),
        columns: [i32::MIN, i32::MIN, i32::MAX, i32::MAX],
        rests: [0; 4],
        steps: [0; 4],
        more: [0; 4],
        heights: [1; 4],
        signs: [0; 4],
    };
    let (mut left, mut right) = (0, 2);
    for ([px, py], [qx, qy]) in [(a, b), (b, c), (c, a)] {
        let [px, py, qx, qy] = [i32::from(px), i32::from(py), i32::from(qx), i32::from(qy)];
        // Inside is on the positive turn of each side: left of those that lead down, right of those
        // that lead up; level sides are the top or the bottom.
        let (at, sign) = match qy.cmp(&py) {
            Ordering::Greater => (&mut right, 1),
            Ordering::Less => (&mut left, -1),
            Ordering::Equal => continue,
        };
        rows.limit(*at, [px, py], [qx - px, (qy - py).abs()], sign);
        *at += 1;
    }
    rows
}

/// The rows of a triangle from top to bottom; see [`rows_of`].
///
/// Two limits to the left, two to the right, each the last column on the inner side of a line; side
/// by side, for all four advance at once.
pub(crate) struct Rows {
    row: i32,
    bottom: i32,
    columns: [i32; 4],
    /// What the division by the height leaves.
    rests: [i32; 4],
    /// What each row adds to the columns.
    steps: [i32; 4],
    /// What each row adds to the rests.
    more: [i32; 4],
    heights: [i32; 4],
    /// 1 where columns up to the limit are inside, -1 where those from it on are.
    signs: [i32; 4],
}

impl Rows {
    /// Pixels are below 2^14, so products are below 2^29.
    fn limit(&mut self, at: usize, [px, py]: [i32; 2], [dx, height]: [i32; 2], sign: i32) {
        let reach = dx * (self.row - py);
        self.columns[at] = px + sign * reach.div_euclid(height);
        self.rests[at] = reach.rem_euclid(height);
        self.steps[at] = sign * dx.div_euclid(height);
        self.more[at] = dx.rem_euclid(height);
        self.heights[at] = height;
        self.signs[at] = sign;
    }
}

impl Iterator for Rows {
    type Item = Span;

    #[inline]
    fn next(&mut self) -> Option<Span> {
        while self.row <= self.bottom {
            let row = self.row;
            let [left, other_left, right, other_right] = self.columns;
            let (first, last) = (left.max(other_left), right.min(other_right));
            self.row += 1;
            for at in 0..4 {
                let rest = self.rests[at] + self.more[at];
                let carry = rest >= self.heights[at];
                self.rests[at] = rest - if carry { self.heights[at] } else { 0 };
                self.columns[at] += self.steps[at] + if carry { self.signs[at] } else { 0 };
            }
            if first <= last {
                let [row, first, last] = [row as usize, first as usize, last as usize];
                return Some(Span { row, first, last });
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::super::orient;
    use super::*;

    #[test]
    fn spans_are_the_pixels_of_the_closed_triangle() {
        let points: Vec<Pixel> = (0..49).map(|i| [i % 7, i / 7]).collect();
        let mut seed = 1_u32;
        let mut next = move || {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (seed >> 16) as usize % 49
        };
        let mut seen = 0;
        while seen < 2000 {
            let [a, b, c] = [points[next()], points[next()], points[next()]];
            if orient(a, b, c) <= 0 {
                continue;
            }
            seen += 1;
            let inside: Vec<Pixel> = points
                .iter()
                .copied()
                .filter(|&p| orient(a, b, p) >= 0 && orient(b, c, p) >= 0 && orient(c, a, p) >= 0)
                .collect();
            let spans: Vec<Pixel> = rows_of([a, b, c])
                .flat_map(|s| (s.first..=s.last).map(move |c| [c as u16, s.row as u16]))
                .collect();
            assert_eq!(spans, inside, "{a:?} {b:?} {c:?}");
        }
    }
}
