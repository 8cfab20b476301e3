//! What a simulated flying robot is made of.

use pose::Se3;
use pose::nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use sensing::Camera;

use crate::WorldError;
use crate::generate::range::{count, length, refuse};
use crate::robot::PlaceParams;

/// All parameters of a simulated flying robot.
#[derive(Clone, Debug, PartialEq)]
pub struct FlyerParams {
    /// The depth camera.
    pub camera: CameraParams,
    /// The drift of odometry.
    pub odometry: FlightNoiseParams,
    /// Place recognition; the options that it has in the plane, but false places.
    pub places: PlaceParams,
    /// Radius of the ball that must not touch a surface, metres; 0 is a point.
    pub radius_m: f64,
    /// Standard deviation of the position at the end of teach and repeat, metres, each axis.
    pub repeat_sigma_m: f64,
    /// Standard deviation of the yaw at the end of teach and repeat, radians.
    pub repeat_sigma_rotation_rad: f64,
}

impl Default for FlyerParams {
    /// A body of 20 cm; places are recognised within 2.5 m.
    fn default() -> Self {
        Self {
            camera: CameraParams::default(),
            odometry: FlightNoiseParams::default(),
            places: PlaceParams { radius_m: 2.5, ..PlaceParams::default() },
            radius_m: 0.2,
            repeat_sigma_m: 0.0,
            repeat_sigma_rotation_rad: 0.0,
        }
    }
}

impl FlyerParams {
    /// Checks the fields.
    ///
    /// # Errors
    /// [`WorldError::Parameter`] with the first field that is wrong.
    pub fn check(&self) -> Result<(), WorldError> {
        self.camera.check()?;
        let from_0 = |field, found: f64| {
            refuse(found.is_finite() && found >= 0.0, field, found, "a number from 0 up")
        };
        from_0("sigma_translation", self.odometry.sigma_translation)?;
        from_0("sigma_rotation", self.odometry.sigma_rotation_rad)?;
        from_0("scale", self.odometry.scale)?;
        from_0("radius_m", self.radius_m)?;
        from_0("repeat_sigma_m", self.repeat_sigma_m)?;
        from_0("repeat_sigma_rotation", self.repeat_sigma_rotation_rad)
    }
}

/// A pinhole depth camera at the middle of the body.
///
/// The field of view must be wider than what lies between two looks: robots here look around in steps of a
/// quarter turn, so more than 90 degrees across; and what it does not see above and below must be seen from
/// elsewhere, so rather more than less up and down.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraParams {
    /// Pixels side by side, at least 2.
    pub columns: usize,
    /// Pixels above each other, at least 2.
    pub rows: usize,
    /// Angle between the rays of the first and of the last column, radians, below a half turn.
    pub fov_across_rad: f64,
    /// Angle between the rays of the first and of the last row, radians, below a half turn.
    pub fov_down_rad: f64,
    /// Depth along the optical axis beyond which nothing is read, metres.
    pub far_m: f64,
    /// How far the camera looks down, radians.
    pub pitch_down_rad: f64,
    /// Noise of a structured-light camera, if any.
    pub noise: Option<StructuredLight>,
}

impl Default for CameraParams {
    /// 100 by 90 degrees, 8 m.
    fn default() -> Self {
        Self {
            columns: 100,
            rows: 88,
            fov_across_rad: 100f64.to_radians(),
            fov_down_rad: 90f64.to_radians(),
            far_m: 8.0,
            pitch_down_rad: 0.0,
            noise: None,
        }
    }
}

impl CameraParams {
    /// The camera itself.
    pub fn camera(&self) -> Camera {
        let focal = |side: usize, fov: f64| 0.5 * (side as f64 - 1.0) / (0.5 * fov).tan();
        let middle = |side: usize| 0.5 * (side as f64 - 1.0);
        Camera::new(
            focal(self.columns, self.fov_across_rad),
            focal(self.rows, self.fov_down_rad),
            middle(self.columns),
            middle(self.rows),
        )
    }

    /// Where it is mounted: z ahead and down by the pitch, x to the right, y down.
    pub fn body_from_camera(&self) -> Se3 {
        let upright = Matrix3::new(0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0);
        let upright =
            UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(upright));
        let pitch = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), self.pitch_down_rad);
        Se3::new(Vector3::zeros(), pitch * upright)
    }

    fn check(&self) -> Result<(), WorldError> {
        count("columns", self.columns.saturating_sub(1))?;
        count("rows", self.rows.saturating_sub(1))?;
        let pixels = self.columns as f64 * self.rows as f64;
        refuse(pixels <= 1e8, "columns", pixels, "at most 1e8 pixels")?;
        let angle = |field, found: f64| {
            let good = found > 0.0 && found < std::f64::consts::PI;
            refuse(good, field, found, "an angle above 0, below a half turn")
        };
        angle("fov_across", self.fov_across_rad)?;
        angle("fov_down", self.fov_down_rad)?;
        length("far_m", self.far_m)?;
        let good = self.pitch_down_rad.abs() < 1.5;
        refuse(good, "pitch_down", self.pitch_down_rad, "an angle of less than 1.5 rad")?;
        let Some(noise) = &self.noise else { return Ok(()) };
        let good = |x: f64| x.is_finite() && x >= 0.0;
        refuse(good(noise.sigma_m), "sigma_m", noise.sigma_m, "a number from 0 up")?;
        let found = noise.sigma_per_m;
        refuse(good(found), "sigma_per_m", found, "a number from 0 up")
    }
}

/// Noise of a camera that measures depth by disparity: its error grows with the square of the depth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StructuredLight {
    /// Standard deviation that does not depend on the depth, metres.
    pub sigma_m: f64,
    /// Standard deviation per squared depth, metres per square metre.
    pub sigma_per_m: f64,
}

impl Default for StructuredLight {
    /// About that of the first Kinect.
    fn default() -> Self {
        Self { sigma_m: 0.0, sigma_per_m: 0.001_4 }
    }
}

/// How the true flight differs from the commanded one, which is what odometry reports.
///
/// A flight of d metres ends in a pose error with variance `scale² · sigma² · d` per component, in the
/// body's frame: three of position, one of yaw. The law of the plane (\[ISRR19\] 6.1) with one axis more.
/// Turns are exact.
#[derive(Clone, Debug, PartialEq)]
pub struct FlightNoiseParams {
    /// Standard deviation along each axis, metres per square root of a metre.
    pub sigma_translation: f64,
    /// Standard deviation of the yaw, radians per square root of a metre.
    pub sigma_rotation_rad: f64,
    /// Multiplies every error; the α of \[ISRR19\].
    pub scale: f64,
}

impl Default for FlightNoiseParams {
    fn default() -> Self {
        Self { sigma_translation: 0.1, sigma_rotation_rad: 5f64.to_radians(), scale: 1.0 }
    }
}
