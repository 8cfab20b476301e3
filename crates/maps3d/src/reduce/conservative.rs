//! One-sided: nothing counts as free that was not measured to be.

use crate::image::{FilledImage, Pixel};
use crate::triangulate::{ImageMesh, rows_of};

/// How far the surface of a mesh lies beyond the measured one at most, along viewing rays, metres.
///
/// Measured is the surface of the full grid. Looked at are all pixels and all places where edges of the
/// mesh cross edges of the grid. Between these both surfaces are affine in inverse depth, but their
/// difference in metres is not: inside a cell across a deep step it may be larger (by up to 43 % in one
/// of a thousand images of a few pixels with steps). 0 where the mesh lies nowhere beyond.
/// O(pixels + length of all edges in pixels).
pub fn outside_max_m(image: &FilledImage, mesh: &ImageMesh) -> f64 {
    let mut most = 0.0_f64;
    visit(image, mesh, |_, place| {
        most = most.max((1.0 / place.mesh - 1.0 / place.measured) * place.stretch);
    });
    most
}

/// Draws vertices towards the camera until the surface is at none of the places that
/// [`outside_max_m`] looks at more than `bound_m` beyond the measured one; returns how many moved.
///
/// Where a face goes too far, by some inverse depth, all its corners come nearer by that much: then
/// the whole face does. Nothing ever moves away from the camera, so one pass is enough.
pub(super) fn withhold(image: &FilledImage, mesh: &mut ImageMesh, bound_m: f64) -> usize {
    let mut raise = vec![0.0_f64; mesh.pixels.len()];
    visit(image, mesh, |corners, place| {
        let farthest = 1.0 / place.measured + bound_m / place.stretch;
        let short = 1.0 / farthest - place.mesh;
        if short > 0.0 {
            for &corner in corners {
                raise[corner as usize] = raise[corner as usize].max(short);
            }
        }
    });
    for (depth_m, raise) in mesh.depths_m.iter_mut().zip(&raise) {
        if *raise > 0.0 {
            // A little more than needed, for rounding.
            *depth_m = 1.0 / ((1.0 / *depth_m + raise) * (1.0 + 1e-12));
        }
    }
    raise.iter().filter(|raise| **raise > 0.0).count()
}

/// A place of the image where the two surfaces are compared.
struct Place {
    /// Inverse depth of the mesh.
    mesh: f64,
    /// Inverse depth of the full grid.
    measured: f64,
    /// Metres along the ray per metre of depth.
    stretch: f64,
}

/// Looks at every pixel of every face, and at every crossing of an edge with the grid; tells which
/// corners hold the place up.
fn visit(image: &FilledImage, mesh: &ImageMesh, mut look: impl FnMut(&[u32], Place)) {
    let camera = image.camera();
    let stretch = |column: f64, row: f64| {
        let [x, y] = camera.slope_of(column, row);
        (x * x + y * y + 1.0).sqrt()
    };
    let inverse_at = |column: usize, row: usize| {
        1.0 / f64::from(image.depths_m()[row * image.columns() + column])
    };
    for triangle in &mesh.triangles {
        let [base, per_column, per_row] = mesh.inverse_depth_plane(*triangle);
        for span in rows_of(mesh.corner_pixels(*triangle)) {
            for column in span.first..=span.last {
                let (c, r) = (column as f64, span.row as f64);
                let place = Place {
                    mesh: base + c * per_column + r * per_row,
                    measured: inverse_at(column, span.row),
                    stretch: stretch(c, r),
                };
                look(triangle, place);
            }
        }
        for side in 0..3 {
            let (a, b) = (triangle[side], triangle[(side + 1) % 3]);
            let ends = [a, b].map(|v| mesh.pixels[v as usize]);
            let inverse = [a, b].map(|v| 1.0 / mesh.depths_m[v as usize]);
            for along in crossings(ends) {
                let at = |i: usize| {
                    let (p, q) = (f64::from(ends[0][i]), f64::from(ends[1][i]));
                    p + along * (q - p)
                };
                let (c, r) = (at(0), at(1));
                let place = Place {
                    mesh: inverse[0] + along * (inverse[1] - inverse[0]),
                    measured: measured_at(image, c, r),
                    stretch: stretch(c, r),
                };
                look(&[a, b], place);
            }
        }
    }
}

/// Where a segment crosses columns, rows and diagonals of the grid, as shares of its length.
fn crossings([p, q]: [Pixel; 2]) -> impl Iterator<Item = f64> {
    let ([px, py], [qx, qy]) = (p.map(i64::from), q.map(i64::from));
    [(px, qx), (py, qy), (px - py, qx - qy)].into_iter().flat_map(|(from, to)| {
        let span = to - from;
        (1..span.abs()).map(move |step| step as f64 / span.abs() as f64)
    })
}

/// The inverse depth of the full grid at any place of the image.
fn measured_at(image: &FilledImage, column: f64, row: f64) -> f64 {
    let c = (column.floor() as usize).min(image.columns() - 2);
    let r = (row.floor() as usize).min(image.rows() - 2);
    let at = |dc: usize, dr: usize| {
        1.0 / f64::from(image.depths_m()[(r + dr) * image.columns() + c + dc])
    };
    let (x, y) = (column - c as f64, row - r as f64);
    let (here, far) = (at(0, 0), at(1, 1));
    if x >= y {
        let right = at(1, 0);
        here + x * (right - here) + y * (far - right)
    } else {
        let below = at(0, 1);
        here + y * (below - here) + x * (far - below)
    }
}
