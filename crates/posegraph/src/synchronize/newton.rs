//! Damped Newton steps in the tangent space of a product of Stiefel manifolds.

use probe::Probe;

use super::event::SynchronizeEvent;
use super::problem::{Block, Problem};
use super::sparse::{BlockCholesky, Part};
use super::stiefel::{multipliers, retract, subtract_product};
use super::tangent::Tangent;
use crate::linear::dot;

/// When a descent ends.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Limits {
    /// Factorisations.
    pub(crate) iterations: usize,
    /// Ends where the decrease that a step promises is below this share of the cost.
    pub(crate) relative_decrease: f64,
}

/// Where a descent ended.
#[derive(Clone, Debug)]
pub(crate) struct Descent<const B: usize> {
    pub(crate) x: Vec<f64>,
    pub(crate) cost: f64,
    /// Lagrange multipliers of orthonormality at `x`.
    pub(crate) multipliers: Vec<Block<B>>,
    pub(crate) converged: bool,
}

/// Smallest damping, as a share of the diagonal of `M`: makes up for directions without curvature.
const LEAST: f64 = 1e-12;

/// Shares of the multipliers that are taken off the quadratic form: 0 gives Gauss and Newton's matrix,
/// 1 the Hessian. What is between is damped by the form itself, which does not hold back where the
/// cost is flat, as a multiple of the identity does.
const SHARES: [f64; 6] = [0.0, 0.5, 0.9, 0.99, 0.999, 1.0];

/// Where a step promises less than this share of the cost, the Hessian is no longer cut short.
const NEAR: f64 = 1e-4;

/// Moves `x` to a stationary point of the cost among points of its rank.
///
/// 1. Half the cost has the gradient `P(M X)` and the Hessian `V ↦ P(S V)`, `S = M - Λ` (Rosen et al.
///    2019, eq. 38), `P` the projection to the tangent space. In a basis of that space ([`Tangent`])
///    it has the pattern of the graph, with blocks of `d (d - 1) / 2 + (r - d) d + r` rows.
/// 2. Of the part `-P(Λ V)` only a share is taken, see [`SHARES`]. At rank `d` it is none until a step
///    promises less than [`NEAR`] of the cost: what is left is Gauss and Newton's matrix, never
///    indefinite, whose steps pass far-off stretches where Newton's are too long. Then it is all,
///    and less again where the factorisation or the step fails.
/// 3. Where even Gauss and Newton's step fails, a multiple of the diagonal of `M` is added, which grows
///    until a step succeeds, and shrinks where steps keep their promise.
/// 4. Done where an undamped Newton step promised less than the asked share of the cost, and was taken.
///
/// The first vertex of each component stands still. Deviates from Rosen et al., who truncate
/// conjugate gradients: one factorisation costs less here than the dozens to hundreds of products
/// and solves that a step took.
pub(crate) fn descend<const B: usize>(
    problem: &Problem<B>,
    mut x: Vec<f64>,
    limits: &Limits,
    probe: &mut impl for<'a> Probe<SynchronizeEvent<'a>>,
) -> Descent<B> {
    let rows = problem.rows();
    let rank = x.len() / rows;
    let mut product = vec![0.0; x.len()];
    let mut cost = problem.cost_and_product(&x, &mut product);
    // What is below this is rounding of the terms that the cost is the difference of.
    let floor = 1e-24 * problem.scale;
    let mut factor = BlockCholesky::new(&problem.pattern, Tangent::<B>::size(rank));
    let mut damping = 0.0_f64;
    // Rank d starts as Gauss and Newton do; higher ranks start beside a saddle point.
    let mut level = if rank == B - 1 { 0 } else { SHARES.len() - 3 };
    let mut iterations = 0;
    let mut lagrange = multipliers::<B>(rows, &x, &product);
    let mut tangent = Tangent::<B>::new(rows, &x);
    let mut gradient = {
        let mut gradient = product.clone();
        subtract_product(rows, &lagrange, &x, &mut gradient);
        tangent.coordinates(&gradient)
    };
    let end = |x, cost, multipliers, converged| Descent { x, cost, multipliers, converged };
    loop {
        if iterations == limits.iterations || !cost.is_finite() {
            return end(x, cost, lagrange, false);
        }
        iterations += 1;
        let share = SHARES[level];
        assemble(problem, &tangent, &lagrange, share, damping.max(LEAST), &mut factor);
        if !factor.factorize() {
            if level > 0 {
                level -= 1;
                continue;
            }
            damping = (damping * 10.0).max(1e-9);
            if damping > 1e6 {
                return end(x, cost, lagrange, false);
            }
            continue;
        }
        let mut coordinates: Vec<f64> = gradient.iter().map(|g| -g).collect();
        tangent.hold(problem, &mut coordinates);
        let right = coordinates.clone();
        factor.solve(&mut coordinates);
        // Of the model with damping: -2 ⟨g, v⟩ - ⟨v, (H + λ D) v⟩ = -⟨g, v⟩.
        let promised = dot(&right, &coordinates);
        let tried = retract::<B>(rows, &x, &tangent.vector(&coordinates));
        let tried_cost = problem.cost_and_product(&tried, &mut product);
        let blur = 1e-11 * cost + floor;
        let gain = (cost - tried_cost + blur) / (promised + blur);
        let accepted = tried_cost.is_finite() && gain > 1e-3;
        probe.emit(SynchronizeEvent::Iterated {
            rank,
            iteration: iterations,
            cost: tried_cost,
            promised,
            damping,
            gain_ratio: gain,
            accepted,
        });
        if !accepted {
            if level > 0 {
                level = level.saturating_sub(2);
                continue;
            }
            damping = (damping * 10.0).max(1e-6);
            if damping > 1e6 {
                return end(x, cost, lagrange, false);
            }
            continue;
        }
        x = tried;
        cost = tried_cost;
        lagrange = multipliers::<B>(rows, &x, &product);
        subtract_product(rows, &lagrange, &x, &mut product);
        tangent = Tangent::<B>::new(rows, &x);
        gradient = tangent.coordinates(&product);
        let whole = level + 1 == SHARES.len() && damping <= LEAST;
        if whole && promised <= limits.relative_decrease * cost + floor {
            return end(x, cost, lagrange, true);
        }
        if gain < 0.25 {
            level = level.saturating_sub(1);
        } else if level > 0 {
            level = (level + 1).min(SHARES.len() - 1);
        } else if promised <= NEAR * cost {
            level = if damping <= LEAST { SHARES.len() - 1 } else { 1 };
        }
        if gain > 0.75 {
            damping = if damping < 1e-9 { 0.0 } else { damping * 0.1 };
        } else if gain < 0.25 {
            damping = (damping * 10.0).max(1e-9);
        }
    }
}

