//! A listener that writes a log beside what another listener does.

use explore::{GraphEvent, PlannerEvent};
use maps2d::correction::CorrectionEvent;
use maps2d::grid::GridEvent;
use maps2d::polygons::PolygonEvent;
use maps2d::relative::ConsolidationEvent;
use maps2d::volume::VolumeEvent;
use metrics::Coverage;
use probe::Probe;
use worlds::World2d;

use super::{AtWork, RunError, StepSeen, Watch};
use crate::export::{Exports, Fed};

/// Hands everything on, and exports where it is asked to.
pub struct Exporting<W> {
    inner: W,
    exports: Option<Exports>,
    kinds: Vec<&'static str>,
    at_work: AtWork,
}

impl<W> Exporting<W> {
    /// A listener beside `inner`; `kinds` are the maps of the robot, in their order.
    pub fn new(inner: W, exports: Option<Exports>, kinds: &[&'static str]) -> Self {
        Self { inner, exports, kinds: kinds.to_vec(), at_work: AtWork::new(kinds.len()) }
    }

    /// The listener beside, and the export.
    pub fn into_parts(self) -> (W, Option<Exports>) {
        (self.inner, self.exports)
    }

    fn kind(&self) -> &'static str {
        self.at_work.current().and_then(|map| self.kinds.get(map).copied()).unwrap_or("map")
    }
}

macro_rules! handed_on {
    ($($event:ident),+) => {$(
        impl<W: for<'a> Probe<$event<'a>>> Probe<$event<'_>> for Exporting<W> {
            fn on(&self) -> bool {
                Probe::<$event<'_>>::on(&self.inner)
            }

            fn emit(&mut self, event: $event<'_>) {
                self.inner.emit(event);
            }
        }
    )+};
}

handed_on!(GridEvent, CorrectionEvent, PolygonEvent, PlannerEvent);

macro_rules! listened_to {
    ($($event:ident => $method:ident),+) => {$(
        impl<W: for<'a> Probe<$event<'a>>> Probe<$event<'_>> for Exporting<W> {
            fn on(&self) -> bool {
                self.exports.is_some() || Probe::<$event<'_>>::on(&self.inner)
            }

            fn emit(&mut self, event: $event<'_>) {
                let kind = self.kind();
                if let Some(exports) = &mut self.exports {
                    exports.$method(kind, &event);
                }
                if Probe::<$event<'_>>::on(&self.inner) {
                    self.inner.emit(event);
                }
            }
        }
    )+};
}

listened_to!(VolumeEvent => volume, ConsolidationEvent => consolidation);

impl<W: Probe<GraphEvent>> Probe<GraphEvent> for Exporting<W> {
    fn on(&self) -> bool {
        Probe::<GraphEvent>::on(&self.inner)
    }

    fn emit(&mut self, event: GraphEvent) {
        self.inner.emit(event);
    }
}

impl<W: Watch> Watch for Exporting<W>
where
    RunError: From<W::Error>,
{
    type Error = RunError;

    fn maps(&mut self, at_work: &AtWork) {
        self.at_work = at_work.clone();
        self.inner.maps(at_work);
    }

    fn wants_feed(&self) -> bool {
        self.exports.is_some() || self.inner.wants_feed()
    }

    fn place(&mut self, world: &World2d, coverage: &Coverage) -> Result<(), RunError> {
        Ok(self.inner.place(world, coverage)?)
    }

    fn step_begins(&mut self, step: u64, distance_m: f64, sim_time_secs: f64) {
        self.inner.step_begins(step, distance_m, sim_time_secs);
    }

    fn step_ends(&mut self, end: &StepSeen<'_>) -> Result<(), RunError> {
        if let Some(exports) = &mut self.exports {
            let start_from_world = end.witness.robot().world().world_from_start().inverse();
            for fed in end.fed {
                let at = exports.simulated_time(end.witness.tally().distance_m);
                exports.fed(at, fed);
                if let Fed::Scan { .. } = fed {
                    exports.reference(at, &(start_from_world * end.witness.world_from_body()));
                }
            }
            exports.draw();
            exports.check()?;
        }
        Ok(self.inner.step_ends(end)?)
    }
}
