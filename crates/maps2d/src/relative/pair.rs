//! Two volumes held against each other: frontier of one inside the other is closed (\[ISRR19\] 4.3).

use geometry::planar::{Interval, box_gap};
use pose::Se2;
use probe::VertexId;

use super::walls::{ROUNDING_M, WallRule, spans_along_walls, spans_given_up};
use super::{Cause, Certainty, Closing, ConsolidationEvent, RelativeMap, VolumeState};
use crate::MapProbe;
use crate::volume::LocalVolume;

/// A way between a pair that is so many times as long as the shortest is as good.
const NEARLY_SHORTEST: f64 = 1.2;

/// Memory that comparisons reuse.
#[derive(Clone, Debug, Default)]
pub(super) struct Work {
    /// Pairs to compare: rows of the scope, the volume whose frontier is looked at first.
    pub pairs: Vec<(u32, u32)>,
    /// Parts to close: frontier edge and stretch.
    spans: Vec<(usize, Interval)>,
    clipped: Vec<Interval>,
    placements: Vec<Se2>,
    newly: Vec<Interval>,
    /// Open parts that begin a sliver that was none before: volume, frontier edge, parameter on it.
    pub slivers: Vec<(VertexId, usize, f64)>,
    /// Volumes whose ledgers changed, each with a volume that closed something there.
    pub touched: Vec<(VertexId, VertexId)>,
}

impl RelativeMap {
    /// Compares the pairs in `self.work.pairs`, over the rows of the scope at hand.
    ///
    /// First everything that lies inside the other volume is closed, over all pairs; then what is
    /// left along walls, then what could not be reached. So "free" is preferred as a reason. Of the
    /// volumes that account for a part the oldest closes it: in known space the old ones do all the
    /// work, and the new ones can be retired.
    pub(super) fn consolidate(&mut self, probe: &mut dyn MapProbe) {
        let mut pairs = std::mem::take(&mut self.work.pairs);
        let rows = self.scope.placed();
        pairs.sort_unstable_by_key(|&(target, source)| (rows[source as usize].vertex, target));
        self.work.touched.clear();
        for cause in [Cause::Inside, Cause::Wall, Cause::Unreachable] {
            for &(target, source) in &pairs {
                self.compare(target as usize, source as usize, cause, probe);
            }
        }
        self.work.pairs = pairs;
        self.measure_touched();
    }

    /// Measures the volumes whose ledgers changed, and credits those that closed what counted.
    fn measure_touched(&mut self) {
        let mut touched = std::mem::take(&mut self.work.touched);
        touched.sort_unstable();
        touched.dedup();
        let mut i = 0;
        while i < touched.len() {
            let vertex = touched[i].0;
            let end = touched[i..].iter().take_while(|(v, _)| *v == vertex).count() + i;
            let counted_less = self.remeasure(vertex);
            for &(_, by) in touched[i..end].iter().filter(|(_, by)| *by != vertex) {
                let Some(state) = self.volumes[by].as_deref_mut() else { continue };
                if counted_less {
                    state.closed_others = true;
                    state.idle_scans = 0;
                }
                if let Err(at) = state.closed_in.binary_search(&vertex) {
                    state.closed_in.insert(at, vertex);
                }
            }
            i = end;
        }
        self.work.touched = touched;
    }

    /// Measures one volume anew; returns whether less of its frontier counts than before.
    pub(super) fn remeasure(&mut self, vertex: VertexId) -> bool {
        let sliver_m = self.params.sliver_m;
        let Some(state) = self.volumes[vertex].as_deref_mut() else { return false };
        self.totals.remove(state);
        let before_m = state.open_m;
        let before = std::mem::take(&mut state.chains);
        state.measure(sliver_m);
        self.totals.add(state);
        for sliver in state.chains.iter().filter(|chain| !chain.counts) {
            let Some(part) = sliver.parts.first() else { continue };
            let at = part.span.middle();
            if !before.iter().any(|chain| !chain.counts && chain.holds(part.edge, at)) {
                self.work.slivers.push((vertex, part.edge, at));
            }
        }
        state.open_m < before_m
    }

