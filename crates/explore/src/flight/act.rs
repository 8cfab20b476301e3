//! One step: what comes first.

use geometry::Point3;
use maps3d::{FlightRoute, FrontierPatch, Hovering};
use pose::Se3;
use probe::VertexId;
use sensing::FlyingRobot;

use super::aim::BORDER_PX;
use super::events::FlightGiveUp;
use super::memory::Target;
use super::nearby::{Near, legs_to, nearby};
use super::viewpoint::{Aim, Plan, STAYS_M};
use super::{FlightEvent, FlightExplorer, FlightProbe};
use crate::{Ending, State};

/// Other vertices that are tried as a start for looking at a piece of frontier.
const OTHERS: usize = 16;
/// The same for frontier that was put off, and how much farther along the graph they may be.
const FAR_OTHERS: usize = 32;
const FAR_AROUND: f64 = 2.0;
/// What is solid so much before frontier hides it, metres of depth.
const HIDES_M: f64 = 0.1;
/// So many views have to say that something solid stands before a piece that was looked at.
const SIGHTS: usize = 3;

impl FlightExplorer {
    pub(super) fn act(&mut self, robot: &mut dyn FlyingRobot, probe: &mut dyn FlightProbe) {
        if self.goes_on_through_views(robot, probe) {
            return;
        }
        if let Some((to, length_m)) = self.way.pop() {
            self.repeat(robot, to, length_m, probe);
            return;
        }
        if let Some(plan) = self.plan.take()
            && plan.at == self.hovering.vertex
            && self.carry_out(robot, plan, probe)
        {
            return;
        }
        // Each round but the last puts something off, or gives it up.
        loop {
            self.change_state(State::Reactive, probe);
            let here = self.hovering.vertex;
            self.ask_frontiers(here);
            let least_m2 = if self.later.is_late() { 0.0 } else { self.params.turn_gain_m2 };
            if self.looks_here < self.params.looks_at_a_place
                && let Some(yaw_rad) = self.best_yaw(least_m2)
            {
                self.turn_to(robot, yaw_rad, probe);
                self.look(robot, probe);
                self.settle_targets();
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

    /// Flies to where a plan says, and notes what is to be looked at from there. Where nobody looked that way
    /// with some room on both sides, it is looked that way first, and the flight comes next; false where that
    /// look showed something in the way.
    pub(super) fn carry_out(
        &mut self,
        robot: &mut dyn FlyingRobot,
        plan: Plan,
        probe: &mut dyn FlightProbe,
    ) -> bool {
        let here = self.hovering.vertex;
        let stays = plan.place.coords.norm() < STAYS_M;
        if let Some(yaw_rad) = self.blind_yaw(&plan.place).filter(|_| !stays) {
            self.turn_to(robot, yaw_rad, probe);
            self.look(robot, probe);
            self.plan = Some(plan);
            return true;
        }
        let is_steered = !stays && !plan.targets.is_empty();
        if is_steered && !(self.may_fly(here, &plan.place) && self.may_leave(here, &plan.place)) {
            return false;
        }
        // The owners are near: their frames are known along the graph.
        let near = nearby(&self.graph, here, FAR_AROUND * self.params.around_m + self.params.hop_m);
        for target in &plan.targets {
            let owner = near.iter().find(|near| near.vertex == target.owner);
            let Some(owner) = owner else { continue };
            let from_in_owner = owner.root_from_vertex.inverse_transform(&plan.place);
            self.tries.note(target, from_in_owner, self.params.same_place_m);
        }
        let there_from_here = if stays {
            Se3::identity()
        } else {
            self.fly_to(robot, &plan.place, probe);
            Se3::new(-plan.place.coords, Se3::identity().rotation)
        };
        self.targets = plan.targets.iter().map(|target| target.moved(&there_from_here)).collect();
        self.patches.clear();
        if let Some(yaw_rad) = self.best_yaw(0.0) {
            self.turn_to(robot, yaw_rad, probe);
        }
        self.look(robot, probe);
        self.settle_targets();
        true
    }

    /// Notes of what the robot came for, and has in view now, whether something solid stands before it.
    fn settle_targets(&mut self) {
        let Some(seen) = self.seen.get(self.hovering.vertex) else { return };
        let same_m = self.params.same_place_m;
        let tries = &mut self.tries;
        self.targets.retain(|target| {
            let is_hidden = seen.hides(&target.at, HIDES_M);
            if let Some(is_hidden) = is_hidden {
                tries.note_seen(target, is_hidden, same_m);
            }
            is_hidden.is_none() && !seen.has_in_view(&target.at, BORDER_PX)
        });
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
        if self.later.is_late() && self.held_farther.insert((self.later.round(), owner)) {
            // Before anything is flown for what was put off, and before it is given up; also where the robot hovers.
            self.maps[0].compare_farther(owner, self.later.is_last(), &mut *probe);
            self.ask_frontiers(owner);
        }
        let targets: Vec<Target> = self.patches.iter().flat_map(targets_of).collect();
        let is_by_vertex = self.maps[0].is_by_vertex();
        // Later on one look at each piece is enough of a bound.
        let in_vain = !self.later.is_late()
            && self.visits.get(&owner).is_some_and(|v| v.0 > self.params.visits_in_vain);
        let (fresh, spent): (Vec<Target>, Vec<Target>) = targets.iter().partition(|target| {
            // A map with one global frame holds what was seen against all of its frontier at once.
            let was_seen = is_by_vertex && self.tries.was_seen(target, same_m);
            !in_vain && !was_seen && self.tries.count(target, same_m) < tries
        });
        if !self.later.is_last() && self.plan_look(robot, owner, &fresh, probe) {
            return true;
        }
        if is_by_vertex && !self.later.is_last() {
            self.later.put_off(owner);
            return false;
        }
        let mut places = Vec::new();
        for (targets, why) in
            [(spent, FlightGiveUp::NothingNew), (fresh, FlightGiveUp::Unreachable)]
        {
            for target in targets {
                let is_hidden =
                    self.tries.is_hidden(&target, same_m) || self.stands_before(owner, &target.at);
                let was_tried = self.tries.count(&target, same_m) > 0;
                let is_hidden = was_tried && is_hidden;
                let why = if is_hidden { FlightGiveUp::Hidden } else { why };
                self.note_given_up(&target, why, probe);
                places.push(target.at);
            }
        }
        let hovering = Hovering { vertex: owner, vertex_from_body: Se3::identity() };
        self.maps[0].give_up(&hovering, &places, same_m, false, &mut *probe);
        false
    }

    /// Whether several views have a point in their image, and where they say something, something solid stands
    /// before it.
    fn stands_before(&mut self, owner: VertexId, place_in_vertex: &Point3) -> bool {
        let hovering = Hovering { vertex: owner, vertex_from_body: Se3::identity() };
        let sights = self.maps[0].sights_of(&hovering, place_in_vertex);
        sights.free == 0 && sights.solid >= SIGHTS
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
        let aims = if self.later.is_late() {
            &[Aim::Look, Aim::Approach, Aim::Believe][..]
        } else {
            &[Aim::Look]
        };
        for &aim in aims {
            for other in near.iter().take(count + 1) {
                let other_from_owner = other.root_from_vertex.inverse();
                let moved: Vec<Target> =
                    targets.iter().map(|target| target.moved(&other_from_owner)).collect();
                let from = (other.vertex, &other.root_from_vertex);
                let plan = self.choose_viewpoint(aim, from, &moved, probe);
                if let Some(plan) = plan
                    && self.go_to(robot, plan, probe)
                {
                    return true;
                }
            }
        }
        false
    }

    /// Carries a plan out here, or sets out to where it begins; false where it cannot be.
    fn go_to(
        &mut self,
        robot: &mut dyn FlyingRobot,
        plan: Plan,
        probe: &mut dyn FlightProbe,
    ) -> bool {
        if plan.at == self.hovering.vertex {
            return self.carry_out(robot, plan, probe);
        }
        let all = nearby(&self.graph, self.hovering.vertex, f64::INFINITY);
        let legs = legs_to(&all, plan.at);
        let legs_m: f64 = legs.iter().map(|leg| leg.1).sum();
        let repeat_m = legs_m + plan.place.coords.norm();
        if self.sets_out_through_views(plan.at, Some(&plan), repeat_m, probe) {
            return self.goes_on_through_views(robot, probe);
        }
        self.way = legs;
        self.plan = Some(plan);
        self.set_out(robot, probe);
        true
    }

    /// The first leg of a way.
    pub(super) fn set_out(&mut self, robot: &mut dyn FlyingRobot, probe: &mut dyn FlightProbe) {
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
                self.ask_frontiers(goal);
                if self.patches.is_empty() {
                    self.later.put_off(goal);
                    return false;
                }
                let sets_out = self.go_look(robot, goal, probe);
                if sets_out {
                    self.note_visit(goal);
                }
                return sets_out;
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
                if self.sets_out_through_views(goal, None, length_m, probe)
                    && self.goes_on_through_views(robot, probe)
                {
                    return true;
                }
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
                self.carry_out(robot, plan, probe)
            }
        }
    }

    /// Counts visits to a vertex whose frontier does not get less; after too many it is given up on arrival.
    fn note_visit(&mut self, goal: VertexId) {
        let left_m2 = self.maps[0].frontier_at(goal);
        let visit = self.visits.entry(goal).or_insert((0, f64::INFINITY));
        *visit = if left_m2 < 0.95 * visit.1 { (1, left_m2) } else { (visit.0 + 1, visit.1) };
    }

    /// Counts what is given up, by why.
    fn note_given_up(&mut self, target: &Target, why: FlightGiveUp, probe: &mut dyn FlightProbe) {
        let Target { owner, at: place_in_vertex, area_m2, .. } = *target;
        self.given_up += 1;
        let sum = self.given_up_by.entry(why).or_default();
        *sum = (sum.0 + area_m2, sum.1.max(area_m2));
        probe.emit(FlightEvent::FrontierGivenUp { owner, place_in_vertex, area_m2, why });
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
