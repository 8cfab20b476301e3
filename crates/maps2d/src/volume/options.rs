//! The choices that \[Zie18\] 2.4 makes differently.

use geometry::Point2;

use super::Sample;

/// When two neighbouring hits belong to different things.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum OcclusionRule {
    /// Their ranges differ by the gap or more (\[ISRR19\] 4.1).
    #[default]
    Range,
    /// Their forward coordinates, first minus second counter-clockwise, differ by more than the
    /// gap (\[Zie18\] eq. 2.4). The sign matters: a step away from the robot is not an occlusion.
    ForwardSigned,
}

/// Options of the construction; the defaults are those of \[ISRR19\].
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Options {
    /// How occlusions are told from surfaces.
    pub occlusion: OcclusionRule,
    /// Whether a frontier vertex is put into the middle of each edge that spans an occlusion, so
    /// that there is a place to go to (\[Zie18\] 2.4).
    pub insert_occlusion_vertex: bool,
    /// Hits closer than this to the hit kept before are dropped, metres; 0 keeps all
    /// (\[Zie18\] 2.4, "subsample"). The last hit before a miss or an occlusion always stays.
    pub thin_m: f64,
}

impl Options {
    /// Whether the edge from `a` to the next sample `b` spans an occlusion.
    pub fn is_occlusion(&self, a: &Sample, b: &Sample, gap_m: f64) -> bool {
        match self.occlusion {
            OcclusionRule::Range => (a.range_m - b.range_m).abs() >= gap_m,
            OcclusionRule::ForwardSigned => a.end_in_anchor.x - b.end_in_anchor.x > gap_m,
        }
    }

    /// The indices of the samples to keep, by rising bearing.
    ///
    /// `joined(i)` tells whether samples i and i + 1 bound one surface. A sample goes only where
    /// both its edges are surface, so no label changes.
    pub fn thin(&self, samples: &[Sample], joined: impl Fn(usize) -> bool) -> Vec<usize> {
        let mut kept: Vec<usize> = Vec::with_capacity(samples.len());
        for i in 0..samples.len() {
            let inner = i > 0 && i + 1 < samples.len() && joined(i - 1) && joined(i);
            let near = kept.last().is_some_and(|&last| {
                distance(&samples[last].end_in_anchor, &samples[i].end_in_anchor) < self.thin_m
            });
            if !(inner && near) {
                kept.push(i);
            }
        }
        kept
    }
}

fn distance(a: &Point2, b: &Point2) -> f64 {
    (a - b).norm()
}
