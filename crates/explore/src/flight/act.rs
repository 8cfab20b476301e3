//! One step: what comes first.

use geometry::Point3;
use maps3d::{FlightRoute, FrontierPatch, Hovering};
use pose::Se3;
use probe::VertexId;
use sensing::FlyingRobot;

use super::events::FlightGiveUp;
use super::memory::Target;
use super::nearby::{Near, legs_to, nearby};
use super::viewpoint::{Aim, Plan};
use super::{FlightEvent, FlightExplorer, FlightProbe};
use crate::{Ending, State};

/// Other vertices that are tried as a start for looking at a piece of frontier.
const OTHERS: usize = 16;
/// The same for frontier that was put off, and how much farther along the graph they may be.
const FAR_OTHERS: usize = 32;
const FAR_AROUND: f64 = 2.0;

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
        // Each round but the last puts something off, or gives it up.
        loop {
            self.change_state(State::Reactive, probe);
            let here = self.hovering.vertex;
            self.ask_frontiers(here);
            if self.looks_here < self.params.looks_at_a_place
                && let Some(yaw_rad) = self.best_yaw()
            {
                self.turn_to(robot, yaw_rad, probe);
                self.look(robot, probe);
                return;
            }
            self.targets.clear();
            if self.patches.is_empty() || !self.later.comes_now(here) {
                if self.go_elsewhere(robot, probe) {
                    return;
                }
                continue;
            }
            if self.go_look(robot, here, probe) {
                return;
            }
        }
    }

    /// The frontier of a vertex, in its frame.
    fn ask_frontiers(&mut self, vertex: VertexId) {
        let hovering = Hovering { vertex, vertex_from_body: Se3::identity() };
        let mut patches = std::mem::take(&mut self.patches);
        self.maps[0].frontiers(&hovering, &mut patches);
        self.patches = patches;
    }

    /// Flies to where a plan says, and notes what is to be looked at from there.
    fn carry_out(&mut self, robot: &mut dyn FlyingRobot, plan: Plan, probe: &mut dyn FlightProbe) {
        let here = self.hovering.vertex;
        // The owners are near: their frames are known along the graph.
        let near = nearby(&self.graph, here, FAR_AROUND * self.params.around_m + self.params.hop_m);
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

    /// Sets out to look at the frontier of a vertex, which was asked for; false when all that happened is
    /// that some was put off or given up.
    fn go_look(
        &mut self,
        robot: &mut dyn FlyingRobot,
        owner: VertexId,
        probe: &mut dyn FlightProbe,
    ) -> bool {
        let (same_m, tries) = (self.params.same_place_m, self.params.tries);
        let targets: Vec<Target> = self.patches.iter().flat_map(targets_of).collect();
        let in_vain = self.visits.get(&owner).is_some_and(|v| v.0 > self.params.visits_in_vain);
        let (fresh, spent): (Vec<Target>, Vec<Target>) =
            targets.iter().partition(|target| !in_vain && self.tries.count(target, same_m) < tries);
        if !self.later.is_last() && self.plan_look(robot, owner, &fresh, probe) {
            return true;
        }
        if self.maps[0].is_by_vertex() && !self.later.is_last() {
            self.later.put_off(owner);
            return false;
        }
        for (targets, why) in
            [(spent, FlightGiveUp::NothingNew), (fresh, FlightGiveUp::Unreachable)]
        {
            for target in targets {
                self.give_up(owner, &target.at, target.area_m2, why, probe);
            }
        }
        false
    }

    /// Sets out to a place that has some targets of a vertex in view, if there is one.
    fn plan_look(
        &mut self,
        robot: &mut dyn FlyingRobot,
        owner: VertexId,
        targets: &[Target],
        probe: &mut dyn FlightProbe,
    ) -> bool {
        if targets.is_empty() {
            return false;
        }
        // From what the vertex itself sees, then from what others do: the nearest first, later on those that
        // are nearest to the targets.
        let (share, count) =
            if self.later.is_late() { (FAR_AROUND, FAR_OTHERS) } else { (1.0, OTHERS) };
        let mut near = nearby(&self.graph, owner, share * self.params.around_m);
        if self.later.is_late() {
            let apart = |near: &Near| {
                let at = near.root_from_vertex.translation;
                targets.iter().map(|t| (t.at.coords - at).norm()).fold(f64::INFINITY, f64::min)
            };
            near.sort_by(|a, b| apart(a).total_cmp(&apart(b)).then(a.vertex.cmp(&b.vertex)));
        }
        let aims =
            if self.later.is_late() { &[Aim::Look, Aim::Approach][..] } else { &[Aim::Look] };
        for &aim in aims {
            for other in near.iter().take(count + 1) {
                let other_from_owner = other.root_from_vertex.inverse();
                let moved: Vec<Target> =
                    targets.iter().map(|target| target.moved(&other_from_owner)).collect();
                let from = (other.vertex, &other.root_from_vertex);
                if let Some(plan) = self.choose_viewpoint(aim, from, &moved, probe) {
                    self.go_to(robot, plan, probe);
                    return true;
                }
            }
        }
        false
    }

    /// Carries a plan out here, or sets out to where it begins.
    fn go_to(&mut self, robot: &mut dyn FlyingRobot, plan: Plan, probe: &mut dyn FlightProbe) {
        if plan.at == self.hovering.vertex {
            self.carry_out(robot, plan, probe);
            return;
        }
        let all = nearby(&self.graph, self.hovering.vertex, f64::INFINITY);
        self.way = legs_to(&all, plan.at);
        self.plan = Some(plan);
        self.set_out(robot, probe);
    }

    /// The first leg of a way.
    fn set_out(&mut self, robot: &mut dyn FlyingRobot, probe: &mut dyn FlightProbe) {
        if let Some((to, length_m)) = self.way.pop() {
            self.repeat(robot, to, length_m, probe);
        }
    }

    /// Nothing is left to do here: the nearest frontier elsewhere, or the end. False when all that happened
    /// is that some was put off or given up, or that a new round began.
    fn go_elsewhere(&mut self, robot: &mut dyn FlyingRobot, probe: &mut dyn FlightProbe) -> bool {
        self.change_state(State::Deliberate, probe);
        let hovering = self.hovering;
        let keep_m = self.params.body_radius_m + self.params.margins_m.first().unwrap_or(&0.0);
        let later = &self.later;
        let comes_now = |vertex: VertexId| later.comes_now(vertex);
        let Some(route) = self.maps[0].route_with(&hovering, keep_m, &comes_now, &mut *probe)
        else {
            let is_left = self.maps[0].is_by_vertex() && self.maps[0].tally().patches > 0;
            if is_left && !self.later.is_last() {
                self.later.begin_round(self.looks);
                return false;
            }
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
        if let FlightRoute::Repeat(legs) = &route {
            let goal = legs.last().map_or(hovering.vertex, |&(goal, _)| goal);
            if self.later.comes_again(goal) {
                // What was put off once is flown for only when there is something to do.
                self.note_visit(goal);
                if self.later.is_last() {
                    self.maps[0].compare_farther(goal, &mut *probe);
                }
                self.ask_frontiers(goal);
                if self.patches.is_empty() {
                    self.later.put_off(goal);
                    return false;
                }
                return self.go_look(robot, goal, probe);
            }
        }
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
        owner: VertexId,
        place_in_vertex: &Point3,
        area_m2: f64,
        why: FlightGiveUp,
        probe: &mut dyn FlightProbe,
    ) {
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
