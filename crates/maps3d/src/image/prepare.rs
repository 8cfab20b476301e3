//! Crop, invalid values, missing data.

use nalgebra::Point3;
use sensing::{Camera, DepthImage};

use crate::Maps3dError;

/// A column and a row of an image, from 0; the row counts downwards.
pub type Pixel = [u16; 2];

/// The most columns, and the most rows, that an image may have: in-circle tests on such pixels fit
/// into 64 bits.
pub const LARGEST_SIDE: usize = 1 << 14;

/// Readings nearer than this are missing: no depth camera sees there, and zero has no direction.
pub const NEAREST_M: f32 = 1e-3;

/// Readings farther than this are missing: inverse depths stay apart by more than rounding.
pub const FARTHEST_M: f32 = 1e6;

/// What is done to an image before it is triangulated; the defaults are those of \[Mos15\] 5.4.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrepareOptions {
    /// Pixels cut off on each of the four sides.
    pub crop: usize,
    /// Depth at which missing data is placed, metres.
    pub far_m: f64,
    /// Readings beyond this depth are missing; none are where it is infinite.
    pub max_m: f64,
}

impl Default for PrepareOptions {
    fn default() -> Self {
        Self { crop: 0, far_m: 8.0, max_m: f64::INFINITY }
    }
}

/// An image with a depth at every pixel, and the knowledge which of them were measured.
///
/// What holds: 2 to [`LARGEST_SIDE`] columns and rows, a usable camera, every depth between
/// [`NEAREST_M`] and [`FARTHEST_M`].
#[derive(Clone, Debug, PartialEq)]
pub struct FilledImage {
    columns: usize,
    rows: usize,
    camera: Camera,
    depths_m: Vec<f32>,
    /// One bit per pixel, set where nothing was measured.
    missing: Vec<u64>,
    missing_count: usize,
}

impl PrepareOptions {
    /// Checks what can be told without an image.
    ///
    /// # Errors
    /// [`Maps3dError::Option`] for a distance out of its range.
    pub fn check(&self) -> Result<(), Maps3dError> {
        let near = f64::from(NEAREST_M);
        if !(near..=f64::from(FARTHEST_M)).contains(&self.far_m) {
            let expected = "a distance from 0.001 to 1e6 m";
            return Err(Maps3dError::Option { option: "far_m", found: self.far_m, expected });
        }
        if self.max_m.is_nan() || self.max_m < near {
            let expected = "a distance of at least 0.001 m, or infinity";
            return Err(Maps3dError::Option { option: "max_m", found: self.max_m, expected });
        }
        Ok(())
    }

    /// Whether a depth is a reading, metres: finite, not nearer than [`NEAREST_M`], not farther than
    /// [`FARTHEST_M`] or `max_m`.
    #[expect(clippy::cast_possible_truncation, reason = "depths are kept as sensors give them")]
    pub fn measures(&self, depth_m: f32) -> bool {
        (NEAREST_M..=self.max_m.min(f64::from(FARTHEST_M)) as f32).contains(&depth_m)
    }

    /// The columns and rows that are left of an image.
    ///
    /// # Errors
    /// [`Maps3dError::ImageSize`] where they are none, or too many.
    pub fn size_left(&self, columns: usize, rows: usize) -> Result<[usize; 2], Maps3dError> {
        let (least, most, crop) = (1, LARGEST_SIDE, self.crop);
        let left = |side: usize| {
            side.checked_sub(crop.saturating_mul(2)).filter(|left| (least..=most).contains(left))
        };
        match (left(columns), left(rows)) {
            (Some(width), Some(height)) => Ok([width, height]),
            _ => Err(Maps3dError::ImageSize { columns, rows, crop, least, most }),
        }
    }
}

