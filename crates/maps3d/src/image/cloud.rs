//! Organised clouds: one point per pixel.

use nalgebra::{Matrix2, Vector2};
use sensing::{Camera, DepthImage};

use crate::Maps3dError;
use crate::tolerance::LINE_SHARE;

/// What happens to points that share one place (\[Mos15\] 5.4.1).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Duplicates {
    /// The cloud is refused, as the thesis does.
    #[default]
    Refuse,
    /// All points of that place are missing.
    Missing,
}

/// How a cloud is read as an image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CloudOptions {
    /// What happens where more points than `shared` are at one place.
    pub duplicates: Duplicates,
    /// The most points that may be at one place; pixels have rays of their own, so one is right.
    pub shared: usize,
    /// How far 95 % of the points may be from the ray of their pixel, pixels.
    pub off_ray_px: f64,
}

impl Default for CloudOptions {
    fn default() -> Self {
        Self { duplicates: Duplicates::Refuse, shared: 1, off_ray_px: 0.5 }
    }
}

/// A camera found for a cloud.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fitted {
    /// The camera.
    pub camera: Camera,
    /// The distance of a point from its pixel's ray that 95 % of the points keep, pixels.
    pub error_px: f64,
}

/// The depth image of an organised cloud: row-major points of the frame `camera`, metres.
///
/// Points that are not finite or not ahead are missing. Where `camera` is `None` it is fitted.
/// O(points log points), for the duplicates.
///
/// # Errors
/// [`Maps3dError::NotOrganised`] for a single row; [`Maps3dError::Duplicates`];
/// [`Maps3dError::NoCamera`] where no pinhole camera explains the points.
pub fn depth_image_of(
    columns: usize,
    points_in_camera: &[[f32; 3]],
    camera: Option<Camera>,
    options: &CloudOptions,
) -> Result<DepthImage, Maps3dError> {
    let points = points_in_camera.len();
    let rows = points.checked_div(columns).unwrap_or(0);
    if columns < 2 || rows < 2 || rows * columns != points {
        return Err(Maps3dError::NotOrganised { points, rows });
    }
    let mut depths_m: Vec<f32> =
        points_in_camera.iter().map(|p| if is_ahead(p) { p[2] } else { f32::NAN }).collect();
    for place in shared_places(points_in_camera, options.shared) {
        if options.duplicates == Duplicates::Refuse {
            let [x, y, z] = points_in_camera[place[0] as usize];
            let (points, limit) = (place.len(), options.shared);
            return Err(Maps3dError::Duplicates { points, limit, x, y, z });
        }
        for &index in &place {
            depths_m[index as usize] = f32::NAN;
        }
    }
    let camera = match camera {
        Some(camera) => camera,
        None => {
            let limit_px = options.off_ray_px;
            match fit_camera(columns, points_in_camera) {
                Some(fitted) if fitted.error_px <= limit_px => fitted.camera,
                found => {
                    let error_px = found.map_or(f64::NAN, |fitted| fitted.error_px);
                    return Err(Maps3dError::NoCamera { error_px, limit_px });
                }
            }
        }
    };
    Ok(DepthImage::new(columns, camera, depths_m))
}

/// The pinhole camera whose rays pass the points best, by least squares of pixels; `None` where the
/// points do not determine one.
///
/// Column = fx (x / z) + cx and row = fy (y / z) + cy are two straight lines through the points.
/// One more fit leaves out what is more than three times as far off as 95 % of the points.
pub fn fit_camera(columns: usize, points_in_camera: &[[f32; 3]]) -> Option<Fitted> {
    let mut limit_px = f64::INFINITY;
    let mut fitted = None;
    for _ in 0..2 {
        let mut sums = [Line::default(); 2];
        for (index, p) in points_in_camera.iter().enumerate().filter(|(_, p)| is_ahead(p)) {
            let (slopes, pixel) = observed(columns, index, p);
            if let Some(Fitted { camera, .. }) = fitted
                && off_ray(&camera, slopes, pixel) > limit_px
            {
                continue;
            }
            sums[0].add(slopes[0], pixel[0]);
            sums[1].add(slopes[1], pixel[1]);
        }
        let [(fx, cx), (fy, cy)] = [sums[0].solve()?, sums[1].solve()?];
        let camera = Camera::new(fx, fy, cx, cy);
        if !camera.is_usable() {
            return None;
        }
        let mut errors: Vec<f64> = points_in_camera
            .iter()
            .enumerate()
            .filter(|(_, p)| is_ahead(p))
            .map(|(index, p)| {
                let (slopes, pixel) = observed(columns, index, p);
                off_ray(&camera, slopes, pixel)
            })
            .collect();
        let rank = (errors.len() * 95 / 100).min(errors.len() - 1);
        let error_px = *errors.select_nth_unstable_by(rank, f64::total_cmp).1;
        limit_px = 3.0 * error_px;
        fitted = Some(Fitted { camera, error_px });
    }
    fitted
}

fn is_ahead(p: &[f32; 3]) -> bool {
    p.iter().all(|x| x.is_finite()) && p[2] > 0.0
}

