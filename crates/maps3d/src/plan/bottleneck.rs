//! Step 4: which faces a ball can pass.

use std::collections::VecDeque;

use solid::Point3;

use super::obstacles::Obstacles;
use super::space::middle_of;

/// Parts of a face that are looked at before it is given the benefit of the doubt.
const MOST_PARTS: usize = 40;

/// Whether the centre of a ball can be anywhere on a face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Passage {
    /// At this point the ball touches nothing.
    Open(Point3),
    /// Nobody knows: it was not found, nor ruled out.
    Unknown,
    /// Nowhere: each part of the face lies too near to an obstacle.
    Shut,
}

/// Whether a ball of `radius_m` can have its centre on a face.
///
/// Distance from the obstacles changes by no more than one moves. A part of the face, no point of which
/// lies farther than R from its middle, is ruled out where the middle's distance and R are less than the
/// radius together; otherwise it is cut into four, the largest first. So [`Passage::Shut`] is a proof
/// (to rounding), and a face that a ball can pass is never shut.
pub fn passage(face: &[Point3; 3], radius_m: f64, obstacles: &Obstacles) -> Passage {
    let mut parts = VecDeque::from([*face]);
    let mut looked_at = 0;
    while let Some([a, b, c]) = parts.pop_front() {
        if looked_at == MOST_PARTS {
            return Passage::Unknown;
        }
        looked_at += 1;
        let middle = middle_of([&a, &b, &c]);
        let Some(distance_m) = obstacles.within(&middle, radius_m) else {
            return Passage::Open(middle);
        };
        let reach_m = [a, b, c].iter().map(|p| (p - middle).norm()).fold(0.0, f64::max);
        if distance_m + reach_m < radius_m * (1.0 - 1e-9) {
            continue;
        }
        let halves = [(a, b), (b, c), (c, a)].map(|(p, q)| nalgebra::center(&p, &q));
        let [ab, bc, ca] = halves;
        parts.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], halves]);
    }
    Passage::Shut
}

/// The point of a face that is farthest from obstacles, as far as its middle and those of its parts
/// tell; and how far, up to `enough_m`.
pub fn clearest(face: &[Point3; 3], enough_m: f64, obstacles: &Obstacles) -> (Point3, f64) {
    let mut best = (middle_of([&face[0], &face[1], &face[2]]), -1.0);
    let mut parts = vec![*face];
    for _ in 0..4 {
        let mut next: Option<([Point3; 3], f64)> = None;
        for part in &parts {
            let middle = middle_of([&part[0], &part[1], &part[2]]);
            let distance_m = obstacles.within(&middle, enough_m).unwrap_or(enough_m);
            if distance_m > best.1 {
                best = (middle, distance_m);
            }
            if distance_m >= enough_m {
                return best;
            }
            let reach_m = part.iter().map(|p| (p - middle).norm()).fold(0.0, f64::max);
            if next.is_none_or(|(_, hope)| distance_m + reach_m > hope) {
                next = Some((*part, distance_m + reach_m));
            }
        }
        let Some(([a, b, c], _)) = next else { break };
        let halves = [(a, b), (b, c), (c, a)].map(|(p, q)| nalgebra::center(&p, &q));
        let [ab, bc, ca] = halves;
        parts = vec![[a, ab, ca], [ab, b, bc], [ca, bc, c], halves];
    }
    best
}
