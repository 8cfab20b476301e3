//! What was seen from one vertex: its depth images, exact to each other.

use geometry::{Point3, Vector3};
use pose::Se3;
use pose::nalgebra::UnitQuaternion;
use sensing::{Camera, DepthImage};

/// A turn about the vertical, counter-clockwise from above, radians.
pub(super) fn yaw(angle_rad: f64) -> Se3 {
    Se3::new(Vector3::zeros(), UnitQuaternion::from_axis_angle(&Vector3::z_axis(), angle_rad))
}

/// Distances that differ by less are the same, metres.
const SAME_M: f64 = 1e-4;

/// Images are kept with at most so many columns: of larger ones several pixels become one. 99 columns by 87 rows
/// hold 34 KiB; an image of 640 by 480 would hold 1.2 MB and tell the policy nothing more.
const MOST_COLUMNS: usize = 128;

/// The images of one vertex.
#[derive(Clone, Debug, Default)]
pub(super) struct Panorama {
    looks: Vec<Seen>,
    /// The yaw of the first image in the frame of the vertex, radians.
    pub(super) first_yaw_rad: Option<f64>,
}

/// One image, its depths replaced by what is free for certain between the pixels.
///
/// What is a pixel here stands for a square of the camera's where that has more than [`MOST_COLUMNS`].
#[derive(Clone, Debug)]
struct Seen {
    vertex_from_camera: Se3,
    camera: Camera,
    columns: usize,
    rows: usize,
    /// For each square of four pixels the least of their depths; 0 where one of them has no reading.
    free_m: Vec<f32>,
}

/// The shape of a camera: what can be in view of a place that nobody was at yet.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lens {
    pub(super) body_from_camera: Se3,
    pub(super) camera: Camera,
    pub(super) columns: usize,
    pub(super) rows: usize,
    /// The farthest reading so far, metres.
    pub(super) far_m: f64,
}

impl Panorama {
    /// Adds an image. Missing readings count as not seen.
    pub(super) fn add(&mut self, yaw_rad: f64, vertex_from_camera: Se3, image: &DepthImage) {
        self.first_yaw_rad.get_or_insert(yaw_rad);
        let free = |depth_m: f32| if depth_m.is_finite() && depth_m > 0.0 { depth_m } else { 0.0 };
        let side = image.columns.div_ceil(MOST_COLUMNS).max(1);
        // What is left over of a square at the right and at the bottom is not seen.
        let squares = image.columns.saturating_sub(1) / side;
        let squares_down = image.rows().saturating_sub(1) / side;
        let mut free_m = Vec::with_capacity(squares * squares_down);
        for (row, column) in (0..squares_down).flat_map(|row| (0..squares).map(move |c| (row, c))) {
            let rows = row * side..=(row + 1) * side;
            let least_m = rows.fold(f32::MAX, |least_m, row| {
                let from = row * image.columns + column * side;
                let depths = &image.depths_m[from..=from + side];
                depths.iter().map(|&depth_m| free(depth_m)).fold(least_m, f32::min)
            });
            free_m.push(least_m);
        }
        // The corners of the squares are the pixels of this camera.
        let Camera { fx, fy, cx, cy } = image.camera;
        let by = side as f64;
        let camera = Camera::new(fx / by, fy / by, cx / by, cy / by);
        let (columns, rows) = (squares + 1, squares_down + 1);
        self.looks.push(Seen { vertex_from_camera, camera, columns, rows, free_m });
    }

    /// Whether nobody looked yet.
    pub(super) fn is_empty(&self) -> bool {
        self.looks.is_empty()
    }

    /// Whether a point is in front of what was seen in its direction, by at least `short_m` of depth.
    pub(super) fn is_free(&self, point_in_vertex: &Point3, short_m: f64) -> bool {
        self.looks.iter().any(|seen| {
            let point = seen.vertex_from_camera.inverse_transform(point_in_vertex);
            let Some([column, row]) = seen.camera.pixel_of(&point) else { return false };
            if column < 0.0 || row < 0.0 {
                return false;
            }
            let (column, row) = (column as usize, row as usize);
            column + 1 < seen.columns
                && row + 1 < seen.rows
                && point.z + short_m <= f64::from(seen.free_m[row * (seen.columns - 1) + column])
        })
    }

