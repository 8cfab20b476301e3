//! What maps of united polygons tell.

use geometry::Point2;
use geometry::planar::overlay::{OverlayEvent, Region};
use probe::VertexId;

use crate::active::Broken;

use super::{DualGraph, OpenFrontier, Tag};

/// Steps of maps that unite views (\[Zie18\] 2.6 to 2.8, \[Mos15\] 4.3 to 4.5).
#[derive(Clone, Copy, Debug)]
pub enum PolygonEvent<'a> {
    /// Two edges met (\[Zie18\] 2.6.1); map frame.
    Intersected {
        /// Where.
        at: Point2,
        /// Whether the map's edge enters the view there (eq. 2.11), else it leaves it.
        entry: bool,
    },
    /// Two edges were joined where they met (\[Zie18\] 2.6.2).
    Merged {
        /// Where.
        at: Point2,
    },
    /// A loop came out (\[Zie18\] 2.6.3).
    LoopClosed {
        /// Its corners.
        corners: usize,
        /// Its area, square metres; negative for a hole.
        area_m2: f64,
    },
    /// A view was united with the map.
    United {
        /// The vertex of the view.
        vertex: VertexId,
        /// The view, placed in the map.
        view: &'a Region<Tag>,
        /// The map now.
        region: &'a Region<Tag>,
    },
    /// Poses changed, and all views were united again.
    Rebuilt {
        /// How many views.
        views: usize,
        /// The map now.
        region: &'a Region<Tag>,
    },
    /// What is open was measured.
    Settled {
        /// Where the robot stands.
        standing: VertexId,
        /// The map.
        region: &'a Region<Tag>,
        /// Its open frontier.
        open: &'a OpenFrontier,
    },
    /// The extended polygon was grown (\[Zie18\] 2.8.1).
    Extended {
        /// The vertex of the robot, in whose frame it is.
        root: VertexId,
        /// The polygons that intersect that of the robot, in the order in which they were met.
        members: &'a [VertexId],
        /// Their union.
        region: &'a Region<Tag>,
    },
    /// Corners inside the extended polygon became free (\[Zie18\] eq. 2.15).
    MarkedFree {
        /// Whose corners.
        vertex: VertexId,
        /// How many.
        count: usize,
    },
    /// Crossings outside the active area were found by following rings on (\[Zie18\] 2.7.2).
    Followed {
        /// The vertex of the view.
        vertex: VertexId,
        /// How many.
        found: usize,
    },
    /// Corners moved with their anchors after a loop closure (\[Zie18\] eq. 2.12).
    CornersMoved {
        /// The farthest that one moved, metres.
        moved_max_m: f64,
        /// The map now, before it is mended.
        region: &'a Region<Tag>,
    },
    /// Rings that crossed themselves were split (\[Zie18\] 2.7.5).
    Untwisted {
        /// Where they crossed.
        at: &'a [Point2],
        /// How many upended parts were turned round.
        flipped: usize,
        /// How many were removed.
        removed: usize,
    },
    /// The map is broken: a view could not be united with it.
    Invalid {
        /// The vertex of the view.
        vertex: VertexId,
        /// Why.
        why: Broken,
    },
    /// A way was planned since the last step (\[Mos15\] 4.5).
    WayPlanned {
        /// Centres of triangles, goals and start, with their links.
        dual: &'a DualGraph,
        /// The way, map frame; empty where there is none.
        way: &'a [Point2],
    },
}

probe::variants!(
    PolygonEvent<'_>:
    Intersected, Merged, LoopClosed, United, Rebuilt, Settled, Extended, MarkedFree,
    Followed, CornersMoved, Untwisted, Invalid, WayPlanned
);

impl PolygonEvent<'_> {
    /// What the kernel's overlay told, in the words of a map whose region is the first input.
    pub(crate) fn of_overlay(event: &OverlayEvent) -> PolygonEvent<'static> {
        match *event {
            OverlayEvent::Intersected { at, entry, .. } => PolygonEvent::Intersected { at, entry },
            OverlayEvent::Merged { at, .. } => PolygonEvent::Merged { at },
            OverlayEvent::LoopClosed { corners, area_m2, .. } => {
                PolygonEvent::LoopClosed { corners, area_m2 }
            }
        }
    }
}
