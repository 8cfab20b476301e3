//! Volumes that add nothing are taken out of later comparisons, so that going round and round in
//! known space costs no more each time.
//!
//! A volume is spent when none of its own frontier counts any more. It is retired
//!
//! - as the robot leaves it, if the active volumes account without it for everything that it closed
//!   (`is_missed` does the sum: it opens those parts on a copy and closes them again), or
//! - after it closed nothing that counted for so many scans in its scope (`retire_idle`). Volumes
//!   that need only each other would stay for ever otherwise: under drift ever more of them.
//!
//! A retired volume takes no part in comparisons, and its vertex is contracted
//! (`posegraph::Skeleton::retire`). What counts as frontier stays what it would be if nothing were
//! ever retired:
//!
//! - *Its own frontier.* None of it counts, and none will: consolidation only closes, and chains
//!   that lose parts get no longer. Where a part that counts opens again, it is taken in again.
//! - *Frontier of others that it could close.* Where frontier still counts after the active volumes
//!   were asked, the retired ones in scope are asked too (`ask_retired_about`). A volume without
//!   frontier that counts would have none after more was closed, either: there it makes no
//!   difference that nobody asked.
//! - *Ways.* No way over the skeleton is shorter than it is along the measured edges, so nobody is
//!   asked who would not be otherwise. Whom the skeleton puts out of scope, because ways over
//!   retired vertices stretch, is asked over the full graph together with the retired.
//!
//! A retired volume that closes what counted is taken in again. So in known space, where no frontier
//! is left, nobody asks, and the cost stops growing. Where frontier is left, the nearest
//! [`MOST_ASKED`] vertices are asked: it takes more than that within one scope for frontier to be
//! left that a retired volume would have closed; never is any closed that it would have left. Over
//! the skeleton, placement may go round by a tenth per retired vertex: under drift a part may be
//! closed along that way instead of the shortest.
//!
//! One thing differs: slivers are judged together with those of retired volumes (`slivers`), which
//! nobody closes any more. So more slivers may count than if nothing were retired, never fewer.

use geometry::Point2;
use geometry::planar::Interval;
use posegraph::Scope;
use probe::VertexId;

use super::incremental::Changed;
use super::inside::{placements, spans_inside};
use super::state::disc_around;
use super::walls::{WallRule, spans_along_walls};
use super::{Cause, Closing, ConsolidationEvent, RelativeMap, VolumeState};
use crate::MapProbe;

/// Of the vertices in a scope of the full graph only so many are asked, the nearest.
pub(super) const MOST_ASKED: usize = 200;

impl RelativeMap {
    pub(super) fn retire_if_spent(&mut self, vertex: VertexId, probe: &mut dyn MapProbe) {
        if self.params.retire && self.is_spent(vertex) && !self.is_missed(vertex) {
            self.retire(vertex, probe);
        }
    }

