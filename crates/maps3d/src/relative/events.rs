//! What the relative map of space tells.

use pose::Se3;
use posegraph::{Scope, Skeleton};
use probe::{EdgeId, VertexId};
use solid::Tetrahedra;

use super::book::Cause;
use super::ledger::OpenPart;
use super::{RelativeMap, ViewState};
use crate::Plan;

/// Steps of consolidation in space (\[ISRR19\] 4.3, 4.4); numbers of views are those of
/// [`RelativeMap::views`].
#[derive(Clone, Copy, Debug)]
pub enum ConsolidationEvent<'a> {
    /// A look became a view.
    ViewAdded {
        /// Its number.
        view: u32,
        /// The view, all of its frontier open.
        state: &'a ViewState,
    },
    /// The scope was gathered: all vertices within the radius of the root along the graph, each placed
    /// along its shortest path.
    ScopeTaken {
        /// The scope; its first row is the root.
        scope: &'a Scope<Se3>,
        /// The links that the paths of the scope walk.
        skeleton: &'a Skeleton<Se3>,
    },
    /// The open frontier of one view was held against the volume of another.
    PairCompared {
        /// The view whose frontier was looked at.
        view: u32,
        /// The view that it was held against.
        against: u32,
        /// The camera of `against` in the frame of that of `view`, along the shortest path.
        camera_from_against: Se3,
        /// Why what was closed was closed.
        cause: Cause,
        /// Frontier area that this closed, square metres.
        closed_m2: f64,
    },
    /// A part of a frontier face was closed.
    Closed {
        /// The view that the face belongs to.
        view: u32,
        /// Its state before: volume, and where the camera was.
        state: &'a ViewState,
        /// Index into the frontier faces of the view.
        face: usize,
        /// What was open before, on the grid of the face ([`ViewState::grid`]).
        before: &'a OpenPart,
        /// What is open now.
        after: &'a OpenPart,
        /// Why.
        cause: Cause,
        /// The view that did it.
        by: u32,
        /// The measured edges of the path between the two.
        path: &'a [EdgeId],
    },
    /// A part of a frontier face was opened again, because a place edge was withdrawn.
    Reopened {
        /// The view that the face belongs to.
        view: u32,
        /// The view.
        state: &'a ViewState,
        /// Index into the frontier faces of the view.
        face: usize,
        /// What was open before.
        before: &'a OpenPart,
        /// What is open now.
        after: &'a OpenPart,
        /// The edge.
        edge: EdgeId,
    },
    /// Frontier about a place was given up.
    GivenUp {
        /// The vertex in whose frame the place is.
        vertex: VertexId,
        /// The place.
        place_in_vertex: nalgebra::Point3<f64>,
        /// The radius about it, metres.
        radius_m: f64,
    },
    /// A view that adds nothing was taken out of later comparisons.
    Retired {
        /// The view.
        view: u32,
    },
    /// A retired view was taken in again.
    Restored {
        /// The view.
        view: u32,
    },
    /// Views became volumes for the planner; what it tells next, and the way that it finds, is in the frame of the
    /// vertex.
    Fanned {
        /// The vertex.
        vertex: VertexId,
        /// The fans.
        volumes: &'a [Tetrahedra],
        /// Where it is sought from.
        from: nalgebra::Point3<f64>,
        /// Where to.
        to: nalgebra::Point3<f64>,
    },
    /// A way was planned through them.
    Planned {
        /// The vertex in whose frame everything is.
        vertex: VertexId,
        /// The way through centroids, its corridor, and the path that the cone programme made of it.
        plan: &'a Plan,
        /// The path that is given: that of the plan without bends that it can do without.
        given: &'a [nalgebra::Point3<f64>],
    },
    /// All that one look or edge set off is done.
    Settled {
        /// The map, to be read.
        map: &'a RelativeMap,
        /// The vertex that it happened at.
        vertex: VertexId,
    },
}

probe::variants!(ConsolidationEvent<'_>: ViewAdded, ScopeTaken, PairCompared, Closed, Reopened, GivenUp,
    Retired, Restored, Fanned, Planned, Settled);
