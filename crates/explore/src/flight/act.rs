//! One step: what comes first.

use geometry::Point3;
use maps3d::{FlightRoute, FrontierPatch, Hovering};
use pose::Se3;
use probe::VertexId;
use sensing::FlyingRobot;

use super::events::FlightGiveUp;
use super::memory::Target;
use super::nearby::{legs_to, nearby};
use super::viewpoint::Plan;
use super::{FlightEvent, FlightExplorer, FlightProbe};
use crate::{Ending, State};

/// Other vertices that are tried as a start for looking at a piece of frontier.
const OTHERS: usize = 16;

impl FlightExplorer {
    pub(super) fn act(&mut self, robot: &mut dyn FlyingRobot, probe: &mut dyn FlightProbe) {
        if let Some((to, length_m)) = self.way.pop() {
            self.repeat(robot, to, length_m, probe);
            return;
        }
        if let Some(plan) = self.plan.take()
            && plan.at == self.hovering.vertex
        {
            self.carry_out(robot, plan, probe);
            return;
        }
        // Each round but the last gives something up.
        loop {
            self.change_state(State::Reactive, probe);
            self.ask_frontiers();
            if self.looks_here < self.params.looks_at_a_place
                && let Some(yaw_rad) = self.best_yaw()
            {
                self.turn_to(robot, yaw_rad, probe);
                self.look(robot, probe);
                return;
            }
            self.targets.clear();
            if self.patches.is_empty() {
                if self.go_elsewhere(robot, probe) {
                    return;
                }
                continue;
            }
            if self.go_look(robot, probe) {
                return;
            }
        }
    }

    /// The frontier of the vertex where the robot hovers, in the frame of that vertex.
    fn ask_frontiers(&mut self) {
        let hovering = Hovering { vertex: self.hovering.vertex, vertex_from_body: Se3::identity() };
        let mut patches = std::mem::take(&mut self.patches);
        self.maps[0].frontiers(&hovering, &mut patches);
        self.patches = patches;
    }

    /// Flies to where a plan says, and notes what is to be looked at from there.
    fn carry_out(&mut self, robot: &mut dyn FlyingRobot, plan: Plan, probe: &mut dyn FlightProbe) {
        let here = self.hovering.vertex;
        // The owners are near: their frames are known along the graph.
        let near = nearby(&self.graph, here, 2.0 * self.params.around_m);
        for target in &plan.targets {
            let owner = near.iter().find(|near| near.vertex == target.owner);
            let Some(owner) = owner else { continue };
            let from_in_owner = owner.root_from_vertex.inverse_transform(&plan.place);
            self.tries.note(target, from_in_owner, self.params.same_place_m);
        }
        self.fly_to(robot, &plan.place, probe);
        let there_from_here = Se3::new(-plan.place.coords, Se3::identity().rotation);
        self.targets = plan.targets.iter().map(|target| target.moved(&there_from_here)).collect();
        self.patches.clear();
        if let Some(yaw_rad) = self.best_yaw() {
            self.turn_to(robot, yaw_rad, probe);
        }
        self.look(robot, probe);
    }

    /// Sets out to look at the frontier of here; false when all that happened is that some was given up.
    fn go_look(&mut self, robot: &mut dyn FlyingRobot, probe: &mut dyn FlightProbe) -> bool {
        let here = self.hovering.vertex;
        let (same_m, tries) = (self.params.same_place_m, self.params.tries);
        let targets: Vec<Target> = self.patches.iter().flat_map(targets_of).collect();
        let in_vain = self.visits.get(&here).is_some_and(|v| v.0 > self.params.visits_in_vain);
        let (fresh, spent): (Vec<Target>, Vec<Target>) =
            targets.iter().partition(|target| !in_vain && self.tries.count(target, same_m) < tries);
        let owner_from_here = Se3::identity();
        if let Some(plan) = self.choose_viewpoint(here, &owner_from_here, &fresh, probe) {
            self.carry_out(robot, plan, probe);
            return true;
        }
        // From what others see, the nearest first.
        let near = nearby(&self.graph, here, self.params.around_m);
        for other in near.iter().skip(1).take(OTHERS) {
            let other_from_here = other.root_from_vertex.inverse();
            let moved: Vec<Target> = fresh.iter().map(|t| t.moved(&other_from_here)).collect();
            let found = self.choose_viewpoint(other.vertex, &other.root_from_vertex, &moved, probe);
            if let Some(plan) = found {
                self.way = legs_to(&near, other.vertex);
                self.plan = Some(plan);
                self.set_out(robot, probe);
                return true;
            }
        }
        for (targets, why) in
            [(spent, FlightGiveUp::NothingNew), (fresh, FlightGiveUp::Unreachable)]
        {
            for target in targets {
                self.give_up(&target.at, target.area_m2, why, probe);
            }
        }
        false
    }

