//! The depth camera. Degrees are allowed here and end here.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The depth camera of a flying robot, at the middle of its body.
///
/// Its field of view must be wider than what lies between two looks: the robot looks around in steps, and
/// what is above and below must be seen from elsewhere.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Camera {
    /// Pixels side by side.
    #[schemars(range(min = 2, max = 8192))]
    pub columns: u32,
    /// Pixels above each other.
    #[schemars(range(min = 2, max = 8192))]
    pub rows: u32,
    /// Angle between the first and the last column, degrees.
    #[schemars(range(max = 170.0), extend("exclusiveMinimum" = 0.0))]
    pub fov_across_deg: f64,
    /// Angle between the first and the last row, degrees.
    #[schemars(range(max = 170.0), extend("exclusiveMinimum" = 0.0))]
    pub fov_down_deg: f64,
    /// Depth along the optical axis beyond which nothing is read, metres.
    #[schemars(range(min = 0.01))]
    pub far_m: f64,
    /// How far the camera looks down, degrees.
    #[schemars(range(min = -80.0, max = 80.0))]
    pub pitch_down_deg: f64,
    /// Standard deviation of a depth, metres; 0 is exact.
    #[schemars(range(min = 0.0))]
    pub sigma_m: f64,
    /// Standard deviation per squared depth, as of structured light, metres per square metre; a Kinect has
    /// about 0.0014.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub sigma_per_m2: f64,
}

impl Default for Camera {
    fn default() -> Self {
        Self {
            columns: 100,
            rows: 88,
            fov_across_deg: 100.0,
            fov_down_deg: 90.0,
            far_m: 8.0,
            pitch_down_deg: 0.0,
            sigma_m: 0.0,
            sigma_per_m2: 0.0,
        }
    }
}
