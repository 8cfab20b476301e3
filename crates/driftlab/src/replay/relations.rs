//! Errors against published relations (Kümmerle et al. 2009): relative poses between two times.

use formats::laser::relations::Relation;
use pose::Se2;
use serde::Serialize;

use super::PlanarLog;
use super::between::{at, nearest};

/// A stamp within this of a scan is that of the scan, seconds.
const NEAR_SECS: f64 = 0.05;

/// Mean absolute errors of relative poses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct RelationErrors {
    /// Mean length of what is missing, metres; null without a relation.
    pub translation_m: Option<f64>,
    /// Mean angle of what is missing, degrees; null without a relation.
    pub rotation_deg: Option<f64>,
}

/// Errors of several estimates over the same relations.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct OverRelations {
    /// How many relations.
    pub count: u64,
    /// By the log's odometry.
    pub odometry: RelationErrors,
    /// By steps alone.
    pub tracked: RelationErrors,
    /// By relative placement: along the shortest path of the graph, nothing optimised.
    pub relative: RelationErrors,
    /// As everything agrees best.
    pub optimised: RelationErrors,
}

/// Errors over the relations that scans were taken at, and over the others.
///
/// Stamps of buffered logs come in bunches: two scans of the complete log, half a metre apart, may bear
/// stamps a few milliseconds from each other. Where the log at hand holds one of the two only, a relation
/// between them asks where a scan is relative to itself, which says nothing of any estimate.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Relations {
    /// Both stamps lie within 50 ms of a scan, and not of the same one.
    pub of_two_scans: OverRelations,
    /// Both stamps lie within 50 ms of a scan, be it the same one.
    pub at_scans: OverRelations,
    /// The others, between scans.
    pub interpolated: OverRelations,
}

/// The poses of all scans by each estimate.
pub(super) struct Estimates<'a> {
    pub odometry: &'a [Se2],
    pub tracked: &'a [Se2],
    pub optimised: &'a [Se2],
}

/// Whether both times of a relation are within those of the log.
pub(super) fn is_within(log: &PlanarLog, relation: &Relation) -> bool {
    let first = log.scans.first().map_or(f64::INFINITY, |scan| scan.stamp_secs);
    let last = log.scans.last().map_or(f64::NEG_INFINITY, |scan| scan.stamp_secs);
    let within = |secs: f64| secs >= first - NEAR_SECS && secs <= last + NEAR_SECS;
    within(relation.from_secs) && within(relation.to_secs)
}

/// Holds the estimates against relations; `relative` places the second scan in the frame of the first.
pub(super) fn relations(
    log: &PlanarLog,
    relations: &[Relation],
    estimates: &Estimates<'_>,
    mut relative: impl FnMut(f64, f64) -> Option<Se2>,
) -> Relations {
    // Of two scans, of one, between scans.
    let mut sums = [Sums::default(); 3];
    for relation in relations {
        let (from, to) = (relation.from_secs, relation.to_secs);
        let (Some(a), Some(b)) = (nearest(log, from), nearest(log, to)) else { continue };
        if !is_within(log, relation) {
            continue;
        }
        let class = if a.1.max(b.1) > NEAR_SECS { 2 } else { usize::from(a.0 == b.0) };
        let by = |poses: &[Se2]| Some(at(log, poses, from)?.inverse_mul(&at(log, poses, to)?));
        let all = [
            by(estimates.odometry),
            by(estimates.tracked),
            relative(from, to),
            by(estimates.optimised),
        ];
        sums[class].add(&relation.from_from_to, all);
    }
    let [of_two_scans, of_one, between] = sums;
    Relations {
        at_scans: of_two_scans.with(&of_one).mean(),
        of_two_scans: of_two_scans.mean(),
        interpolated: between.mean(),
    }
}

/// Sums over relations, by estimate.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    count: u64,
    of: [Sum; 4],
}

impl Sums {
    fn add(&mut self, truth: &Se2, between: [Option<Se2>; 4]) {
        self.count += 1;
        for (sum, between) in self.of.iter_mut().zip(between) {
            sum.add(truth, between.as_ref());
        }
    }

    fn with(mut self, other: &Self) -> Self {
        self.count += other.count;
        for (sum, other) in self.of.iter_mut().zip(&other.of) {
            sum.count += other.count;
            sum.metres += other.metres;
            sum.degrees += other.degrees;
        }
        self
    }

    fn mean(self) -> OverRelations {
        let [odometry, tracked, relative, optimised] = self.of.map(Sum::mean);
        OverRelations { count: self.count, odometry, tracked, relative, optimised }
    }
}

#[derive(Clone, Copy, Debug, Default)]
struct Sum {
    count: f64,
    metres: f64,
    degrees: f64,
}

impl Sum {
    fn add(&mut self, truth: &Se2, between: Option<&Se2>) {
        let Some(between) = between else { return };
        let error = truth.inverse_mul(between);
        self.count += 1.0;
        self.metres += error.distance();
        self.degrees += error.angle().abs().to_degrees();
    }

    fn mean(self) -> RelationErrors {
        let mean = |sum: f64| (self.count > 0.0).then(|| sum / self.count);
        RelationErrors { translation_m: mean(self.metres), rotation_deg: mean(self.degrees) }
    }
}
