//! What truth records of a run.

use geometry::Point2;
use pose::Se2;

/// Sums over everything that a robot did.
#[derive(Clone, Debug, PartialEq)]
pub struct Tally {
    /// Distance driven, metres: commanded forward motions and repeated legs.
    pub distance_m: f64,
    /// Sum of the absolute turning angles, radians.
    pub turning_rad: f64,
    /// Forward motions commanded.
    pub forwards: u64,
    /// Scans taken.
    pub scans: u64,
    /// Place matches reported, right or wrong.
    pub place_edges: u64,
    /// Commanded motions that would have touched an obstacle without any noise.
    pub collisions: u64,
    /// Motions whose noise pushed the robot against an obstacle.
    pub bumps: u64,
    /// Least distance from the robot's centre to an obstacle over its whole true path, metres.
    pub min_clearance_m: f64,
}

/// What a scan truly saw, without range noise, in the world frame.
#[derive(Clone, Debug, PartialEq)]
pub struct View {
    /// Pose of the sensor.
    pub world_from_sensor: Se2,
    /// End of each ray in the world frame: the hit, or the point at full range.
    pub ends_in_world: Vec<Point2>,
    /// Whether each ray hit something.
    pub hit: Vec<bool>,
    /// Angle from each ray to the next, radians.
    pub bearing_step_rad: f64,
    /// Whether the last ray is one step before the first.
    pub full_circle: bool,
}