/// Crops the image, tells invalid values and places missing data at the far distance.
///
/// Cropping by n leaves `columns - 2 n` columns; the thesis kept one more of each (541 of 640 at
/// 50). Missing is what is no reading ([`PrepareOptions::measures`]). A missing pixel gets the depth
/// `far_m` on its own ray (eq. 5.1). Readings beyond `far_m` stay where they are. O(pixels).
///
/// The rays of a single row or column lie in one plane and enclose nothing. What is one pixel wide is
/// taken over the whole width of its pixels: two rows (columns) of the same depths, half a pixel to each
/// side of the one that was measured, which so lies on the surface.
///
/// # Errors
/// [`Maps3dError`] for a size, camera or option out of its range.
pub fn prepare(image: &DepthImage, options: &PrepareOptions) -> Result<FilledImage, Maps3dError> {
    let Camera { fx, fy, cx, cy } = image.camera;
    if !image.camera.is_usable() {
        return Err(Maps3dError::Camera { fx, fy, cx, cy });
    }
    let (columns, rows, crop) = (image.columns, image.rows(), options.crop);
    if columns == 0 || !image.depths_m.len().is_multiple_of(columns) {
        return Err(Maps3dError::ImageShape { depths: image.depths_m.len(), columns });
    }
    options.check()?;
    let [width, height] = options.size_left(columns, rows)?;
    let [wide, high] = [width, height].map(|side| if side == 1 { 2 } else { 1 });
    let mut camera = image.camera.cropped(crop, crop);
    camera.cx += 0.5 * (wide - 1) as f64;
    camera.cy += 0.5 * (high - 1) as f64;
    let pixels = width * wide * height * high;
    let mut filled = FilledImage {
        columns: width * wide,
        rows: height * high,
        camera,
        depths_m: Vec::with_capacity(pixels),
        missing: vec![0; pixels.div_ceil(64)],
        missing_count: 0,
    };
    #[expect(clippy::cast_possible_truncation, reason = "depths are kept as sensors give them")]
    let far_m = options.far_m as f32;
    let kept = image.depths_m.chunks_exact(columns).skip(crop).take(height);
    for row in kept.flat_map(|row| std::iter::repeat_n(row, high)) {
        let kept = row[crop..crop + width].iter();
        for &depth_m in kept.flat_map(|depth_m| std::iter::repeat_n(depth_m, wide)) {
            let measured = options.measures(depth_m);
            if !measured {
                let at = filled.depths_m.len();
                filled.missing[at / 64] |= 1 << (at % 64);
                filled.missing_count += 1;
            }
            filled.depths_m.push(if measured { depth_m } else { far_m });
        }
    }
    Ok(filled)
}

impl FilledImage {
    /// Number of columns, at least 2.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Number of rows, at least 2.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Number of pixels.
    pub fn pixels(&self) -> usize {
        self.depths_m.len()
    }

    /// The camera of the cropped image.
    pub fn camera(&self) -> &Camera {
        &self.camera
    }

    /// All depths, row-major, metres.
    pub fn depths_m(&self) -> &[f32] {
        &self.depths_m
    }

    /// Number of pixels without a reading.
    pub fn missing_count(&self) -> usize {
        self.missing_count
    }

    /// The place of a pixel in [`depths_m`](Self::depths_m).
    #[inline]
    pub fn index(&self, [column, row]: Pixel) -> usize {
        usize::from(row) * self.columns + usize::from(column)
    }

    /// The pixel at a place of [`depths_m`](Self::depths_m).
    #[inline]
    pub fn pixel(&self, index: usize) -> Pixel {
        [(index % self.columns) as u16, (index / self.columns) as u16]
    }

    /// The depth of a pixel, metres.
    #[inline]
    pub fn depth_m(&self, pixel: Pixel) -> f32 {
        self.depths_m[self.index(pixel)]
    }

    /// Whether nothing was measured at the pixel of this index.
    #[inline]
    pub fn is_missing(&self, index: usize) -> bool {
        self.missing[index / 64] >> (index % 64) & 1 == 1
    }

    /// Calls with the index of each missing pixel, in their order.
    pub(crate) fn for_each_missing(&self, mut call: impl FnMut(usize)) {
        for (word, &bits) in self.missing.iter().enumerate() {
            let mut left = bits;
            while left != 0 {
                call(word * 64 + left.trailing_zeros() as usize);
                left &= left - 1;
            }
        }
    }

    /// The point of a pixel, in the frame `camera`, metres.
    pub fn point_in_camera(&self, pixel: Pixel) -> Point3<f64> {
        let [column, row] = pixel.map(f64::from);
        self.camera.point_in_camera(column, row, f64::from(self.depth_m(pixel)))
    }

