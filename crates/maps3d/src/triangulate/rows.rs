//! The pixels of a triangle, row by row.

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
/// Rows without a pixel are left out. A pixel on a side shared by two triangles is in both.
pub(crate) fn rows_of(corners: [Pixel; 3]) -> impl Iterator<Item = Span> {
    let [a, b, c] = corners.map(|p| p.map(i64::from));
    let top = a[1].min(b[1]).min(c[1]);
    let bottom = a[1].max(b[1]).max(c[1]);
    let sides = [(a, b), (b, c), (c, a)];
    (top..=bottom).filter_map(move |row| {
        let (mut first, mut last) = (i64::MIN, i64::MAX);
        for ([px, py], [qx, qy]) in sides {
            let (dx, dy) = (qx - px, qy - py);
            // Inside is where dx (row - py) - dy (column - px) >= 0.
            match dy {
                0 if dx * (row - py) < 0 => return None,
                0 => {}
                _ => {
                    let reach = dx * (row - py);
                    if dy > 0 {
                        last = last.min(px + reach.div_euclid(dy));
                    } else {
                        // column - px >= reach / dy, rounded up.
                        first = first.max(px - reach.div_euclid(-dy));
                    }
                }
            }
        }
        (first <= last).then_some(Span {
            row: row as usize,
            first: first as usize,
            last: last as usize,
        })
    })
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
