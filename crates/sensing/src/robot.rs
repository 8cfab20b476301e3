//! What a policy can ask of a robot.

use pose::Se2;
use probe::VertexId;

use crate::{Odometry, PlaceMatch, Repeated, Scan};

/// A robot that turns, drives, repeats taught legs, scans and recognises places.
///
/// The caller names its poses: after each scan that founds a new vertex it calls
/// [`mark`](Self::mark), and later speaks of that place by the id. The robot itself knows no map.
pub trait Robot {
    /// Turns in place, counter-clockwise, radians.
    fn turn(&mut self, angle_rad: f64) -> Odometry;

    /// Drives straight ahead, metres (at least 0).
    fn forward(&mut self, distance_m: f64) -> Odometry;

    /// Repeats the taught leg to `to`, an edge away from the vertex that the robot stands on.
    ///
    /// `here_from_there` is what the graph says of that edge: the vertex `to` in the frame of the
    /// vertex that the robot stands on. The robot arrives heading along the leg.
    fn repeat(&mut self, to: VertexId, here_from_there: &Se2) -> Repeated;

    /// Takes a scan where the robot stands.
    fn scan(&mut self) -> Scan;

    /// Calls the place where the robot stands `vertex`; the frame of the vertex is the body's.
    fn mark(&mut self, vertex: VertexId);

    /// Known places that the robot recognises from the vertex it just marked.
    fn recognize(&mut self) -> Vec<PlaceMatch>;
}
