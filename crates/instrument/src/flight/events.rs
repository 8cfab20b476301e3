//! Every event in order: a line of text each, and what it draws.

use explore::FlightEvent;
use maps3d::global_union::UnionEvent;
use maps3d::relative::ConsolidationEvent;
use maps3d::{DepthEvent, PlanEvent};
use probe::Probe;

use super::views::{self, ClosedFaces};
use super::{FlightRecorder, looks, planner, union};
use crate::{Family, Level};

impl Probe<FlightEvent<'_>> for FlightRecorder {
    fn on(&self) -> bool {
        self.ink.is_on()
    }

    fn emit(&mut self, event: FlightEvent<'_>) {
        // The graph is kept whole, whatever is thinned.
        match event {
            FlightEvent::VertexAdded { vertex, odom_from_vertex } => {
                self.here = vertex;
                self.odom_from_vertex.push(odom_from_vertex);
                self.graph.vertex(self.world_from_start * odom_from_vertex);
                self.graph_grew = true;
            }
            FlightEvent::EdgeAdded { kind, a, b, .. } => {
                self.graph.edge(kind, a, b);
                self.graph_grew = true;
            }
            FlightEvent::LegRepeated { to, .. } => self.here = to,
            _ => {}
        }
        let family = family_of(&event);
        if !self.takes(family) {
            return;
        }
        if self.level == Level::Full {
            self.next_event();
            let line = planner::line(&event);
            self.ink.say(family.name(), event.variant(), format_args!("{line}"));
        }
        if let FlightEvent::Looked { hovering, vertex_from_camera, image } = event {
            self.looked(&hovering, &vertex_from_camera, image);
        }
        if family == Family::Planner {
            self.planned = true;
            let vertex = planner::vertex_of(&event).unwrap_or(self.here);
            let drawn_from_vertex = self.drawn_from_vertex(vertex);
            planner::draw(&mut self.ink, &event, &drawn_from_vertex);
        }
    }
}

/// What an event of the flight is about.
fn family_of(event: &FlightEvent<'_>) -> Family {
    match event {
        FlightEvent::Looked { .. } => Family::Sensing,
        FlightEvent::VertexAdded { .. } | FlightEvent::EdgeAdded { .. } => Family::PoseGraph,
        _ => Family::Planner,
    }
}

impl Probe<DepthEvent<'_>> for FlightRecorder {
    fn on(&self) -> bool {
        self.takes(Family::Sensing)
    }

    fn emit(&mut self, event: DepthEvent<'_>) {
        if !looks::is_told(&event) {
            return;
        }
        if self.level == Level::Full {
            self.next_event();
            let line = looks::line(&event);
            self.ink.say(Family::Sensing.name(), event.variant(), format_args!("{line}"));
        }
        looks::polyhedron(&mut self.ink, &event);
    }
}

impl Probe<ConsolidationEvent<'_>> for FlightRecorder {
    fn on(&self) -> bool {
        self.ink.is_on()
    }

    fn emit(&mut self, event: ConsolidationEvent<'_>) {
        self.views.note(&event);
        let family = views::family_of(&event);
        if !self.takes(family) {
            return;
        }
        if self.level == Level::Full {
            let next = ClosedFaces::of(&event);
            let joined = match (&mut self.closed, &next) {
                (Some(closed), Some(next)) => closed.join(next),
                _ => false,
            };
            if !joined {
                self.tell_closed();
                self.closed = next;
            }
            if self.closed.is_none() {
                self.next_event();
                let line = views::line(&event);
                self.ink.say(family.name(), event.variant(), format_args!("{line}"));
            }
        }
        match event {
            ConsolidationEvent::Settled { map, .. } => self.views.settle(&mut self.ink, map),
            ConsolidationEvent::Planned { vertex, plan, given } => {
                let drawn_from_vertex = self.drawn_from_vertex(vertex);
                let entity = "belief/planner/plan";
                self.planned = true;
                planner::draw_plan(&mut self.ink, entity, plan, given, &drawn_from_vertex);
            }
            _ => {}
        }
    }
}

impl FlightRecorder {
    /// Tells of the faces that were closed in a row, if any were.
    fn tell_closed(&mut self) {
        let Some(closed) = self.closed.take() else { return };
        self.next_event();
        let line = closed.line();
        self.ink.say(Family::Consolidation.name(), "Closed", format_args!("{line}"));
    }
}

impl Probe<UnionEvent<'_>> for FlightRecorder {
    fn on(&self) -> bool {
        self.ink.is_on()
    }

    fn emit(&mut self, event: UnionEvent<'_>) {
        let family = union::family_of(&event);
        if !self.takes(family) {
            return;
        }
        if self.level == Level::Full {
            self.next_event();
            let line = union::line(&event);
            self.ink.say(family.name(), event.variant(), format_args!("{line}"));
        }
        union::draw(&mut self.ink, &event);
    }
}

impl Probe<PlanEvent<'_>> for FlightRecorder {
    fn on(&self) -> bool {
        self.level == Level::Full && self.takes(Family::Tetrahedra)
    }

    fn emit(&mut self, event: PlanEvent<'_>) {
        if !Probe::<PlanEvent<'_>>::on(self) || !self.searches.count(&event) {
            return;
        }
        self.next_event();
        if self.around_robot
            && let PlanEvent::Joined { .. } = event
        {
            let drawn_from_vertex = self.drawn_from_vertex(self.here);
            self.searches.place(&mut self.ink, &drawn_from_vertex);
        }
        let line = self.searches.tell(&mut self.ink, &event);
        self.ink.say(Family::Tetrahedra.name(), event.variant(), format_args!("{line}"));
    }
}
