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
    /// Ours: looks around before it moves, since turning costs no distance, then goes where it is
    /// nearest.
    Survey(SurveyPlanner),
}

impl Default for Planner {
    fn default() -> Self {
        Self::Rapid(RapidPlanner::default())
    }
}

/// Both policies have the same parameters and their own defaults: two tables without `flatten`,
/// which would spoil the messages.
macro_rules! policy_table {
    ($(#[$doc:meta])* $name:ident, $defaults:expr) => {
        $(#[$doc])*
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
        #[serde(deny_unknown_fields, default)]
        pub struct $name {
            /// Longest straight move before the next scan, metres.
            #[schemars(range(min = 0.001))]
            pub step_m: f64,
            /// Distances to keep between the body and obstacles, metres, tried in this order: a
            /// fixed one traps the robot.
            #[schemars(length(min = 1), inner(range(min = 0.0)))]
            pub clearances_m: Vec<f64>,
            /// A turn smaller than this is made without a scan of its own, degrees.
            #[schemars(range(min = 0.0, max = 180.0))]
            pub turn_tolerance_deg: f64,
            /// How far before a frontier that its own place cannot reach the robot tries to stand,
            /// metres, in this order (\[Zie18\] 2.9.3, the "normal point").
            #[schemars(inner(range(min = 0.0)))]
            pub normal_point_m: Vec<f64>,
            /// How near a goal counts as reached, metres.
            #[schemars(extend("exclusiveMinimum" = 0.0))]
            pub arrival_m: f64,
            /// Radius around a goal within which frontier is given up, metres.
            #[schemars(extend("exclusiveMinimum" = 0.0))]
            pub give_up_radius_m: f64,
            /// How often the robot is sent to a place whose frontier does not get less, before it
            /// gives the frontier there up.
            #[schemars(range(min = 1))]
            pub visits_in_vain: u32,
            /// Scans at one place before the robot moves on, whatever it sees.
            #[schemars(range(min = 1))]
            pub turns_at_a_place: u32,
            /// Look into every direction that may show something before moving; the paper does not.
            pub look_first: bool,
            /// The robot jumps along the graph and scans only at the end of a way; the distance is
            /// charged in full (\[Zie18\] 3.1).
            pub teleport: bool,
        }

        impl Default for $name {
            fn default() -> Self {
                Self::from($defaults)
            }
        }

        impl From<RapidParams> for $name {
            fn from(params: RapidParams) -> Self {
                let tolerance_deg = params.turn_tolerance_rad.to_degrees();
                Self {
                    step_m: params.step_m,
                    clearances_m: params.clearances_m,
                    // A whole number of degrees must not be written with rounding in it.
                    turn_tolerance_deg: (tolerance_deg * 1e9).round() / 1e9,
                    normal_point_m: params.normal_point_m,
                    arrival_m: params.arrival_m,
                    give_up_radius_m: params.give_up_radius_m,
                    visits_in_vain: params.visits_in_vain,
                    turns_at_a_place: params.turns_at_a_place,
                    look_first: params.look_first,
                    teleport: params.teleport,
                }
            }
        }

        impl From<&$name> for RapidParams {
            fn from(planner: &$name) -> Self {
                Self {
                    step_m: planner.step_m,
                    clearances_m: planner.clearances_m.clone(),
                    body_radius_m: 0.0,
                    turn_tolerance_rad: planner.turn_tolerance_deg.to_radians(),
                    normal_point_m: planner.normal_point_m.clone(),
                    arrival_m: planner.arrival_m,
                    give_up_radius_m: planner.give_up_radius_m,
                    visits_in_vain: planner.visits_in_vain,
                    turns_at_a_place: planner.turns_at_a_place,
                    look_first: planner.look_first,
                    teleport: planner.teleport,
                }
            }
        }
    };
}

policy_table!(
    /// Parameters of `[planner.rapid]`.
    RapidPlanner,
    RapidParams::default()
);

policy_table!(
    /// Parameters of `[planner.survey]`.
    SurveyPlanner,
    RapidParams { look_first: true, ..RapidParams::default() }
);
