//! Wrong loop closures: found, and left out.
//!
//! Places look alike, so some loop closures are wrong, and one of them is enough to fold a map.
//! [`optimize_robust`] deals with them in the way that [`Robust`] names, and lists those that it does
//! not believe. Odometry is trusted; only loop closures can be rejected ([`closures`] tells which are).
//!
//! **The scale of the noise.** All methods ask whether an error is larger than noise can make it, so
//! they need information matrices that are right, and those of public files are off by up to 20,000
//! times. The scale is estimated, twice:
//!
//! 1. **Before** anything is optimised, from loops of two neighbouring closures and the odometry between
//!    their ends, whose covariance is known to first order. Each closure is compared with its nearest
//!    neighbour along odometry. Wrong ones disagree by orders of magnitude, so the scale is found from
//!    below: that at which the median of the loops within a 99 % gate is the median of a chi-square
//!    distribution ([`RobustSolution::loop_scale`]).
//! 2. **At a solution**, from the residuals of believed closures: the median, or the 95 % quantile
//!    where the tail is heavier; or `χ²` per degree of freedom of all that is believed, which is what is
//!    reported ([`RobustSolution::noise_scale`]).
//!
//! On the way a closure is believed up to the 1 - 10⁻⁶ quantile of the chi-square distribution of its
//! dimension, times the scale: the **gate**. Genuine closures have heavier tails than Gaussian noise,
//! and wrong ones are far off.
//!
//! **Graduated non-convexity** (Yang et al. 2020), `GncTls` and `GncGm`:
//!
//! 1. **Witnesses.** Closures that agree with one of their four nearest neighbours along odometry, where
//!    that is no accident (the ellipsoid of the gate is small in the volume of all relative poses), are
//!    the first to be believed.
//! 2. **Growth**, where fewer than a tenth have such a witness: every closure is predicted from odometry,
//!    with the covariance of the prediction. Those within it are taken where a random pose would be
//!    there with a chance of half a percent; the graph is optimised, what it predicts is surer, and so
//!    on; where none is left, with twice the chance, up to 0.3. Where this finds nothing either, all
//!    closures are taken, as in the paper.
//! 3. Weights of all closures follow from their residuals by the surrogate cost with control
//!    parameter `μ = c²/level`. The level starts at twice the largest residual, from witnesses at most
//!    100 gates up, and falls by 1.4 in each round of three iterations. Our deviation: the gate `c²`
//!    follows the scale of what is believed at the time.
//! 4. With `GncTls` weights end at 0 or 1; with `GncGm` at those of Geman and McClure.
//! 5. **Settling.** The residual of a closure says little where the map gives way to it, and much too
//!    much where the map is loose and the closure was left out. So each is held against what the *rest*
//!    of the graph predicts: `t = eᵀ S⁻¹ e`, with `S` the covariance of the prediction plus that of the
//!    closure. To first order `t` is what the closure adds to the cost of all, its studentised residual
//!    where it took part: with `Σ` the covariance of its error by all others and itself, in units in
//!    which its own covariance is 1, `t = eᵀ (1 - Σ)⁻¹ e`. The scale of the noise follows from the `t`
//!    of believed closures. The graph is optimised, closures are taken or left out, the worst first,
//!    until nothing changes; one that was left out twice stays out.
//! 6. **The limit** of `t` is the gate, or up to 16 times as much where chance allows it: as far as an
//!    ellipsoid that all rejected closures, were they random, would enter 0.02 times in all. Real noise
//!    has tails (a genuine closure of KITTI 05 is at 4 gates, one of the parking garage at 7), and where
//!    the map is large and closures are precise nothing wrong comes near by chance. It is less than the
//!    gate, down to the 99.9 % quantile, where the prediction is over three times as loose as the closure
//!    (at the end of a long way without closures) and an error of this size is likelier by chance: where
//!    the density of the prediction, times the closures taken for each rejected, is below ten times that
//!    of random closures. One wrong closure there moves the whole way.
//!
//! Cost of a round of settling: a factorisation, a pass over the inverse within its cliques, and the way
//! to the root of the elimination tree for each rejected closure that is not certainly far off
//! (`S ≤ 2 (Σ_a + Σ_b)` plus its own tells).
//!
//! **PCM** (Mangelson et al. 2018): two closures are consistent where the loop through both and the
//! odometry between them passes the gate at the scale of loops. The largest clique of consistent
//! closures is searched by branch and bound from a greedy one, and left unproven where that takes too
//! long ([`RobustSolution::largest_set`]). Heavy tails keep many good closures out of a clique, which asks
//! every pair to agree, so that it is not the last word here: it takes the place of the witnesses in
//! step 1 above, and graduated non-convexity and settling go on from it (so does Kimera-RPGO, Rosinol et al. 2020;
//! the paper stops at the clique).
//!
//! **Losses**, by reweighting from the start as it is: Huber, Cauchy, Geman-McClure, truncated least
//! squares, and **dynamic covariance scaling** (Agarwal et al. 2013), whose `Φ` is the 99 % quantile
//! times the scale. **Switchable constraints** (Sünderhauf and Protzel 2012) keep one switch for each
//! closure as a variable of its own; poses and switches are minimised in turns from all switches on.
//! Eliminated in closed form the switches would leave Geman and McClure's loss with `k² = Ξ`. All of them
//! reject what is beyond four gates at the scale of loops; none has a way back from a wrong start.
//!
//! The start of all is the caller's; odometry is the one that no wrong closure has touched.
//! Everything is computed in the order of the data: same input, same bits.
//!
//! # Results
#![doc = include_str!("../../docs/robust.md")]

mod believed;
mod chain;
mod chance;
mod chi_square;
mod clique;
mod dense;
mod gate;
mod gnc;
mod growth;
mod method;
mod noise;
mod optimize;
mod pcm;
mod prediction;
mod settle;
mod soft;

pub use chain::closures;
pub use chi_square::chi_square_quantile;
pub use method::Robust;
pub use optimize::{RobustSolution, optimize_robust};
