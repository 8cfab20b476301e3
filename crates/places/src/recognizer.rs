//! Keyframe by keyframe: tracked, recognised, closed.

use pose::Se2;
use pose::nalgebra::Matrix3;
use probe::{Off, Probe};
use sensing::Scan;

use crate::candidates::{Candidate, candidates};
use crate::consistency::{against_each_other, against_graph};
use crate::descriptor::Descriptor;
use crate::links::{Links, Measured, Seen};
use crate::matching::{Prior, Window};
use crate::place::{Place, thinned};
use crate::verify::{Judged, Pair, Verdict, window_of};
use crate::{Keyframe, MatchParams, Matched, PlaceEvent, PlaceParams, SurfacePoint};

/// What the wheels say of the way from the last keyframe.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Driven {
    /// The new keyframe in the frame of the last one.
    pub last_from_new: Se2,
    /// Distance driven, metres.
    pub distance_m: f64,
    /// Angles turned, either way, radians.
    pub turned_rad: f64,
}

/// A recognised place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closure {
    /// The current keyframe in the frame of the known one.
    pub measured: Measured,
    /// Root of the mean square distance of points to their surfaces, metres; 0 where it was given.
    pub residual_m: f64,
}

/// What a new keyframe came to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Added {
    /// Its index.
    pub keyframe: usize,
    /// Where it lies in the frame of the last one, the scans heard; `None` for the first.
    pub step: Option<Measured>,
    /// Closures that are believed from now on; some may be of earlier keyframes.
    pub closures: Vec<Closure>,
    /// Candidates that were matched.
    pub proposed: usize,
    /// Keyframes that were candidates before the most promising were taken.
    pub gated: usize,
}

/// Counts of all that was tried.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// Matches by verdict, in the order of [`Verdict::ALL`]; those that waited are counted as that.
    pub verdicts: [u64; Verdict::ALL.len()],
    /// Steps for which the scans had no say.
    pub untracked: u64,
}

#[derive(Clone, Copy, Debug)]
struct Waiting {
    closure: Closure,
    since: usize,
}

/// The recogniser of places: holds keyframes, and what was measured between them.
#[derive(Clone, Debug)]
pub struct Recognizer {
    params: PlaceParams,
    recognises: bool,
    keyframes: Vec<Keyframe>,
    descriptors: Vec<Descriptor>,
    steps: Vec<Measured>,
    closures: Vec<Closure>,
    waiting: Vec<Waiting>,
    links: Links,
    tally: Tally,
    reached: Vec<Seen>,
    around_known: Vec<Seen>,
}

impl Recognizer {
    /// One that has seen nothing.
    pub fn new(params: PlaceParams) -> Self {
        Self {
            params,
            recognises: true,
            keyframes: Vec::new(),
            descriptors: Vec::new(),
            steps: Vec::new(),
            closures: Vec::new(),
            waiting: Vec::new(),
            links: Links::default(),
            tally: Tally::default(),
            reached: Vec::new(),
            around_known: Vec::new(),
        }
    }

    /// One that finds no places itself: they come through [`given`](Self::given).
    pub fn tracking_only(params: PlaceParams) -> Self {
        Self { recognises: false, ..Self::new(params) }
    }

    /// Takes the next keyframe.
    pub fn add(&mut self, scan: Scan, driven: &Driven) -> Added {
        self.add_with(scan, driven, &mut Off)
    }