    /// The four corner pixels, in order of positive turns (columns to rows).
    pub fn corners(&self) -> [Pixel; 4] {
        let (right, bottom) = ((self.columns - 1) as u16, (self.rows - 1) as u16);
        [[0, 0], [right, 0], [right, bottom], [0, bottom]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(columns: usize, depths_m: Vec<f32>) -> DepthImage {
        DepthImage::new(columns, Camera::new(100.0, 100.0, 1.0, 1.0), depths_m)
    }

    #[test]
    fn cropping_cuts_as_much_on_each_side() {
        let depths = (0..20).map(|i| 1.0 + i as f32).collect();
        let options = PrepareOptions { crop: 1, ..Default::default() };
        let filled = prepare(&image(5, depths), &options).expect("3 x 2 are left");
        assert_eq!((filled.columns(), filled.rows()), (3, 2));
        assert_eq!(filled.depths_m(), [7.0, 8.0, 9.0, 12.0, 13.0, 14.0]);
        assert_eq!(filled.camera().cx, 0.0);
        // 640 columns cropped by 50 are 540: the thesis counts 541.
        let thesis = prepare(
            &image(640, vec![1.0; 640 * 480]),
            &PrepareOptions { crop: 50, ..Default::default() },
        );
        let thesis = thesis.expect("large enough");
        assert_eq!((thesis.columns(), thesis.rows()), (540, 380));
    }

    #[test]
    fn what_is_no_reading_goes_to_the_far_distance() {
        let odd = vec![1.0, 0.0, -1.0, f32::NAN, f32::INFINITY, 1e-4, 2e6, 9.0, 4.0];
        let options = PrepareOptions { max_m: 8.5, far_m: 3.0, ..Default::default() };
        let filled = prepare(&image(3, odd), &options).expect("3 x 3");
        assert_eq!(filled.depths_m(), [1.0, 3.0, 3.0, 3.0, 3.0, 3.0, 3.0, 3.0, 4.0]);
        assert_eq!(filled.missing_count(), 7);
        let missing: Vec<bool> = (0..9).map(|i| filled.is_missing(i)).collect();
        assert_eq!(missing, [false, true, true, true, true, true, true, true, false]);
        assert_eq!(filled.point_in_camera([2, 0]), Point3::new(0.03, -0.03, 3.0));
        assert_eq!(filled.pixel(filled.index([2, 1])), [2, 1]);
    }

    #[test]
    fn a_line_of_pixels_is_as_wide_as_they_are() {
        let fine = PrepareOptions::default();
        let row = prepare(&image(3, vec![1.0, 0.0, 3.0]), &fine).expect("a row");
        assert_eq!((row.columns(), row.rows(), row.missing_count()), (3, 2, 2));
        assert_eq!(row.depths_m(), [1.0, 8.0, 3.0, 1.0, 8.0, 3.0]);
        let column = prepare(&image(1, vec![1.0, 0.0, 3.0]), &fine).expect("a column");
        assert_eq!((column.columns(), column.rows()), (2, 3));
        assert_eq!(column.depths_m(), [1.0, 1.0, 8.0, 8.0, 3.0, 3.0]);
        let one = prepare(&image(1, vec![4.0]), &fine).expect("one pixel");
        assert_eq!((one.columns(), one.rows()), (2, 2));
        // The ray of the pixel, at column 0 and row 0, is the middle of the two.
        let before = image(1, vec![4.0]).camera.slope_of(0.0, 0.0);
        assert_eq!(one.camera().slope_of(0.5, 0.5), before);
        assert_eq!(row.camera().slope_of(2.0, 0.5), image(3, vec![]).camera.slope_of(2.0, 0.0));
        assert_eq!(column.camera().slope_of(0.5, 2.0), image(1, vec![]).camera.slope_of(0.0, 2.0));
    }

    #[test]
    fn sizes_cameras_and_options_are_checked() {
        let fine = PrepareOptions::default();
        let crop = |crop| PrepareOptions { crop, ..Default::default() };
        for (columns, count, options) in
            [(1, 0, fine), (4, 16, crop(2)), (3, 9, crop(usize::MAX / 2)), (0, 0, fine)]
        {
            assert!(prepare(&image(columns, vec![1.0; count]), &options).is_err(), "{columns}");
        }
        assert!(prepare(&image(3, vec![1.0; 10]), &fine).is_err());
        for far_m in [0.0, f64::NAN, f64::INFINITY, -1.0] {
            let options = PrepareOptions { far_m, ..Default::default() };
            assert!(prepare(&image(3, vec![1.0; 9]), &options).is_err(), "{far_m}");
        }
        let mut blind = image(3, vec![1.0; 9]);
        blind.camera.fx = 0.0;
        assert!(matches!(prepare(&blind, &fine), Err(Maps3dError::Camera { .. })));
    }
}
