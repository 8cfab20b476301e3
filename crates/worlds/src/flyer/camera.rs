//! The depth camera: what it truly sees, and what it tells.

use geometry::{Point3, Vector3};
use pose::Se3;
use sensing::{Camera, DepthImage};

use super::SimFlyer;
use crate::robot::random::Purpose;

/// What a look truly saw, without noise, in the world frame.
#[derive(Clone, Debug, PartialEq)]
pub struct SpaceView {
    /// Pose of the camera.
    pub world_from_camera: Se3,
    /// The camera.
    pub camera: Camera,
    /// Number of columns.
    pub columns: usize,
    /// True depth of each pixel along the optical axis, metres, row-major; `far_m` where nothing is nearer.
    pub depths_m: Vec<f64>,
    /// How far the camera sees along its axis, metres.
    pub far_m: f64,
}

impl SpaceView {
    /// Whether the volume that was seen holds a point: in the image, and no deeper than what the nearest
    /// pixel sees.
    pub fn contains(&self, point_in_world: &Point3) -> bool {
        let point = self.world_from_camera.inverse_transform(point_in_world);
        let Some([column, row]) = self.camera.pixel_of(&point) else { return false };
        let rows = self.depths_m.len() / self.columns.max(1);
        // What the rays of the border span belongs to the image, whatever the rounding.
        let within = |x: f64, count: usize| x >= -1e-9 && x <= count as f64 - 1.0 + 1e-9;
        let at = || row.round() as usize * self.columns + column.round() as usize;
        within(column, self.columns) && within(row, rows) && point.z <= self.depths_m[at()]
    }
}

impl SimFlyer {
    /// Casts a ray through every pixel from the true pose; draws noise for each where there is any.
    pub(super) fn take_image(&mut self) -> DepthImage {
        let params = &self.params.camera;
        let camera = params.camera();
        let world_from_camera = self.world_from_body * params.body_from_camera();
        let origin = Point3::from(world_from_camera.translation);
        let rays: Vec<Vector3> = (0..params.columns * params.rows)
            .map(|at| {
                let (column, row) = (at % params.columns, at / params.columns);
                let [x, y] = camera.slope_of(column as f64, row as f64);
                Vector3::new(x, y, 1.0)
            })
            .collect();
        let directions: Vec<Vector3> =
            rays.iter().map(|ray| world_from_camera.rotation * ray.normalize()).collect();
        let corner = rays.iter().map(|ray| ray.norm()).fold(1.0, f64::max);
        let hits_m = self.world.caster().cast_all(&origin, &directions, params.far_m * corner);
        let depths_m: Vec<f64> =
            hits_m.iter().zip(&rays).map(|(hit_m, ray)| hit_m / ray.norm()).collect();
        let told = depths_m.iter().enumerate().map(|(at, &depth_m)| {
            if depth_m >= params.far_m {
                return f32::NAN;
            }
            let noisy_m = match &params.noise {
                None => depth_m,
                Some(noise) => {
                    let sigma_m = noise.sigma_m + noise.sigma_per_m * depth_m * depth_m;
                    let mut draw = self.streams.draw(Purpose::Depth, self.tally.scans, at as u64);
                    depth_m + sigma_m * draw.normals2()[0]
                }
            };
            #[expect(clippy::cast_possible_truncation, reason = "as sensors give it")]
            let depth_m = noisy_m as f32;
            if depth_m > 0.0 { depth_m } else { f32::NAN }
        });
        let image = DepthImage::new(params.columns, camera, told.collect());
        self.view = SpaceView {
            world_from_camera,
            camera,
            columns: params.columns,
            depths_m: depths_m.iter().map(|depth_m| depth_m.min(params.far_m)).collect(),
            far_m: params.far_m,
        };
        self.tally.scans += 1;
        image
    }
}