    /// Takes the next keyframe: matches it against the last ones, and against known ones nearby.
    ///
    /// Without finite odometry the robot counts as standing. Cost: bounded by the parameters, but for
    /// the search through the graph, n log n in the keyframes that are certain enough.
    pub fn add_with(
        &mut self,
        scan: Scan,
        driven: &Driven,
        probe: &mut (impl for<'a> Probe<PlaceEvent<'a>> + ?Sized),
    ) -> Added {
        let driven = if is_finite(driven) { *driven } else { Driven::default() };
        let new = self.keyframes.len();
        let before_m = self.keyframes.last().map_or(0.0, |last| last.travelled_m);
        let travelled_m = before_m + driven.distance_m.abs();
        let MatchParams { range_m, spacing_m, .. } = self.params.matching;
        let keyframe = Keyframe::new(scan, travelled_m, range_m, spacing_m);
        self.links.push();
        self.keyframes.push(keyframe);
        let surface = &self.keyframes[new].surface;
        probe.emit(PlaceEvent::KeyframeAdded { keyframe: new, surface, travelled_m });
        let mut added = Added { keyframe: new, ..Added::default() };
        if new > 0 {
            let step = self.track(new, &driven, probe);
            self.links.add(&step);
            self.steps.push(step);
            added.step = Some(step);
        }
        let matching = &self.params.matching;
        let place = self.place(new, (matching.beside, 0));
        self.descriptors.push(Descriptor::new(&thinned(&place.points, 0.1, 0)));
        if self.recognises && new > 0 {
            self.recognise(&place, &mut added, probe);
        }
        self.give_up(new, probe);
        added
    }

    fn place(&self, middle: usize, beside: (usize, usize)) -> Place {
        let local_m = self.params.matching.local_m;
        Place::around(&self.keyframes, &self.steps, middle, beside, local_m)
    }

    /// The step to a new keyframe: what the wheels say, and how its scan fits the last ones.
    fn track(
        &mut self,
        new: usize,
        driven: &Driven,
        probe: &mut (impl for<'a> Probe<PlaceEvent<'a>> + ?Sized),
    ) -> Measured {
        let covariance = self.params.odometry.covariance(driven.distance_m, driven.turned_rad);
        let place_from_scan = driven.last_from_new;
        let place = self.place(new - 1, (self.params.matching.recent, 0));
        let information = covariance.try_inverse().unwrap_or_else(Matrix3::identity);
        let prior = Prior { place_from_scan, information };
        // Wheels that jump by a kilometre would have the search fill the memory.
        let candidates = &self.params.candidates;
        let window = Window {
            place_from_scan,
            reach_m: (3.0 * covariance[(0, 0)].sqrt() + 0.1).min(candidates.search_m),
            reach_rad: (3.0 * covariance[(2, 2)].sqrt()).min(candidates.search_rad),
            angle_step_rad: self.params.matching.angle_step_rad,
        };
        let own = &self.keyframes[new].surface;
        let pair = Pair { keyframes: &self.keyframes, known: &place, current: own, own };
        let mut judged = pair.judge(&self.params, &window, Some(&prior), false);
        // The prior bounds what the surfaces do not, and the robot did move somewhere: what counts is
        // that most of the scan is explained.
        let known_enough = judged.agreement.overlap >= 0.6 * self.params.rejection.overlap;
        let fits = judged.residual_m <= self.params.rejection.residual_m * 1.5;
        judged.verdict = match judged.verdict {
            Verdict::NoFit => Verdict::NoFit,
            _ if !known_enough => Verdict::Overlap,
            _ if !fits => Verdict::Residual,
            _ => Verdict::Believed,
        };
        let (before, last) = (place_from_scan, new - 1);
        emit(probe, false, &judged, (last, &place.points), (new, own), before);
        let believed = judged.verdict == Verdict::Believed;
        self.tally.untracked += u64::from(!believed);
        let (from_from_to, covariance) = if believed {
            (judged.known_from_current, judged.covariance)
        } else {
            (place_from_scan, covariance)
        };
        Measured { from: last, to: new, from_from_to, covariance }
    }

    /// Looks for known places around the newest keyframe.
    fn recognise(
        &mut self,
        place: &Place,
        added: &mut Added,
        probe: &mut (impl for<'a> Probe<PlaceEvent<'a>> + ?Sized),
    ) {
        let new = added.keyframe;
        let limit_m = self.params.candidates.sigma_limit_m;
        let mut reached = std::mem::take(&mut self.reached);
        self.links.around(new, limit_m, &mut reached);
        let travelled_m = self.keyframes[new].travelled_m;
        let (ranked, gated) = candidates(
            &self.params.candidates,
            &reached,
            new,
            |i| travelled_m - self.keyframes[i].travelled_m,
            &self.descriptors,
        );
        added.gated = gated;
        probe.emit(PlaceEvent::CandidatesRanked { current: new, candidates: &ranked });
        if !ranked.is_empty() {
            let current = thinned(&place.points, 0.08, 600);
            for (rank, candidate) in ranked.iter().enumerate() {
                // The wider the window the dearer the search: of wide ones only the best is worth it.
                let wide = window_of(&self.params, &candidate.seen).reach_m
                    > self.params.candidates.wide_m;
                if rank > 0 && wide {
                    continue;
                }
                added.proposed += 1;
                self.try_one(candidate, new, &current, &reached, added, probe);
            }
        }
        self.reached = reached;
    }

