//! A flying robot that is watched: it behaves as ever, and what it truly sees is written down.

use geometry::Vector3;
use pose::Se3;
use probe::VertexId;
use sensing::{DepthImage, Flight, FlyingRobot, Returned, SpaceMatch};
use worlds::{SimFlyer, SpaceView, Tally};

use super::VoxelCoverage;
use crate::Verdict;

/// A simulated flying robot together with its true coverage, which each look brings up to date.
///
/// A policy sees it as any [`FlyingRobot`]; its own methods tell the truth and are for reports and viewers.
/// It adds nothing to what the robot does or draws.
#[derive(Clone, Debug)]
pub struct FlightWitness {
    robot: SimFlyer,
    coverage: VoxelCoverage,
}

impl FlightWitness {
    /// Watches a robot; `coverage` must be of the robot's place.
    pub fn new(robot: SimFlyer, coverage: VoxelCoverage) -> Self {
        Self { robot, coverage }
    }

    /// The robot.
    pub fn robot(&self) -> &SimFlyer {
        &self.robot
    }

    /// What was truly seen so far.
    pub fn coverage(&self) -> &VoxelCoverage {
        &self.coverage
    }

    /// Sums over everything that the robot did.
    pub fn tally(&self) -> &Tally {
        self.robot.tally()
    }

    /// The true pose.
    pub fn world_from_body(&self) -> Se3 {
        self.robot.world_from_body()
    }

    /// What the last look truly saw.
    pub fn view(&self) -> &SpaceView {
        self.robot.view()
    }

    /// The voxels first seen since the last call, as indices into the coverage.
    pub fn take_newly_seen(&mut self) -> Vec<usize> {
        self.coverage.take_newly_seen()
    }

    /// The judgement, were the run to end here.
    pub fn verdict(&self, believed_complete: bool) -> Verdict {
        self.coverage.verdict(self.robot.tally(), believed_complete)
    }
}

impl FlyingRobot for FlightWitness {
    fn turn(&mut self, yaw_rad: f64) -> Flight {
        self.robot.turn(yaw_rad)
    }

    fn fly(&mut self, by_in_body: &Vector3) -> Flight {
        self.robot.fly(by_in_body)
    }

    fn repeat(&mut self, to: VertexId, length_m: f64) -> Returned {
        self.robot.repeat(to, length_m)
    }

    fn look(&mut self) -> DepthImage {
        let image = self.robot.look();
        self.coverage.see(self.robot.view(), self.robot.tally().distance_m);
        image
    }

    fn body_from_camera(&self) -> Se3 {
        self.robot.body_from_camera()
    }

    fn mark(&mut self, vertex: VertexId) {
        self.robot.mark(vertex);
    }

    fn recognize(&mut self) -> Vec<SpaceMatch> {
        self.robot.recognize()
    }
}
