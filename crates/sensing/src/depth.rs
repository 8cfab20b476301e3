//! A depth image and the camera that took it.

use pose::nalgebra::Point3;

/// A pinhole camera without distortion; lengths in pixels, pixel centres at whole numbers.
///
/// The frame `camera` has x to the right of the image, y down, z ahead. A negative focal length
/// mirrors its axis: some synthetic images are stored bottom up that way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Focal length along columns, pixels.
    pub fx: f64,
    /// Focal length along rows, pixels.
    pub fy: f64,
    /// Column of the optical axis.
    pub cx: f64,
    /// Row of the optical axis.
    pub cy: f64,
}

impl Camera {
    /// A camera from its focal lengths and its centre, pixels.
    pub fn new(fx: f64, fy: f64, cx: f64, cy: f64) -> Self {
        Self { fx, fy, cx, cy }
    }

    /// Whether all four numbers are finite and no focal length is zero.
    pub fn is_usable(&self) -> bool {
        [self.fx, self.fy, self.cx, self.cy].iter().all(|x| x.is_finite())
            && self.fx != 0.0
            && self.fy != 0.0
    }

    /// Whether a turn from columns to rows is one from x to y, seen along z.
    pub fn is_right_handed(&self) -> bool {
        (self.fx > 0.0) == (self.fy > 0.0)
    }

    /// The same camera after the image lost its first `columns` and `rows`.
    pub fn cropped(&self, columns: usize, rows: usize) -> Self {
        Self { cx: self.cx - columns as f64, cy: self.cy - rows as f64, ..*self }
    }

    /// Where the ray of a pixel meets the plane `z = 1`, in the frame `camera`.
    pub fn slope_of(&self, column: f64, row: f64) -> [f64; 2] {
        [(column - self.cx) / self.fx, (row - self.cy) / self.fy]
    }

    /// The point on the ray of a pixel at a depth, in the frame `camera`, metres.
    pub fn point_in_camera(&self, column: f64, row: f64, depth_m: f64) -> Point3<f64> {
        let [x, y] = self.slope_of(column, row);
        Point3::new(x * depth_m, y * depth_m, depth_m)
    }

    /// The pixel of a point of the frame `camera`; `None` for a point that is not ahead.
    pub fn pixel_of(&self, point: &Point3<f64>) -> Option<[f64; 2]> {
        (point.z > 0.0)
            .then(|| [self.cx + self.fx * point.x / point.z, self.cy + self.fy * point.y / point.z])
    }
}

/// One depth image: for each pixel the distance along the optical axis.
///
/// Row-major, the top row first. What is not a positive finite number is "no reading".
#[derive(Clone, Debug, PartialEq)]
pub struct DepthImage {
    /// Number of columns.
    pub columns: usize,
    /// The camera that took it.
    pub camera: Camera,
    /// One depth per pixel, metres; its length is a multiple of `columns`.
    pub depths_m: Vec<f32>,
}

impl DepthImage {
    /// An image from its parts, in the units of the fields.
    pub fn new(columns: usize, camera: Camera, depths_m: Vec<f32>) -> Self {
        Self { columns, camera, depths_m }
    }

    /// Number of rows; a last row that is not whole does not count.
    pub fn rows(&self) -> usize {
        self.depths_m.len().checked_div(self.columns).unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_and_pixels_agree() {
        let camera = Camera::new(500.0, -510.0, 319.5, 239.5);
        let point = camera.point_in_camera(12.0, 400.0, 2.5);
        let [column, row] = camera.pixel_of(&point).expect("ahead");
        assert!((column - 12.0).abs() < 1e-9 && (row - 400.0).abs() < 1e-9);
        assert_eq!(camera.pixel_of(&Point3::new(1.0, 1.0, -1.0)), None);
        assert!(camera.is_usable() && !camera.is_right_handed());
        assert_eq!(camera.cropped(10, 20).slope_of(2.0, 30.0), camera.slope_of(12.0, 50.0));
        assert!(!Camera::new(0.0, 1.0, 0.0, 0.0).is_usable());
    }

    #[test]
    fn rows_are_whole() {
        let camera = Camera::new(1.0, 1.0, 0.0, 0.0);
        assert_eq!(DepthImage::new(2, camera, vec![1.0; 5]).rows(), 2);
        assert_eq!(DepthImage::new(0, camera, vec![]).rows(), 0);
    }
}
