//! Whether a solution of SE-Sync's problem is globally optimal, and the proof.
//!
//! Poses at which the gradient of SE-Sync's cost `F` vanishes have multipliers `Λ`, one symmetric
//! `d × d` block for each rotation, and a certificate matrix `S = M - Λ` with `S Xᵀ = 0`
//! ([`synchronize`](crate::synchronize) derives them). For any other poses `Y`
//!
//! `F(Y) = ⟨Y, M Y⟩ = tr Λ + ⟨Y, S Y⟩ = F(X) + ⟨Y, S Y⟩`,
//!
//! because every rotation has orthonormal columns. So where `S` has no negative eigenvalue, no poses
//! cost less than `X`; where the smallest one of `S_R` (translations eliminated) is at least `-η`, none
//! cost less than `F(X) - η d n`. That is a statement about the cost, not about a neighbourhood.
//!
//! 1. **Solve** from the start that is given, best the lowest `χ²` known ([`certify`]).
//! 2. **Test** `S + η I_R` by one sparse Cholesky factorisation, `η` = the allowed relative gap
//!    ([`relative_gap`](crate::synchronize::SynchronizeOptions::relative_gap)) of `F`, shared out over
//!    the `d n` columns; at least `1e-15` of the largest diagonal entry, growing by tens to `1e-12` of
//!    it where rounding spoils the factorisation. A bound on the gap that comes out wider than
//!    `1e-4` of the cost is no certificate. Success is the positive case, and no eigenvector is ever
//!    computed for it: `S Xᵀ = 0` shows that the smallest eigenvalue is at most 0, the factor that it
//!    is above `-η`.
//! 3. **Hold a rotation** where rounding leaves a wider gap than was asked for (entries of `M` reach
//!    `1e14` where a file claims to know translations to a micrometre), or spoils the factorisation. Every other `Y`
//!    can be turned so that it agrees with `X` at one vertex; what is left, `W`, does not touch its rows, and
//!    `F(Y) ≥ F(X) - ⟨G, S_h⁻¹ G⟩` with the gradient `G = S X` and `S_h` without those rows. `S_h` has
//!    no null space, so `S_h - 1e-12 max M_kk I` is factorised: far above rounding, not at it. The gap
//!    that is left is Newton's decrement.
//! 4. **On failure** the shift is raised by tens until the factorisation succeeds, and Lanczos on the
//!    inverse of the shifted matrix gives the smallest eigenvalue with its vector. The shift is within
//!    a factor of ten of the eigenvalue, so that some dozen steps suffice.
//! 5. **Climb** the staircase along that vector, round, and test again.
//!
//! The verdict is about `F` at its own stationary point and says nothing about `χ²`. It is
//! `not_applicable` where several vertices of a component are fixed (`F` knows one gauge per
//! component), where there is nothing to test, or where a start pose is missing.
//!
//! A relaxation that is not tight (noise beyond a bound that Rosen et al. 2019, theorem 2 show to exist)
//! ends as `not_certified` with a finite gap: the cost of the poses minus that of the relaxation.

#[expect(clippy::needless_range_loop, reason = "indices of small blocks, as in the formulas")]
pub(crate) mod dual;
mod lanczos;
mod verdict;

pub use verdict::{Certificate, Verdict, certify, certify_with};
