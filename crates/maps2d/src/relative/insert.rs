//! A scan comes in: it founds a volume, or is merged into the one of the same place.

use geometry::Point2;
use geometry::planar::{EdgeLedger, Interval};
use probe::VertexId;
use sensing::Scan;

use super::{Cause, Closing, ConsolidationEvent, RelativeMap, ReopenCause, VolumeState};
use crate::volume::{EdgeKey, LocalVolume, Samples, VolumeEvent, build};
use crate::{MapProbe, Standing};

impl RelativeMap {
    pub(super) fn insert(&mut self, standing: &Standing, scan: &Scan, probe: &mut dyn MapProbe) {
        let vertex = standing.vertex;
        self.cover(vertex);
        self.restore(vertex, probe);
        self.scans += 1;
        if probe::Probe::<VolumeEvent<'_>>::on(probe) {
            probe.emit(VolumeEvent::Measured {
                vertex,
                scan,
                anchor_from_sensor: standing.vertex_from_body,
            });
        }
        let before = self.volumes[vertex].take();
        let mut samples = before.as_ref().map_or_else(Samples::new, |state| state.samples.clone());
        match before.as_deref() {
            None => samples.add(scan, &standing.vertex_from_body),
            Some(state) => {
                samples.add_where(scan, &standing.vertex_from_body, |end| tells(state, end));
            }
        }
        if probe::Probe::<VolumeEvent<'_>>::on(probe) {
            probe.emit(VolumeEvent::Sampled { vertex, samples: &samples });
        }
        // Ranges beyond the envelope of the predicates bound nothing; the view is then empty.
        let volume = build(&samples, &self.params.volume).unwrap_or_else(|_| LocalVolume::empty());
        if probe::Probe::<VolumeEvent<'_>>::on(probe) {
            probe.emit(match before {
                None => VolumeEvent::Built { vertex, volume: &volume },
                Some(_) => VolumeEvent::Merged { vertex, volume: &volume },
            });
        }
        let mut state = VolumeState::new(volume, samples, self.params.sliver_m);
        let mut doubtful: Vec<VertexId> = Vec::new();
        if let Some(before) = before {
            self.totals.remove(&before);
            if before.volume.polygon != state.volume.polygon {
                doubtful.clone_from(&before.closed_in);
            }
            inherit(&mut state, *before, self.params.sliver_m);
        }
        self.totals.add(&state);
        self.volumes[vertex] = Some(Box::new(state));
        let mut lost: Vec<Vec<(usize, Interval)>> = Vec::with_capacity(doubtful.len());
        for &other in &doubtful {
            lost.push(self.reopen_what_closed(other, vertex, probe));
            self.restore_if_it_counts(other, probe);
        }
        self.compare_with_scope(vertex, probe);
        for (other, parts) in doubtful.into_iter().zip(lost) {
            // What this volume does not close any more may lie inside others, which were not asked
            // while it was closed.
            if self.any_open(other, &parts) {
                self.compare_with_scope(other, probe);
            }
            self.retire_if_spent(other, probe);
        }
        if let Some(left) = self.stood.replace(vertex)
            && left != vertex
        {
            self.retire_idle(probe);
            self.retire_if_spent(left, probe);
        }
    }

    /// The volume that closed parts of `other` has changed: they are open until it closes them again.
    /// Returns them, by edge.
    ///
    /// A ray between two old ones may show that the edge between them cut a corner.
    pub(super) fn reopen_what_closed(
        &mut self,
        other: VertexId,
        by: VertexId,
        probe: &mut dyn MapProbe,
    ) -> Vec<(usize, Interval)> {
        let mut reopened: Vec<(usize, Interval)> = Vec::new();
        let Some(state) = self.volumes[other].as_deref_mut() else { return reopened };
        let on = probe::Probe::<ConsolidationEvent<'_>>::on(probe);
        let mut parts: Vec<Interval> = Vec::new();
        for (i, edge) in state.volume.frontier.iter().enumerate() {
            parts.clear();
            state.ledgers[i].reopen(
                |closing: &Closing| closing.by == by && closing.cause != Cause::Unreachable,
                &mut parts,
            );
            for &span in parts.iter().filter(|_| on) {
                let cause = ReopenCause::VolumeReplaced(by);
                probe.emit(ConsolidationEvent::Reopened { volume: other, edge, span, cause });
            }
            reopened.extend(parts.iter().map(|&span| (i, span)));
        }
        self.remeasure(other);
        reopened
    }

    /// Whether anything of these parts of frontier edges is open.
    pub(super) fn any_open(&self, vertex: VertexId, parts: &[(usize, Interval)]) -> bool {
        self.volume(vertex).is_some_and(|state| {
            parts.iter().any(|(edge, span)| {
                state.ledgers[*edge].open().any(|open| open.overlap(span).is_some())
            })
        })
    }

    /// Room for a vertex in the volumes and in the skeleton.
    pub(super) fn cover(&mut self, vertex: VertexId) {
        while self.volumes.next_id() <= vertex {
            self.volumes.push(None);
        }
        self.skeleton.cover(vertex);
        self.full.cover(vertex);
    }
}

/// Whether a ray that ends there tells the volume something: it looks where nobody looked, or splits
/// a frontier edge that is still open. Everything else is settled, and the volume stays small
/// however often the robot comes back.
fn tells(state: &VolumeState, end_in_anchor: &Point2) -> bool {
    let polygon = &state.volume.polygon;
    let Some(sector) = polygon.sector_of(end_in_anchor) else { return true };
    if polygon.is_gap(sector.index) {
        return true;
    }
    let key = EdgeKey(2 * sector.index as u32);
    let found = state.volume.frontier.binary_search_by_key(&key, |edge| edge.key);
    found.is_ok_and(|edge| !state.ledgers[edge].is_closed())
}

/// What the volume before had closed stays closed where the same edge is still there; and what it
/// closed in others stays credited to the vertex.
fn inherit(state: &mut VolumeState, before: VolumeState, sliver_m: f64) {
    let mut old = before.volume.frontier.iter().zip(before.ledgers).collect::<Vec<_>>();
    for (edge, ledger) in state.volume.frontier.iter().zip(&mut state.ledgers) {
        let same = old.iter().position(|(o, _)| o.from == edge.from && o.to == edge.to);
        if let Some(i) = same {
            *ledger = std::mem::replace(&mut old[i].1, EdgeLedger::new());
        }
    }
    state.closed_others = before.closed_others;
    state.closed_in = before.closed_in;
    state.blocked = before.blocked;
    state.held = before.held;
    state.given_up = before.given_up;
    state.measure(sliver_m);
}
