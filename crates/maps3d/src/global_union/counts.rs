//! What a united map did.

/// What was done so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct UnionCounts {
    /// Unions of a view with the map, those of rebuilding included.
    pub unions: u64,
    /// Times that a view was united again with a larger jitter, because the map crossed itself.
    pub again: u64,
    /// Views that the union refused when they came.
    pub refused: u64,
    /// Times that the pose graph was optimised.
    pub corrections: u64,
    /// Times that all views were united again.
    pub rebuilds: u64,
    /// Times that the map was filled with tetrahedra.
    pub fillings: u64,
    /// Times that it could not be.
    pub refused_fillings: u64,
    /// Ways that were planned.
    pub ways: u64,
    /// Ways that were asked for and not found.
    pub no_ways: u64,
}