fn observed(columns: usize, index: usize, p: &[f32; 3]) -> ([f64; 2], [f64; 2]) {
    let [x, y, z] = p.map(f64::from);
    ([x / z, y / z], [(index % columns) as f64, (index / columns) as f64])
}

fn off_ray(camera: &Camera, [x, y]: [f64; 2], [column, row]: [f64; 2]) -> f64 {
    (camera.fx * x + camera.cx - column).hypot(camera.fy * y + camera.cy - row)
}

/// Sums for the line `pixel = f slope + c`.
#[derive(Clone, Copy, Default)]
struct Line {
    count: f64,
    slope: f64,
    pixel: f64,
    slope_slope: f64,
    slope_pixel: f64,
}

impl Line {
    fn add(&mut self, slope: f64, pixel: f64) {
        self.count += 1.0;
        self.slope += slope;
        self.pixel += pixel;
        self.slope_slope += slope * slope;
        self.slope_pixel += slope * pixel;
    }

    fn solve(&self) -> Option<(f64, f64)> {
        let matrix = Matrix2::new(self.slope_slope, self.slope, self.slope, self.count);
        // Points of one column, or a single one, leave the focal length open.
        let spread = matrix.determinant() / (self.count * self.count);
        if spread.is_nan() || spread <= LINE_SHARE * (self.slope_slope / self.count) {
            return None;
        }
        let line = matrix.lu().solve(&Vector2::new(self.slope_pixel, self.pixel))?;
        Some((line.x, line.y))
    }
}

/// The groups of more than `limit` points ahead at one place, each in order; largest first.
fn shared_places(points: &[[f32; 3]], limit: usize) -> Vec<Vec<u32>> {
    let key = |index: u32| points[index as usize].map(f32::to_bits);
    let mut order: Vec<u32> =
        (0..points.len() as u32).filter(|&i| is_ahead(&points[i as usize])).collect();
    order.sort_unstable_by_key(|&index| (key(index), index));
    let mut places: Vec<Vec<u32>> = order
        .chunk_by(|a, b| key(*a) == key(*b))
        .filter(|place| place.len() > limit)
        .map(<[u32]>::to_vec)
        .collect();
    places.sort_by_key(|place| (std::cmp::Reverse(place.len()), place[0]));
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cloud(camera: &Camera) -> Vec<[f32; 3]> {
        (0..20 * 10)
            .map(|i| {
                let depth = 1.0 + 0.01 * (i % 7) as f64;
                let p = camera.point_in_camera((i % 20) as f64, (i / 20) as f64, depth);
                [p.x as f32, p.y as f32, p.z as f32]
            })
            .collect()
    }

    #[test]
    fn the_camera_of_a_cloud_is_found() {
        let camera = Camera::new(525.0, -520.0, 9.5, 4.25);
        let mut points = cloud(&camera);
        points[7] = [f32::NAN; 3];
        let image = depth_image_of(20, &points, None, &CloudOptions::default()).expect("a pinhole");
        for (found, right) in [
            (image.camera.fx, camera.fx),
            (image.camera.fy, camera.fy),
            (image.camera.cx, camera.cx),
            (image.camera.cy, camera.cy),
        ] {
            assert!((found - right).abs() < 1e-2, "{found} {right}");
        }
        assert!(image.depths_m[7].is_nan());
        assert_eq!(image.depths_m[8], points[8][2]);
    }

    #[test]
    fn duplicates_are_refused_or_missing() {
        let mut points = cloud(&Camera::new(525.0, 525.0, 9.5, 4.5));
        for point in &mut points[20..25] {
            *point = [0.5, 0.5, 2.0];
        }
        let refused = depth_image_of(20, &points, None, &CloudOptions::default());
        assert!(matches!(refused, Err(Maps3dError::Duplicates { points: 5, limit: 1, .. })));
        let options = CloudOptions { duplicates: Duplicates::Missing, ..Default::default() };
        let camera = Camera::new(525.0, 525.0, 9.5, 4.5);
        let image = depth_image_of(20, &points, Some(camera), &options).expect("told what to do");
        assert!(image.depths_m[20..25].iter().all(|z| z.is_nan()));
        assert_eq!(image.depths_m.iter().filter(|z| z.is_nan()).count(), 5);
    }

    #[test]
    fn what_is_no_image_is_refused() {
        let options = CloudOptions::default();
        let points = cloud(&Camera::new(525.0, 525.0, 9.5, 4.5));
        let refused = depth_image_of(points.len(), &points, None, &options);
        assert!(matches!(refused, Err(Maps3dError::NotOrganised { points: 200, rows: 1 })));
        // Points in no order of rays.
        let mixed: Vec<[f32; 3]> = (0..200).map(|i| points[i * 37 % 200]).collect();
        let refused = depth_image_of(20, &mixed, None, &options);
        assert!(matches!(refused, Err(Maps3dError::NoCamera { .. })));
        let empty = vec![[f32::NAN; 3]; 200];
        assert!(matches!(
            depth_image_of(20, &empty, None, &options),
            Err(Maps3dError::NoCamera { error_px, .. }) if error_px.is_nan()
        ));
    }
}
