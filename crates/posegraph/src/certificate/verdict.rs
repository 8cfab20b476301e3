//! The certificate that users see.

use probe::{Off, Probe};

use crate::factors::FactorGraph;
use crate::synchronize::measurements::Measurements;
use crate::synchronize::poses::{align, stack, unstack};
use crate::synchronize::problem::Problem;
use crate::synchronize::staircase::{Climbed, climb};
use crate::synchronize::{Rigid, SynchronizeEvent, SynchronizeOptions};

/// Whether poses are known to be a global optimum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// No poses have a lower cost (SE-Sync's), to the stated precision.
    GloballyOptimal,
    /// The test failed: there may be better poses, or the relaxation is not tight.
    NotCertified,
    /// The graph is not of the kind that the test is for.
    NotApplicable,
}

impl Verdict {
    /// A name for reports: `globally_optimal`, `not_certified`, `not_applicable`.
    pub fn name(self) -> &'static str {
        match self {
            Self::GloballyOptimal => "globally_optimal",
            Self::NotCertified => "not_certified",
            Self::NotApplicable => "not_applicable",
        }
    }
}

/// Poses, and what is known of their optimality; all of SE-Sync's cost, which is not `χ²`.
#[derive(Clone, Debug, PartialEq)]
pub struct Certificate<P> {
    /// Whether the poses are known to be a global optimum.
    pub verdict: Verdict,
    /// The smallest eigenvalue of the certificate matrix (translations eliminated). It is never above 0,
    /// since the poses themselves span a part of its null space; 0 where none is below `-precision`.
    pub smallest_eigenvalue: f64,
    /// What it is known to.
    pub precision: f64,
    /// The cost of the poses minus what the optimum is known to be at least; infinite where no such
    /// bound is known.
    pub gap: f64,
    /// SE-Sync's cost of the poses.
    pub sesync_cost: f64,
    /// `map_from_body` of every vertex.
    pub poses: Vec<P>,
    /// The highest rank of the staircase that was needed; the dimension of space where the first
    /// point was certified.
    pub rank: usize,
    /// Why the verdict is what it is.
    pub reason: String,
}

/// Solves SE-Sync's problem from `start`, and tells whether the solution is globally optimal.
pub fn certify<P: Rigid<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    start: &[P],
    options: &SynchronizeOptions,
) -> Certificate<P> {
    certify_with(graph, start, options, &mut Off)
}

/// [`certify`], watched by a probe.
pub fn certify_with<P: Rigid<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    start: &[P],
    options: &SynchronizeOptions,
    probe: &mut impl for<'a> Probe<SynchronizeEvent<'a>>,
) -> Certificate<P> {
    match P::DIM {
        2 => certify_blocks::<P, D, 3>(graph, start, options, probe),
        _ => certify_blocks::<P, D, 4>(graph, start, options, probe),
    }
}

fn certify_blocks<P: Rigid<D>, const D: usize, const B: usize>(
    graph: &FactorGraph<P, D>,
    start: &[P],
    options: &SynchronizeOptions,
    probe: &mut impl for<'a> Probe<SynchronizeEvent<'a>>,
) -> Certificate<P> {
    let measurements = Measurements::new(graph);
    let components = measurements.components(|_| true);
    let refuse = |reason: &str| Certificate {
        verdict: Verdict::NotApplicable,
        smallest_eigenvalue: f64::NAN,
        precision: f64::INFINITY,
        gap: f64::INFINITY,
        sesync_cost: f64::NAN,
        poses: start.to_vec(),
        rank: P::DIM,
        reason: reason.to_owned(),
    };
    if start.len() != measurements.count || !start.iter().all(P::is_finite) {
        return refuse("there is no finite start pose for every vertex");
    }
    if measurements.relatives.is_empty() {
        return refuse("there are no measurements");
    }
    let mut fixed_in = vec![0usize; measurements.count];
    let mut fixed: Vec<usize> =
        graph.fixed.iter().copied().filter(|&v| v < measurements.count).collect();
    fixed.sort_unstable();
    fixed.dedup();
    for &v in &fixed {
        fixed_in[components[v]] += 1;
    }
    if fixed_in.iter().any(|&number| number > 1) {
        return refuse(
            "several vertices of a component are fixed, which SE-Sync's problem does not know",
        );
    }
    let problem = Problem::<B>::new(&measurements);
    let columns: Vec<_> = start.iter().map(P::columns).collect();
    let x = stack(&problem, &columns);
    let climbed = climb(&problem, x, options, probe);
    let mut poses: Vec<P> = unstack(&problem, &climbed.x).iter().map(P::from_columns).collect();
    let mut reference = components.clone();
    for &v in &fixed {
        let component = components[v];
        reference.iter_mut().for_each(|r| {
            if *r == component {
                *r = v
            }
        });
    }
    align(&mut poses, &reference, |v| start[v]);
    conclude(climbed, poses, problem.scale)
}

/// A bound on the gap that is wider than this share of the cost proves nothing worth telling.
const WIDEST_GAP: f64 = 1e-4;

/// So small a share of the terms that the cost is the difference of is rounding, where the cost is 0.
const ROUNDING: f64 = 1e-9;

fn conclude<P>(climbed: Climbed, poses: Vec<P>, scale: f64) -> Certificate<P> {
    let Climbed { cost, smallest, lower_bound, rank, converged, .. } = climbed;
    let gap = lower_bound.map_or(f64::INFINITY, |bound| (cost - bound).max(0.0));
    let tells = gap <= (WIDEST_GAP * cost).max(ROUNDING * scale);
    let verdict =
        if smallest.positive && tells { Verdict::GloballyOptimal } else { Verdict::NotCertified };
    let reason = if smallest.positive && !tells {
        format!(
            "weights so large that eigenvalues are known to {:.3e} only leave a gap of {gap:.3e}",
            smallest.precision
        )
    } else if smallest.positive && smallest.held {
        format!(
            "the certificate matrix without one rotation, which leaves no null space, has a Cholesky factor, so no poses cost less than {:.9e}",
            cost - gap
        )
    } else if smallest.positive {
        format!(
            "the certificate matrix plus {:.3e} I has a Cholesky factor, so no poses cost less than {:.9e}",
            smallest.precision,
            cost - gap
        )
    } else if !converged {
        "the descent ended before the gradient vanished".to_owned()
    } else if let Some(bound) = lower_bound {
        format!(
            "the relaxation is not tight: its optimum of rank {rank} is at least {bound:.9e}, and rounding it gave no poses of that cost"
        )
    } else {
        format!(
            "the certificate matrix has the eigenvalue {:.3e}, and no rank up to {rank} passed the test",
            smallest.eigenvalue
        )
    };
    Certificate {
        verdict,
        smallest_eigenvalue: smallest.eigenvalue,
        precision: smallest.precision,
        gap,
        sesync_cost: cost,
        poses,
        rank,
        reason,
    }
}
