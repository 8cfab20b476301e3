//! One candidate: matched, and judged by what the match says.

use pose::Se2;
use pose::nalgebra::Matrix3;

use crate::links::worst_axis;
use crate::matching::{
    Agreement, Aligned, Apart, Found, Noise, Prior, Surfaces, Window, agreement, align, search,
};
use crate::place::{Place, thinned};
use crate::{Keyframe, PlaceParams, Seen, SurfacePoint};

/// What came of a match.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// It is believed.
    Believed,
    /// It may be right; others have to agree first.
    Waits,
    /// Too few points found a surface.
    NoFit,
    /// Another pose scores nearly as well.
    Ambiguous,
    /// Too little of the scan is explained.
    Overlap,
    /// Too much of the scan stands where the place is known to be free.
    Contradiction,
    /// What is explained lies too far from its surface.
    Residual,
    /// Along some direction nothing holds it: a corridor.
    Unbounded,
    /// It is too far from where the graph expects it.
    Unexpected,
}

impl Verdict {
    /// All verdicts, in order.
    pub const ALL: [Self; 9] = [
        Self::Believed,
        Self::Waits,
        Self::NoFit,
        Self::Ambiguous,
        Self::Overlap,
        Self::Contradiction,
        Self::Residual,
        Self::Unbounded,
        Self::Unexpected,
    ];

    /// A name for reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Believed => "believed",
            Self::Waits => "waits",
            Self::NoFit => "no_fit",
            Self::Ambiguous => "ambiguous",
            Self::Overlap => "overlap",
            Self::Contradiction => "contradiction",
            Self::Residual => "residual",
            Self::Unbounded => "unbounded",
            Self::Unexpected => "unexpected",
        }
    }
}

/// A match and what it is worth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Judged {
    pub known_from_current: Se2,
    pub covariance: Matrix3<f64>,
    pub residual_m: f64,
    pub agreement: Agreement,
    pub found: Option<Found>,
    pub verdict: Verdict,
}

/// What is matched: a known place against the current one.
pub(crate) struct Pair<'a> {
    pub keyframes: &'a [Keyframe],
    pub known: &'a Place,
    /// Returns of the current place, and of its middle alone.
    pub current: &'a [SurfacePoint],
    pub own: &'a [SurfacePoint],
}

impl Pair<'_> {
    /// Matches within a window around the prediction and judges the match by itself; a `prior` takes
    /// part in it.
    pub fn judge(
        &self,
        params: &PlaceParams,
        window: &Window,
        prior: Option<&Prior>,
        with_ambiguity: bool,
    ) -> Judged {
        let (matching, rejection) = (&params.matching, &params.rejection);
        let apart = Apart {
            metres: rejection.apart_m,
            radians: rejection.apart_rad,
            share: if with_ambiguity { rejection.ambiguity } else { 1.0 },
        };
        let mut judged = Judged {
            known_from_current: window.place_from_scan,
            covariance: Matrix3::identity() * 1e6,
            residual_m: 0.0,
            agreement: Agreement::default(),
            found: None,
            verdict: Verdict::NoFit,
        };
        let table = self.known.table(matching.cell_m);
        let scored: Vec<_> = thinned(self.current, matching.cell_m, matching.scored_points)
            .iter()
            .map(|point| point.point)
            .collect();
        let Some(found) = search(&table, &scored, window, &apart) else { return judged };
        judged.found = Some(found);
        judged.known_from_current = found.place_from_scan;
        if with_ambiguity && found.elsewhere > rejection.ambiguity * found.score {
            judged.verdict = Verdict::Ambiguous;
            return judged;
        }
        let surfaces = self.known.surfaces();
        let Some(aligned) = self.align(params, &surfaces, &found.place_from_scan, prior) else {
            return judged;
        };
        judged.known_from_current = aligned.place_from_scan;
        judged.covariance = aligned.covariance;
        judged.residual_m = aligned.residual_m;
        judged.agreement = agreement(
            &surfaces,
            &self.known.keyframes(self.keyframes),
            self.own,
            &aligned.place_from_scan,
            matching.same_m,
        );
        judged.verdict = if judged.agreement.overlap < rejection.overlap {
            Verdict::Overlap
        } else if judged.agreement.contradiction > rejection.contradiction {
            Verdict::Contradiction
        } else if judged.residual_m > rejection.residual_m {
            Verdict::Residual
        } else if worst_axis(&judged.covariance) > rejection.sigma_m {
            Verdict::Unbounded
        } else {
            Verdict::Waits
        };
        judged
    }

    fn align(
        &self,
        params: &PlaceParams,
        surfaces: &Surfaces,
        start: &Se2,
        prior: Option<&Prior>,
    ) -> Option<Aligned> {
        let noise = Noise {
            range_sigma_m: params.matching.range_sigma_m,
            correlated_points: params.matching.correlated_points,
        };
        align(surfaces, self.current, start, prior, &noise)
    }
}

/// The window of a candidate: around where the graph has it, as wide as the graph is uncertain.
pub(crate) fn window_of(params: &PlaceParams, seen: &Seen) -> Window {
    let candidates = &params.candidates;
    let known_from_current = seen.root_from_keyframe.inverse();
    let reach = |sigma: f64, least: f64, most: f64| (3.0 * sigma + least).min(most);
    // Of the current keyframe seen from the known one: its heading's error swings it around.
    let swing_m = seen.sigma_rad() * seen.root_from_keyframe.distance();
    Window {
        place_from_scan: known_from_current,
        reach_m: reach(seen.sigma_m() + swing_m, 0.2, candidates.search_m),
        reach_rad: reach(seen.sigma_rad(), 3.0_f64.to_radians(), candidates.search_rad),
        angle_step_rad: params.matching.angle_step_rad,
    }
}
