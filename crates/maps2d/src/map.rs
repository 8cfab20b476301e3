//! What a policy asks of a map, whatever represents it.

use geometry::{Point2, Vector2};
use pose::Se2;
use posegraph::PoseGraph;
use probe::{EdgeId, VertexId};
use sensing::Scan;

use crate::MapProbe;
use crate::grid::Cells;

/// Where the robot believes that it stands: at a vertex, maybe turned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Standing {
    /// The vertex.
    pub vertex: VertexId,
    /// The body in the frame of the vertex; it only turns.
    pub vertex_from_body: Se2,
}

/// A frontier that can be seen from where the robot stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Candidate {
    /// Points to go to, in the body frame, metres: the best first, the others for where it cannot
    /// be reached.
    pub goals_in_body: [Point2; 3],
    /// Unit vector across the frontier at the first goal, into the unknown, in the body frame; zero
    /// where the map knows none.
    pub normal_in_body: Vector2,
    /// Length of the frontier that hangs together there, metres.
    pub length_m: f64,
    /// Whether turning is enough to look behind it.
    pub turn_only: bool,
    /// A name that stays the same while the map does not change.
    pub tag: u64,
}

/// How near a straight motion comes to known obstacles, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clearance {
    /// At its start.
    pub at_start_m: f64,
    /// The least along all of it; 0 where it leaves known free space.
    pub along_m: f64,
    /// The least along what comes after its first [`LEAVING_M`](Self::LEAVING_M).
    pub after_m: f64,
    /// At its end.
    pub at_end_m: f64,
}

impl Clearance {
    /// Leaves known free space.
    pub const NONE: Self = Self { at_start_m: 0.0, along_m: 0.0, after_m: 0.0, at_end_m: 0.0 };

    /// Within this distance a robot that stands too near to something has to get away from it,
    /// metres.
    pub const LEAVING_M: f64 = 0.1;

    /// Whether the motion keeps a distance; or, where it starts nearer than that, leaves at once, at
    /// an angle of 30 degrees or more, and ends at that distance. A robot that was pushed to a wall
    /// can so leave it, but does not slide along it.
    pub fn keeps(&self, least_m: f64) -> bool {
        let away = self.along_m > 0.0
            && self.along_m >= 0.99 * self.at_start_m
            && self.after_m >= 0.5 * Self::LEAVING_M.min(least_m)
            && self.at_end_m >= least_m;
        self.along_m >= least_m || (self.at_start_m < least_m && away)
    }

    /// The same for a round body instead of a point: how near its hull comes.
    ///
    /// A body that is seen to overlap with something counts as touching it, so that it can leave.
    pub fn around_body(&self, radius_m: f64) -> Self {
        let body_m = radius_m.min(0.999 * self.at_start_m);
        Self {
            at_start_m: self.at_start_m - body_m,
            along_m: self.along_m - body_m,
            after_m: self.after_m - body_m,
            at_end_m: self.at_end_m - body_m,
        }
    }
}

/// What is left to explore, as the map believes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Frontier {
    /// Length of the frontier that counts, metres.
    pub open_m: f64,
    /// Length of the frontier that does not: slivers below the named length, and what could not be
    /// reached, metres.
    pub ignored_m: f64,
    /// Volumes or cells that have frontier that counts.
    pub places: usize,
}

/// How to get to the nearest frontier out of view.
#[derive(Clone, Debug, PartialEq)]
pub enum Route {
    /// By teach and repeat along the graph: the vertices in driving order, each with the length of
    /// the link that leads to it, metres. Empty where the robot stands at the goal already.
    Repeat(Vec<(VertexId, f64)>),
    /// Straight legs through free space: points in the body frame of now.
    Drive(Vec<Point2>),
}

/// A place from which a goal can be reached that cannot be from where it was seen.
#[derive(Clone, Debug, PartialEq)]
pub struct Vantage {
    /// The way there by teach and repeat: the vertices in driving order, each with the length of the
    /// link that leads to it, metres. Never empty.
    pub way: Vec<(VertexId, f64)>,
    /// The goal, in the frame of the last vertex of the way.
    pub goal_in_vertex: Point2,
}

/// What a map with one global frame believes, in that frame; for judging it, not for deciding.
#[derive(Clone, Debug)]
pub struct GlobalBelief {
    /// Free, occupied and unknown space as cells.
    pub cells: Cells,
    /// What is believed to be solid, as segments; a point where it is not known better.
    pub walls: Vec<(Point2, Point2)>,
    /// Where each vertex is believed to be.
    pub map_from_vertex: Vec<Se2>,
}

