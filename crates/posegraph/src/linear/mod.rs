//! Block-sparse normal equations: pattern, ordering, Cholesky factor.
//!
//! Unknowns come in blocks of `D`, one per free vertex. What depends on the graph alone is done
//! once:
//!
//! 1. Which blocks meet in a factor: the pattern of the matrix, [`BlockPattern`].
//! 2. An elimination order that keeps the factor sparse: approximate minimum degree on the graph
//!    of blocks (Amestoy, Davis and Duff 1996), which is `D²` times smaller than the matrix and
//!    gives the same fill.
//! 3. The pattern of the factor, its columns gathered into supernodes ([`BlockCholesky::new`]).
//!
//! Each iteration then writes numbers into the pattern ([`BlockPattern::slot`]) and factorises
//! them ([`BlockCholesky::factorize`]) with faer's supernodal Cholesky, which spends its time in
//! dense kernels. On the public pose graphs it takes a half to a tenth of the time of the
//! simplicial one, for the plane too. Right-hand sides are solved for here ([`substitution`]).

mod cholesky;
mod ordering;
mod pattern;
mod substitution;

pub(crate) use cholesky::{BlockCholesky, NotPositiveDefinite};
pub(crate) use ordering::minimum_degree;
pub(crate) use pattern::{BlockPattern, Slot};
pub(crate) use substitution::dot;