/// Writes the Hessian of half the cost in coordinates of the tangent space, plus `damping` times the
/// diagonal of `M` (its mean over the columns of rotations, and that of translations).
fn assemble<const B: usize>(
    problem: &Problem<B>,
    tangent: &Tangent<B>,
    multipliers: &[Block<B>],
    share: f64,
    damping: f64,
    into: &mut BlockCholesky,
) {
    into.clear();
    let size = tangent.width();
    let mut block = vec![0.0; size * size];
    for (vertex, (entry, multiplier)) in problem.diagonal().iter().zip(multipliers).enumerate() {
        if problem.component[vertex] == vertex {
            for k in 0..size {
                into.add(Part::Diagonal(vertex), k, k, 1.0);
            }
            continue;
        }
        let mut reduced = *entry;
        for a in 0..B - 1 {
            for b in 0..B - 1 {
                reduced[a][b] -= share * multiplier[a][b];
            }
        }
        tangent.reduce(vertex, vertex, &reduced, &mut block);
        let mean = (0..B - 1).map(|k| entry[k][k]).sum::<f64>() / (B - 1) as f64;
        for e in 0..size {
            for f in 0..=e {
                let mut value = block[e * size + f];
                if e == f {
                    value += damping * if tangent.turns(e) { mean } else { entry[B - 1][B - 1] };
                }
                into.add(Part::Diagonal(vertex), e, f, value);
            }
        }
    }
    for (pair, (&(low, high), entry)) in
        problem.pattern.pairs.iter().zip(problem.below()).enumerate()
    {
        let (low, high) = (low as usize, high as usize);
        if problem.component[low] == low || problem.component[high] == high {
            continue;
        }
        tangent.reduce(high, low, entry, &mut block);
        for e in 0..size {
            for f in 0..size {
                into.add(Part::Below(pair), e, f, block[e * size + f]);
            }
        }
    }
}