/// A map of the plane that exploration runs on: fed with scans and graph events, asked for frontiers.
///
/// Points and goals are in the body frame of [`Standing`], so that no answer needs a global frame.
pub trait ExplorationMap {
    /// The name of the representation, as in configs and results: `relative`, `grid`, ...
    fn kind(&self) -> &'static str;

    /// Edges were added to `graph`, all with one vertex in common; it may have no scan yet.
    fn edges_added(&mut self, graph: &PoseGraph, edges: &[EdgeId], probe: &mut dyn MapProbe);

    /// A place edge of `graph` was withdrawn.
    fn edge_withdrawn(&mut self, graph: &PoseGraph, edge: EdgeId, probe: &mut dyn MapProbe);

    /// Poses of the graph were estimated anew: `map_from_vertex` by vertex.
    fn poses_reestimated(&mut self, map_from_vertex: &[Se2], probe: &mut dyn MapProbe);

    /// A scan was taken at a vertex, or after turning in place there.
    fn scanned(&mut self, standing: &Standing, scan: &Scan, probe: &mut dyn MapProbe);

    /// What is left to explore.
    fn frontier(&self) -> Frontier;

    /// The frontiers in view, in no particular order; `out` is overwritten.
    fn in_view(&mut self, standing: &Standing, out: &mut Vec<Candidate>);

    /// Frontiers of other places nearby that lie in directions not looked into from here: turning
    /// may be enough to settle them. `out` is overwritten.
    fn around(&mut self, standing: &Standing, out: &mut Vec<Candidate>);

    /// How near the straight motion `to_in_body` comes to known obstacles.
    fn clearance(&mut self, standing: &Standing, to_in_body: &Point2) -> Clearance;

    /// The way to the nearest frontier, or `None` if none is left that can be reached.
    fn route(&mut self, standing: &Standing, clearance_m: f64) -> Option<Route>;

    /// Nothing counts any more: a map that has doubts opens again what it is least sure of. Returns
    /// whether any frontier counts now; false, sooner or later, for good.
    fn look_again(&mut self, _probe: &mut dyn MapProbe) -> bool {
        false
    }

    /// Whether its frontier belongs to vertices, so that [`route_to`](Self::route_to) can leave some out.
    fn has_frontier_by_vertex(&self) -> bool {
        false
    }

    /// The way to the nearest frontier of a vertex that `comes_now`, or `None` if there is none.
    ///
    /// A map whose frontier belongs to no vertex leads to the nearest of all.
    fn route_to(
        &mut self,
        standing: &Standing,
        clearance_m: f64,
        comes_now: &dyn Fn(VertexId) -> bool,
    ) -> Option<Route> {
        let _ = comes_now;
        self.route(standing, clearance_m)
    }

    /// Length of the frontier that counts at a vertex, metres; 0 means that a way to it is not worth
    /// going on with.
    fn frontier_at(&self, vertex: VertexId) -> f64;

    /// A point in view that keeps `clearance_m` from everything on the straight way to it and on the
    /// straight way from it to `goal_in_body`; the one with the shortest way. For a goal round a
    /// corner that the robot stands too near to.
    fn detour(
        &self,
        standing: &Standing,
        goal_in_body: &Point2,
        clearance_m: f64,
    ) -> Option<Point2>;

    /// The nearest place along the graph, other than the one that the robot stands on, from which the
    /// straight way to `goal_in_body` keeps `clearance_m`; `None` where the map knows none, or goes
    /// by ways that need none.
    fn vantage(
        &mut self,
        standing: &Standing,
        goal_in_body: &Point2,
        clearance_m: f64,
    ) -> Option<Vantage>;

    /// Frontier within `radius_m` of `goal_in_body` does not count from now on.
    ///
    /// With `everywhere` the robot got as near as it may, looked, and it is still there: that holds
    /// for every volume nearby, now and later. Without, only no motion towards it is allowed from
    /// here, and what other places see of it stays.
    fn give_up(
        &mut self,
        standing: &Standing,
        goal_in_body: &Point2,
        radius_m: f64,
        everywhere: bool,
        probe: &mut dyn MapProbe,
    );

    /// Whether the map takes a point in the body frame for known, free or occupied: so that beliefs of
    /// several maps can be compared where the robot stands.
    fn knows(&self, _standing: &Standing, _point_in_body: &Point2) -> bool {
        false
    }

    /// All that the map believes, if it has one global frame. Cost: the whole map.
    fn global(&self) -> Option<GlobalBelief> {
        None
    }

    /// How often the map has corrected its poses: 0 for maps that never do.
    fn corrections(&self) -> u64 {
        0
    }

    /// How often the map found itself broken, and kept a view out: 0 for maps that cannot be.
    fn invalid(&self) -> u64 {
        0
    }

    /// Memory held, bytes.
    fn bytes(&self) -> usize;
}
