//! What a united map tells.

use nalgebra::Point3;
use pose::Se3;
use posegraph::Report;
use probe::VertexId;
use solid::{Polyhedron, SolidError, Tetrahedra};

use crate::{FrontierPatch, Plan};

/// Steps of uniting, correcting and planning; the numbers are those of `docs/global_union.md`. Everything is
/// in the frame `map`.
#[derive(Clone, Copy, Debug)]
pub enum UnionEvent<'a> {
    /// A view was moved by the estimated pose, and jittered (step 1).
    Placed {
        /// The number of the look.
        view: u32,
        /// The vertex that it was taken at.
        vertex: VertexId,
        /// The camera.
        map_from_camera: Se3,
        /// The view.
        operand: &'a Polyhedron,
    },
    /// A view was united with the map (step 2).
    United {
        /// The number of the look.
        view: u32,
        /// The map.
        map: &'a Polyhedron,
        /// Frontier faces of it that coincide with obstacle faces, and became obstacle.
        settled: usize,
    },
    /// Short edges were drawn together (step 3).
    Cleaned {
        /// The map.
        map: &'a Polyhedron,
        /// Where vertices were taken out, metres.
        removed: &'a [Point3<f64>],
    },
    /// The union refused a view; it stays beside the map, as a volume of its own (step 2).
    Refused {
        /// The number of the look.
        view: u32,
        /// Why.
        why: &'a SolidError,
    },
    /// Frontier of the map was sorted into patches (step 4).
    Sorted {
        /// The patches that count, points in the frame `map`.
        patches: &'a [FrontierPatch],
        /// Area of what does not count because it is too small, square metres.
        sliver_m2: f64,
    },
    /// The pose graph was optimised (step 5).
    Corrected {
        /// Place edges that gave the occasion.
        new_places: usize,
        /// `map_from_vertex` before, by vertex.
        before: &'a [Se3],
        /// `map_from_vertex` now, by vertex.
        after: &'a [Se3],
        /// The farthest that a vertex moved, metres.
        moved_max_m: f64,
        /// How the optimiser ended.
        report: &'a Report,
    },
    /// The optimiser ended at poses that cannot be used; they stay as they were (step 5).
    NotCorrected {
        /// How the optimiser ended.
        report: &'a Report,
    },
    /// Views moved, and all of them were united again (step 5).
    Rebuilt {
        /// How many views were united.
        views: usize,
        /// The farthest that a point of a view moved, metres.
        moved_max_m: f64,
        /// The map.
        map: &'a Polyhedron,
    },
    /// The map was filled with tetrahedra (step 6).
    Filled {
        /// The tetrahedra of the map.
        tetrahedra: &'a Tetrahedra,
    },
    /// The map could not be filled: the fans of its views stand for it (step 6).
    Fanned {
        /// Why.
        why: &'a SolidError,
        /// Number of fans.
        fans: usize,
    },
    /// A way to frontier was planned (step 7).
    Planned {
        /// The way, its corridor and its path.
        plan: &'a Plan,
        /// Points of the path that is given, after it was cut where it comes near to what was not seen.
        given: &'a [Point3<f64>],
    },
    /// Frontier round a place does not count from now on (step 4).
    GivenUp {
        /// The place.
        place: Point3<f64>,
        /// The radius, metres.
        radius_m: f64,
        /// Whether the map itself found no way to it.
        unreachable: bool,
    },
}

probe::variants!(UnionEvent<'_>: Placed, United, Cleaned, Refused, Sorted, Corrected, NotCorrected, Rebuilt,
    Filled, Fanned, Planned, GivenUp);
