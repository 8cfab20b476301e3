//! A Cholesky factor that changes in parts: a tree of cliques, each with its share of the factor.
//!
//! Variables are vertices of a pose graph, in blocks of `D`. A clique holds a few variables that are
//! eliminated together, its *frontals*, and those eliminated later that they meet, its *separator*;
//! a parent holds the first of the separator among its frontals (the Bayes tree of Kaess et al. 2012,
//! iSAM2, here for the normal equations: a multifrontal Cholesky factor, Duff and Reid 1983). Each
//! clique keeps
//!
//! - its columns of the factor and its part of the forward-solved right-hand side;
//! - its *update*: what eliminating it and all beneath it adds to its separator. A parent needs no
//!   more, so everything beneath an unchanged clique stays as it is.
//!
//! To change terms:
//!
//! 1. **Detach** the cliques of their variables and all above them, up to the roots ([`tree`]).
//!    Subtrees beneath come loose; their updates stand for them.
//! 2. **Order** the variables that came loose by approximate minimum degree, those that the next
//!    change will meet last ([`order`](self::order)), and find the new cliques ([`symbolic`]).
//! 3. **Eliminate** them: add up terms and updates of children, factorise the dense front
//!    ([`assemble`], [`front`]).
//! 4. **Solve** from the roots down, no further than steps change ([`solve`]).
//!
//! Covariances come from the same tree ([`covariance`]). One thread, in the order of the data: the
//! same calls give the same bits.

mod assemble;
mod covariance;

mod front;
mod order;
mod solve;
mod symbolic;
mod tree;

pub(crate) use tree::{CliqueTree, HELD, Term};
