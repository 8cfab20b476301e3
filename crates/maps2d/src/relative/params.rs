//! What can be chosen about the relative map.

use crate::volume::VolumeParams;

/// Parameters of the relative map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RelativeParams {
    /// How scans become volumes.
    pub volume: VolumeParams,
    /// Radius of the consolidation scope along the graph, metres (R in \[ISRR19\] 4.3, where its value
    /// is not printed; the figures give 10 m).
    pub consolidation_radius_m: f64,
    /// As how many metres a metre along a place edge counts in the length of a path, above 0.
    ///
    /// Place edges do not drift, so below 1 placement goes where the covariance along the way is
    /// less, as far as it grows with the odometry on it; lever arms are left out. 1 is \[ISRR19\] 4.3,
    /// which takes lengths. Below it the scope reaches farther: at 0.2 two of eight runs of the
    /// paper's `open` at full drift ended too early, and no weight clearly shortened the runs.
    pub place_weight: f64,
    /// Frontier nearer than this to an obstacle edge of another volume in scope is closed as wall,
    /// metres: drift leaves bits along walls that no volume ever covers. Openings narrower than
    /// twice this may be missed.
    pub wall_closing_m: f64,
    /// Frontier that hangs together over less than this does not count, metres.
    pub sliver_m: f64,
    /// How sure placement has to be before frontier counts as inside another volume.
    pub certainty: Certainty,
    /// The `sigmas` of the last look, which the map offers once, when no frontier counts any more: what
    /// was closed and is less sure than that opens again. No more than those of `certainty`, or no noise
    /// there: no last look. Fewer than those of `certainty`: pairs are compared along longer ways too, which
    /// certainty then judges.
    pub last_look_sigmas: f64,
    /// Whether volumes that add nothing are taken out of later comparisons.
    pub retire: bool,
    /// A volume without frontier of its own that counts is taken out after it was of no use to so
    /// many others that came into its scope.
    pub idle_scans: u32,
}

/// Frontier counts as inside another volume only if it stays inside when their relative pose is
/// wrong by so many standard deviations of the odometry between them, in either direction of each
/// axis and of the rotation.
///
/// Without it volumes whose frontiers nearly coincide can close each other's in a circle, each
/// placed a little wrong, and nobody is left to look. Not in \[ISRR19\], which trusts placement
/// inside the scope; 0 standard deviations, the default, is that.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Certainty {
    /// How many standard deviations.
    pub sigmas: f64,
    /// Standard deviation of the odometry along each axis, metres per square root of a metre.
    pub sigma_translation: f64,
    /// Standard deviation of the odometry's heading, radians per square root of a metre.
    pub sigma_rotation_rad: f64,
}

impl Default for RelativeParams {
    fn default() -> Self {
        Self {
            volume: VolumeParams::default(),
            consolidation_radius_m: 10.0,
            place_weight: 1.0,
            wall_closing_m: 0.3,
            sliver_m: 0.4,
            certainty: Certainty::default(),
            last_look_sigmas: 1.0,
            retire: true,
            idle_scans: 40,
        }
    }
}
