//! The graph as plain data.

use pose::nalgebra::SMatrix;
use pose::{Se2, Se3};

/// A measured relative pose with its information matrix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Factor<P, const D: usize> {
    /// Index of the vertex in whose frame the measurement is given.
    pub from: usize,
    /// Index of the vertex that was measured.
    pub to: usize,
    /// Frame of `to` in the frame of `from`.
    pub from_from_to: P,
    /// Inverse covariance of the error, in the order translation, rotation and in g2o's scaling.
    pub information: SMatrix<f64, D, D>,
}

/// Vertices and factors, vertices by dense index.
///
/// Plain data; the optimiser leaves out factors that are not finite or lead nowhere.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FactorGraph<P, const D: usize> {
    /// File id of each vertex.
    pub ids: Vec<u64>,
    /// `map_from_body` of each vertex as the file gives it, if it does; as long as `ids`.
    pub initial: Vec<Option<P>>,
    /// Indices of the vertices that are held where they start.
    pub fixed: Vec<usize>,
    /// The factors in file order; several may join the same two vertices.
    pub factors: Vec<Factor<P, D>>,
}

/// A graph of the plane.
pub type FactorGraph2 = FactorGraph<Se2, 3>;

/// A graph of space.
pub type FactorGraph3 = FactorGraph<Se3, 6>;
