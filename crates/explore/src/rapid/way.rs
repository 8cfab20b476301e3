//! Ways along the graph and over free cells to a frontier out of view.

use geometry::Point2;
use maps2d::Route;
use probe::VertexId;
use sensing::Robot;

use super::behind::Behind;
use crate::{Ending, ExploreProbe, Explorer, GiveUp, PlannerEvent, RapidParams, State};

impl Explorer {
    /// Nothing in view: the nearest frontier elsewhere, or the end.
    pub(super) fn deliberate(
        &mut self,
        robot: &mut dyn Robot,
        params: &RapidParams,
        probe: &mut dyn ExploreProbe,
    ) {
        self.change_state(State::Deliberate, probe);
        let least_m = params.clearances_m.first().copied().unwrap_or(0.0);
        let Some(route) = self.route_now(least_m) else {
            // Before it believes so: does the map itself?
            if self.maps[0].look_again(&mut *probe) {
                self.act_rapid(robot, probe);
                return;
            }
            self.finish(Ending::Complete, probe);
            return;
        };
        self.take_route(robot, route, params, probe);
    }

    /// Where others come before this place: on the way to the nearest of them, if there is any.
    pub(super) fn leave_haunt(
        &mut self,
        robot: &mut dyn Robot,
        params: &RapidParams,
        probe: &mut dyn ExploreProbe,
    ) -> bool {
        let here = self.standing.vertex;
        if !self.rapid.haunts.can_wait(here) || self.rapid.haunts.is_spent(here) {
            return false;
        }
        let least_m = params.clearances_m.first().copied().unwrap_or(0.0);
        let Some(route) = self.route_now(least_m) else { return false };
        if !self.rapid.haunts.can_wait(here) || self.rapid.haunts.is_spent(here) {
            // Nothing is left elsewhere, so this place has its turn again.
            return false;
        }
        self.change_state(State::Deliberate, probe);
        self.take_route(robot, route, params, probe);
        true
    }

    /// The way to the nearest frontier whose turn it is; places get further turns where it is none's.
    fn route_now(&mut self, clearance_m: f64) -> Option<Route> {
        loop {
            let haunts = &self.rapid.haunts;
            let comes_now = |vertex| !haunts.can_wait(vertex) || haunts.is_spent(vertex);
            let route = self.maps[0].route_to(&self.standing, clearance_m, &comes_now);
            if route.is_some() || !self.rapid.haunts.relent() {
                return route;
            }
        }
    }

    pub(super) fn take_route(
        &mut self,
        robot: &mut dyn Robot,
        route: Route,
        params: &RapidParams,
        probe: &mut dyn ExploreProbe,
    ) {
        let length_m = self.tell_route(&route, probe);
        match route {
            Route::Repeat(mut legs) => {
                legs.reverse();
                if let Some(&(goal, _)) = legs.first() {
                    let left_m = self.maps[0].frontier_at(goal);
                    let sent = self.rapid.sent.entry(goal).or_insert((0, f64::INFINITY));
                    *sent = if left_m < sent.1 - 1e-6 { (1, left_m) } else { (sent.0 + 1, left_m) };
                    self.rapid.in_vain = (sent.0 > params.visits_in_vain).then_some(goal);
                }
                self.rapid.way = legs;
                if !self.follow_way(robot, params, probe) {
                    // The goal is here, but nothing of it is in view: it cannot be acted on.
                    self.finish(Ending::Stuck, probe);
                }
            }
            Route::Drive(points) => {
                let Some(goal) = points.last() else {
                    self.finish(Ending::Stuck, probe);
                    return;
                };
                if self.is_worth_going(goal, length_m, params) {
                    self.drive_towards(robot, &points, params, probe);
                } else {
                    self.give_up(goal, GiveUp::NothingNew, params, probe);
                }
            }
        }
    }

    /// Goes on along the way, if one is being followed and still worth it.
    pub(super) fn follow_way(
        &mut self,
        robot: &mut dyn Robot,
        params: &RapidParams,
        probe: &mut dyn ExploreProbe,
    ) -> bool {
        let Some(&(last, _)) = self.rapid.way.first() else { return false };
        let goal = self.rapid.served.map_or(last, |served| served.vertex);
        if self.maps[0].frontier_at(goal) <= 0.0 {
            self.rapid.way.clear();
            self.rapid.served = None;
            return false;
        }
        self.rapid.turns_here = 0;
        self.rapid.pursuit = None;
        if params.teleport {
            let legs = std::mem::take(&mut self.rapid.way);
            for (i, (to, length_m)) in legs.into_iter().enumerate().rev() {
                self.repeat(robot, to, length_m, i == 0, probe);
            }
        } else if let Some((to, length_m)) = self.rapid.way.pop() {
            self.repeat(robot, to, length_m, true, probe);
        }
        if self.rapid.way.is_empty()
            && let Some(served) = self.rapid.served.take()
        {
            let vertex_from_body = self.standing.vertex_from_body;
            let goal = vertex_from_body.inverse_transform(&served.goal_in_last);
            self.rapid.behind = Some(Behind::new(None, goal, params));
        }
        true
    }

    /// Sets out along a way of links, in driving order, that leads somewhere.
    pub(super) fn set_out(
        &mut self,
        robot: &mut dyn Robot,
        mut way: Vec<(VertexId, f64)>,
        params: &RapidParams,
        probe: &mut dyn ExploreProbe,
    ) {
        self.tell_route(&Route::Repeat(way.clone()), probe);
        way.reverse();
        self.rapid.way = way;
        self.follow_way(robot, params, probe);
    }

    /// Tells the probe of a planned way; returns its length, metres.
    fn tell_route(&self, route: &Route, probe: &mut dyn ExploreProbe) -> f64 {
        let length_m = length_m(route);
        probe.emit(PlannerEvent::RoutePlanned { standing: self.standing, route, length_m });
        length_m
    }
}

fn length_m(route: &Route) -> f64 {
    match route {
        Route::Repeat(legs) => legs.iter().map(|(_, length_m)| length_m).sum(),
        Route::Drive(points) => {
            let mut at = Point2::origin();
            let mut sum_m = 0.0;
            for point in points {
                sum_m += (point - at).norm();
                at = *point;
            }
            sum_m
        }
    }
}
