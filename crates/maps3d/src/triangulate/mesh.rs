//! A triangulation whose vertices are pixels with a depth.

use nalgebra::Point3;
use sensing::Camera;

use crate::image::Pixel;

/// Twice the signed area of three pixels: positive for a turn from columns to rows. Exact.
#[inline]
pub fn orient(a: Pixel, b: Pixel, c: Pixel) -> i64 {
    let [ax, ay] = a.map(i64::from);
    let [bx, by] = b.map(i64::from);
    let [cx, cy] = c.map(i64::from);
    (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
}

/// A triangulation of the image: every face covers part of it, all faces together cover it once.
///
/// A vertex keeps its pixel and its depth apart: the proof that faces do not overlap is one about
/// whole pixels ([`check_planar`](super::check_planar)) and holds whatever the depths are.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ImageMesh {
    /// Column and row of each vertex.
    pub pixels: Vec<Pixel>,
    /// Depth of each vertex along the optical axis, metres.
    pub depths_m: Vec<f64>,
    /// Three vertices each, of positive [`orient`].
    pub triangles: Vec<[u32; 3]>,
}

impl ImageMesh {
    /// The pixels of the corners of a face.
    #[inline]
    pub fn corner_pixels(&self, triangle: [u32; 3]) -> [Pixel; 3] {
        triangle.map(|vertex| self.pixels[vertex as usize])
    }

    /// The points of all vertices, in the frame `camera`, metres.
    pub fn points_in_camera(&self, camera: &Camera) -> Vec<Point3<f64>> {
        self.pixels
            .iter()
            .zip(&self.depths_m)
            .map(|(pixel, &depth_m)| {
                let [column, row] = pixel.map(f64::from);
                camera.point_in_camera(column, row, depth_m)
            })
            .collect()
    }

    /// One over the depth, as an affine function of pixels, for each face in its own right.
    ///
    /// A plane of space is affine in inverse depth, so this is the lifted face exactly: `[value at
    /// column 0 and row 0, change per column, change per row]`, per metre.
    pub fn inverse_depth_plane(&self, triangle: [u32; 3]) -> [f64; 3] {
        let pixels = self.corner_pixels(triangle);
        plane_of(pixels, triangle.map(|vertex| 1.0 / self.depths_m[vertex as usize]))
    }

    /// The vertices on the border of the image, in order of positive turns from the first corner.
    ///
    /// Empty unless the mesh is a triangulation of the image.
    pub fn border(&self) -> Vec<u32> {
        let [right, bottom] = self
            .pixels
            .iter()
            .fold([0, 0], |[right, bottom], &[c, r]| [right.max(c), bottom.max(r)]);
        let along = |&[column, row]: &Pixel| {
            let [c, r] = [u32::from(column), u32::from(row)];
            let [w, h] = [u32::from(right), u32::from(bottom)];
            match () {
                () if r == 0 => Some(c),
                () if c == w => Some(w + r),
                () if r == h => Some(w + h + (w - c)),
                () if c == 0 => Some(w + h + w + (h - r)),
                () => None,
            }
        };
        let mut border: Vec<(u32, u32)> = (0..)
            .zip(&self.pixels)
            .filter_map(|(vertex, pixel)| along(pixel).map(|along| (along, vertex)))
            .collect();
        border.sort_unstable();
        border.into_iter().map(|(_, vertex)| vertex).collect()
    }
}

/// The affine function with these values at three pixels that do not lie on one line.
pub(crate) fn plane_of([a, b, c]: [Pixel; 3], [at_a, at_b, at_c]: [f64; 3]) -> [f64; 3] {
    let area = orient(a, b, c) as f64;
    let [ax, ay] = a.map(f64::from);
    let [bx, by] = b.map(f64::from);
    let [cx, cy] = c.map(f64::from);
    let (db, dc) = (at_b - at_a, at_c - at_a);
    let per_column = (db * (cy - ay) - dc * (by - ay)) / area;
    let per_row = (dc * (bx - ax) - db * (cx - ax)) / area;
    [at_a - per_column * ax - per_row * ay, per_column, per_row]
}
