//! What can be chosen.

/// Parameters of place recognition; the defaults serve planar lasers on wheels, indoors.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PlaceParams {
    /// When a scan becomes a keyframe.
    pub keyframes: KeyframeParams,
    /// How far the wheels are believed.
    pub odometry: OdometryNoise,
    /// How scans are matched.
    pub matching: MatchParams,
    /// Which keyframes are tried.
    pub candidates: CandidateParams,
    /// Which matches are believed.
    pub rejection: RejectionParams,
}

/// A scan becomes a keyframe where the robot drove or turned so far since the last one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KeyframeParams {
    /// Distance, metres.
    pub distance_m: f64,
    /// Turn, radians.
    pub angle_rad: f64,
}

impl Default for KeyframeParams {
    fn default() -> Self {
        Self { distance_m: 0.4, angle_rad: 15.0_f64.to_radians() }
    }
}

/// Noise of what the wheels say; variances grow with what was driven and turned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OdometryNoise {
    /// Standard deviation along each axis, metres per square root of a metre.
    pub sigma_translation: f64,
    /// Standard deviation of the heading, radians per square root of a metre.
    pub sigma_rotation_rad: f64,
    /// Standard deviation of the heading, radians per square root of a radian turned.
    pub sigma_turn_rad: f64,
    /// Part of it that is there without motion, metres.
    pub least_m: f64,
    /// Part of it that is there without motion, radians.
    pub least_rad: f64,
}

impl Default for OdometryNoise {
    fn default() -> Self {
        Self {
            sigma_translation: 0.1,
            sigma_rotation_rad: 3.0_f64.to_radians(),
            sigma_turn_rad: 5.0_f64.to_radians(),
            least_m: 0.01,
            least_rad: 0.2_f64.to_radians(),
        }
    }
}

/// How scans are matched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MatchParams {
    /// Returns from farther away are left out, metres.
    pub range_m: f64,
    /// Returns nearer than this to the one kept before are left out, metres: near walls are seen by far
    /// more rays than it takes to match them.
    pub spacing_m: f64,
    /// Size of the cells of the table that scores are looked up in, metres.
    pub cell_m: f64,
    /// Angle between the headings that are tried, radians.
    pub angle_step_rad: f64,
    /// Points of the scan that the search scores, at most.
    pub scored_points: usize,
    /// A returned point and a surface nearer than this are one, metres.
    pub same_m: f64,
    /// Keyframes before the last that a new one is matched against too.
    pub recent: usize,
    /// Keyframes to either side of a known one that are matched against too.
    pub beside: usize,
    /// Keyframes farther than this from the one in the middle are left out, metres.
    pub local_m: f64,
    /// Standard deviation of a range, metres; the covariance is never better than it allows.
    pub range_sigma_m: f64,
    /// So many neighbouring points err together: as one, when covariances are told.
    pub correlated_points: f64,
}

impl Default for MatchParams {
    fn default() -> Self {
        Self {
            range_m: 20.0,
            spacing_m: 0.04,
            cell_m: 0.1,
            angle_step_rad: 1.0_f64.to_radians(),
            scored_points: 150,
            same_m: 0.15,
            recent: 6,
            beside: 4,
            local_m: 4.0,
            range_sigma_m: 0.02,
            correlated_points: 6.0,
        }
    }
}

/// Which keyframes are tried.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CandidateParams {
    /// Known keyframes that may lie within this of the current one are candidates, metres.
    pub radius_m: f64,
    /// How many standard deviations of the way between them "may" is.
    pub sigmas: f64,
    /// Keyframes between which less than this was driven are no candidates of each other, metres.
    pub loop_m: f64,
    /// Ways less certain than this are not followed, metres.
    pub sigma_limit_m: f64,
    /// The search looks no farther than this to either side of the prediction, metres.
    pub search_m: f64,
    /// Nor farther than this in heading, radians.
    pub search_rad: f64,
    /// Candidates tried for each keyframe, at most.
    pub tried: usize,
    /// A candidate whose window reaches farther to either side than this is tried only if it is the
    /// most promising one, metres.
    pub wide_m: f64,
}

impl Default for CandidateParams {
    fn default() -> Self {
        Self {
            radius_m: 3.0,
            sigmas: 2.5,
            loop_m: 10.0,
            sigma_limit_m: 5.0,
            search_m: 4.0,
            search_rad: 40.0_f64.to_radians(),
            tried: 2,
            wide_m: 1.5,
        }
    }
}

/// Which matches are believed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RejectionParams {
    /// Share of the current scan's returns that the known place explains, at least.
    pub overlap: f64,
    /// Share of the returns that the known place saw through, at most.
    pub contradiction: f64,
    /// Root of the mean square distance of what is explained, metres, at most.
    pub residual_m: f64,
    /// Another pose that scores more than this share of the best makes a match ambiguous.
    pub ambiguity: f64,
    /// Poses farther apart than this are others, metres.
    pub apart_m: f64,
    /// Poses turned by more than this are others, radians.
    pub apart_rad: f64,
    /// Standard deviation along the worst axis, metres, at most: along a corridor nothing is known.
    pub sigma_m: f64,
    /// Squared deviation from the prediction, in units of its covariance, at most.
    pub gate: f64,
    /// Where the prediction is less certain than this a match alone is not believed, metres.
    pub alone_m: f64,
    /// Nor where its heading is less certain than this, radians.
    pub alone_rad: f64,
    /// Matches that must agree before one that is not believed alone is, itself included.
    pub agreeing: usize,
    /// Keyframes after which a match that nothing agrees with is given up.
    pub patience: usize,
}

impl Default for RejectionParams {
    fn default() -> Self {
        Self {
            overlap: 0.5,
            contradiction: 0.15,
            residual_m: 0.07,
            ambiguity: 0.9,
            apart_m: 0.8,
            apart_rad: 15.0_f64.to_radians(),
            sigma_m: 0.1,
            gate: 16.3,
            alone_m: 0.35,
            alone_rad: 6.0_f64.to_radians(),
            agreeing: 3,
            patience: 20,
        }
    }
}
