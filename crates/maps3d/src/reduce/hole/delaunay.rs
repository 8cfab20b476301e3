//! Constrained Delaunay, by flips.

use crate::image::Pixel;
use crate::reduce::inverse_depth::in_circle;

use super::Piece;

/// Exchanges diagonals until each circle is empty of what its triangle can see (\[Mos15\] 3.6.4).
///
/// The sides of the hole stay. Each flip makes the triangulation more Delaunay, so it ends (Lawson).
/// O(n^2) per round of flips; holes have about six sides.
pub(super) fn flip(polygon: &[Pixel], pieces: &mut [Piece]) {
    let at = |i: u16| polygon[usize::from(i)];
    let mut again = true;
    while again {
        again = false;
        for first in 0..pieces.len() {
            for second in first + 1..pieces.len() {
                let Some((p, b, c, q)) = quadrangle(pieces[first], pieces[second]) else {
                    continue;
                };
                if in_circle(at(p), at(b), at(c), at(q)) > 0 {
                    pieces[first] = [p, b, q];
                    pieces[second] = [p, q, c];
                    again = true;
                }
            }
        }
    }
}

/// `(p, b, c, q)` for triangles `p b c` and `q c b`.
fn quadrangle(one: Piece, other: Piece) -> Option<(u16, u16, u16, u16)> {
    (0..3).find_map(|side| {
        let [p, b, c] = [one[side], one[(side + 1) % 3], one[(side + 2) % 3]];
        let q = (0..3).find(|&i| other[(i + 1) % 3] == c && other[(i + 2) % 3] == b)?;
        Some((p, b, c, other[q]))
    })
}
