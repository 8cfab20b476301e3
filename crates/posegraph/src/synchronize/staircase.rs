//! The Riemannian staircase (Boumal 2015; Rosen et al. 2019, algorithm 1).

use probe::Probe;

use super::event::SynchronizeEvent;
use super::newton::{Descent, Limits, descend};
use super::problem::Problem;
use super::rounding::round;
use super::stiefel::orthonormalise;
use crate::certificate::dual::{DualMatrix, Smallest, TestLimits};

/// How far a synchronisation goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SynchronizeOptions {
    /// Dimensions that the rotations' columns may be given.
    pub max_rank: usize,
    /// Newton iterations at each rank.
    pub iterations: usize,
    /// A descent ends where the decrease that is left is below this share of the cost.
    pub relative_decrease: f64,
    /// The certificate allows the optimum to be lower by this share of the cost.
    pub relative_gap: f64,
}

impl Default for SynchronizeOptions {
    fn default() -> Self {
        Self { max_rank: 10, iterations: 200, relative_decrease: 1e-12, relative_gap: 1e-6 }
    }
}

/// What the staircase came to.
pub(crate) struct Climbed {
    /// A stationary point of rank `d` with rotations in SO(d).
    pub(crate) x: Vec<f64>,
    /// Its cost.
    pub(crate) cost: f64,
    /// What is known of the certificate matrix there.
    pub(crate) smallest: Smallest,
    /// The optimum of the relaxation is at least this, where a point was certified.
    pub(crate) lower_bound: Option<f64>,
    /// Highest rank that was used.
    pub(crate) rank: usize,
    /// Whether the gradient vanished to the asked precision.
    pub(crate) converged: bool,
}

/// What the certificate's test is given.
///
/// `η`, above minus which eigenvalues count as not negative: the cost exceeds the optimum by at most
/// `η d n` then, so it is the allowed gap shared out over the `d n` columns; never less than what
/// rounding leaves of the largest entry.
fn test_limits<const B: usize>(problem: &Problem<B>, cost: f64, relative_gap: f64) -> TestLimits {
    let columns = (problem.rows() / B * (B - 1)).max(1) as f64;
    let (largest, _) = problem.largest_diagonal();
    let gap = relative_gap * cost;
    // A gap that is wholly used up by `η d n` leaves none for rounding of the sums.
    TestLimits { eta: (gap / columns).max(1e-15 * largest), most: 1e-12 * largest, gap: 1.01 * gap }
}

/// Descends from `x` at rank `d`, tests the certificate, and climbs while it fails.
pub(crate) fn climb<const B: usize>(
    problem: &Problem<B>,
    x: Vec<f64>,
    options: &SynchronizeOptions,
    probe: &mut impl for<'a> Probe<SynchronizeEvent<'a>>,
) -> Climbed {
    let d = B - 1;
    let limits =
        Limits { iterations: options.iterations, relative_decrease: options.relative_decrease };
    let mut found = descend(problem, x, &limits, probe);
    let mut rank = d;
    let mut lower_bound: Option<f64> = None;
    // The best point of rank d so far, with its test.
    let mut best: Option<(Descent<B>, Smallest)> = None;
    loop {
        let smallest = test(problem, &found, rank, options, probe);
        let positive = smallest.positive;
        lower_bound = higher(lower_bound, &smallest);
        if rank == d {
            best = Some((found.clone(), smallest.clone()));
        }
        if positive || rank >= options.max_rank {
            break;
        }
        match escape(problem, &found, &smallest, rank, probe) {
            Some(x) => {
                rank += 1;
                found = descend(problem, x, &limits, probe);
            }
            None => break,
        }
    }
    if rank > d {
        let (x, spectrum) = round(problem, &found.x);
        let rounded = descend(problem, x, &limits, probe);
        probe.emit(SynchronizeEvent::Rounded {
            rank,
            cost_before: found.cost,
            cost: rounded.cost,
            spectrum: &spectrum,
        });
        let lower = best.as_ref().is_none_or(|(best, _)| rounded.cost < best.cost);
        if lower {
            let smallest = test(problem, &rounded, d, options, probe);
            lower_bound = higher(lower_bound, &smallest);
            best = Some((rounded, smallest));
        }
    }
    let (found, smallest) = best.expect("the first point has rank d");
    Climbed {
        x: found.x,
        cost: found.cost,
        smallest,
        lower_bound,
        rank,
        converged: found.converged,
    }
}

/// The higher of a bound and that of a test, where it knows one.
fn higher(bound: Option<f64>, test: &Smallest) -> Option<f64> {
    let bounds = bound.into_iter().chain(Some(test.lower_bound)).filter(|bound| bound.is_finite());
    bounds.reduce(f64::max)
}

/// The certificate test at a stationary point.
fn test<const B: usize>(
    problem: &Problem<B>,
    found: &Descent<B>,
    rank: usize,
    options: &SynchronizeOptions,
    probe: &mut impl for<'a> Probe<SynchronizeEvent<'a>>,
) -> Smallest {
    let limits = test_limits(problem, found.cost, options.relative_gap);
    let smallest =
        DualMatrix::new(problem, &found.multipliers).smallest(&found.x, found.cost, &limits);
    probe.emit(SynchronizeEvent::Tested {
        rank,
        cost: found.cost,
        smallest_eigenvalue: smallest.eigenvalue,
        precision: smallest.precision,
        positive: smallest.positive,
    });
    smallest
}

/// A point one rank higher with a lower cost, along a direction of negative curvature.
///
/// To second order a step `α` changes the cost by `α² λ`. Steps are halved from where the rotations
/// move by a radian in the mean, as long as that lowers the cost further.
fn escape<const B: usize>(
    problem: &Problem<B>,
    found: &Descent<B>,
    smallest: &Smallest,
    rank: usize,
    probe: &mut impl for<'a> Probe<SynchronizeEvent<'a>>,
) -> Option<Vec<f64>> {
    if !smallest.direction.iter().all(|x| x.is_finite()) || smallest.direction.is_empty() {
        return None;
    }
    let rows = problem.rows();
    let mut length = (rows as f64 / B as f64).sqrt();
    let mut best: Option<(f64, Vec<f64>)> = None;
    for _ in 0..60 {
        let mut x = found.x.clone();
        x.extend(smallest.direction.iter().map(|v| length * v));
        orthonormalise::<B>(rows, &mut x);
        let cost = problem.cost(&x);
        match &best {
            Some((lowest, _)) if cost >= *lowest => break,
            _ if cost < found.cost => best = Some((cost, x)),
            _ => {}
        }
        length *= 0.5;
    }
    let (cost, x) = best?;
    probe.emit(SynchronizeEvent::Escaped { rank: rank + 1, cost_before: found.cost, cost });
    Some(x)
}
