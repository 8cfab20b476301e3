//! The last look: before the robot believes that it has seen everything.
//!
//! At full drift two volumes of which one was placed over 8 m of odometry lie a metre and more off at
//! the range of the sensor, which is as much as an unseen corner is wide, or a wall thick. Such a volume may
//! close the last frontier of a corner, and nobody is left to look. To trust it less from the start
//! makes robots drive much farther all the while; mostly others would have closed the same anyway.
//! So it is asked for at the end only, when few volumes are in doubt:
//!
//! 1. Everything that was closed is opened, but for what could not be reached; all volumes take part
//!    again.
//! 2. It is closed again as ever, but by volumes that account for it under every placement that is off
//!    by the named number of standard deviations ([`Certainty`](super::Certainty)).
//! 3. What opened in scraps, shorter than three slivers, is closed as it was: what hides a corner is
//!    longer, and scraps are where all the views end.
//! 4. What still counts is looked at as any other frontier, and closed with that certainty from then on:
//!    whoever goes there sees it from a volume that has driven a metre or two.
//!
//! So the cells are first seen when they would have been, and only the distance to the end grows. Not in
//! \[ISRR19\], which trusts placement inside the scope. Cost: every volume compared once with its scope.

use geometry::planar::{EdgeLedger, Interval};
use probe::VertexId;

use super::{Cause, Closing, ConsolidationEvent, RelativeMap, ReopenCause};
use crate::MapProbe;

/// What opens counts only where it hangs together over so many times the length of a sliver.
///
/// Every overlap of two views ends in scraps that are not sure. With 2 the maze at full drift takes 40 m
/// more, with 1 it takes 130 m more.
const SCRAP_SLIVERS: f64 = 3.0;

impl RelativeMap {
    /// Opens what was closed with less certainty than the last look asks for; returns whether any of it
    /// counts. Does nothing where that certainty was asked for already, or without noise.
    pub(super) fn take_last_look(&mut self, probe: &mut dyn MapProbe) -> bool {
        let certainty = &mut self.params.certainty;
        let is_noisy = certainty.sigma_translation > 0.0 || certainty.sigma_rotation_rad > 0.0;
        if !is_noisy || self.params.last_look_sigmas <= certainty.sigmas {
            return false;
        }
        certainty.sigmas = self.params.last_look_sigmas;
        let vertices: Vec<VertexId> = self.volumes().map(|(vertex, _)| vertex).collect();
        let before: Vec<Vec<EdgeLedger<Closing>>> = vertices
            .iter()
            .map(|&vertex| self.volume(vertex).map_or_else(Vec::new, |state| state.ledgers.clone()))
            .collect();
        for &vertex in &vertices {
            self.open_all(vertex, probe);
            self.restore(vertex, probe);
        }
        for &vertex in &vertices {
            self.compare_with_scope(vertex, probe);
        }
        for (&vertex, before) in vertices.iter().zip(&before) {
            self.close_scraps(vertex, before, probe);
        }
        self.hold_slivers(probe);
        // No way starts at a vertex that is retired, so not the one that the robot stands on.
        let stood = self.stood;
        for &vertex in vertices.iter().filter(|&&vertex| Some(vertex) != stood) {
            self.retire_if_spent(vertex, probe);
        }
        self.totals.places > 0
    }

    /// Closes what opened in scraps as it was before.
    fn close_scraps(
        &mut self,
        vertex: VertexId,
        before: &[EdgeLedger<Closing>],
        probe: &mut dyn MapProbe,
    ) {
        let on = probe::Probe::<ConsolidationEvent<'_>>::on(probe);
        let least_m = SCRAP_SLIVERS * self.params.sliver_m;
        let Some(state) = self.volumes[vertex].as_deref_mut() else { return };
        let scraps = state.chains.iter().filter(|chain| chain.length_m < least_m);
        let mut newly: Vec<Interval> = Vec::new();
        let mut has_closed = false;
        for part in scraps.flat_map(|chain| &chain.parts) {
            for closed in before[part.edge].closed() {
                if let Some(span) = closed.span.overlap(&part.span) {
                    newly.clear();
                    state.ledgers[part.edge].close(span, &closed.reason, &mut newly);
                    has_closed |= !newly.is_empty();
                    let Closing { cause, by, path, .. } = closed.reason;
                    for &span in newly.iter().filter(|_| on) {
                        let edge = &state.volume.frontier[part.edge];
                        let path = self.book.edges(path);
                        let volume = vertex;
                        probe.emit(ConsolidationEvent::Closed {
                            volume,
                            edge,
                            span,
                            cause,
                            by,
                            path,
                        });
                    }
                }
            }
        }
        if has_closed {
            self.remeasure(vertex);
        }
    }

    /// Opens all that other volumes closed in one.
    fn open_all(&mut self, vertex: VertexId, probe: &mut dyn MapProbe) {
        let Some(state) = self.volumes[vertex].as_deref_mut() else { return };
        let on = probe::Probe::<ConsolidationEvent<'_>>::on(probe);
        let mut parts: Vec<Interval> = Vec::new();
        for (edge, ledger) in state.volume.frontier.iter().zip(&mut state.ledgers) {
            parts.clear();
            ledger.reopen(|closing: &Closing| closing.cause != Cause::Unreachable, &mut parts);
            for &span in parts.iter().filter(|_| on) {
                let cause = ReopenCause::LastLook;
                probe.emit(ConsolidationEvent::Reopened { volume: vertex, edge, span, cause });
            }
        }
        self.remeasure(vertex);
    }
}