    /// Closes what of the open frontier of row `target` the volume of row `source` accounts for.
    fn compare(&mut self, target: usize, source: usize, cause: Cause, probe: &mut dyn MapProbe) {
        let rows = self.scope.placed();
        let (at, against) = (rows[target].vertex, rows[source].vertex);
        let at_from_against =
            rows[target].root_from_vertex.inverse_mul(&rows[source].root_from_vertex);
        if at == against && cause != Cause::Unreachable {
            return;
        }
        if !self.volumes[at].as_deref().is_some_and(VolumeState::has_open) {
            return;
        }
        // The volume at hand is taken out of the map while the other is read.
        let Some(mut state) = self.volumes[at].take() else { return };
        let own;
        let other = if at == against {
            own = state.clone();
            Some(&own)
        } else {
            self.volumes[against].as_ref()
        };
        let silent = |other: &VolumeState| other.blocked && cause == Cause::Inside && at != against;
        if let Some(other) = other.filter(|other| !silent(other)) {
            let mut spans = std::mem::take(&mut self.work.spans);
            spans.clear();
            match cause {
                Cause::Inside => {
                    let rows = self.scope.placed();
                    // What the two ways share towards the root does not drift between them; at the
                    // root there is nothing to share, elsewhere this says rather too much.
                    let odometry_m = rows[target].odometry_m + rows[source].odometry_m;
                    let certainty = &self.params.certainty;
                    let mut poses = std::mem::take(&mut self.work.placements);
                    placements(&at_from_against, odometry_m, certainty, &mut poses);
                    let clipped = &mut self.work.clipped;
                    spans_inside(&state, &other.volume, &poses, clipped, &mut spans);
                    self.work.placements = poses;
                }
                Cause::Wall => {
                    let rows = self.scope.placed();
                    let odometry_m = rows[target].odometry_m + rows[source].odometry_m;
                    let rule = WallRule::over(odometry_m, &self.params);
                    spans_along_walls(&state, &other.volume, &at_from_against, rule, &mut spans);
                }
                Cause::Unreachable => {
                    spans_given_up(&state, &other.given_up, &at_from_against, &mut spans);
                }
            }
            let closes = |(edge, span): &(usize, Interval)| {
                state.ledgers[*edge].open().any(|open| open.overlap(span).is_some())
            };
            if spans.iter().any(closes) && self.way_may_decide(target, source) {
                self.close(&mut state, target, source, cause, &at_from_against, &spans, probe);
            }
            self.work.spans = spans;
        }
        self.volumes[at] = Some(state);
    }

    /// Whether the way between two rows through the scope at hand may decide: no other is clearly shorter,
    /// or more certainty is asked of it than at a last look.
    ///
    /// Where both are recognised from a new vertex that is off the way between them, their poses by way
    /// of it are worse than those that they were held against each other with.
    fn way_may_decide(&mut self, target: usize, source: usize) -> bool {
        let rows = self.scope.placed();
        // Where more is asked of placement than at a last look, that decides: the longer way may have
        // less odometry, and be the surer one.
        let decides = self.params.certainty.sigmas > self.params.last_look_sigmas;
        if target == 0 || source == 0 || decides {
            return true;
        }
        let (a, b) = (rows[target], rows[source]);
        let limit_m = (a.distance_m + b.distance_m) / NEARLY_SHORTEST;
        let walked = if self.scope_is_full { &self.full } else { &self.skeleton };
        self.scratch.distance_within(walked, a.vertex, b.vertex, limit_m).is_none()
    }

