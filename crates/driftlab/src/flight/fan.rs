//! Several listeners of one flying robot: one for each of its maps.

use explore::FlightEvent;
use maps3d::global_union::UnionEvent;
use maps3d::relative::ConsolidationEvent;
use maps3d::{DepthEvent, PlanEvent};
use metrics::VoxelCoverage;
use probe::Probe;
use worlds::World3d;

use super::{FlightSeen, FlightWatch};
use crate::run::{AtWork, Fan, of_the_map_at_work};

of_the_map_at_work!(DepthEvent, ConsolidationEvent, UnionEvent, PlanEvent);

impl<W: for<'a> Probe<FlightEvent<'a>>> Probe<FlightEvent<'_>> for Fan<W> {
    fn on(&self) -> bool {
        self.watchers().iter().any(|watcher| Probe::<FlightEvent<'_>>::on(watcher))
    }

    fn emit(&mut self, event: FlightEvent<'_>) {
        self.watchers_mut().iter_mut().for_each(|watcher| watcher.emit(event));
    }
}

impl<W: FlightWatch> FlightWatch for Fan<W> {
    type Error = W::Error;

    fn maps(&mut self, at_work: &AtWork) {
        self.listen_to(at_work);
    }

    fn place(&mut self, world: &World3d, coverage: &VoxelCoverage) -> Result<(), W::Error> {
        self.watchers_mut().iter_mut().try_for_each(|watcher| watcher.place(world, coverage))
    }

    fn step_begins(&mut self, step: u64, distance_m: f64) {
        for watcher in self.watchers_mut() {
            watcher.step_begins(step, distance_m);
        }
    }

    fn step_ends(&mut self, end: &FlightSeen<'_>) -> Result<(), W::Error> {
        for (watcher, row) in self.watchers_mut().iter_mut().zip(end.rows) {
            let rows = std::slice::from_ref(row);
            watcher.step_ends(&FlightSeen { rows, ..*end })?;
        }
        Ok(())
    }
}
