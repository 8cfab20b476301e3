//! A listener that keeps what the policy told.

use std::collections::BTreeSet;

use explore::{Ending, GiveUp, GraphEvent, PlannerEvent};
use geometry::Point2;
use maps2d::correction::CorrectionEvent;
use maps2d::grid::GridEvent;
use maps2d::polygons::PolygonEvent;
use maps2d::relative::ConsolidationEvent;
use maps2d::volume::VolumeEvent;
use probe::Probe;

/// What tests look at, in order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Told {
    Chose(Point2),
    GaveUp(Point2, GiveUp),
    Finished(Ending),
}

#[derive(Clone, Debug, Default)]
pub struct Heard {
    pub told: Vec<Told>,
    pub planner: BTreeSet<&'static str>,
    pub graph: BTreeSet<&'static str>,
    pub routes: usize,
    pub legs: usize,
    pub volumes: usize,
    pub consolidations: usize,
}

impl Heard {
    pub fn given_up(&self) -> Vec<GiveUp> {
        let why = |told: &Told| match told {
            Told::GaveUp(_, why) => Some(*why),
            _ => None,
        };
        self.told.iter().filter_map(why).collect()
    }
}

impl Probe<PlannerEvent<'_>> for Heard {
    fn emit(&mut self, event: PlannerEvent<'_>) {
        self.planner.insert(event.variant());
        match event {
            PlannerEvent::GoalChosen { goal_in_body, .. } => {
                self.told.push(Told::Chose(goal_in_body));
            }
            PlannerEvent::GoalGivenUp { goal_in_body, why, .. } => {
                self.told.push(Told::GaveUp(goal_in_body, why));
            }
            PlannerEvent::RoutePlanned { .. } => self.routes += 1,
            PlannerEvent::LegRepeated { .. } => self.legs += 1,
            PlannerEvent::Finished { ending } => self.told.push(Told::Finished(ending)),
            _ => {}
        }
    }
}

impl Probe<GraphEvent> for Heard {
    fn emit(&mut self, event: GraphEvent) {
        self.graph.insert(event.variant());
    }
}

impl Probe<VolumeEvent<'_>> for Heard {
    fn emit(&mut self, _event: VolumeEvent<'_>) {
        self.volumes += 1;
    }
}

impl Probe<ConsolidationEvent<'_>> for Heard {
    fn emit(&mut self, _event: ConsolidationEvent<'_>) {
        self.consolidations += 1;
    }
}

impl Probe<GridEvent<'_>> for Heard {
    fn emit(&mut self, _event: GridEvent<'_>) {}
}

impl Probe<CorrectionEvent<'_>> for Heard {
    fn emit(&mut self, _event: CorrectionEvent<'_>) {}
}

impl Probe<PolygonEvent<'_>> for Heard {
    fn emit(&mut self, _event: PolygonEvent<'_>) {}
}
