//! Two volumes held against each other: frontier of one inside the other is closed (\[ISRR19\] 4.3).

use geometry::planar::Interval;
use pose::Se2;
use probe::VertexId;

use super::inside::{placements, spans_inside};
use super::walls::{WallRule, spans_along_walls, spans_given_up};
use super::{Cause, Closing, ConsolidationEvent, RelativeMap, VolumeState};
use crate::MapProbe;

/// Memory that comparisons reuse.
#[derive(Clone, Debug, Default)]
pub(super) struct Work {
    /// Pairs to compare: rows of the scope, the volume whose frontier is looked at first.
    pub pairs: Vec<(u32, u32)>,
    /// For each of them, whether nothing that is open comes near the other volume, nor its walls.
    far: Vec<bool>,
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
        self.drop_longer_ways(&mut pairs);
        let rows = self.scope.placed();
        pairs.sort_unstable_by_key(|&(target, source)| (rows[source as usize].vertex, target));
        self.work.touched.clear();
        let mut far = std::mem::take(&mut self.work.far);
        far.clear();
        far.resize(pairs.len(), false);
        for cause in [Cause::Inside, Cause::Wall, Cause::Unreachable] {
            for (&(target, source), far) in pairs.iter().zip(&mut far) {
                if cause != Cause::Wall || !*far {
                    *far = self.compare(target as usize, source as usize, cause, probe);
                }
            }
        }
        self.work.far = far;
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
    /// Returns whether that was found to be too far from all of it, walls included.
    fn compare(
        &mut self,
        target: usize,
        source: usize,
        cause: Cause,
        probe: &mut dyn MapProbe,
    ) -> bool {
        let rows = self.scope.placed();
        let (at, against) = (rows[target].vertex, rows[source].vertex);
        let at_from_against =
            rows[target].root_from_vertex.inverse_mul(&rows[source].root_from_vertex);
        if at == against && cause != Cause::Unreachable {
            return false;
        }
        if !self.volumes[at].as_deref().is_some_and(VolumeState::has_open) {
            return false;
        }
        // The volume at hand is taken out of the map while the other is read.
        let Some(mut state) = self.volumes[at].take() else { return false };
        let mut far = false;
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
                    let wall_m = self.params.wall_closing_m;
                    far = spans_inside(&state, &other.volume, &poses, wall_m, clipped, &mut spans);
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
            if spans.iter().any(closes) {
                self.close(&mut state, target, source, cause, &at_from_against, &spans, probe);
            }
            self.work.spans = spans;
        }
        self.volumes[at] = Some(state);
        far
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
