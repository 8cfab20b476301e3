//! A robot that flies: what a policy can ask of it, and what it is told.

use pose::Se3;
use pose::nalgebra::Vector3;
use probe::VertexId;

use crate::DepthImage;

/// What odometry says of one commanded motion in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flight {
    /// The body after the motion, in the frame of the body before it.
    pub before_from_after: Se3,
    /// Distance flown, metres.
    pub distance_m: f64,
}

/// The end of one leg of teach and repeat in space: the robot is at a vertex again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Returned {
    /// The vertex that was flown to.
    pub vertex: VertexId,
    /// The body as the robot believes it, in the frame of that vertex.
    pub vertex_from_body: Se3,
    /// Distance flown, metres.
    pub distance_m: f64,
}

/// The robot recognised a place of space that it knows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpaceMatch {
    /// The vertex that was recognised.
    pub vertex: VertexId,
    /// The current vertex in the frame of the recognised one.
    pub known_from_current: Se3,
}

/// A robot that hovers upright, turns about the vertical, flies straight in any direction, repeats
/// taught legs, takes depth images and recognises places.
///
/// The twin of [`Robot`](crate::Robot) in space. The frame `body` has x ahead, y to the left, z up. The
/// caller names poses with [`mark`](Self::mark) and later speaks of them by the id; the robot itself
/// knows no map.
pub trait FlyingRobot {
    /// Turns on the spot about the vertical, counter-clockwise seen from above, radians.
    fn turn(&mut self, yaw_rad: f64) -> Flight;

    /// Flies straight by a vector in the frame `body`, metres, without turning.
    fn fly(&mut self, by_in_body: &Vector3<f64>) -> Flight;

    /// Repeats the taught way to `to`, one edge of the pose graph away; `length_m` is what it costs.
    /// The robot arrives with the heading of the vertex.
    fn repeat(&mut self, to: VertexId, length_m: f64) -> Returned;

    /// Takes a depth image from where the robot hovers.
    fn look(&mut self) -> DepthImage;

    /// Where the camera is mounted.
    fn body_from_camera(&self) -> Se3;

    /// Calls the place where the robot hovers `vertex`; the frame of the vertex is the body's.
    fn mark(&mut self, vertex: VertexId);

    /// Known places that the robot recognises from the vertex that it just marked.
    fn recognize(&mut self) -> Vec<SpaceMatch>;
}
