//! How the robot chooses where to go: one table under `[planner]`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Which policy drives.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Planner {
    /// The paper's: the frontier in view that changes the heading least, else the nearest vertex
    /// with frontier left ([ISRR19] 5).
    Rapid(RapidPlanner),
    /// Ours: a full look around where it pays, then the nearest frontier.
    Survey(SurveyPlanner),
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
    /// Length of a forward move, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub step_m: f64,
    /// Distance kept from obstacles, metres.
    #[schemars(range(min = 0.0))]
    pub clearance_m: f64,
    /// Distance kept on the last try, where the first would trap the robot; metres.
    #[schemars(range(min = 0.0))]
    pub last_clearance_m: f64,
}

impl Default for RapidPlanner {
    fn default() -> Self {
        Self { step_m: 1.0, clearance_m: 0.3, last_clearance_m: 0.03 }
    }
}

/// Parameters of `[planner.survey]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SurveyPlanner {
    /// Length of a forward move, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub step_m: f64,
    /// Distance kept from obstacles, metres.
    #[schemars(range(min = 0.0))]
    pub clearance_m: f64,
    /// Distance kept on the last try, where the first would trap the robot; metres.
    #[schemars(range(min = 0.0))]
    pub last_clearance_m: f64,
}

impl Default for SurveyPlanner {
    fn default() -> Self {
        Self { step_m: 1.0, clearance_m: 0.3, last_clearance_m: 0.03 }
    }
}
