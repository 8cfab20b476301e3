//! Relative motions that a robot is told: by its wheels, or by recognising a place.

use pose::Se2;
use probe::VertexId;

/// What the wheels say of one commanded motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Odometry {
    /// The body after the motion, in the frame of the body before it.
    pub before_from_after: Se2,
    /// Distance driven, metres.
    pub distance_m: f64,
    /// The known vertex that the robot now stands on, where its localisation put it onto one
    /// (\[Zie18\] 3.1), with the body in that vertex's frame.
    pub snapped: Option<(VertexId, Se2)>,
}

/// The end of one leg of teach and repeat: the robot stands on a vertex again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Repeated {
    /// The vertex that was driven to.
    pub vertex: VertexId,
    /// The body as the robot believes it, in the frame of that vertex.
    pub vertex_from_body: Se2,
    /// Distance driven, metres.
    pub distance_m: f64,
}

/// The robot recognised a place that it knows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaceMatch {
    /// The vertex that was recognised.
    pub vertex: VertexId,
    /// The current vertex in the frame of the recognised one.
    pub known_from_current: Se2,
}