    /// Whether a round body that flies straight from the vertex keeps clear of what the pixels saw: from each
    /// square of four of them it stays `keep_m` away, or gets no nearer than it was at the start.
    ///
    /// Near to surfaces reduced polyhedra are not exact enough for that. O(pixels).
    pub(super) fn keeps_clear(&self, to: &Point3, keep_m: f64) -> bool {
        let way = to.coords;
        let squared = way.norm_squared();
        if squared <= 0.0 {
            return true;
        }
        let reach_m = squared.sqrt() + keep_m;
        self.looks.iter().all(|seen| {
            let (squares, camera) = (seen.columns.saturating_sub(1), &seen.camera);
            let way = seen.vertex_from_camera.rotation.inverse() * way;
            let start = seen.vertex_from_camera.inverse_transform(&Point3::origin());
            seen.free_m.iter().enumerate().all(|(at, &depth_m)| {
                if depth_m <= 0.0 || f64::from(depth_m) > reach_m {
                    return true;
                }
                let (column, row) = ((at % squares) as f64 + 0.5, (at / squares) as f64 + 0.5);
                let by = camera.point_in_camera(column, row, depth_m.into()) - start;
                let along = (by.dot(&way) / squared).clamp(0.0, 1.0);
                let near_m = (by - way * along).norm();
                near_m >= keep_m || near_m >= by.norm() - SAME_M
            })
        })
    }

    /// Calls with what the pixels saw within `reach_m` of the root, in its frame: one point for each square of four.
    pub(super) fn near_points(
        &self,
        root_from_vertex: &Se3,
        reach_m: f64,
        mut call: impl FnMut(Point3),
    ) {
        for seen in &self.looks {
            let root_from_camera = *root_from_vertex * seen.vertex_from_camera;
            let root = root_from_camera.inverse_transform(&Point3::origin());
            let squares = seen.columns.saturating_sub(1);
            for (at, &depth_m) in seen.free_m.iter().enumerate() {
                // What is so much deeper or less deep than the root is far from it.
                if depth_m <= 0.0 || (f64::from(depth_m) - root.z).abs() > reach_m {
                    continue;
                }
                let (column, row) = ((at % squares) as f64 + 0.5, (at / squares) as f64 + 0.5);
                let point = seen.camera.point_in_camera(column, row, depth_m.into());
                if (point - root).norm_squared() <= reach_m * reach_m {
                    call(root_from_camera.transform(&point));
                }
            }
        }
    }

    /// Whether some image has the direction of a point in it, by at least so many pixels from its border.
    pub(super) fn has_in_view(&self, point_in_vertex: &Point3, border_px: f64) -> bool {
        self.looks.iter().any(|seen| {
            let point = seen.vertex_from_camera.inverse_transform(point_in_vertex);
            in_image(&seen.camera, (seen.columns, seen.rows), &point, border_px)
        })
    }

    /// What an image that has the direction of a point in it read there: whether something solid stands before
    /// it, by at least `before_m` of depth. `None` where no image has it, or none has a reading there.
    pub(super) fn hides(&self, point_in_vertex: &Point3, before_m: f64) -> Option<bool> {
        self.looks.iter().find_map(|seen| {
            let point = seen.vertex_from_camera.inverse_transform(point_in_vertex);
            let [column, row] = seen.camera.pixel_of(&point)?;
            if column < 0.0 || row < 0.0 {
                return None;
            }
            let (column, row) = (column as usize, row as usize);
            if column + 1 >= seen.columns || row + 1 >= seen.rows {
                return None;
            }
            let depth_m = f64::from(seen.free_m[row * (seen.columns - 1) + column]);
            (depth_m > 0.0).then_some(depth_m + before_m <= point.z)
        })
    }

    /// Whether the straight way between two points is free, its last `short_m` left out.
    pub(super) fn is_way_free(&self, from: &Point3, to: &Point3, short_m: f64) -> bool {
        let way = to - from;
        let length_m = way.norm();
        let steps = ((length_m - short_m) / 0.15).ceil();
        if steps <= 0.0 {
            return true;
        }
        let step = way * ((length_m - short_m) / length_m / steps);
        // The far end first: it is what fails most often.
        (1..=steps as usize).rev().all(|i| self.is_free(&(from + step * i as f64), 0.0))
    }
}

