//! What can be watched while a path is planned.

use solid::Point3;

use super::graph::{DualGraph, NodeId};
use super::space::Space;

/// Something that happened, told to a probe; the steps are those of `docs/plan.md`.
#[derive(Clone, Copy, Debug)]
pub enum PlanEvent<'a> {
    /// The graph was built; told once, by [`Planner::tell`](super::Planner::tell).
    Joined {
        /// The space.
        space: &'a Space,
        /// Its dual graph.
        graph: &'a DualGraph,
    },
    /// Start and goal were found in the space.
    Located {
        /// The start.
        from: Point3,
        /// The goal, if it is a point.
        to: Option<Point3>,
        /// The tetrahedron of the start.
        tetrahedron: u32,
    },
    /// A node was met for the first time, or more cheaply than before: it is open.
    Opened {
        /// The node.
        node: NodeId,
        /// Where it is.
        at: Point3,
        /// The node that the leg leaves, where that is.
        before: Option<Point3>,
        /// Its cost, metres; the number of legs where costs are not read.
        cost: f64,
    },
    /// An open node was closed, and all legs from it were looked at.
    Expanded {
        /// The node.
        node: NodeId,
        /// Where it is.
        at: Point3,
        /// The node before it.
        before: Option<Point3>,
        /// Its cost, metres; the number of legs where costs are not read.
        cost: f64,
        /// What is left at least, metres; 0 where nothing was estimated.
        estimate: f64,
    },
    /// A way was found.
    Routed {
        /// From the start through the nodes to the goal.
        points: &'a [Point3],
        /// The tetrahedra that it passes.
        corridor: &'a [u32],
        /// Its cost, metres.
        cost: f64,
        /// Expansions that it took.
        expansions: usize,
    },
    /// The cone programme was solved.
    Solved {
        /// Its polyline.
        points: &'a [Point3],
        /// Its length, metres.
        length_m: f64,
        /// Half-spaces that kept it from obstacles.
        half_spaces: usize,
    },
    /// A face of the corridor that the polyline missed takes part from now on.
    Activated {
        /// The face's corners.
        face: [Point3; 3],
    },
    /// The polyline came too near to an obstacle: a half-space keeps it away from now on.
    Separated {
        /// The point of the polyline that was kept from it before.
        from: Point3,
        /// The point of the obstacle.
        obstacle: Point3,
        /// How near it came, metres.
        distance_m: f64,
    },
    /// A shorter polyline was verified: inside of the corridor, clear of obstacles.
    Verified {
        /// The polyline.
        points: &'a [Point3],
        /// Its length, metres.
        length_m: f64,
    },
    /// The corridor is too narrow here; the next is searched without it.
    Blocked {
        /// Where.
        at: Point3,
        /// Distance of the polyline from the obstacle, metres.
        clearance_m: f64,
    },
    /// The plan is made.
    Finished {
        /// The path.
        points: &'a [Point3],
        /// Its length, metres.
        length_m: f64,
    },
    /// There is no way.
    Unreachable {
        /// Expansions that it took to know.
        expansions: usize,
    },
}

probe::variants!(PlanEvent<'_>: Joined, Located, Opened, Expanded, Routed, Solved, Activated, Separated, Verified,
    Blocked, Finished, Unreachable);
