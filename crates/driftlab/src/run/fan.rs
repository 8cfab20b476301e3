//! Several listeners of one robot: one for each of its maps.

use explore::{GraphEvent, PlannerEvent};
use maps2d::correction::CorrectionEvent;
use maps2d::grid::GridEvent;
use maps2d::polygons::PolygonEvent;
use maps2d::relative::ConsolidationEvent;
use maps2d::volume::VolumeEvent;
use metrics::Coverage;
use probe::Probe;
use worlds::World2d;

use super::{AtWork, StepSeen, Watch};

/// Hands what a map tells to that map's listener, and what robot and policy tell to all of them.
pub struct Fan<W> {
    watchers: Vec<W>,
    at_work: AtWork,
}

impl<W> Fan<W> {
    /// One listener per map, in the order of the maps.
    pub fn new(watchers: Vec<W>) -> Self {
        let at_work = AtWork::new(watchers.len());
        Self { watchers, at_work }
    }

    /// The listeners.
    pub fn into_watchers(self) -> Vec<W> {
        self.watchers
    }

    /// The listeners, in the order of the maps.
    pub(crate) fn watchers(&self) -> &[W] {
        &self.watchers
    }

    /// The same, to be told something.
    pub(crate) fn watchers_mut(&mut self) -> &mut [W] {
        &mut self.watchers
    }

    /// Which map is at work is asked of this from now on.
    pub(crate) fn listen_to(&mut self, at_work: &AtWork) {
        self.at_work = at_work.clone();
    }

    pub(crate) fn current(&self) -> Option<&W> {
        self.watchers.get(self.at_work.current()?)
    }

    pub(crate) fn current_mut(&mut self) -> Option<&mut W> {
        self.watchers.get_mut(self.at_work.current()?)
    }
}

/// What a map tells goes to the listener of that map.
macro_rules! of_the_map_at_work {
    ($($event:ident),+) => {$(
        impl<W: for<'a> ::probe::Probe<$event<'a>>> ::probe::Probe<$event<'_>>
            for $crate::run::Fan<W>
        {
            fn on(&self) -> bool {
                self.current().is_some_and(|watcher| ::probe::Probe::<$event<'_>>::on(watcher))
            }

            fn emit(&mut self, event: $event<'_>) {
                if let Some(watcher) = self.current_mut() {
                    watcher.emit(event);
                }
            }
        }
    )+};
}

pub(crate) use of_the_map_at_work;

of_the_map_at_work!(VolumeEvent, ConsolidationEvent, GridEvent, CorrectionEvent, PolygonEvent);

impl<W: Probe<GraphEvent>> Probe<GraphEvent> for Fan<W> {
    fn on(&self) -> bool {
        self.watchers.iter().any(|watcher| Probe::<GraphEvent>::on(watcher))
    }

    fn emit(&mut self, event: GraphEvent) {
        self.watchers.iter_mut().for_each(|watcher| watcher.emit(event));
    }
}

impl<W: for<'a> Probe<PlannerEvent<'a>>> Probe<PlannerEvent<'_>> for Fan<W> {
    fn on(&self) -> bool {
        self.watchers.iter().any(|watcher| Probe::<PlannerEvent<'_>>::on(watcher))
    }

    fn emit(&mut self, event: PlannerEvent<'_>) {
        self.watchers.iter_mut().for_each(|watcher| watcher.emit(event));
    }
}

impl<W: Watch> Watch for Fan<W> {
    type Error = W::Error;

    fn maps(&mut self, at_work: &AtWork) {
        self.listen_to(at_work);
    }

    fn place(&mut self, world: &World2d, coverage: &Coverage) -> Result<(), W::Error> {
        self.watchers.iter_mut().try_for_each(|watcher| watcher.place(world, coverage))
    }

    fn step_begins(&mut self, step: u64, distance_m: f64, sim_time_secs: f64) {
        for watcher in &mut self.watchers {
            watcher.step_begins(step, distance_m, sim_time_secs);
        }
    }

    fn step_ends(&mut self, end: &StepSeen<'_>) -> Result<(), W::Error> {
        for (watcher, row) in self.watchers.iter_mut().zip(end.rows) {
            let rows = std::slice::from_ref(row);
            watcher.step_ends(&StepSeen { rows, ..*end })?;
        }
        Ok(())
    }
}