    /// The first leg of a way.
    fn set_out(&mut self, robot: &mut dyn FlyingRobot, probe: &mut dyn FlightProbe) {
        if let Some((to, length_m)) = self.way.pop() {
            self.repeat(robot, to, length_m, probe);
        }
    }

    /// Nothing is left here: the nearest frontier elsewhere, or the end. False when all that happened is
    /// that some was given up.
    fn go_elsewhere(&mut self, robot: &mut dyn FlyingRobot, probe: &mut dyn FlightProbe) -> bool {
        self.change_state(State::Deliberate, probe);
        let hovering = self.hovering;
        let keep_m = self.params.body_radius_m + self.params.margins_m.first().unwrap_or(&0.0);
        let Some(route) = self.maps[0].route_with(&hovering, keep_m, &|_| true, &mut *probe) else {
            self.finish(Ending::Complete, probe);
            return true;
        };
        let length_m = match &route {
            FlightRoute::Repeat(legs) => legs.iter().map(|(_, length_m)| length_m).sum(),
            FlightRoute::Fly(points) => {
                let starts = std::iter::once(Point3::origin()).chain(points.iter().copied());
                starts.zip(points).map(|(a, b)| (b - a).norm()).sum()
            }
        };
        probe.emit(FlightEvent::RoutePlanned { hovering, route: &route, length_m });
        match route {
            FlightRoute::Repeat(legs) => {
                let Some(&(goal, _)) = legs.last() else {
                    self.finish(Ending::Stuck, probe);
                    return true;
                };
                self.note_visit(goal);
                self.way = legs;
                self.way.reverse();
                self.set_out(robot, probe);
                true
            }
            FlightRoute::Fly(points) => {
                let Some(first) = points.first() else {
                    self.finish(Ending::Stuck, probe);
                    return true;
                };
                let place = hovering.vertex_from_body.transform(first);
                let distance_m = place.coords.norm();
                let share = (self.params.hop_m / distance_m.max(1e-9)).min(1.0);
                let plan = Plan { at: hovering.vertex, place: place * share, targets: Vec::new() };
                self.carry_out(robot, plan, probe);
                true
            }
        }
    }

    /// Counts visits to a vertex whose frontier does not get less; after too many it is given up on arrival.
    fn note_visit(&mut self, goal: VertexId) {
        let left_m2 = self.maps[0].frontier_at(goal);
        let visit = self.visits.entry(goal).or_insert((0, f64::INFINITY));
        *visit = if left_m2 < 0.95 * visit.1 { (1, left_m2) } else { (visit.0 + 1, visit.1) };
    }

    fn give_up(
        &mut self,
        place_in_vertex: &Point3,
        area_m2: f64,
        why: FlightGiveUp,
        probe: &mut dyn FlightProbe,
    ) {
        let owner = self.hovering.vertex;
        self.given_up += 1;
        let place_in_vertex = *place_in_vertex;
        probe.emit(FlightEvent::FrontierGivenUp { owner, place_in_vertex, area_m2, why });
        let hovering = Hovering { vertex: owner, vertex_from_body: Se3::identity() };
        let radius_m = self.params.same_place_m;
        self.maps[0].give_up(&hovering, &place_in_vertex, radius_m, false, &mut *probe);
    }
}

/// The points of a patch, as targets in the frame of its owner.
fn targets_of(patch: &FrontierPatch) -> impl Iterator<Item = Target> + '_ {
    patch.points.iter().map(|point| Target {
        owner: patch.owner,
        in_owner: point.in_body,
        at: point.in_body,
        normal: point.normal_in_body,
        area_m2: point.area_m2,
    })
}
