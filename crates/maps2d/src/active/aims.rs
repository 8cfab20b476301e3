//! The way on: where ways lead to, and when that is given up (\[Zie18\] 2.9.2, 2.9.3).

use geometry::Point2;
use pose::Se2;
use probe::VertexId;

use super::ActiveArea;
use crate::{ExplorationMap, Route, Standing};

/// Goals so near to each other are one, metres.
const AIM_M: f64 = 0.5;

/// A goal that ways led to anew more often than this is given up: as the robot moves, so does the
/// area that reachability is judged in, and two goals may each be the nearest from where the way to
/// the other leads.
const MOST_AIMS: u32 = 6;

/// The goals that ways have led to, and how often each was taken up anew.
#[derive(Clone, Debug, Default)]
pub(super) struct Aims {
    of: Vec<(VertexId, Point2, u32)>,
    last: Option<usize>,
}

impl Aims {
    /// Takes a goal, given in the frame of a vertex; false if it was taken up too often.
    fn take(
        &mut self,
        at: Point2,
        vertex: VertexId,
        is_trip: bool,
        pose: impl Fn(VertexId) -> Se2,
    ) -> bool {
        let goal = pose(vertex).transform(&at);
        let near =
            |aim: &(VertexId, Point2, u32)| (pose(aim.0).transform(&aim.1) - goal).norm() <= AIM_M;
        let index = self.of.iter().position(near).unwrap_or_else(|| {
            self.of.push((vertex, at, 0));
            self.of.len() - 1
        });
        // A way along the graph is a trip of its own each time, though it may lead to the same place.
        if is_trip || self.last != Some(index) {
            self.last = Some(index);
            self.of[index].2 += 1;
        }
        self.of[index].2 <= MOST_AIMS
    }
}

impl ActiveArea {
    /// The way to the nearest goal that ways have not led to too often; those that they have are given
    /// up, each for good, so this ends.
    pub(super) fn way_on(&mut self, standing: &Standing) -> Option<Route> {
        let active = self.area(standing.vertex);
        let region = self.region_inside(&active);
        let map_from_body = self.map_from_body(standing);
        let map_from_vertex = self.correction.pose(standing.vertex);
        loop {
            let open = self.open_inside(&active);
            let through = self.planner.route(&region, &open, &map_from_body);
            let route = through.or_else(|| self.way_back(standing.vertex))?;
            let goals = self.goals_of(&route, &map_from_body);
            let Some(goal) = goals.first() else { return Some(route) };
            let at_in_vertex = map_from_vertex.inverse_transform(goal);
            let is_trip = matches!(route, Route::Repeat(_));
            let pose = |vertex| self.correction.pose(vertex);
            if self.aims.take(at_in_vertex, standing.vertex, is_trip, pose) {
                return Some(route);
            }
            for goal in &goals {
                let at_in_vertex = map_from_vertex.inverse_transform(goal);
                self.given_up.add(standing.vertex, at_in_vertex, AIM_M);
            }
            let left_m = self.open.summary().open_m;
            self.measure();
            if self.open.summary().open_m >= left_m {
                return None;
            }
        }
    }

    /// Back along the graph, to the vertex with frontier that the fewest edges lead to.
    fn way_back(&self, from: VertexId) -> Option<Route> {
        let has_frontier = |vertex| vertex != from && self.frontier_at(vertex) > 0.0;
        self.links.way(from, has_frontier).map(Route::Repeat)
    }

    /// Where a way leads to, in the map's frame: its end, or all frontier of its last vertex.
    fn goals_of(&self, route: &Route, map_from_body: &Se2) -> Vec<Point2> {
        match route {
            Route::Drive(points) => {
                points.last().map(|goal| map_from_body.transform(goal)).into_iter().collect()
            }
            Route::Repeat(legs) => {
                let goal = legs.last().map(|&(vertex, _)| vertex);
                let parts = self.open.counting().flat_map(|chain| &chain.parts);
                let of_goal = parts.filter(|part| Some(part.tag.vertex) == goal);
                of_goal.map(|part| part.from + (part.to - part.from) * 0.5).collect()
            }
        }
    }
}