    /// Writes stretches into the ledgers of `state`, remembers the path, and tells.
    #[expect(clippy::too_many_arguments, reason = "one call site; the parts of one comparison")]
    fn close(
        &mut self,
        state: &mut VolumeState,
        target: usize,
        source: usize,
        cause: Cause,
        at_from_against: &Se2,
        spans: &[(usize, Interval)],
        probe: &mut dyn MapProbe,
    ) {
        let rows = self.scope.placed();
        let (at, by) = (rows[target].vertex, rows[source].vertex);
        let on = probe::Probe::<ConsolidationEvent<'_>>::on(probe);
        let mut closing: Option<Closing> = None;
        let mut closed_m = 0.0;
        for &(edge, span) in spans {
            let ledger = &mut state.ledgers[edge];
            if !ledger.open().any(|open| open.overlap(&span).is_some()) {
                continue;
            }
            let reason = *closing.get_or_insert_with(|| {
                let edges = self.scope.path_between(self.walked(), target, source);
                Closing { cause, by, step: self.scans, path: self.book.remember(at, edges) }
            });
            self.work.newly.clear();
            ledger.close(span, &reason, &mut self.work.newly);
            let length_m = state.volume.frontier[edge].length_m();
            for newly in &self.work.newly {
                closed_m += newly.share() * length_m;
                if on {
                    probe.emit(ConsolidationEvent::Closed {
                        volume: at,
                        edge: &state.volume.frontier[edge],
                        span: *newly,
                        cause,
                        by,
                        path: self.book.edges(reason.path),
                    });
                }
            }
        }
        if closing.is_some() {
            self.work.touched.push((at, by));
        }
        if on && (cause == Cause::Inside || closed_m > 0.0) {
            probe.emit(ConsolidationEvent::PairCompared {
                volume: at,
                against: by,
                volume_from_against: *at_from_against,
                closed_m,
            });
        }
    }
}

/// The stretches of open frontier of `state` that lie strictly inside `other`, under each of the
/// placements.
///
/// Whole edges are clipped, not their open parts, so that a stretch does not depend on what was
/// closed before. Only edges near the disc around what is open are looked at.
pub(super) fn spans_inside(
    state: &VolumeState,
    other: &LocalVolume,
    placements: &[Se2],
    clipped: &mut Vec<Interval>,
    spans: &mut Vec<(usize, Interval)>,
) {
    let (centre, open_m) = state.open_disc;
    let open_m = open_m + ROUNDING_M;
    let reach_m = open_m + other.inner.outer_radius();
    if placements[0].transform(&centre).coords.norm_squared() > reach_m * reach_m {
        return;
    }
    let mut common: Vec<Interval> = Vec::new();
    for (edge, ledger) in state.ledgers.iter().enumerate() {
        if ledger.is_closed() {
            continue;
        }
        let frontier = &state.volume.frontier[edge];
        if box_gap(&frontier.from, &frontier.to, &centre, &centre) > open_m {
            continue;
        }
        for (i, other_from_at) in placements.iter().enumerate() {
            clipped.clear();
            other.inner.clip(
                &other_from_at.transform(&frontier.from),
                &other_from_at.transform(&frontier.to),
                clipped,
            );
            if i == 0 {
                common.clone_from(clipped);
            } else {
                common = shared(&common, clipped);
            }
            if common.is_empty() {
                break;
            }
        }
        spans.extend(common.iter().map(|&span| (edge, span)));
    }
}

/// What two sorted lists of disjoint stretches have in common.
fn shared(a: &[Interval], b: &[Interval]) -> Vec<Interval> {
    a.iter().flat_map(|x| b.iter().filter_map(|y| x.overlap(y))).collect()
}

/// `other_from_at` as estimated, and as it would be were the odometry in between wrong by the named
/// number of standard deviations.
pub(super) fn placements(
    at_from_other: &Se2,
    odometry_m: f64,
    certainty: &Certainty,
    out: &mut Vec<Se2>,
) {
    let other_from_at = at_from_other.inverse();
    out.clear();
    out.push(other_from_at);
    let root = certainty.sigmas * odometry_m.max(0.0).sqrt();
    let (shift_m, turn_rad) =
        (root * certainty.sigma_translation, root * certainty.sigma_rotation_rad);
    if turn_rad > 0.0 {
        out.push(Se2::from_angle(turn_rad) * other_from_at);
        out.push(Se2::from_angle(-turn_rad) * other_from_at);
    }
    if shift_m > 0.0 {
        for (x_m, y_m) in [(shift_m, 0.0), (-shift_m, 0.0), (0.0, shift_m), (0.0, -shift_m)] {
            out.push(Se2::new(x_m, y_m, 0.0) * other_from_at);
        }
    }
}
