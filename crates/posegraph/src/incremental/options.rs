//! What an incremental optimisation is asked to do, and what a step of it did.

use crate::ErrorKind;

/// Options of an incremental optimisation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IncrementalOptions {
    /// Which error is minimised.
    pub error: ErrorKind,
    /// A pose is linearised anew where an entry of its step is longer than this, metres or radians.
    pub relinearise: f64,
    /// The poses of a factor are linearised anew where what its linear model leaves out is more `χ²`
    /// than this share of the mean over all factors: stiff factors bend long before steps are long.
    pub bend: f64,
    /// Changes of steps that lower the cost by no more than this share of the mean `χ²` of a factor
    /// are not passed on.
    pub propagate: f64,
    /// Gauss-Newton iterations per added vertex, at most; at least one is done. The second is done only
    /// where the first left something to be linearised anew, which after most steps it does not.
    pub iterations: usize,
}

impl Default for IncrementalOptions {
    fn default() -> Self {
        Self {
            error: ErrorKind::G2o,
            relinearise: 0.01,
            bend: 1e-4,
            propagate: 1e-7,
            iterations: 2,
        }
    }
}

/// What adding or withdrawing did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Update {
    /// Poses that were linearised anew, over all iterations.
    pub relinearised: usize,
    /// Block columns of the factor that were computed anew, over all iterations.
    pub refactored: usize,
    /// Steps that changed, over all iterations.
    pub solved: usize,
    /// Gauss-Newton iterations.
    pub iterations: usize,
}
