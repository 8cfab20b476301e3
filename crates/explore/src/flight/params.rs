//! What can be chosen about the exploration of space.

use super::Ways;

/// Parameters of a run of [`FlightExplorer`](super::FlightExplorer).
#[derive(Clone, Debug, PartialEq)]
pub struct FlightParams {
    /// Radius of the body, metres.
    pub body_radius_m: f64,
    /// What to keep from surfaces beside the radius, metres, tried in this order: a fixed distance traps the
    /// robot.
    pub margins_m: Vec<f64>,
    /// What was not seen does not count so near to the start of a flight, metres: the body is there already.
    pub leaving_m: f64,
    /// Longest flight between two looks, metres.
    pub hop_m: f64,
    /// Looks at one place before the robot moves on, whatever turning may show.
    pub looks_at_a_place: u32,
    /// Least area of frontier that is worth turning to, square metres.
    pub turn_gain_m2: f64,
    /// Depth up to which a frontier counts as in view of a place, as a share of the farthest that was read.
    pub view_share: f64,
    /// Places that a frontier is looked at from before it is given up.
    pub tries: usize,
    /// How near two places are the same one, metres: frontier is given up within it, and not looked at from
    /// the same place twice.
    pub same_place_m: f64,
    /// How far along the graph other places are sought from which to look at frontier that cannot be seen
    /// from what its own vertex sees, metres.
    pub around_m: f64,
    /// How often the robot is sent to a vertex whose frontier does not get less, before it is given up.
    pub visits_in_vain: u32,
    /// How the robot gets to somewhere that is not straight from where it hovers.
    pub ways: Ways,
    /// A run that takes more steps than this ends as not complete.
    pub max_steps: u64,
}

impl Default for FlightParams {
    fn default() -> Self {
        Self {
            body_radius_m: 0.2,
            margins_m: vec![0.15, 0.08, 0.03],
            leaving_m: 0.5,
            hop_m: 3.0,
            looks_at_a_place: 6,
            turn_gain_m2: 0.1,
            view_share: 0.75,
            tries: 4,
            same_place_m: 0.4,
            around_m: 5.0,
            visits_in_vain: 5,
            ways: Ways::default(),
            max_steps: 20_000,
        }
    }
}