impl Lens {
    /// Whether a point would be in the image of a robot with that yaw, in the frame of the vertex.
    pub(super) fn sees(&self, yaw_rad: f64, point_in_vertex: &Point3, border_px: f64) -> bool {
        let vertex_from_camera = yaw(yaw_rad) * self.body_from_camera;
        let point = vertex_from_camera.inverse_transform(point_in_vertex);
        in_image(&self.camera, (self.columns, self.rows), &point, border_px)
    }

    /// Depth that a point has for a robot which turned to it, metres; `None` where it is too high or too low.
    pub(super) fn depth_of(&self, by: &Vector3, border_px: f64) -> Option<f64> {
        let ahead = Point3::new(by.x.hypot(by.y), 0.0, by.z);
        let point = self.body_from_camera.inverse_transform(&ahead);
        let [_, row] = self.camera.pixel_of(&point)?;
        (row >= border_px && row <= self.rows as f64 - 1.0 - border_px).then_some(point.z)
    }
}

fn in_image(
    camera: &Camera,
    (columns, rows): (usize, usize),
    point: &Point3,
    border_px: f64,
) -> bool {
    camera.pixel_of(point).is_some_and(|[column, row]| {
        let within = |x: f64, count: usize| x >= border_px && x <= count as f64 - 1.0 - border_px;
        within(column, columns) && within(row, rows)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A wall at x = 1 m, seen from the vertex by a camera that looks along x.
    fn wall() -> Panorama {
        let upright = pose::nalgebra::Matrix3::new(0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0);
        let upright = pose::nalgebra::Rotation3::from_matrix_unchecked(upright);
        let upright = UnitQuaternion::from_rotation_matrix(&upright);
        let camera = Camera::new(50.0, 50.0, 49.5, 39.5);
        let image = DepthImage::new(100, camera, vec![1.0; 100 * 80]);
        let mut seen = Panorama::default();
        seen.add(0.0, Se3::new(Vector3::zeros(), upright), &image);
        seen
    }

    #[test]
    fn a_large_image_is_kept_as_a_small_one() {
        let small = wall();
        let seen = &small.looks[0];
        let (camera, by) = (seen.camera, 8.0);
        let large = Camera::new(by * camera.fx, by * camera.fy, by * camera.cx, by * camera.cy);
        let image = DepthImage::new(800, large, vec![1.0; 800 * 640]);
        let mut kept = Panorama::default();
        kept.add(0.0, seen.vertex_from_camera, &image);
        assert!(kept.looks[0].free_m.len() < 2 * seen.free_m.len());
        for to in [[0.7, 0.0, 0.0], [0.8, 0.0, 0.0], [0.8, 0.4, 0.0], [0.9, 0.3, -0.3]] {
            let to = Point3::from(to);
            assert_eq!(kept.keeps_clear(&to, 0.25), small.keeps_clear(&to, 0.25), "{to}");
            assert_eq!(kept.is_free(&to, 0.15), small.is_free(&to, 0.15), "{to}");
        }
    }

    #[test]
    fn a_body_keeps_clear_of_what_the_pixels_saw() {
        let seen = wall();
        assert!(seen.keeps_clear(&Point3::new(0.7, 0.0, 0.0), 0.25));
        assert!(!seen.keeps_clear(&Point3::new(0.8, 0.0, 0.0), 0.25));
        assert!(!seen.keeps_clear(&Point3::new(0.8, 0.4, 0.0), 0.25));
        assert!(!seen.keeps_clear(&Point3::new(2.0, 0.0, 0.0), 0.25));
        // Nearer to the wall than it keeps it may get away from it, and along it, but not towards it.
        assert!(seen.keeps_clear(&Point3::new(-0.5, 0.2, 0.0), 1.2));
        assert!(seen.keeps_clear(&Point3::origin(), 1.2));
        assert!(!seen.keeps_clear(&Point3::new(0.1, 0.0, 0.0), 1.2));
    }
}
