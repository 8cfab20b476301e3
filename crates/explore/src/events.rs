//! What the exploration loop tells.

use geometry::Point2;
use maps2d::{Candidate, MapProbe, Route, Standing};
use pose::Se2;
use posegraph::EdgeKind;
use probe::{EdgeId, Probe, VertexId};

/// What the loop is doing (\[ISRR19\] 5).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// Towards a frontier in view.
    Reactive,
    /// On the way to the nearest frontier out of view.
    Deliberate,
    /// Nothing is left, or the step limit is reached.
    Done,
}

/// How the pose graph grew.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum GraphEvent {
    /// The robot founded a vertex where it stands.
    VertexAdded {
        /// The vertex.
        vertex: VertexId,
        /// Odometry alone: its frame in the frame of the first vertex.
        odom_from_vertex: Se2,
    },
    /// A measured relative pose was added.
    EdgeAdded {
        /// The edge.
        edge: EdgeId,
        /// Odometry or place recognition.
        kind: EdgeKind,
        /// Where it starts.
        a: VertexId,
        /// Where it ends.
        b: VertexId,
        /// Frame of `b` in the frame of `a`.
        a_from_b: Se2,
    },
    /// A place edge was taken back.
    EdgeWithdrawn {
        /// The edge.
        edge: EdgeId,
    },
}

/// Why a goal was given up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GiveUp {
    /// No motion towards it keeps even the least clearance.
    Blocked,
    /// The robot stood as near as it may and looked, and the frontier is still there.
    NothingNew,
}

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// The map has no frontier left that counts.
    Complete,
    /// The step limit was reached first.
    StepLimit,
    /// Frontier is left that counts, but the map offers no way to act on it.
    Stuck,
}

/// Steps of the policy (\[ISRR19\] 5, \[Zie18\] 2.9).
#[derive(Clone, Copy, Debug)]
pub enum PlannerEvent<'a> {
    /// The state changed.
    StateChanged {
        /// State before.
        from: State,
        /// State now.
        to: State,
    },
    /// The frontiers in view were scored; the least score wins.
    CandidatesScored {
        /// Where the robot stands.
        standing: Standing,
        /// Each candidate with its score; infinite where no motion towards it is allowed.
        scored: &'a [(Candidate, f64)],
    },
    /// A goal in view was chosen.
    GoalChosen {
        /// Where the robot stands.
        standing: Standing,
        /// The goal, in the body frame.
        goal_in_body: Point2,
    },
    /// A way to a frontier out of view was planned.
    RoutePlanned {
        /// Where the robot stands.
        standing: Standing,
        /// The way.
        route: &'a Route,
        /// Its length, metres.
        length_m: f64,
    },
    /// The robot turned in place.
    Turned {
        /// The angle, counter-clockwise, radians.
        angle_rad: f64,
    },
    /// The robot drove straight ahead.
    Drove {
        /// The distance, metres.
        distance_m: f64,
    },
    /// The robot repeated one link of the graph.
    LegRepeated {
        /// Where it stood.
        from: VertexId,
        /// Where it stands now.
        to: VertexId,
        /// The distance, metres.
        length_m: f64,
    },
    /// A goal was given up.
    GoalGivenUp {
        /// Where the robot stands.
        standing: Standing,
        /// The goal, in the body frame.
        goal_in_body: Point2,
        /// Why.
        why: GiveUp,
    },
    /// The run is over.
    Finished {
        /// Why.
        ending: Ending,
    },
}

/// A listener of everything that a run emits.
pub trait ExploreProbe: MapProbe + Probe<GraphEvent> + for<'a> Probe<PlannerEvent<'a>> {}

impl<P> ExploreProbe for P where
    P: MapProbe + Probe<GraphEvent> + for<'a> Probe<PlannerEvent<'a>> + ?Sized
{
}

probe::variants!(GraphEvent: VertexAdded, EdgeAdded, EdgeWithdrawn);
probe::variants!(
    PlannerEvent<'_>:
    StateChanged, CandidatesScored, GoalChosen, RoutePlanned, Turned, Drove, LegRepeated,
    GoalGivenUp, Finished
);
