//! Least total length of diagonals.

use crate::image::Pixel;
use crate::triangulate::orient;

use super::Piece;

/// Above so many sides the table would be too large; constrained Delaunay is taken instead.
pub(super) const LARGEST: usize = 128;

/// The table of the dynamic programme.
#[derive(Clone, Debug, Default)]
pub(super) struct Table {
    /// Least length for the part of the polygon from `i` to `j`, and the apex on side `i j`.
    cells: Vec<(f64, u16)>,
    stack: Vec<(u16, u16)>,
}

/// The triangulation of least total edge length ([Klincsek 1980], as \[Mos15\] table 5.2 counts it).
///
/// The least for the part from corner `i` to corner `j` is, over all apexes between them that turn
/// strictly, the least of both parts and the length of the diagonal, which must lie inside of the
/// hole. O(n^3) for up to [`LARGEST`] sides.
///
/// [Klincsek 1980]: https://doi.org/10.1016/S0167-5060(08)70044-X
pub(super) fn triangulate(polygon: &[Pixel], table: &mut Table, pieces: &mut Vec<Piece>) {
    let n = polygon.len();
    table.cells.clear();
    table.cells.resize(n * n, (f64::INFINITY, 0));
    let length = |i: usize, j: usize| {
        if j == i + 1 || (i == 0 && j == n - 1) {
            return 0.0;
        }
        let [[ax, ay], [bx, by]] = [polygon[i], polygon[j]].map(|p| p.map(f64::from));
        (ax - bx).hypot(ay - by)
    };
    for i in 0..n - 1 {
        table.cells[i * n + i + 1] = (0.0, 0);
    }
    for span in 2..n {
        for i in 0..n - span {
            let j = i + span;
            if span < n - 1 && !is_inside(polygon, i, j) {
                continue;
            }
            let mut best = (f64::INFINITY, 0);
            for k in i + 1..j {
                let parts = table.cells[i * n + k].0 + table.cells[k * n + j].0;
                if parts < best.0 && orient(polygon[i], polygon[k], polygon[j]) > 0 {
                    best = (parts, k as u16);
                }
            }
            table.cells[i * n + j] = (best.0 + length(i, j), best.1);
        }
    }
    table.stack.clear();
    table.stack.push((0, n as u16 - 1));
    while let Some((i, j)) = table.stack.pop() {
        if j - i < 2 {
            continue;
        }
        let k = table.cells[usize::from(i) * n + usize::from(j)].1;
        pieces.push([i, k, j]);
        table.stack.extend([(i, k), (k, j)]);
    }
}

/// Whether the open segment between two corners lies strictly inside of the polygon.
fn is_inside(polygon: &[Pixel], i: usize, j: usize) -> bool {
    let n = polygon.len();
    let (a, b) = (polygon[i], polygon[j]);
    // Within the angle at `i`.
    let (before, after) = (polygon[(i + n - 1) % n], polygon[(i + 1) % n]);
    let within = if orient(before, a, after) > 0 {
        orient(a, b, before) > 0 && orient(a, after, b) > 0
    } else {
        !(orient(a, b, after) >= 0 && orient(a, before, b) >= 0)
    };
    within
        && (0..n).all(|k| {
            let (p, q) = (polygon[k], polygon[(k + 1) % n]);
            if [k, (k + 1) % n].iter().any(|&end| end == i || end == j) {
                // A side at an end touches there; farther along it only where it lies on the line.
                return [k, (k + 1) % n]
                    .iter()
                    .all(|&end| end == i || end == j || !on_segment(a, b, polygon[end]));
            }
            let (ap, aq) = (orient(a, b, p).signum(), orient(a, b, q).signum());
            let (pa, pb) = (orient(p, q, a).signum(), orient(p, q, b).signum());
            !on_segment(a, b, p) && !on_segment(a, b, q) && (ap == aq || pa == pb)
        })
}

fn on_segment(a: Pixel, b: Pixel, p: Pixel) -> bool {
    let within = |i: usize| a[i].min(b[i]) <= p[i] && p[i] <= a[i].max(b[i]);
    orient(a, b, p) == 0 && within(0) && within(1)
}
