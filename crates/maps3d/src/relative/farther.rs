//! Frontier that would be given up is held against views farther along the graph first.

use probe::{Probe, VertexId};

use super::RelativeMap;
use super::book::Cause;
use super::events::ConsolidationEvent;
use super::insert::PlacedView;
use crate::Map3dProbe;

/// How much farther along the graph, as a multiple of the consolidation radius.
const FARTHER: f64 = 2.0;

/// Why frontier is closed then.
const CAUSES: [Cause; 3] = [Cause::Inside, Cause::Wall, Cause::Behind];

impl RelativeMap {
    /// Compares the frontier of the views of a vertex with all views within twice the consolidation radius.
    ///
    /// What was seen from far round, through a gap that the robot does not fit through, may lie in views that
    /// are near in space and far along the graph. The farther the way, the more drift; so it comes last. And
    /// what lies up to twice as far behind walls as is closed otherwise is closed: reduced surfaces of far views
    /// cut through pillars and furniture, where nobody can ever look.
    pub(super) fn compare_with_farther(&mut self, vertex: VertexId, probe: &mut dyn Map3dProbe) {
        self.cover(vertex);
        let radius_m = FARTHER * self.params.consolidation_radius_m;
        self.scratch.place(&self.skeleton, vertex, radius_m, &mut self.scope);
        // Nobody else asks for a scope of this radius.
        self.scope_is_fresh = false;
        if Probe::<ConsolidationEvent<'_>>::on(probe) {
            let (scope, skeleton) = (&self.scope, &self.skeleton);
            probe.emit(ConsolidationEvent::ScopeTaken { scope, skeleton });
        }
        let placed = self.placed_views();
        let own: Vec<PlacedView> = placed.iter().filter(|own| own.row == 0).copied().collect();
        self.work.touched.clear();
        for of in &own {
            for against in placed.iter().filter(|against| against.view != of.view) {
                if self.views[of.view as usize].counts() {
                    self.compare_rows(of, against, &CAUSES, probe);
                }
            }
        }
        self.measure_touched();
    }
}
