//! What can be chosen about the exploration.

/// Parameters of the rapid policy (\[ISRR19\] 5, \[Zie18\] 2.9).
#[derive(Clone, Debug, PartialEq)]
pub struct RapidParams {
    /// Longest straight move before the next scan, metres.
    pub step_m: f64,
    /// Distances to keep between the middle of the body and obstacles, metres, tried in this order: a
    /// fixed one traps the robot.
    pub clearances_m: Vec<f64>,
    /// Radius of the body, metres, no more than those distances. A body that stands too near to
    /// something has to leave by its hull: a hundredth of the distance of its middle would be inside.
    pub body_radius_m: f64,
    /// A turn smaller than this is made without a scan of its own, radians.
    pub turn_tolerance_rad: f64,
    /// How far before the frontier the "normal point" lies, metres (\[Zie18\] 2.9.3).
    pub normal_point_m: Vec<f64>,
    /// How near a goal counts as reached, metres.
    pub arrival_m: f64,
    /// Radius around a goal within which frontier is given up, metres.
    pub give_up_radius_m: f64,
    /// How often the robot is sent to a vertex whose frontier does not get less, before it gives the
    /// frontier there up.
    pub visits_in_vain: u32,
    /// Scans at one place before the robot moves on, whatever it sees.
    pub turns_at_a_place: u32,
    /// Whether the robot looks into every direction that may show something before it moves, since
    /// turning costs no distance. The paper's policy does not.
    pub look_first: bool,
    /// Whether the robot jumps along the graph and scans only at the end of a way; the distance is
    /// charged in full (\[Zie18\] 3.1).
    pub teleport: bool,
}

impl Default for RapidParams {
    fn default() -> Self {
        Self {
            step_m: 1.0,
            clearances_m: vec![0.3, 0.1, 0.03],
            body_radius_m: 0.0,
            turn_tolerance_rad: 1.0_f64.to_radians(),
            normal_point_m: vec![1.0, 0.5],
            arrival_m: 0.05,
            give_up_radius_m: 0.5,
            visits_in_vain: 2,
            turns_at_a_place: 6,
            look_first: false,
            teleport: false,
        }
    }
}

/// Which policy steers.
#[derive(Clone, Debug, PartialEq)]
pub enum Policy {
    /// The policy of the paper: least change of heading, else the nearest vertex with frontier.
    Rapid(RapidParams),
    /// Our own: looks around before it moves, then goes where it is nearest.
    Survey(RapidParams),
}

impl Policy {
    /// The parameters that every policy shares.
    pub fn rapid(&self) -> &RapidParams {
        match self {
            Policy::Rapid(params) | Policy::Survey(params) => params,
        }
    }
}

/// Parameters of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct ExploreParams {
    /// Which policy steers.
    pub policy: Policy,
    /// A run that takes more steps than this ends as not complete.
    pub max_steps: u64,
}

impl Default for ExploreParams {
    fn default() -> Self {
        Self { policy: Policy::Rapid(RapidParams::default()), max_steps: 20_000 }
    }
}