    fn try_one(
        &mut self,
        candidate: &Candidate,
        new: usize,
        current: &[SurfacePoint],
        reached: &[Seen],
        added: &mut Added,
        probe: &mut (impl for<'a> Probe<PlaceEvent<'a>> + ?Sized),
    ) {
        let seen = &candidate.seen;
        let beside = self.params.matching.beside;
        let known = self.place(seen.keyframe, (beside, beside));
        let own = &self.keyframes[new].surface;
        let pair = Pair { keyframes: &self.keyframes, known: &known, current, own };
        let window = window_of(&self.params, seen);
        let mut judged = pair.judge(&self.params, &window, None, true);
        let measured = Measured {
            from: seen.keyframe,
            to: new,
            from_from_to: judged.known_from_current,
            covariance: judged.covariance,
        };
        let rejection = &self.params.rejection;
        if judged.verdict == Verdict::Waits {
            let sure =
                seen.sigma_m() <= rejection.alone_m && seen.sigma_rad() <= rejection.alone_rad;
            if against_graph(&measured, seen) > rejection.gate {
                judged.verdict = Verdict::Unexpected;
            } else if sure {
                judged.verdict = Verdict::Believed;
            }
        }
        let before = window.place_from_scan;
        emit(probe, true, &judged, (seen.keyframe, &known.points), (new, current), before);
        self.count(judged.verdict);
        let closure = Closure { measured, residual_m: judged.residual_m };
        match judged.verdict {
            Verdict::Believed => self.close(&[closure], added, probe),
            Verdict::Waits => self.wait(closure, reached, added, probe),
            _ => {}
        }
    }

    fn count(&mut self, verdict: Verdict) {
        let at = Verdict::ALL.iter().position(|other| *other == verdict);
        if let Some(count) = at.and_then(|at| self.tally.verdicts.get_mut(at)) {
            *count += 1;
        }
    }

    /// A match that is not believed alone: it and those that agree with it are, once they are enough.
    fn wait(
        &mut self,
        closure: Closure,
        reached: &[Seen],
        added: &mut Added,
        probe: &mut (impl for<'a> Probe<PlaceEvent<'a>> + ?Sized),
    ) {
        let mine = closure.measured;
        let limit_m = self.params.candidates.sigma_limit_m;
        let mut around_known = std::mem::take(&mut self.around_known);
        if !self.waiting.is_empty() {
            self.links.around(mine.from, limit_m, &mut around_known);
        }
        let rejection = &self.params.rejection;
        let agrees = |other: &Waiting| {
            let theirs = other.closure.measured;
            let find = |among: &[Seen], keyframe| {
                among.iter().find(|seen| seen.keyframe == keyframe).copied()
            };
            let pair = (find(&around_known, theirs.from), find(reached, theirs.to));
            let (Some(known), Some(current)) = pair else { return false };
            let (squared, off) = against_each_other(&mine, &theirs, &known, &current);
            squared <= rejection.gate
                && off.distance() <= rejection.apart_m
                && off.angle().abs() <= rejection.apart_rad
        };
        let agreeing: Vec<usize> =
            (0..self.waiting.len()).filter(|&i| agrees(&self.waiting[i])).collect();
        let mut keyframes: Vec<usize> =
            agreeing.iter().map(|&i| self.waiting[i].closure.measured.to).collect();
        keyframes.push(mine.to);
        keyframes.dedup();
        let enough = keyframes.len() >= rejection.agreeing;
        self.around_known = around_known;
        if !enough {
            self.waiting.push(Waiting { closure, since: mine.to });
            return;
        }
        let mut believed: Vec<Closure> =
            agreeing.iter().map(|&i| self.waiting[i].closure).collect();
        for &i in agreeing.iter().rev() {
            self.waiting.remove(i);
        }
        believed.push(closure);
        self.close(&believed, added, probe);
    }

