//! How the robot chooses where to go: one table under `[planner]`.

use explore::RapidParams;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Which policy drives.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Planner {
    /// The paper's: the frontier in view that changes the heading least, else the nearest vertex
    /// with frontier left (\[ISRR19\] 5, \[Zie18\] 2.9).
    Rapid(RapidPlanner),
}

impl Default for Planner {
    fn default() -> Self {
        Self::Rapid(RapidPlanner::default())
    }
}

/// Parameters of `[planner.rapid]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct RapidPlanner {
    /// Longest straight move before the next scan, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub step_m: f64,
    /// Distances to keep from obstacles, metres, tried in this order: a fixed one traps the robot.
    #[schemars(length(min = 1), inner(range(min = 0.0)))]
    pub clearances_m: Vec<f64>,
    /// A turn smaller than this is made without a scan of its own, degrees.
    #[schemars(range(min = 0.0, max = 180.0))]
    pub turn_tolerance_deg: f64,
    /// How far before a frontier that its own place cannot reach the robot tries to stand, metres,
    /// in this order (\[Zie18\] 2.9.3, the "normal point").
    #[schemars(inner(range(min = 0.0)))]
    pub normal_point_m: Vec<f64>,
    /// How near a goal counts as reached, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub arrival_m: f64,
    /// Radius around a goal within which frontier is given up, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub give_up_radius_m: f64,
    /// How often the robot is sent to a place whose frontier does not get less, before it gives the
    /// frontier there up.
    #[schemars(range(min = 1))]
    pub visits_in_vain: u32,
    /// Scans at one place before the robot moves on, whatever it sees.
    #[schemars(range(min = 1))]
    pub turns_at_a_place: u32,
    /// The robot jumps along the graph and scans only at the end of a way; the distance is charged
    /// in full (\[Zie18\] 3.1).
    pub teleport: bool,
}

impl Default for RapidPlanner {
    fn default() -> Self {
        let good = RapidParams::default();
        Self {
            step_m: good.step_m,
            clearances_m: good.clearances_m,
            turn_tolerance_deg: 1.0,
            normal_point_m: good.normal_point_m,
            arrival_m: good.arrival_m,
            give_up_radius_m: good.give_up_radius_m,
            visits_in_vain: good.visits_in_vain,
            turns_at_a_place: good.turns_at_a_place,
            teleport: good.teleport,
        }
    }
}
