//! Which known keyframes are worth a look.

use crate::descriptor::Descriptor;
use crate::{CandidateParams, Seen};

/// A known keyframe that may be near the current one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Candidate {
    /// Where the graph has it, in the frame of the current keyframe.
    pub seen: Seen,
    /// What speaks against it: distance in units of the radius, difference of the descriptors, turn.
    pub cost: f64,
}

/// Keyframes closer than this in their order show the same.
const BESIDE: usize = 4;

/// Those of `reached` that may lie within the radius, the most promising first, and how many there were
/// before neighbours of one that was taken were left out.
pub fn candidates(
    params: &CandidateParams,
    reached: &[Seen],
    current: usize,
    driven_since: impl Fn(usize) -> f64,
    descriptors: &[Descriptor],
) -> (Vec<Candidate>, usize) {
    let mut all: Vec<Candidate> = reached
        .iter()
        .filter(|seen| seen.keyframe < current && driven_since(seen.keyframe) >= params.loop_m)
        .filter_map(|seen| {
            let distance_m = seen.root_from_keyframe.distance();
            let sigma_m = seen.sigma_m();
            if distance_m - params.sigmas * sigma_m > params.radius_m {
                return None;
            }
            let near = distance_m / params.radius_m.hypot(sigma_m);
            let alike = descriptors[seen.keyframe].distance(&descriptors[current]);
            let turned = 0.25 * (1.0 - seen.root_from_keyframe.angle().cos());
            Some(Candidate { seen: *seen, cost: near + alike + turned })
        })
        .collect();
    all.sort_by(|a, b| a.cost.total_cmp(&b.cost).then(a.seen.keyframe.cmp(&b.seen.keyframe)));
    let count = all.len();
    let mut taken: Vec<Candidate> = Vec::new();
    for candidate in all {
        let beside =
            |other: &Candidate| other.seen.keyframe.abs_diff(candidate.seen.keyframe) < BESIDE;
        if taken.len() < params.tried && !taken.iter().any(beside) {
            taken.push(candidate);
        }
    }
    (taken, count)
}
