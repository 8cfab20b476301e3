//! What a simulated robot is made of. The defaults are those of \[ISRR19\] sec. 6 at α = 1.

/// All parameters of a simulated robot.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RobotParams {
    /// The range sensor.
    pub sensor: SensorParams,
    /// The drift of the wheels.
    pub odometry: OdometryParams,
    /// Place recognition.
    pub places: PlaceParams,
    /// The body, and driving along known legs.
    pub drive: DriveParams,
}

/// A planar range sensor at the body's origin, looking along its x axis.
#[derive(Clone, Debug, PartialEq)]
pub struct SensorParams {
    /// Field of view, radians. Below a full turn both borders carry a ray; from a full turn on the
    /// rays are spaced evenly around the circle, the first looking backwards.
    pub fov_rad: f64,
    /// Range beyond which the sensor sees nothing, metres.
    pub range_m: f64,
    /// Number of rays; a single ray looks ahead.
    pub rays: usize,
    /// Standard deviation of a measured range, metres. Off in \[ISRR19\].
    pub range_sigma_m: f64,
}

impl Default for SensorParams {
    fn default() -> Self {
        Self { fov_rad: 115f64.to_radians(), range_m: 5.0, rays: 16, range_sigma_m: 0.0 }
    }
}

impl SensorParams {
    /// Bearing of the first ray and the angle from each ray to the next, radians.
    pub fn bearings_rad(&self) -> (f64, f64) {
        let turn = std::f64::consts::TAU;
        if self.rays <= 1 {
            (0.0, 0.5 * turn)
        } else if self.fov_rad >= turn - 1e-9 {
            (-0.5 * turn, turn / self.rays as f64)
        } else {
            (-0.5 * self.fov_rad, self.fov_rad / (self.rays - 1) as f64)
        }
    }
}

/// How the true motion differs from the commanded one, which is what odometry reports.
///
/// A forward motion of d metres ends in a pose error with mean `scale · bias · d` and variance
/// `scale² · sigma² · d` per component, in the body's frame (\[ISRR19\] 6.1). Turns are exact.
#[derive(Clone, Debug, PartialEq)]
pub struct OdometryParams {
    /// Standard deviation along each axis, metres per square root of a metre.
    pub sigma_translation: f64,
    /// Standard deviation of the heading, radians per square root of a metre.
    pub sigma_rotation_rad: f64,
    /// Multiplies every error; the α of \[ISRR19\].
    pub scale: f64,
    /// Mean error along the heading, metres per metre. Off in \[ISRR19\].
    pub bias_translation: f64,
    /// Mean error of the heading, radians per metre. Off in \[ISRR19\].
    pub bias_rotation_rad: f64,
}

impl Default for OdometryParams {
    fn default() -> Self {
        Self {
            sigma_translation: 0.1,
            sigma_rotation_rad: 5f64.to_radians(),
            scale: 1.0,
            bias_translation: 0.0,
            bias_rotation_rad: 0.0,
        }
    }
}

/// When the robot recognises a place, and what it is told of it.
#[derive(Clone, Debug, PartialEq)]
pub struct PlaceParams {
    /// Whether places are recognised at all.
    pub enabled: bool,
    /// True distance below which a place can be recognised, metres; d_pr in \[ISRR19\].
    pub radius_m: f64,
    /// A place nearer than this many radii along the robot's own pose graph is no news and is not
    /// reported.
    pub exclude_factor: f64,
    /// Probability that a place which can be recognised is.
    pub recall: f64,
    /// Probability per call that a wrong place is reported as well.
    pub false_positive_rate: f64,
    /// Standard deviation of the reported relative position, metres, each axis.
    pub sigma_translation_m: f64,
    /// Standard deviation of the reported relative heading, radians.
    pub sigma_rotation_rad: f64,
    /// At most so many true places per call, the nearest first; `None` reports all, as \[ISRR19\].
    pub max_matches: Option<usize>,
}

impl Default for PlaceParams {
    fn default() -> Self {
        Self {
            enabled: true,
            radius_m: 5.0,
            exclude_factor: 1.5,
            recall: 1.0,
            false_positive_rate: 0.0,
            sigma_translation_m: 0.0,
            sigma_rotation_rad: 0.0,
            max_matches: None,
        }
    }
}

/// The robot's body, and how well it drives along known legs. All off in \[ISRR19\].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DriveParams {
    /// Radius of the disc that must not touch an obstacle, metres; 0 is a point.
    pub robot_radius_m: f64,
    /// Standard deviation of the position at the end of teach and repeat, metres, each axis.
    pub repeat_sigma_m: f64,
    /// Standard deviation of the heading at the end of teach and repeat, radians.
    pub repeat_sigma_rotation_rad: f64,
    /// After a forward motion, a robot this near to a known vertex in line of sight is put onto it
    /// (\[Zie18\] 3.1), metres; `None` never does.
    pub snap_radius_m: Option<f64>,
}
