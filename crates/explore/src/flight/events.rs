//! What the exploration of space tells.

use geometry::Point3;
use maps3d::{FlightRoute, Hovering, Map3dProbe};
use pose::Se3;
use posegraph::EdgeKind;
use probe::{EdgeId, Probe, VertexId};
use sensing::DepthImage;

use super::Target;
use crate::{Ending, State};

/// Why frontier was given up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum FlightGiveUp {
    /// No place that the robot can get to has it in view: not by what was seen from there, and not by all that
    /// is believed to be free.
    Unreachable,
    /// It was looked at, and from wherever that was, something solid stands before it.
    Hidden,
    /// It was looked at from as many places as are tried, or visited often in vain, and is still there.
    NothingNew,
}

/// Steps of the exploration of space; the numbers are those of the module page.
#[derive(Clone, Copy, Debug)]
pub enum FlightEvent<'a> {
    /// The state changed.
    StateChanged {
        /// State before.
        from: State,
        /// State now.
        to: State,
    },
    /// The robot founded a vertex where it hovers.
    VertexAdded {
        /// The vertex.
        vertex: VertexId,
        /// Odometry alone: its frame in the frame of the first vertex.
        odom_from_vertex: Se3,
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
        a_from_b: Se3,
    },
    /// The robot turned on the spot (1).
    Turned {
        /// The angle, counter-clockwise from above, radians.
        yaw_rad: f64,
    },
    /// A depth image was taken (1).
    Looked {
        /// Where the robot hovers.
        hovering: Hovering,
        /// Where the camera is.
        vertex_from_camera: Se3,
        /// The image.
        image: &'a DepthImage,
    },
    /// Places to look from were weighed against each other (2).
    ViewpointsScored {
        /// The vertex from which they are flown to.
        at: VertexId,
        /// Frontier to be looked at, in the frame of the vertex.
        targets: &'a [Target],
        /// Places in the frame of the vertex, each with its score, the best first.
        scored: &'a [(Point3, f64)],
    },
    /// A place to look from was chosen (2).
    ViewpointChosen {
        /// The vertex from which it is flown to.
        at: VertexId,
        /// The place in the frame of the vertex.
        place_in_vertex: Point3,
        /// Area of the frontier in view of it, square metres.
        area_m2: f64,
        /// Distance that is kept beside the radius of the body, metres.
        margin_m: f64,
    },
    /// A way to frontier elsewhere was planned (4).
    RoutePlanned {
        /// Where the robot hovers.
        hovering: Hovering,
        /// The way.
        route: &'a FlightRoute,
        /// Its length, metres.
        length_m: f64,
    },
    /// A way through the views between was found to somewhere that is not straight from here (4).
    WayWeighed {
        /// Where the robot hovers.
        hovering: Hovering,
        /// Its bends and its end, in the frame `body`.
        in_body: &'a [Point3],
        /// Its length, metres.
        way_m: f64,
        /// What is flown along the graph otherwise, metres.
        repeat_m: f64,
        /// Whether the robot sets out on it; else it repeats.
        is_flown: bool,
    },
    /// The robot flew straight.
    Flew {
        /// The distance, metres.
        distance_m: f64,
    },
    /// The robot repeated one link of the graph (4).
    LegRepeated {
        /// Where it hovered.
        from: VertexId,
        /// Where it hovers now.
        to: VertexId,
        /// The distance, metres.
        length_m: f64,
    },
    /// Frontier was given up (5).
    FrontierGivenUp {
        /// The vertex whose views it belongs to.
        owner: VertexId,
        /// Where it is, in the frame of that vertex.
        place_in_vertex: Point3,
        /// Its area, square metres.
        area_m2: f64,
        /// Why.
        why: FlightGiveUp,
    },
    /// The run is over (6).
    Finished {
        /// Why.
        ending: Ending,
    },
}

/// A listener of everything that a run in space emits.
pub trait FlightProbe: Map3dProbe + for<'a> Probe<FlightEvent<'a>> {}

impl<P> FlightProbe for P where P: Map3dProbe + for<'a> Probe<FlightEvent<'a>> + ?Sized {}

probe::variants!(
    FlightEvent<'_>:
    StateChanged, VertexAdded, EdgeAdded, Turned, Looked, ViewpointsScored, ViewpointChosen, RoutePlanned,
    WayWeighed, Flew, LegRepeated, FrontierGivenUp, Finished
);
