//! What a synchronisation tells as it goes.

/// Facts about a running synchronisation, in the past tense.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SynchronizeEvent<'a> {
    /// A Newton iteration was done.
    Iterated {
        /// Dimensions that the rotations' columns have.
        rank: usize,
        /// Counts from 1 at each rank.
        iteration: usize,
        /// SE-Sync's cost at the end of the step, whether it was taken or not.
        cost: f64,
        /// Decrease of the cost that the step promised.
        promised: f64,
        /// Damping, as a share of the diagonal of the quadratic form.
        damping: f64,
        /// How much of the promised decrease came true.
        gain_ratio: f64,
        /// Whether the step was taken.
        accepted: bool,
    },
    /// The certificate matrix of a stationary point was tested.
    Tested {
        /// Rank of the point.
        rank: usize,
        /// Its cost.
        cost: f64,
        /// Its smallest eigenvalue; 0 where none is below minus the precision.
        smallest_eigenvalue: f64,
        /// What the eigenvalue is known to.
        precision: f64,
        /// Whether it is positive semidefinite to that precision.
        positive: bool,
    },
    /// A saddle point was left along a direction of negative curvature, one rank higher.
    Escaped {
        /// The new rank.
        rank: usize,
        /// Cost before.
        cost_before: f64,
        /// Cost after.
        cost: f64,
    },
    /// A point of higher rank was rounded to poses.
    Rounded {
        /// Rank of the point.
        rank: usize,
        /// Its cost: a bound from below where it was certified.
        cost_before: f64,
        /// Cost of the poses.
        cost: f64,
        /// Squares of the point's extents along its principal axes, the largest first.
        spectrum: &'a [f64],
    },
}
