//! A part of a face, cut into small pieces: what stands for a place, and for how much area.

use geometry::planar::overlay::StepRings;
use nalgebra::Point3;

use super::grid::FaceGrid;

/// A triangle on the grid of a face.
type Piece = [[f64; 2]; 3];

/// Calls with triangles that fill a region of the grid: between two rows of corners the region consists of
/// trapezoids, each of which is cut in two. O(rows of corners times edges).
pub(super) fn triangles(rings: &StepRings, mut call: impl FnMut(Piece)) {
    let mut edges: Vec<[[f64; 2]; 2]> = Vec::with_capacity(rings.corner_count());
    let mut rows: Vec<i32> = Vec::with_capacity(rings.corner_count());
    for ring in rings.rings() {
        let mut a = ring[ring.len() - 1];
        for &b in ring {
            if a[1] != b[1] {
                let (low, high) = if a[1] < b[1] { (a, b) } else { (b, a) };
                edges.push([low.map(f64::from), high.map(f64::from)]);
            }
            rows.push(b[1]);
            a = b;
        }
    }
    rows.sort_unstable();
    rows.dedup();
    let mut crossed: Vec<[f64; 2]> = Vec::new();
    for pair in rows.windows(2) {
        let [low, high] = [pair[0], pair[1]].map(f64::from);
        crossed.clear();
        for [a, b] in edges.iter().filter(|[a, b]| a[1] <= low && b[1] >= high) {
            let at = |y: f64| a[0] + (b[0] - a[0]) * ((y - a[1]) / (b[1] - a[1]));
            crossed.push([at(low), at(high)]);
        }
        crossed.sort_unstable_by(|a, b| (a[0] + a[1]).total_cmp(&(b[0] + b[1])));
        for sides in crossed.chunks_exact(2) {
            let [[left_low, left_high], [right_low, right_high]] = [sides[0], sides[1]];
            if right_low > left_low {
                call([[left_low, low], [right_low, low], [right_high, high]]);
            }
            if right_high > left_high {
                call([[left_low, low], [right_high, high], [left_high, high]]);
            }
        }
    }
}

/// Calls with triangles that fill a region of a face, in the frame of the face, each with its area, square
/// metres; none is longer than `longest_m`. The areas add up to that of the region.
pub(super) fn pieces(
    face: &FaceGrid,
    rings: &StepRings,
    longest_m: f64,
    mut call: impl FnMut([Point3<f64>; 3], f64),
) {
    let step_m2 = face.step_m2();
    let mut open: Vec<Piece> = Vec::new();
    triangles(rings, |piece| {
        open.push(piece);
        while let Some(piece) = open.pop() {
            let points = piece.map(|place| face.point(place));
            let side = |i: usize| (points[(i + 1) % 3] - points[i]).norm_squared();
            let longest = (0..3).fold(0, |best, i| if side(i) > side(best) { i } else { best });
            if side(longest) > longest_m * longest_m {
                let [i, j, k] = [longest, (longest + 1) % 3, (longest + 2) % 3];
                let middle = [0, 1].map(|axis| 0.5 * (piece[i][axis] + piece[j][axis]));
                open.push([piece[i], middle, piece[k]]);
                open.push([middle, piece[j], piece[k]]);
                continue;
            }
            let [a, b, c] = piece;
            let twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
            call(points, 0.5 * twice.abs() * step_m2);
        }
    });
}

/// The middle of a piece: the point that stands for it.
pub(super) fn middle(piece: &[Point3<f64>; 3]) -> Point3<f64> {
    Point3::from((piece[0].coords + piece[1].coords + piece[2].coords) / 3.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::relative::grid;

    #[test]
    fn pieces_fill_the_region() {
        let mut rings = StepRings::new();
        grid::whole(&mut rings);
        rings.push([[1000, 1000], [1000, 500_000], [300_000, 7000]]);
        let at = |x, y, z| Point3::new(x, y, z);
        let face = FaceGrid::new([at(0.0, 0.0, 1.0), at(3.0, 0.0, 1.0), at(0.0, 2.0, 1.5)]);
        let expected_m2 = rings.twice_area() as f64 * 0.5 * face.step_m2();
        let (mut sum_m2, mut most_m2) = (0.0, 0.0_f64);
        pieces(&face, &rings, 0.2, |piece, area_m2| {
            let point = middle(&piece);
            sum_m2 += area_m2;
            most_m2 = most_m2.max(area_m2);
            assert!((point.z - 1.0 - 0.25 * point.y).abs() < 1e-9);
        });
        assert!((sum_m2 - expected_m2).abs() < 1e-9, "{sum_m2} {expected_m2}");
        assert!(most_m2 <= 0.02);
    }
}
