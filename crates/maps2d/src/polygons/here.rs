//! What is seen from where the robot stands: the one view without drift.

use geometry::Point2;
use probe::VertexId;
use sensing::Scan;

use crate::volume::{LocalVolume, Samples, VolumeParams, build, tell_of_volume};
use crate::{Clearance, MapProbe, Standing};

/// A goal counts as in view if the line of sight is free up to so near before it, metres: it lies on
/// the boundary itself.
const BEFORE_GOAL_M: f64 = 0.02;

/// The volume of the vertex that the robot stands on, from the scans of this visit.
#[derive(Clone, Debug)]
pub(crate) struct Here {
    params: VolumeParams,
    samples: Samples,
    volume: LocalVolume,
    at: Option<VertexId>,
}

impl Here {
    pub fn new(params: VolumeParams) -> Self {
        Self { params, samples: Samples::new(), volume: LocalVolume::empty(), at: None }
    }

    /// Takes a scan; the volume is then that of everything seen on this visit.
    pub fn scanned(&mut self, standing: &Standing, scan: &Scan, probe: &mut dyn MapProbe) {
        let merged = self.at == Some(standing.vertex);
        if !merged {
            self.samples = Samples::new();
            self.at = Some(standing.vertex);
        }
        self.samples.add(scan, &standing.vertex_from_body);
        self.volume = build(&self.samples, &self.params).unwrap_or_else(|_| LocalVolume::empty());
        tell_of_volume(standing, scan, (&self.samples, &self.volume), merged, probe);
    }

    /// The volume seen from a vertex on this visit, if the robot stands there.
    pub fn volume(&self, vertex: VertexId) -> Option<&LocalVolume> {
        (self.at == Some(vertex)).then_some(&self.volume)
    }

    pub fn clearance(&self, standing: &Standing, to_in_body: &Point2) -> Clearance {
        match self.volume(standing.vertex) {
            Some(view) => view.motion_clearance(&standing.vertex_from_body.transform(to_in_body)),
            None => Clearance::NONE,
        }
    }

    pub fn detour(
        &self,
        standing: &Standing,
        goal_in_body: &Point2,
        clearance_m: f64,
    ) -> Option<Point2> {
        let goal = standing.vertex_from_body.transform(goal_in_body);
        let stop = self.volume(standing.vertex)?.detour(&goal, clearance_m)?;
        Some(standing.vertex_from_body.inverse_transform(&stop))
    }

    /// Whether the straight way to a point on the boundary of what is known is in view.
    pub fn sees(&self, standing: &Standing, goal_in_body: &Point2) -> bool {
        let Some(view) = self.volume(standing.vertex) else { return false };
        let goal = standing.vertex_from_body.transform(goal_in_body);
        let distance_m = goal.coords.norm();
        if distance_m <= BEFORE_GOAL_M {
            return true;
        }
        let before = Point2::from(goal.coords * (1.0 - BEFORE_GOAL_M / distance_m));
        view.polygon.contains(&before)
    }

    /// Whether a point lies in reach in a direction that was not looked into.
    pub fn is_unseen_towards(&self, standing: &Standing, point_in_body: &Point2) -> bool {
        let point = standing.vertex_from_body.transform(point_in_body);
        self.volume(standing.vertex).is_some_and(|view| view.is_unseen_towards(&point))
    }

    pub fn heap_bytes(&self) -> usize {
        self.volume.heap_bytes() + self.samples.len() * size_of::<crate::volume::Sample>()
    }
}
