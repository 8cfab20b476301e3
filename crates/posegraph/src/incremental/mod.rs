//! Poses one by one, each optimised with all before it for far less than a solve from scratch.
//!
//! Solving from scratch after every pose spends nearly all of its time on what has not changed. What
//! a new pose changes is its neighbourhood; where it closes a loop, the loop. [`Incremental`] keeps
//! the Cholesky factor as a tree of cliques and computes anew only what depends on the change.
//!
//! 1. **Place** the vertex: at its initial value, or chained from the first factor that joins it to
//!    another. A factor that joins two parts which knew nothing of each other moves the younger part
//!    as a whole: errors and Jacobians by steps on the right do not notice.
//! 2. **Linearise** the new factors. Each vertex is linearised at a pose of its own and has a step `δ`
//!    from there; the estimate is `X exp(δ)`. Vertices whose `δ` has become longer than
//!    [`relinearise`](IncrementalOptions::relinearise) take their step, and their factors are
//!    worked out anew (fluid relinearisation); so do those of a factor whose error is farther from
//!    its linear model than [`bend`](IncrementalOptions::bend) allows. The first catches a map that
//!    turns, the second stiff factors, of which a length says nothing.
//! 3. **Detach** from the tree the cliques of all factors that are new or changed, and all above
//!    them. What hangs beneath stays: its effect on the rest is kept as one dense update per clique.
//! 4. **Order** the vertices that came loose by approximate minimum degree, the new one last, since the
//!    next step will touch it; **eliminate** them as dense fronts.
//! 5. **Solve** from the roots down, no further than changes lower the cost by more than
//!    [`propagate`](IncrementalOptions::propagate) (wildfire). By default a second Gauss-Newton
//!    iteration follows where the first left linear models that no longer hold, as large loop closures
//!    do; later steps go on where it ended.
//! 6. [`finish`](Incremental::finish) runs the batch optimiser from there, which is mostly one or two
//!    iterations, and reports how it ended: where it matters that the poses are *the* minimum.
//!
//! This is iSAM2 (Kaess, Johannsson, Roberts, Ila, Leonard and Dellaert 2012) with these differences:
//! Cholesky on the normal equations in blocks instead of QR; columns joined into larger cliques where
//! that stores few zeros; the new vertex kept out of the ordering and eliminated last, in place of
//! constrained COLAMD; thresholds in shares of `χ²` beside those in metres and radians; vertices held
//! instead of a prior; parts that join; factors that can be taken back
//! ([`withdraw`](Incremental::withdraw)), which detaches the same way.
//!
//! **Why not** a fixed ordering with a warm start: a batch iteration on M3500 costs about 4 ms on its
//! own, and a fixed ordering fills up with every loop closure. **What it costs**: between `finish`es
//! poses lag behind the batch solution. On M3500, where one was computed every 50 steps, the cost was
//! above it by 2e-6 in the median, and by 1e-2 at worst, right after a large loop closure; more
//! [`iterations`](IncrementalOptions::iterations) per step bring that down. Steps are not damped:
//! a start that full Gauss-Newton steps cannot handle is for the batch optimiser.
//!
//! Directions that no factor determines stay where they are. The same calls give the same bits.
//! Times beside iSAM2's are in `docs/benchmarks.md`.
//!
//! ```
//! use pose::Se2;
//! use pose::nalgebra::Matrix3;
//! use posegraph::{Factor, Incremental, IncrementalOptions};
//!
//! let measured = |from, to, x: f64| Factor {
//!     from,
//!     to,
//!     from_from_to: Se2::new(x, 0.0, 0.0),
//!     information: Matrix3::identity() * 100.0,
//! };
//! let mut growing = Incremental::new(IncrementalOptions::default());
//! growing.add(None, &[])?;
//! growing.add(None, &[measured(0, 1, 1.0)])?;
//! // Seen from both, not quite at the same place.
//! growing.add(None, &[measured(1, 2, 1.0), measured(0, 2, 2.3)])?;
//! assert!((growing.pose(2).translation.x - 2.2).abs() < 1e-9);
//! // The second view was wrong.
//! growing.withdraw(2)?;
//! assert!((growing.pose(2).translation.x - 2.0).abs() < 1e-9);
//! # Ok::<(), posegraph::PoseGraphError>(())
//! ```

mod covariance;
mod islands;
mod linearity;
mod options;
mod smoother;
mod withdraw;

pub use options::{IncrementalOptions, Update};
pub use smoother::Incremental;
