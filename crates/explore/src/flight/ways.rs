//! Ways through the views between here and there, beside those along the graph (step 4).

use geometry::Point3;
use pose::Se3;
use probe::VertexId;
use sensing::FlyingRobot;

use super::nearby::{legs_to, nearby};
use super::viewpoint::{Plan, STAYS_M};
use super::{FlightEvent, FlightExplorer, FlightProbe};

/// How the robot gets to somewhere that is not straight from where it hovers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Ways {
    /// By teach and repeat along the graph; nothing else is planned.
    Repeat,
    /// By teach and repeat along the graph; the way through the views is planned, told and counted.
    #[default]
    Told,
    /// By the way through the views where it is clearly shorter and each leg of it may be flown.
    Planned,
}

/// How often ways through views were sought, found and flown.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WaysTally {
    /// Times that the robot set out to somewhere that is not straight from where it was, and asked.
    pub asked: u64,
    /// Times that the map knew a way through views.
    pub found: u64,
    /// What these are long, metres.
    pub found_m: f64,
    /// What the same is long along the graph, metres.
    pub repeat_m: f64,
    /// Times that the way through views was set out on.
    pub begun: u64,
    /// Times that a leg of it could not be flown.
    pub refused: u64,
}

/// A way is clearly shorter than that along the graph where it is so long at most, as a share of that,
const SHORTER: f64 = 0.8;
/// and by so much, metres.
const GAIN_M: f64 = 0.5;

/// A way that is flown bend by bend.
#[derive(Clone, Debug)]
pub(super) struct Course {
    /// The vertex in whose frame the bends are: where the robot hovers.
    at: VertexId,
    /// What is left, the last first.
    bends: Vec<Point3>,
    /// The vertex that the way leads to, by repeating the last leg; or from where
    goal: VertexId,
    /// a place is flown to, and looked from.
    plan: Option<Plan>,
}

impl FlightExplorer {
    /// Asks for a way through views to a place in the frame of another vertex, and sets out on it if it is to be
    /// flown; false where the robot is to repeat the legs along the graph, `repeat_m` with the flight at their end.
    pub(super) fn sets_out_through_views(
        &mut self,
        goal: VertexId,
        plan: Option<&Plan>,
        repeat_m: f64,
        probe: &mut dyn FlightProbe,
    ) -> bool {
        if self.params.ways == Ways::Repeat || goal == self.hovering.vertex {
            return false;
        }
        self.ways.asked += 1;
        let hovering = self.hovering;
        let place = plan.map_or(Point3::origin(), |plan| plan.place);
        let least_m = self.params.margins_m.iter().copied().fold(f64::INFINITY, f64::min);
        let margin_m = if least_m.is_finite() { least_m } else { 0.0 };
        let radius_m = self.params.body_radius_m + margin_m;
        let way = self.maps[0].way_to(&hovering, goal, &place, radius_m, &mut *probe);
        let Some(in_body) = way.filter(|way| !way.is_empty()) else { return false };
        let starts = std::iter::once(Point3::origin()).chain(in_body.iter().copied());
        let way_m: f64 = starts.zip(&in_body).map(|(a, b)| (b - a).norm()).sum();
        let is_shorter = way_m <= SHORTER * repeat_m && way_m + GAIN_M <= repeat_m;
        let is_flown = self.params.ways == Ways::Planned && is_shorter;
        self.ways.found += 1;
        self.ways.found_m += way_m;
        self.ways.repeat_m += repeat_m;
        probe.emit(FlightEvent::WayWeighed {
            hovering,
            in_body: &in_body,
            way_m,
            repeat_m,
            is_flown,
        });
        if !is_flown {
            return false;
        }
        self.ways.begun += 1;
        let mut bends = self.hops(&in_body);
        if plan.is_none() {
            // The vertex itself is reached by repeating.
            bends.remove(0);
        }
        self.course = Some(Course { at: hovering.vertex, bends, goal, plan: plan.cloned() });
        true
    }

    /// A way as flights no longer than a hop, in the frame of the vertex, the last first.
    fn hops(&self, in_body: &[Point3]) -> Vec<Point3> {
        let mut hops = Vec::new();
        let mut from = Point3::origin();
        for to in in_body {
            let count = ((to - from).norm() / self.params.hop_m).ceil().max(1.0);
            let steps = (1..=count as usize).map(|i| from + (to - from) * (i as f64 / count));
            hops.extend(steps.map(|at| self.hovering.vertex_from_body.transform(&at)));
            from = *to;
        }
        hops.reverse();
        hops
    }

    /// Goes on along a way through views: looks where it leads to, flies its next leg if that keeps clear of all
    /// that was seen from here, or goes on along the graph. False where no such way is under way.
    pub(super) fn goes_on_through_views(
        &mut self,
        robot: &mut dyn FlyingRobot,
        probe: &mut dyn FlightProbe,
    ) -> bool {
        let Some(mut course) = self.course.take() else { return false };
        let here = self.hovering.vertex;
        let next = course.bends.last().copied().filter(|_| course.at == here);
        let Some(next) = next else {
            return self.repeats_to(robot, course, probe);
        };
        let is_last = course.bends.len() == 1;
        let mut last = None;
        if is_last && let Some(plan) = &course.plan {
            // Where the place is by now: places may have been recognised on the way.
            last = self.moved_here(plan);
            if last.is_none() {
                return self.repeats_to(robot, course, probe);
            }
        }
        let place = last.as_ref().map_or(next, |plan| plan.place);
        if place.coords.norm() >= STAYS_M {
            if let Some(yaw_rad) = self.blind_yaw(&place) {
                self.turn_to(robot, yaw_rad, probe);
                self.look(robot, probe);
                self.course = Some(course);
                return true;
            }
            if !(self.may_fly(here, &place) && self.may_leave(here, &place)) {
                self.ways.refused += 1;
                return self.repeats_to(robot, course, probe);
            }
        }
        if let Some(plan) = last {
            return self.carry_out(robot, plan, probe) || self.repeats_to(robot, course, probe);
        }
        course.bends.pop();
        self.fly_to(robot, &place, probe);
        let there = self.hovering.vertex;
        let odom_from = |vertex| self.odometry.get(vertex).copied().unwrap_or_default();
        let there_from_here = odom_from(there).inverse_mul(&odom_from(here));
        for bend in &mut course.bends {
            *bend = there_from_here.transform(bend);
        }
        course.at = there;
        self.course = Some(course);
        true
    }

    /// A plan in the frame of the vertex hovered at; `None` where that of the plan is in another part of the graph.
    fn moved_here(&self, plan: &Plan) -> Option<Plan> {
        let here = self.hovering.vertex;
        let near = nearby(&self.graph, here, f64::INFINITY);
        let at = near.iter().find(|near| near.vertex == plan.at)?;
        let here_from_at: &Se3 = &at.root_from_vertex;
        let targets = plan.targets.iter().map(|target| target.moved(here_from_at)).collect();
        Some(Plan { at: here, place: here_from_at.transform(&plan.place), targets })
    }

    /// Leaves a way through views: the rest is by teach and repeat.
    fn repeats_to(
        &mut self,
        robot: &mut dyn FlyingRobot,
        course: Course,
        probe: &mut dyn FlightProbe,
    ) -> bool {
        let all = nearby(&self.graph, self.hovering.vertex, f64::INFINITY);
        self.way = legs_to(&all, course.goal);
        if self.way.is_empty() {
            return false;
        }
        self.plan = course.plan;
        self.set_out(robot, probe);
        true
    }
}