    fn close(
        &mut self,
        closures: &[Closure],
        added: &mut Added,
        probe: &mut (impl for<'a> Probe<PlaceEvent<'a>> + ?Sized),
    ) {
        for closure in closures {
            self.links.add(&closure.measured);
        }
        self.closures.extend_from_slice(closures);
        added.closures.extend_from_slice(closures);
        probe.emit(PlaceEvent::Closed { closures });
    }

    fn give_up(&mut self, new: usize, probe: &mut (impl for<'a> Probe<PlaceEvent<'a>> + ?Sized)) {
        let patience = self.params.rejection.patience;
        self.waiting.retain(|waiting| {
            let stays = new - waiting.since <= patience;
            if !stays {
                probe.emit(PlaceEvent::GivenUp { closure: &waiting.closure.measured });
            }
            stays
        });
    }

    /// Takes a place that somebody else recognised; whether both keyframes are there and its numbers
    /// are of use.
    pub fn given(&mut self, measured: &Measured) -> bool {
        let known = measured.from.max(measured.to) < self.keyframes.len();
        let usable = measured.covariance.cholesky().is_some()
            && measured.from_from_to.translation.iter().all(|x| x.is_finite())
            && measured.from_from_to.angle().is_finite();
        if !known || measured.from == measured.to || !usable {
            return false;
        }
        self.links.add(measured);
        self.closures.push(Closure { measured: *measured, residual_m: 0.0 });
        true
    }

    /// The keyframes.
    pub fn keyframes(&self) -> &[Keyframe] {
        &self.keyframes
    }

    /// Steps from each keyframe to the next.
    pub fn steps(&self) -> &[Measured] {
        &self.steps
    }

    /// All closures that are believed.
    pub fn closures(&self) -> &[Closure] {
        &self.closures
    }

    /// Counts of all that was tried.
    pub fn tally(&self) -> &Tally {
        &self.tally
    }

    /// The least uncertain ways from a keyframe to all that are certain enough.
    pub fn around(&self, keyframe: usize) -> Vec<Seen> {
        let mut reached = Vec::new();
        if keyframe < self.keyframes.len() {
            self.links.around(keyframe, f64::INFINITY, &mut reached);
        }
        reached
    }

    /// Memory held, bytes.
    pub fn bytes(&self) -> usize {
        let of_keyframes: usize = self
            .keyframes
            .iter()
            .map(|keyframe| {
                keyframe.surface.capacity() * size_of::<SurfacePoint>()
                    + keyframe.scan.ranges_m.capacity() * size_of::<f64>()
                    + size_of::<Keyframe>()
                    + size_of::<Descriptor>()
                    + size_of::<Measured>()
            })
            .sum();
        of_keyframes + self.closures.capacity() * size_of::<Closure>() + self.links.bytes()
    }
}

fn is_finite(driven: &Driven) -> bool {
    let pose = &driven.last_from_new;
    pose.translation.iter().all(|x| x.is_finite())
        && pose.angle().is_finite()
        && driven.distance_m.is_finite()
        && driven.turned_rad.is_finite()
}

fn emit(
    probe: &mut (impl for<'a> Probe<PlaceEvent<'a>> + ?Sized),
    of_place: bool,
    judged: &Judged,
    (known, known_points): (usize, &[SurfacePoint]),
    (current, current_points): (usize, &[SurfacePoint]),
    before: Se2,
) {
    let matched = Matched {
        known,
        current,
        known_points,
        current_points,
        before,
        after: judged.known_from_current,
        covariance: judged.covariance,
        residual_m: judged.residual_m,
        agreement: judged.agreement,
        found: judged.found,
        verdict: judged.verdict,
    };
    probe.emit(if of_place {
        PlaceEvent::PlaceMatched(matched)
    } else {
        PlaceEvent::Tracked(matched)
    });
}
