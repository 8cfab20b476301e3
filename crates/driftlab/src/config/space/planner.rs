//! How a flying robot chooses where to go, and how its belief is judged.

use explore::{FlightParams, Ways};
use metrics::VoxelParams;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How a flying robot chooses where to go.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Planner3d {
    /// Distances to keep between the body and surfaces, metres, tried in this order: a fixed one traps the
    /// robot.
    #[schemars(length(min = 1), inner(range(min = 0.0)))]
    pub margins_m: Vec<f64>,
    /// What was not seen does not count so near to the start of a flight, metres: the body is there already.
    #[schemars(range(min = 0.0))]
    pub leaving_m: f64,
    /// Longest flight between two looks, metres.
    #[schemars(range(min = 0.01))]
    pub hop_m: f64,
    /// Looks at one place before the robot moves on, whatever turning may show.
    #[schemars(range(min = 1, max = 1000))]
    pub looks_at_a_place: u32,
    /// Least area of frontier that is worth turning to, square metres.
    #[schemars(range(min = 0.0, max = 1e6))]
    pub turn_gain_m2: f64,
    /// Depth up to which a frontier counts as in view of a place, as a share of `camera.far_m`.
    #[schemars(range(max = 1.0), extend("exclusiveMinimum" = 0.0))]
    pub view_share: f64,
    /// Places that a frontier is looked at from before it is given up.
    #[schemars(range(min = 1, max = 1000))]
    pub tries: u32,
    /// How near two places are the same one, metres: frontier is given up within it.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub same_place_m: f64,
    /// How far along the graph other places are sought from which to look at a frontier, metres.
    #[schemars(range(min = 0.0))]
    pub around_m: f64,
    /// How often the robot is sent to a vertex whose frontier does not get less, before it is given up.
    #[schemars(range(min = 1))]
    pub visits_in_vain: u32,
    /// How the robot gets to somewhere that is not straight from where it hovers, where its map knows ways through the
    /// views between.
    pub ways: Ways3d,
}

/// How a flying robot gets to somewhere that is not straight from where it hovers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Ways3d {
    /// By teach and repeat along the graph; nothing else is planned.
    Repeat,
    /// By teach and repeat along the graph; the way through the views between is planned, told and counted.
    #[default]
    Told,
    /// By the way through the views where it is clearly shorter and each leg of it may be flown.
    Planned,
}

impl From<Ways3d> for Ways {
    fn from(ways: Ways3d) -> Self {
        match ways {
            Ways3d::Repeat => Self::Repeat,
            Ways3d::Told => Self::Told,
            Ways3d::Planned => Self::Planned,
        }
    }
}

impl Default for Planner3d {
    fn default() -> Self {
        let good = FlightParams::default();
        Self {
            margins_m: good.margins_m,
            leaving_m: good.leaving_m,
            hop_m: good.hop_m,
            looks_at_a_place: good.looks_at_a_place,
            turn_gain_m2: good.turn_gain_m2,
            view_share: good.view_share,
            tries: good.tries as u32,
            same_place_m: good.same_place_m,
            around_m: good.around_m,
            visits_in_vain: good.visits_in_vain,
            ways: Ways3d::default(),
        }
    }
}

/// How a belief about space is judged against the truth.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Metrics3d {
    /// Side of the voxels that coverage is counted in, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub cell_m: f64,
    /// Share of the voxels from which on the place counts as seen: whether one in a nook is seen through a
    /// gap between two pixels is nobody's fault.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub complete_share: f64,
}

impl Default for Metrics3d {
    fn default() -> Self {
        let VoxelParams { cell_m, complete_share } = VoxelParams::default();
        Self { cell_m, complete_share }
    }
}
