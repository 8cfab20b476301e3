//! What a policy can ask of a robot.

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

    /// Repeats the taught way to `to`, one link of the pose graph away.
    ///
    /// `length_m` is the length of that way, which is what the drive costs; a link may stand for
    /// several taught legs, so it can be longer than the straight line. The robot arrives heading
    /// along the straight line from where it stood, or unturned where the two places coincide.
    fn repeat(&mut self, to: VertexId, length_m: f64) -> Repeated;

    /// Takes a scan where the robot stands.
    fn scan(&mut self) -> Scan;

    /// Calls the place where the robot stands `vertex`; the frame of the vertex is the body's.
    fn mark(&mut self, vertex: VertexId);

    /// Known places that the robot recognises from the vertex it just marked.
    fn recognize(&mut self) -> Vec<PlaceMatch>;
}
