//! A robot that is watched: it behaves as ever, and what it truly sees is written down.

use pose::Se2;
use probe::VertexId;
use sensing::{Odometry, PlaceMatch, Repeated, Robot, Scan};
use worlds::{SimRobot, Tally, View};

use crate::{Coverage, Verdict};

/// A simulated robot together with its true coverage, which each scan brings up to date.
///
/// A policy sees it as any [`Robot`]; its own methods tell the truth and are for reports and
/// viewers. It adds nothing to what the robot does or draws.
#[derive(Clone, Debug)]
pub struct Witness {
    robot: SimRobot,
    coverage: Coverage,
}

impl Witness {
    /// Watches a robot; `coverage` must be of the robot's place.
    pub fn new(robot: SimRobot, coverage: Coverage) -> Self {
        Self { robot, coverage }
    }

    /// The robot.
    pub fn robot(&self) -> &SimRobot {
        &self.robot
    }

    /// What was truly seen so far.
    pub fn coverage(&self) -> &Coverage {
        &self.coverage
    }

    /// Sums over everything that the robot did.
    pub fn tally(&self) -> &Tally {
        self.robot.tally()
    }

    /// The true pose.
    pub fn world_from_body(&self) -> Se2 {
        self.robot.world_from_body()
    }

    /// What the last scan truly saw.
    pub fn view(&self) -> &View {
        self.robot.view()
    }

    /// The cells first seen since the last call, as indices into the coverage.
    pub fn take_newly_seen(&mut self) -> Vec<usize> {
        self.coverage.take_newly_seen()
    }

    /// The judgement, were the run to end here.
    pub fn verdict(&self, believed_complete: bool) -> Verdict {
        Verdict::new(&self.coverage, self.robot.tally(), believed_complete)
    }
}

impl Robot for Witness {
    fn turn(&mut self, angle_rad: f64) -> Odometry {
        self.robot.turn(angle_rad)
    }

    fn forward(&mut self, distance_m: f64) -> Odometry {
        self.robot.forward(distance_m)
    }

    fn repeat(&mut self, to: VertexId, length_m: f64) -> Repeated {
        self.robot.repeat(to, length_m)
    }

    fn scan(&mut self) -> Scan {
        let scan = self.robot.scan();
        self.coverage.see(self.robot.view(), self.robot.tally().distance_m);
        scan
    }

    fn mark(&mut self, vertex: VertexId) {
        self.robot.mark(vertex);
    }

    fn recognize(&mut self) -> Vec<PlaceMatch> {
        self.robot.recognize()
    }
}
