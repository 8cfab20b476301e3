//! The start that is used where none is asked for: the cheapest that can be believed.
//!
//! No single start leads to the lowest `χ²` on every graph. The cheap one usually does, and whether it
//! did can be judged; more is spent only on doubt.
//!
//! 1. [`chordal`](crate::initial::chordal()) start, then Gauss-Newton on `χ²`.
//! 2. The solution is **judged** ([`Judgement`]) by what costs next to nothing:
//!    - it converged;
//!    - `χ²` is at most its expectation, the degrees of freedom `ν`, and five standard deviations
//!      `√(2 ν)` more, which catches wrong minima where the information matrices are right. Where they
//!      claim far too much, every `χ²` is too high: a solution whose rotation errors add up to less than an
//!      eighth of the next limit around every loop is believed all the same;
//!    - rotation errors, added up around each loop of a breadth-first tree, stay below a quarter of a
//!      turn about each axis. This has no unit, so it holds where the information matrices are far too small and any
//!      `χ²` would look good: a solution that winds around a loop once too often has errors there that
//!      add up to a full turn, minus what noise leaves.
//!
//!    No doubt: done.
//! 3. On doubt, [`certify`](crate::certificate::certify) solves SE-Sync's problem from this solution. If
//!    that ends in a **certified global optimum** and no rotation turned by more than an eighth of a
//!    half-turn on the way, the solution lies in the valley of that optimum: done.
//! 4. Else Gauss-Newton starts again from the poses that the staircase led to, and, unless those were
//!    certified (in the plane: and believed), from odometry, the spanning tree and the surest tree too;
//!    in the plane also from what becomes of odometry and the surest tree when factors may disagree for
//!    a while (Cauchy's loss, as wide as noise is by the lowest solution so far). The lowest `χ²` wins.
//!
//!    In space those starts take long and lead astray. They are left out where the lowest solution so
//!    far is explained by noise: there is no doubt, or `χ²` is at least 0.8 of its expectation and not
//!    too high, so that noise is as large as the information matrices say.
//! 5. Where even the lowest did not converge, damped steps go on from it.
//!
//! A start that is asked for ([`asked_start_by`]) takes the place of the first, and stands as soon as it
//! converges and noise explains its cost; else 1 to 5 follow, and the lowest wins.
//!
//! `χ²` has no certificate: a start that passes is plausible, not proven. Nothing is looked up.

mod judge;
mod ladder;

pub use judge::{Doubt, Judgement, judge};
pub use ladder::{
    Origin, Start, Trial, asked_start_by, default_start, default_start_by, default_start_with,
};
