//! What place recognition tells while it works.

use pose::Se2;
use pose::nalgebra::Matrix3;

use crate::matching::{Agreement, Found};
use crate::{Candidate, Closure, Measured, SurfacePoint, Verdict};

/// Points before and after a match.
#[derive(Clone, Copy, Debug)]
pub struct Matched<'a> {
    /// The known keyframe in whose frame everything is.
    pub known: usize,
    /// The current keyframe.
    pub current: usize,
    /// What is known there.
    pub known_points: &'a [SurfacePoint],
    /// What was matched, in the frame of the current keyframe.
    pub current_points: &'a [SurfacePoint],
    /// Where the current keyframe was expected.
    pub before: Se2,
    /// Where the match has it.
    pub after: Se2,
    /// Covariance of that, in the current keyframe's frame.
    pub covariance: Matrix3<f64>,
    /// Root of the mean square distance of points to their surfaces, metres.
    pub residual_m: f64,
    /// What was explained, and what contradicted.
    pub agreement: Agreement,
    /// The best of the search, where there was one.
    pub found: Option<Found>,
    /// What came of it.
    pub verdict: Verdict,
}

/// An event of place recognition; the numbers are the steps of the crate's page.
#[derive(Clone, Copy, Debug)]
pub enum PlaceEvent<'a> {
    /// A scan became a keyframe (1).
    KeyframeAdded {
        /// Its index.
        keyframe: usize,
        /// Its returns, in its own frame.
        surface: &'a [SurfacePoint],
        /// Distance driven up to it, metres.
        travelled_m: f64,
    },
    /// It was matched against those just before it (2).
    Tracked(Matched<'a>),
    /// Known keyframes that may be near were put in order (3).
    CandidatesRanked {
        /// The current keyframe.
        current: usize,
        /// What will be tried, the most promising first.
        candidates: &'a [Candidate],
    },
    /// One of them was matched (4) and judged (5).
    PlaceMatched(Matched<'a>),
    /// Matches that had waited agreed with each other, or one was sure enough alone (6).
    Closed {
        /// What is believed from now on.
        closures: &'a [Closure],
    },
    /// Nothing agreed with a match in time (6).
    GivenUp {
        /// The match.
        closure: &'a Measured,
    },
}

probe::variants!(PlaceEvent<'_>: KeyframeAdded, Tracked, CandidatesRanked, PlaceMatched, Closed, GivenUp);
