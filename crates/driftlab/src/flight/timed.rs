//! A stopwatch around the simulated flyer: its time is nobody's cost.

use std::time::{Duration, Instant};

use geometry::Vector3;
use pose::Se3;
use probe::VertexId;
use sensing::{DepthImage, Flight, FlyingRobot, Returned, SpaceMatch};

/// A flying robot whose own time is taken.
pub(super) struct TimedFlyer<'a> {
    robot: &'a mut dyn FlyingRobot,
    pub(super) spent: Duration,
}

impl<'a> TimedFlyer<'a> {
    pub(super) fn new(robot: &'a mut dyn FlyingRobot) -> Self {
        Self { robot, spent: Duration::ZERO }
    }

    fn timed<T>(&mut self, work: impl FnOnce(&mut dyn FlyingRobot) -> T) -> T {
        let start = Instant::now();
        let result = work(self.robot);
        self.spent += start.elapsed();
        result
    }
}

impl FlyingRobot for TimedFlyer<'_> {
    fn turn(&mut self, yaw_rad: f64) -> Flight {
        self.timed(|robot| robot.turn(yaw_rad))
    }

    fn fly(&mut self, by_in_body: &Vector3) -> Flight {
        self.timed(|robot| robot.fly(by_in_body))
    }

    fn repeat(&mut self, to: VertexId, length_m: f64) -> Returned {
        self.timed(|robot| robot.repeat(to, length_m))
    }

    fn look(&mut self) -> DepthImage {
        self.timed(|robot| robot.look())
    }

    fn body_from_camera(&self) -> Se3 {
        self.robot.body_from_camera()
    }

    fn mark(&mut self, vertex: VertexId) {
        self.timed(|robot| robot.mark(vertex));
    }

    fn recognize(&mut self) -> Vec<SpaceMatch> {
        self.timed(|robot| robot.recognize())
    }
}
