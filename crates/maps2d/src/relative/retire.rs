//! Volumes that add nothing are taken out of later comparisons, so that going round and round in
//! known space costs no more each time.
//!
//! A volume is spent when, as the robot leaves it, none of its own frontier counts any more and it
//! never closed frontier of another volume that counted. Then the frontier that counts is, at that
//! moment, what it would be had the scan never been taken. Nor can the volume be missed later:
//! all of its boundary is wall or lies in other volumes, and no counting frontier of theirs lies
//! inside it (it would have closed it), so up to slivers the others cover it whole, and whatever it
//! could close later they close too. Its vertex is contracted, which keeps every shortest path up
//! to the horizon (`posegraph::Skeleton::retire`).

use probe::VertexId;

use super::{ConsolidationEvent, RelativeMap};
use crate::MapProbe;

impl RelativeMap {
    pub(super) fn retire_if_spent(&mut self, vertex: VertexId, probe: &mut dyn MapProbe) {
        if !self.params.retire {
            return;
        }
        let Some(state) = self.volumes[vertex].as_deref_mut() else { return };
        let spent =
            !state.retired && !state.counts() && !state.closed_others && state.given_up.is_empty();
        if !spent || !self.skeleton.retire(vertex, &mut self.scratch) {
            return;
        }
        state.retired = true;
        self.scope_is_fresh = false;
        if probe::Probe::<ConsolidationEvent<'_>>::on(probe) {
            probe.emit(ConsolidationEvent::Retired { volume: vertex });
        }
    }

    /// A retired volume of which frontier was opened again takes part again.
    pub(super) fn restore_if_it_counts(&mut self, vertex: VertexId, probe: &mut dyn MapProbe) {
        let Some(state) = self.volumes[vertex].as_deref_mut() else { return };
        if !state.retired || !state.counts() {
            return;
        }
        state.retired = false;
        self.skeleton.restore(vertex);
        self.scope_is_fresh = false;
        if probe::Probe::<ConsolidationEvent<'_>>::on(probe) {
            probe.emit(ConsolidationEvent::Restored { volume: vertex });
        }
    }
}
