//! All keyframes in one frame: as the steps chain them, and as everything agrees best.

use pose::Se2;
use pose::nalgebra::Matrix3;
use posegraph::{Factor, FactorGraph2, Options, Robust, optimize_robust};
use probe::Off;

use crate::Recognizer;
use crate::links::Measured;

/// Poses of all keyframes, and the closures that they do without.
#[derive(Clone, Debug, PartialEq)]
pub struct Settled {
    /// `map_from_keyframe` of every keyframe; the first is at the identity.
    pub map_from_keyframe: Vec<Se2>,
    /// Indices into [`Recognizer::closures`] of those that everything else speaks against, ascending.
    pub rejected: Vec<usize>,
}

impl Recognizer {
    /// The keyframes as the steps chain them.
    pub fn chained(&self) -> Vec<Se2> {
        let mut pose = Se2::identity();
        let mut poses: Vec<Se2> = self.keyframes().iter().take(1).map(|_| pose).collect();
        for step in self.steps() {
            pose = pose * step.from_from_to;
            poses.push(pose);
        }
        poses
    }

    /// The measurements as a graph for the optimiser: steps first, then closures.
    pub fn graph(&self) -> FactorGraph2 {
        let count = self.keyframes().len();
        let closures = self.closures().iter().map(|closure| &closure.measured);
        FactorGraph2 {
            ids: (0..count as u64).collect(),
            initial: self.chained().into_iter().map(Some).collect(),
            fixed: Vec::new(),
            factors: self.steps().iter().chain(closures).map(factor).collect(),
        }
    }

    /// The poses that agree best with all measurements, by graduated non-convexity: closures that
    /// everything else speaks against have no say.
    pub fn settled(&self) -> Settled {
        let graph = self.graph();
        let start = self.chained();
        if graph.factors.is_empty() {
            return Settled { map_from_keyframe: start, rejected: Vec::new() };
        }
        let solution =
            optimize_robust(&graph, &start, Robust::GncTls, &Options::default(), &mut Off);
        let steps = self.steps().len();
        let rejected = solution.rejected.iter().filter_map(|index| index.checked_sub(steps));
        Settled { map_from_keyframe: solution.solution.poses, rejected: rejected.collect() }
    }
}

fn factor(measured: &Measured) -> Factor<Se2, 3> {
    Factor {
        from: measured.from,
        to: measured.to,
        from_from_to: measured.from_from_to,
        information: measured.covariance.try_inverse().unwrap_or_else(Matrix3::identity),
    }
}