    fn retire(&mut self, vertex: VertexId, probe: &mut dyn MapProbe) {
        if !self.skeleton.retire(vertex, &mut self.scratch) {
            return;
        }
        if let Some(state) = self.volumes[vertex].as_deref_mut() {
            state.retired = true;
            state.closed_others = false;
            state.idle_scans = 0;
        }
        self.scope_is_fresh = false;
        if probe::Probe::<ConsolidationEvent<'_>>::on(probe) {
            probe.emit(ConsolidationEvent::Retired { volume: vertex });
        }
    }

    /// Counts for every volume in the scope at hand, but for its root, one scan more for which it was
    /// of no use; of the spent ones retires that which was of no use for longest, if that is long.
    pub(super) fn retire_idle(&mut self, probe: &mut dyn MapProbe) {
        if !self.params.retire {
            return;
        }
        let mut idlest: Option<(u32, VertexId)> = None;
        for row in 1..self.scope.placed().len() {
            let vertex = self.scope.placed()[row].vertex;
            let Some(state) = self.volumes[vertex].as_deref_mut() else { continue };
            state.idle_scans += 1;
            if state.idle_scans >= self.params.idle_scans && state.is_spent() {
                idlest = idlest.max(Some((state.idle_scans, vertex)));
            }
        }
        if let Some((_, vertex)) = idlest {
            self.retire(vertex, probe);
        }
    }

    pub(super) fn is_spent(&self, vertex: VertexId) -> bool {
        self.volume(vertex).is_some_and(VolumeState::is_spent)
    }

    /// Whether frontier would count again somewhere if this volume had closed nothing: whether any
    /// part that it closed is not closed by the other active volumes in scope as well.
    ///
    /// Cost: a scope for each volume of which it closed parts, until one misses it.
    fn is_missed(&mut self, vertex: VertexId) -> bool {
        let Some(state) = self.volume(vertex) else { return false };
        if !state.closed_others {
            return false;
        }
        let helped = state.closed_in.clone();
        // Who missed it before mostly does so again: a robot on its way passes the same places often.
        let before = state.missed_by;
        let order =
            before.into_iter().chain(helped.into_iter().rev().filter(|o| Some(*o) != before));
        let missed_by = order.into_iter().find(|&other| self.is_missed_by(other, vertex));
        if let Some(state) = self.volumes[vertex].as_deref_mut() {
            state.missed_by = missed_by;
        }
        missed_by.is_some()
    }

    fn is_missed_by(&mut self, other: VertexId, vertex: VertexId) -> bool {
        // Tried on the volume itself, which is taken out of the map meanwhile: a copy of all that
        // was measured there would cost more than the sum.
        let Some(mut state) = self.volumes[other].take() else { return false };
        let before = (!state.retired).then(|| state.ledgers.clone());
        let is_missed = before.is_some() && self.counts_more_without(&mut state, other, vertex);
        if let Some(before) = before {
            state.ledgers = before;
            state.measure(self.params.sliver_m);
        }
        self.volumes[other] = Some(state);
        is_missed
    }

    /// Opens what `vertex` closed in a volume that was taken out of the map, closes what the other
    /// active volumes in scope account for, and tells whether more counts than before.
    fn counts_more_without(
        &mut self,
        state: &mut VolumeState,
        of: VertexId,
        vertex: VertexId,
    ) -> bool {
        let counted_m = state.open_m;
        let (mut opened, mut ends): (Vec<Interval>, Vec<Point2>) = (Vec::new(), Vec::new());
        let mut reason: Option<Closing> = None;
        for (edge, ledger) in state.volume.frontier.iter().zip(&mut state.ledgers) {
            let relied = |closing: &Closing| {
                let relies = closing.by == vertex && closing.cause != Cause::Unreachable;
                reason = relies.then_some(*closing).or(reason);
                relies
            };
            opened.clear();
            ledger.reopen(relied, &mut opened);
            ends.extend(opened.iter().flat_map(|span| [edge.at(span.from), edge.at(span.to)]));
        }
        let Some(reason) = reason else { return false };
        state.measure(self.params.sliver_m);
        // Closing never makes more of it count.
        if state.open_m <= counted_m {
            return false;
        }
        // What was open before was held against the others already.
        state.open_disc = disc_around(ends.iter().copied());
        self.take_scope(of, &mut probe::Off);
        let (mut poses, mut clipped) = (Vec::new(), Vec::new());
        let mut spans: Vec<(usize, Interval)> = Vec::new();
        for row in 1..self.scope.placed().len() as u32 {
            let placed = self.scope.placed()[row as usize];
            if !self.is_active(row) || placed.vertex == vertex {
                continue;
            }
            let Some(helper) = self.volume(placed.vertex) else { continue };
            let of_from_helper = placed.root_from_vertex;
            placements(&of_from_helper, placed.odometry_m, &self.params.certainty, &mut poses);
            spans.clear();
            let mut far = false;
            if !helper.blocked {
                let wall_m = self.params.wall_closing_m;
                let volume = &helper.volume;
                far = spans_inside(state, volume, &poses, wall_m, &mut clipped, &mut spans);
            }
            if !far {
                let rule = WallRule::over(placed.odometry_m, &self.params);
                spans_along_walls(state, &helper.volume, &of_from_helper, rule, &mut spans);
            }
            for &(edge, span) in &spans {
                opened.clear();
                state.ledgers[edge].close(span, &reason, &mut opened);
            }
        }
        state.measure(self.params.sliver_m);
        state.open_m > counted_m
    }

    /// A retired volume takes part again.
    pub(super) fn restore(&mut self, vertex: VertexId, probe: &mut dyn MapProbe) {
        let Some(state) = self.volumes[vertex].as_deref_mut() else { return };
        if !state.retired {
            return;
        }
        state.retired = false;
        self.skeleton.restore(vertex, &mut self.scratch);
        self.scope_is_fresh = false;
        if probe::Probe::<ConsolidationEvent<'_>>::on(probe) {
            probe.emit(ConsolidationEvent::Restored { volume: vertex });
        }
    }

    /// A retired volume of which frontier that counts was opened again takes part again.
    pub(super) fn restore_if_it_counts(&mut self, vertex: VertexId, probe: &mut dyn MapProbe) {
        if self.volume(vertex).is_some_and(VolumeState::counts) {
            self.restore(vertex, probe);
        }
    }

    /// After a volume was compared over the skeleton: compares over the full graph what that left
    /// out, retired volumes and those over whose ways the skeleton has stretched, wherever there is
    /// frontier that counts.
    pub(super) fn ask_retired_about(&mut self, root: VertexId, probe: &mut dyn MapProbe) {
        let Some(scope) = self.full_scope_if(root, true) else { return };
        let mut asked: Vec<VertexId> = self.scope.placed().iter().map(|row| row.vertex).collect();
        asked.sort_unstable();
        self.compare_in_full(scope, probe, |map, a, b| {
            let other = map.scope.placed()[if a == 0 { b } else { a } as usize].vertex;
            let retired = map.volume(other).is_some_and(|state| state.retired);
            (a == 0) != (b == 0) && (retired || asked.binary_search(&other).is_err())
        });
    }

    /// Compares pairs of which new edges at the root changed the path, over the full graph; `before`
    /// is the scope without the edges.
    pub(super) fn compare_across_in_full(
        &mut self,
        root: VertexId,
        before: &Scope,
        probe: &mut dyn MapProbe,
    ) {
        let Some(scope) = self.full_scope_if(root, true) else { return };
        let changed = Changed::new(before, &scope, &self.full);
        self.compare_in_full(scope, probe, |_, a, b| changed.is_path_of(a, b));
    }

    /// Compares rows of a scope of the full graph whose frontier counts with others; retired volumes
    /// that close what counted are taken in again.
    fn compare_in_full(
        &mut self,
        mut scope: Scope,
        probe: &mut dyn MapProbe,
        is_pair: impl Fn(&Self, u32, u32) -> bool,
    ) {
        std::mem::swap(&mut self.scope, &mut scope);
        self.scope_is_full = true;
        let rows = self.scope.placed().len() as u32;
        let mut pairs = std::mem::take(&mut self.work.pairs);
        pairs.clear();
        for a in 0..rows {
            let at = self.scope.placed()[a as usize].vertex;
            if !self.volume(at).is_some_and(|state| !state.retired && state.counts()) {
                continue;
            }
            let others = (0..rows).filter(|&b| is_pair(self, a, b) && self.may_touch(a, b));
            pairs.extend(others.map(|b| (a, b)));
        }
        let any = !pairs.is_empty();
        self.work.pairs = pairs;
        if any {
            if probe::Probe::<ConsolidationEvent<'_>>::on(probe) {
                probe.emit(ConsolidationEvent::ScopeTaken {
                    scope: &self.scope,
                    skeleton: &self.full,
                });
            }
            self.consolidate(probe);
        }
        std::mem::swap(&mut self.scope, &mut scope);
        self.scope_is_full = false;
        if any {
            for (_, by) in std::mem::take(&mut self.work.touched) {
                if self.volume(by).is_some_and(|state| state.closed_others) {
                    self.restore(by, probe);
                }
            }
        }
    }

    /// The scope of `root` in the full graph, if anything was ever retired, there is frontier that
    /// counts anywhere, and it is `needed`.
    pub(super) fn full_scope_if(&mut self, root: VertexId, needed: bool) -> Option<Scope> {
        if !needed || self.totals.places == 0 || self.skeleton.is_whole() {
            return None;
        }
        let mut scope = Scope::default();
        let radius_m = self.params.consolidation_radius_m;
        self.scratch.place_nearest(&self.full, root, radius_m, MOST_ASKED, &mut scope);
        Some(scope)
    }
}
