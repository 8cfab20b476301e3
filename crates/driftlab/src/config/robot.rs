//! The robot: sensor, wheels, place recognition, body. Degrees are allowed here and end here.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The range sensor, at the centre of the body and looking ahead.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Sensor {
    /// Field of view, degrees; below 360 the outer rays lie on its two borders.
    #[schemars(range(max = 360.0), extend("exclusiveMinimum" = 0.0))]
    pub fov_deg: f64,
    /// Range beyond which a ray sees nothing, metres.
    #[schemars(range(min = 0.01))]
    pub range_m: f64,
    /// Number of rays.
    #[schemars(range(min = 3, max = 100_000))]
    pub rays: u32,
    /// Standard deviation of each range, metres; 0 is exact.
    #[schemars(range(min = 0.0))]
    pub range_sigma_m: f64,
}

impl Default for Sensor {
    fn default() -> Self {
        Self { fov_deg: 115.0, range_m: 5.0, rays: 16, range_sigma_m: 0.0 }
    }
}

/// The noise of the wheels; it acts on the true pose and grows with the square root of the
/// distance (\[ISRR19\] 6.1).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Odometry {
    /// Standard deviation after one metre, each axis; m/√m.
    #[schemars(range(min = 0.0, max = 100.0))]
    pub sigma_translation: f64,
    /// Standard deviation of the heading after one metre; degrees/√m.
    #[schemars(range(min = 0.0, max = 360.0))]
    pub sigma_rotation: f64,
    /// Factor on both: the paper's α.
    #[schemars(range(min = 0.0, max = 1000.0))]
    pub scale: f64,
    /// Mean error along the heading, metres per metre; scaled as well.
    #[schemars(range(min = -100.0, max = 100.0))]
    pub bias_translation: f64,
    /// Mean error of the heading, degrees per metre, to the left; scaled as well.
    #[schemars(range(min = -360.0, max = 360.0))]
    pub bias_rotation: f64,
}

impl Default for Odometry {
    fn default() -> Self {
        Self {
            sigma_translation: 0.1,
            sigma_rotation: 5.0,
            scale: 1.0,
            bias_translation: 0.0,
            bias_rotation: 0.0,
        }
    }
}

/// Place recognition: the robot sees that it has been here.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Places {
    /// Whether there is any.
    pub enabled: bool,
    /// A known pose that is truly nearer than this and in line of sight is recognised; metres.
    #[schemars(range(min = 0.0))]
    pub radius_m: f64,
    /// A known pose within this many radii along the graph is no news and is not matched.
    #[schemars(range(min = 0.0, max = 1e6))]
    pub exclude_factor: f64,
    /// Share of the places that are recognised.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub recall: f64,
    /// Chance that a pose is matched with a wrong place.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub false_positive_rate: f64,
    /// Standard deviation of a match's relative position, each axis, metres; 0 is exact.
    #[schemars(range(min = 0.0))]
    pub sigma_translation_m: f64,
    /// Standard deviation of a match's relative heading, degrees; 0 is exact.
    #[schemars(range(min = 0.0))]
    pub sigma_rotation_deg: f64,
    /// At most so many matches per pose, the nearest first; 0 is all, as in the paper.
    pub max_matches: u32,
}

impl Default for Places {
    fn default() -> Self {
        Self {
            enabled: true,
            radius_m: 5.0,
            exclude_factor: 1.5,
            recall: 1.0,
            false_positive_rate: 0.0,
            sigma_translation_m: 0.0,
            sigma_rotation_deg: 0.0,
            max_matches: 0,
        }
    }
}

/// The body, and how well it repeats a taught leg.
///
/// A taught leg is not driven through but jumped, and its length is charged (\[Zie18\] 3.1).
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Robot {
    /// Radius of the body, metres; 0 is a point.
    #[schemars(range(min = 0.0))]
    pub radius_m: f64,
    /// Standard deviation of the position after a repeated leg, each axis, metres; 0 is exact.
    #[schemars(range(min = 0.0))]
    pub repeat_sigma_m: f64,
    /// Standard deviation of the heading after a repeated leg, degrees; 0 is exact.
    #[schemars(range(min = 0.0))]
    pub repeat_sigma_deg: f64,
    /// Localisation puts the robot onto a known pose nearer than this, metres (\[Zie18\] 3.1); 0 is
    /// never.
    #[schemars(range(min = 0.0))]
    pub snap_radius_m: f64,
}
