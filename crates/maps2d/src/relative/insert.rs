//! A scan comes in: it founds a volume, or is merged into the one of the same place.

use geometry::planar::EdgeLedger;
use sensing::Scan;

use super::{RelativeMap, VolumeState};
use crate::volume::{LocalVolume, Samples, VolumeEvent, build};
use crate::{MapProbe, Standing};

impl RelativeMap {
    pub(super) fn insert(&mut self, standing: &Standing, scan: &Scan, probe: &mut dyn MapProbe) {
        let vertex = standing.vertex;
        self.cover(vertex);
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
        samples.add(scan, &standing.vertex_from_body);
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
        if let Some(before) = before {
            self.totals.remove(&before);
            inherit(&mut state, *before, self.params.sliver_m);
        }
        self.totals.add(&state);
        self.volumes[vertex] = Some(Box::new(state));
        self.compare_with_scope(vertex, probe);
        if let Some(left) = self.stood.replace(vertex)
            && left != vertex
        {
            self.retire_if_spent(left, probe);
        }
    }

    /// Room for a vertex in the volumes and in the skeleton.
    pub(super) fn cover(&mut self, vertex: probe::VertexId) {
        while self.volumes.next_id() <= vertex {
            self.volumes.push(None);
        }
        self.skeleton.cover(vertex);
    }
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
    state.given_up = before.given_up;
    state.measure(sliver_m);
}
