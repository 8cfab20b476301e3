//! What a correction tells.

use pose::Se2;
use posegraph::Report;

/// Steps of correcting global poses.
#[derive(Clone, Copy, Debug)]
pub enum CorrectionEvent<'a> {
    /// The whole graph was optimised.
    Corrected {
        /// How many place edges gave the occasion.
        new_places: usize,
        /// Factors of the graph.
        factors: usize,
        /// `map_from_vertex` before, by vertex.
        before: &'a [Se2],
        /// `map_from_vertex` now, by vertex.
        after: &'a [Se2],
        /// The farthest that a vertex moved, metres.
        moved_max_m: f64,
        /// How the optimiser ended, its cost and every iteration.
        report: &'a Report,
    },
    /// The optimiser ended at poses that cannot be used; the poses stay as they were.
    Refused {
        /// How the optimiser ended.
        report: &'a Report,
    },
}

probe::variants!(CorrectionEvent<'_>: Corrected, Refused);
