//! Losses, and switchable constraints.

use probe::Probe;

use super::Robust;
use super::believed::Believed;
use super::chi_square::chi_square_quantile;
use super::gate::gate;
use crate::factors::Manifold;
use crate::solvers::{Loss, Optimizer, OptimizerEvent, Options, Solution};

/// Probability with which the errors of good closures stay within the width of losses that come back.
const WIDTH: f64 = 0.99;

/// Rounds of switching, at most.
const ROUNDS: usize = 50;

/// Switching ends where no weight changes by more.
const SETTLED: f64 = 1e-3;

/// The loss of a method at this scale of the noise; `None` where the method is no loss.
pub(super) fn loss(robust: Robust, scale: f64, degrees: usize) -> Option<Loss> {
    let deviation = scale.sqrt();
    let width = (chi_square_quantile(WIDTH, degrees) * scale).sqrt();
    match robust {
        Robust::None => Some(Loss::None),
        // 95 % as efficient as least squares on Gaussian noise, for one degree of freedom.
        Robust::Huber => Some(Loss::Huber { width: 1.345 * deviation }),
        Robust::Cauchy => Some(Loss::Cauchy { width: 2.385 * deviation }),
        Robust::GemanMcClure => Some(Loss::GemanMcClure { width }),
        Robust::Tls => Some(Loss::Tls { width: gate(scale, degrees).sqrt() }),
        Robust::Dcs => Some(Loss::Dcs { width }),
        _ => None,
    }
}

/// One optimisation with a loss on closures.
pub(super) fn with_loss<P: Manifold<D>, const D: usize>(
    believed: &Believed<P, D>,
    start: &[P],
    loss: Loss,
    probe: &mut impl for<'e> Probe<OptimizerEvent<'e, P>>,
) -> Solution<P> {
    let options = Options { loss, ..believed.options };
    let mut found = Optimizer::new(&believed.graph, &options).run(start, &believed.trusting, probe);
    believed.complete(&mut found.report);
    found
}

/// Switches of all closures, turned between optimisations: the poses, weights, rounds, iterations.
///
/// A closure of switch `s` costs `s² χ² + (1 - s)² Ξ` (Sünderhauf and Protzel 2012, equation 8, with
/// the identity for the switch function). The switches are variables of their own: from all on, poses
/// and switches are minimised in turns, the switches in closed form, `s = Ξ / (Ξ + χ²)`.
pub(super) fn switched<P: Manifold<D>, const D: usize>(
    believed: &Believed<P, D>,
    start: &[P],
    scale: f64,
) -> (Vec<P>, Vec<f64>, usize, usize) {
    let prior = chi_square_quantile(WIDTH, D) * scale;
    let short = Options { max_iterations: 5, relative_decrease: 1e-3, ..believed.options };
    let mut optimizer = Optimizer::new(&believed.graph, &short);
    let mut weights = believed.trusting.clone();
    let mut poses = start.to_vec();
    let (mut rounds, mut iterations) = (0, 0);
    while rounds < ROUNDS {
        rounds += 1;
        let found = optimizer.run(&poses, &weights, &mut probe::Off);
        poses = found.poses;
        iterations += found.report.iterations.len();
        let chi2 = believed.chi2(&poses);
        let mut change = 0.0f64;
        for index in believed.closures() {
            let switch = prior / (prior + chi2[index]);
            change = change.max((switch * switch - weights[index]).abs());
            weights[index] = switch * switch;
        }
        if change <= SETTLED {
            break;
        }
    }
    (poses, weights, rounds, iterations)
}
