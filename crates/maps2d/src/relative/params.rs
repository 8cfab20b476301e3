//! What can be chosen about the relative map.

use crate::volume::VolumeParams;

/// Parameters of the relative map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RelativeParams {
    /// How scans become volumes.
    pub volume: VolumeParams,
    /// Radius of the consolidation scope along the graph, metres (R in [ISRR19] 4.3, where its value
    /// is not printed; the figures give 10 m).
    pub consolidation_radius_m: f64,
    /// Frontier nearer than this to an obstacle edge of another volume in scope is closed as wall,
    /// metres: drift leaves bits along walls that no volume ever covers. Openings narrower than
    /// twice this may be missed.
    pub wall_closing_m: f64,
    /// Frontier that hangs together over less than this does not count, metres.
    pub sliver_m: f64,
    /// Whether volumes that add nothing are taken out of later comparisons.
    pub retire: bool,
}

impl Default for RelativeParams {
    fn default() -> Self {
        Self {
            volume: VolumeParams::default(),
            consolidation_radius_m: 10.0,
            wall_closing_m: 0.3,
            sliver_m: 0.4,
            retire: true,
        }
    }
}
