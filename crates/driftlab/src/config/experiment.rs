//! The whole config of one experiment.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{
    Camera, Compare, Maps, Maps3d, Metrics, Metrics3d, Odometry, Places, Planner, Planner3d,
    Record, Replay, Replay3d, Robot, RunSweep, Sensor, World, World3d,
};

/// One experiment: a place, a robot in it, and the maps that it builds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Config {
    /// Version of this file's layout; this driftlab reads 1.
    #[schemars(range(min = 1, max = 1))]
    pub schema: u32,
    /// Name of the experiment and of its folder under recordings/: letters, digits, `.`, `_`, `-`.
    /// Left out, it is the name of the file.
    #[schemars(regex(pattern = r"^[A-Za-z0-9_][A-Za-z0-9._-]*$"))]
    pub name: String,
    /// Seed of every random stream; the same config, seed and program give the same numbers.
    #[schemars(extend("maximum" = i64::MAX))]
    pub seed: u64,
    /// A run that has not ended after so many steps is stopped as "not complete".
    #[schemars(range(min = 1))]
    pub max_steps: u32,
    /// Moves the start by up to this much along each axis, drawn evenly from the seed; metres.
    #[schemars(range(min = 0.0))]
    pub start_jitter_m: f64,
    /// Where the robot starts; left out, the world's own start, or its most open place.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub start: Option<Start>,
    /// The place: exactly one table, whose key says what kind of place it is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub world: Option<World>,
    /// The place of space, in place of `world`: exactly one table, whose key says what kind it is. The
    /// robot flies, and the tables that end in `3d` take the places of those of the plane.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub world3d: Option<World3d>,
    /// The range sensor.
    pub sensor: Sensor,
    /// The depth camera of a robot that flies.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub camera: Option<Camera>,
    /// The noise of the wheels.
    pub odometry: Odometry,
    /// Place recognition.
    pub places: Places,
    /// The body, and how well it repeats a taught leg.
    pub robot: Robot,
    /// The maps that are built: at least one table.
    pub map: Maps,
    /// The maps of space that are built: at least one table.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub map3d: Option<Maps3d>,
    /// How the robot chooses where to go: exactly one table.
    pub planner: Planner,
    /// How a robot that flies chooses where to go.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub planner3d: Option<Planner3d>,
    /// How several maps share the experiment.
    pub compare: Compare,
    /// How the belief is judged against the truth.
    pub metrics: Metrics,
    /// How a belief about space is judged against the truth.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub metrics3d: Option<Metrics3d>,
    /// What the recording holds.
    pub record: Record,
    /// How `driftlab replay` takes a log; nobody else asks. A config with this table needs no world.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub replay: Option<Replay>,
    /// How `driftlab replay` takes depth images; nobody else asks. A config with this table needs no world.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub replay3d: Option<Replay3d>,
    /// What `driftlab sweep` varies; nobody else asks.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sweep: Option<RunSweep>,
}

impl Default for Config {
    fn default() -> Self {
        Self {
            schema: 1,
            name: "run".into(),
            seed: 1,
            max_steps: 20_000,
            start_jitter_m: 0.0,
            start: None,
            world: None,
            world3d: None,
            sensor: Sensor::default(),
            camera: None,
            odometry: Odometry::default(),
            places: Places::default(),
            robot: Robot::default(),
            map: Maps::default(),
            map3d: None,
            planner: Planner::default(),
            planner3d: None,
            compare: Compare::default(),
            metrics: Metrics::default(),
            metrics3d: None,
            record: Record::default(),
            replay: None,
            replay3d: None,
            sweep: None,
        }
    }
}

impl Config {
    /// Whether the robot flies: the tables of space count, those of the plane do not.
    pub fn is_of_space(&self) -> bool {
        self.world3d.is_some() || self.map3d.is_some()
    }

    /// The keys of the maps that are built, in the order in which they run.
    pub fn map_keys(&self) -> Vec<&'static str> {
        match &self.map3d {
            Some(maps) if self.is_of_space() => maps.keys(),
            _ => self.map.keys(),
        }
    }
}

/// Where the robot starts, in the world frame.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Start {
    /// East of the world's origin, metres.
    pub x_m: f64,
    /// North of the world's origin, metres.
    pub y_m: f64,
    /// Above the world's origin, metres; for a robot that flies.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub z_m: Option<f64>,
    /// Heading, degrees counter-clockwise from east.
    pub heading_deg: f64,
}
