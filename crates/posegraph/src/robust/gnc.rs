//! Graduated non-convexity.

use super::believed::Believed;
use super::gate::{gate, scale_at};
use super::noise::Witnessed;
use crate::factors::Manifold;
use crate::solvers::Options;

/// By how much the surrogate comes nearer to its loss in each round (Yang et al. 2020, remark 5).
const STEP: f64 = 1.4;

/// Iterations in each round: the next round moves the target.
const ITERATIONS: usize = 3;

/// On the way what is believed as a whole counts up to this many times the scale of closures: a wrong
/// closure among them must not open the gate.
const WIDEST: f64 = 5.0;

/// Closures with witnesses are the start where they are at least one in this many.
const SEED_SHARE: usize = 10;

/// And at least this many.
const SEED_LEAST: usize = 3;

/// From that start the surrogate reaches this many times as far as the gate: what is farther off is no
/// matter of degree.
const FIRST_LEVEL: f64 = 100.0;

/// Rounds, at most.
const ROUNDS: usize = 200;

/// The loss at the end of the way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Target {
    Tls,
    GemanMcClure,
}

/// Poses, weights, rounds and iterations.
pub(super) struct Graduated<P> {
    pub poses: Vec<P>,
    pub weights: Vec<f64>,
    pub rounds: usize,
    pub iterations: usize,
}

/// Whether there are enough closures with witnesses to start from.
pub(super) fn enough<P: Manifold<D>, const D: usize>(
    believed: &Believed<P, D>,
    supported: &[bool],
) -> bool {
    let supported = supported.iter().filter(|own| **own).count();
    supported * SEED_SHARE >= believed.closures().count() && supported >= SEED_LEAST
}

pub(super) fn graduate<P: Manifold<D>, const D: usize>(
    believed: &Believed<P, D>,
    start: &[P],
    witnessed: &Witnessed,
    target: Target,
) -> Graduated<P> {
    let first = witnessed.scale.unwrap_or(1.0);
    let mut weights = believed.trusting.clone();
    let seeded = enough(believed, &witnessed.supported);
    if seeded {
        for index in believed.closures() {
            weights[index] = f64::from(u8::from(witnessed.supported[index]));
        }
    }
    let (mut poses, mut iterations) = believed.descend(start, &weights, &believed.options);
    let mut chi2 = believed.chi2(&poses);
    let mut scale = scale_at(believed, &chi2, &chi2, &weights, first, WIDEST).max(first);
    if !seeded {
        scale = first;
    }
    let mut limit = gate(scale, D);
    let worst = believed.closures().map(|k| chi2[k]).fold(0.0, f64::max);
    let mut level = 2.0 * worst;
    if seeded {
        level = level.min(FIRST_LEVEL * limit);
    }
    let short = Options { max_iterations: ITERATIONS, relative_decrease: 1e-2, ..believed.options };
    let mut rounds = 0;
    while worst > limit && rounds < ROUNDS {
        rounds += 1;
        let mut open = false;
        for index in believed.closures() {
            weights[index] = match target {
                Target::Tls => truncated(chi2[index], limit, limit / level),
                Target::GemanMcClure => {
                    let width = level.max(limit);
                    (width / (chi2[index] + width)).powi(2)
                }
            };
            open |= (1e-3..1.0 - 1e-3).contains(&weights[index]);
        }
        let (moved, done) = believed.descend(&poses, &weights, &short);
        poses = moved;
        iterations += done;
        chi2 = believed.chi2(&poses);
        scale = scale_at(believed, &chi2, &chi2, &weights, first, WIDEST);
        limit = gate(scale, D);
        let done = match target {
            Target::Tls => level < limit && !open,
            Target::GemanMcClure => level < limit,
        };
        if done || level < 1e-4 * limit {
            break;
        }
        level /= STEP;
    }
    Graduated { poses, weights, rounds, iterations }
}

/// The weight of the surrogate of truncated least squares (Yang et al. 2020, equation 14).
pub(super) fn truncated(chi2: f64, limit: f64, mu: f64) -> f64 {
    if chi2 <= limit * mu / (mu + 1.0) {
        1.0
    } else if chi2 >= limit * (mu + 1.0) / mu {
        0.0
    } else {
        ((limit / chi2 * mu * (mu + 1.0)).sqrt() - mu).clamp(0.0, 1.0)
    }
}
