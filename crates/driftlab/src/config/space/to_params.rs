//! From the tables to the parameters of the algorithms. Degrees end here.

use explore::FlightParams;
use metrics::VoxelParams;
use worlds::{CameraParams, FlightNoiseParams, FlyerParams, PlaceParams, StructuredLight};

use super::super::{Config, Odometry};
use super::{Camera, Metrics3d, Planner3d};

impl From<&Config> for FlyerParams {
    fn from(config: &Config) -> Self {
        Self {
            camera: config.camera.as_ref().map_or_else(CameraParams::default, Into::into),
            odometry: (&config.odometry).into(),
            places: PlaceParams::from(&config.places),
            radius_m: config.robot.radius_m,
            repeat_sigma_m: config.robot.repeat_sigma_m,
            repeat_sigma_rotation_rad: config.robot.repeat_sigma_deg.to_radians(),
        }
    }
}

impl From<&Odometry> for FlightNoiseParams {
    fn from(odometry: &Odometry) -> Self {
        Self {
            sigma_translation: odometry.sigma_translation,
            sigma_rotation_rad: odometry.sigma_rotation.to_radians(),
            scale: odometry.scale,
        }
    }
}

impl From<&Camera> for CameraParams {
    fn from(camera: &Camera) -> Self {
        let is_noisy = camera.sigma_m > 0.0 || camera.sigma_per_m2 > 0.0;
        let noise = StructuredLight { sigma_m: camera.sigma_m, sigma_per_m: camera.sigma_per_m2 };
        Self {
            columns: camera.columns as usize,
            rows: camera.rows as usize,
            fov_across_rad: camera.fov_across_deg.to_radians(),
            fov_down_rad: camera.fov_down_deg.to_radians(),
            far_m: camera.far_m,
            pitch_down_rad: camera.pitch_down_deg.to_radians(),
            noise: is_noisy.then_some(noise),
        }
    }
}

impl From<&Metrics3d> for VoxelParams {
    fn from(metrics: &Metrics3d) -> Self {
        let Metrics3d { cell_m, complete_share } = *metrics;
        Self { cell_m, complete_share }
    }
}

impl From<&Config> for FlightParams {
    fn from(config: &Config) -> Self {
        let defaults = Planner3d::default();
        let planner = config.planner3d.as_ref().unwrap_or(&defaults);
        Self {
            body_radius_m: config.robot.radius_m,
            margins_m: planner.margins_m.clone(),
            leaving_m: planner.leaving_m,
            hop_m: planner.hop_m,
            looks_at_a_place: planner.looks_at_a_place,
            turn_gain_m2: planner.turn_gain_m2,
            view_share: planner.view_share,
            tries: planner.tries as usize,
            same_place_m: planner.same_place_m,
            around_m: planner.around_m,
            visits_in_vain: planner.visits_in_vain,
            ways: planner.ways.into(),
            max_steps: u64::from(config.max_steps),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use worlds::space::{Cave3dParams, Office3dParams, Pillars3dParams, Rooms3dParams};

    #[test]
    fn the_defaults_here_are_the_defaults_below() {
        use super::super::{
            Cave3dWorld, Office3dWorld, Pillars3dWorld, RelativeMap3d, Rooms3dWorld,
        };
        use maps3d::relative::RelativeParams;
        assert_eq!(CameraParams::from(&Camera::default()), CameraParams::default());
        assert_eq!(VoxelParams::from(&Metrics3d::default()), VoxelParams::default());
        let mut config = Config::default();
        config.robot.radius_m = FlightParams::default().body_radius_m;
        assert_eq!(FlightParams::from(&config), FlightParams::default());
        assert_eq!(RelativeParams::from(&RelativeMap3d::default()), RelativeParams::default());
        assert_eq!(Rooms3dParams::from(&Rooms3dWorld::default()), Rooms3dParams::default());
        assert_eq!(Office3dParams::from(&Office3dWorld::default()), Office3dParams::default());
        assert_eq!(Pillars3dParams::from(&Pillars3dWorld::default()), Pillars3dParams::default());
        assert_eq!(Cave3dParams::from(&Cave3dWorld::default()), Cave3dParams::default());
    }

    #[test]
    fn a_camera_is_noisy_only_where_it_is_asked_to_be() {
        assert_eq!(CameraParams::from(&Camera::default()).noise, None);
        let camera = Camera { sigma_per_m2: 0.0014, ..Camera::default() };
        let noise = StructuredLight { sigma_m: 0.0, sigma_per_m: 0.0014 };
        assert_eq!(CameraParams::from(&camera).noise, Some(noise));
    }
}
