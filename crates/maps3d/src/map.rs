//! What a policy asks of a map of space, whatever represents it.

use nalgebra::{Point3, Vector3};
use pose::Se3;
use posegraph::PoseGraph;
use probe::{EdgeId, VertexId};
use sensing::DepthImage;

use crate::{Map3dProbe, Maps3dError};

/// Where the robot believes that it hovers: at a vertex, maybe turned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hovering {
    /// The vertex.
    pub vertex: VertexId,
    /// The body in the frame of the vertex; it only turns about the vertical.
    pub vertex_from_body: Se3,
}

/// One depth image and where it was taken.
#[derive(Clone, Copy, Debug)]
pub struct Look<'a> {
    /// The vertex that the robot hovered at.
    pub vertex: VertexId,
    /// The camera in the frame of the vertex. Looks of one vertex are exact to each other: the robot
    /// turned on the spot.
    pub vertex_from_camera: Se3,
    /// What was seen.
    pub image: &'a DepthImage,
}

/// A place on a frontier, and the share of the frontier that it stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrontierPoint {
    /// A point of the frontier, in the frame `body`, metres.
    pub in_body: Point3<f64>,
    /// Unit vector across the frontier there, into the unknown, in the frame `body`.
    pub normal_in_body: Vector3<f64>,
    /// The area that it stands for, square metres.
    pub area_m2: f64,
}

/// Frontier that hangs together and counts.
#[derive(Clone, Debug, PartialEq)]
pub struct FrontierPatch {
    /// The vertex whose views it belongs to; that of [`Hovering`] for maps with one global frame.
    pub owner: VertexId,
    /// Points to go to, the one that stands for the largest area first; at least one. A large
    /// frontier has several (\[Mos15\] 4.3).
    pub points: Vec<FrontierPoint>,
    /// Its area, square metres.
    pub area_m2: f64,
    /// A name that stays the same while the map does not change.
    pub tag: u64,
}

/// How near a straight motion comes to what is solid, and to what was not seen from where it starts.
///
/// A point, not a body: a round body keeps clear where these exceed its radius.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlightClearance {
    /// The least distance to what is solid, metres, at the start of the motion.
    pub solid_at_start_m: f64,
    /// The same along all of it; 0 where it goes through something.
    pub solid_m: f64,
    /// The same at its end.
    pub solid_at_end_m: f64,
    /// The least distance to what was not seen along the part of the motion that is farther than
    /// `leaving_m` from its start, metres; 0 where it leaves what was seen.
    ///
    /// Nearer than that the robot's own place ends: it has no eyes for what is beside it.
    pub unseen_m: f64,
    /// The same at its end.
    pub unseen_at_end_m: f64,
}

impl FlightClearance {
    /// Leaves what was seen, or goes through something.
    pub const NONE: Self = Self {
        solid_at_start_m: 0.0,
        solid_m: 0.0,
        solid_at_end_m: 0.0,
        unseen_m: 0.0,
        unseen_at_end_m: 0.0,
    };

    /// Whether a round body keeps these distances; or, where it starts nearer to something solid,
    /// gets no nearer and ends at that distance.
    pub fn keeps(&self, solid_m: f64, unseen_m: f64) -> bool {
        let leaves = self.solid_at_start_m < solid_m
            && self.solid_m > 0.0
            && self.solid_m >= 0.99 * self.solid_at_start_m
            && self.solid_at_end_m >= solid_m;
        self.unseen_m >= unseen_m && (self.solid_m >= solid_m || leaves)
    }
}

/// What is left to explore, as the map believes, and what it holds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MapTally {
    /// Area of the frontier that counts, square metres.
    pub open_m2: f64,
    /// Area of frontier that does not, because it hangs together over too little, square metres.
    pub sliver_m2: f64,
    /// The largest of those pieces, square metres.
    pub largest_sliver_m2: f64,
    /// Area of frontier that does not, because it was given up, square metres.
    pub given_up_m2: f64,
    /// Pieces of frontier that count.
    pub patches: usize,
    /// Faces that the map holds; 0 for cells.
    pub faces: usize,
    /// Volumes on vertices, or cells.
    pub volumes: usize,
}

/// What a map did so far beside taking looks in; for reports.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MapWork {
    /// How often it placed its views anew because poses were corrected.
    pub corrections: u64,
    /// Views that it could not take in, or not as it should: each was told by an event.
    pub refused: u64,
    /// Tetrahedra of the last time that space was cut into some.
    pub tetrahedra: usize,
    /// Paths that were planned through tetrahedra.
    pub paths: u64,
    /// Their lengths through centroids, summed, metres.
    pub paths_m: f64,
    /// The same after they were shortened, metres: by cone programmes, and in maps of several volumes by leaving out
    /// bends that they can do without.
    pub shortened_m: f64,
}

/// How to get to frontier that cannot be gone to from here.
#[derive(Clone, Debug, PartialEq)]
pub enum FlightRoute {
    /// By teach and repeat along the graph: the vertices in order, each with the length of the link
    /// that leads to it, metres. Empty where the robot is at the goal already.
    Repeat(Vec<(VertexId, f64)>),
    /// Straight legs through free space: points in the frame `body` of now.
    Fly(Vec<Point3<f64>>),
}

/// How many views have a point in their image, by what they say of it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sights {
    /// Their volume holds it.
    pub free: usize,
    /// Something solid stands before it, or it is solid.
    pub solid: usize,
    /// They end at frontier before it.
    pub unknown: usize,
}

/// What a map takes a point for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Known {
    /// Nothing stands there.
    Free,
    /// Something does.
    Solid,
    /// Nobody looked.
    Unknown,
}

/// A map of space that exploration runs on: fed with looks and graph events, asked for frontiers.
///
/// The twin of `ExplorationMap` of `maps2d`. Points are in the frame `body` of [`Hovering`], so that no
/// answer needs a global frame.
pub trait Map3d {
    /// The name of the representation, as in configs and results: `relative`, `voxels`, ...
    fn kind(&self) -> &'static str;

    /// Edges were added to `graph`, all with one vertex in common; it may have no view yet.
    fn edges_added(&mut self, graph: &PoseGraph<Se3>, edges: &[EdgeId], probe: &mut dyn Map3dProbe);

    /// A place edge of `graph` was withdrawn.
    fn edge_withdrawn(&mut self, graph: &PoseGraph<Se3>, edge: EdgeId, probe: &mut dyn Map3dProbe);

    /// Poses of the graph were estimated anew: `map_from_vertex` by vertex. Maps without one global
    /// frame do not look at them.
    fn poses_reestimated(&mut self, _map_from_vertex: &[Se3], _probe: &mut dyn Map3dProbe) {}

    /// A depth image was taken at a vertex, or after turning on the spot there.
    ///
    /// # Errors
    /// An image or a camera that no view can be made of; the map is what it was before.
    fn looked(&mut self, look: &Look<'_>, probe: &mut dyn Map3dProbe) -> Result<(), Maps3dError>;

    /// What is left to explore, and what the map holds.
    fn tally(&self) -> MapTally;

    /// The frontier that can be gone to from where the robot hovers, in no particular order: that of
    /// the views taken there, or all there is in a map with one global frame. `out` is overwritten.
    fn frontiers(&mut self, hovering: &Hovering, out: &mut Vec<FrontierPatch>);

    /// Whether frontier belongs to the vertices whose views it is of, and is told at these alone; a map with
    /// one global frame tells all of it wherever the robot hovers.
    fn is_by_vertex(&self) -> bool {
        false
    }

    /// Area of the frontier that counts at a vertex, square metres; 0 means that a way to it is not
    /// worth going on with. Maps with one global frame tell all.
    fn frontier_at(&self, vertex: VertexId) -> f64;

    /// The way to the nearest frontier of a vertex that `comes_now`, or `None` if there is none.
    ///
    /// `clearance_m` is what a [`FlightRoute::Fly`] keeps from everything. A map whose frontier belongs
    /// to no vertex leads to the nearest of all; frontier that it finds no way to is given up, and told.
    fn route(
        &mut self,
        hovering: &Hovering,
        clearance_m: f64,
        comes_now: &dyn Fn(VertexId) -> bool,
    ) -> Option<FlightRoute>;

    /// [`route`](Self::route), watched by a probe; maps with nothing to tell of it tell nothing.
    fn route_with(
        &mut self,
        hovering: &Hovering,
        clearance_m: f64,
        comes_now: &dyn Fn(VertexId) -> bool,
        _probe: &mut dyn Map3dProbe,
    ) -> Option<FlightRoute> {
        self.route(hovering, clearance_m, comes_now)
    }

    /// The way of a round body to the nearest frontier through the views around, whoever took them: bends and the
    /// frontier at its end, in the frame `body`. `None` where there is none, and for maps that plan no other way
    /// than [`route`](Self::route).
    fn way_through_views(
        &mut self,
        _hovering: &Hovering,
        _radius_m: f64,
    ) -> Option<Vec<Point3<f64>>> {
        None
    }

    /// A way of a round body to a place in the frame of a vertex, through the views between, whoever took them: its
    /// bends and the place at its end, in the frame `body`. `None` where none is found, where the vertex is too far
    /// along the graph, and for maps that plan no such ways. A way is planned on what was seen, with drift: each leg is
    /// to be looked at before it is flown.
    fn way_to(
        &mut self,
        _hovering: &Hovering,
        _vertex: VertexId,
        _place_in_vertex: &Point3<f64>,
        _radius_m: f64,
        _probe: &mut dyn Map3dProbe,
    ) -> Option<Vec<Point3<f64>>> {
        None
    }

    /// How near the straight motion `to_in_body` comes to what is solid, and to what was not seen.
    ///
    /// Within `leaving_m` of its start what was not seen does not count: the body is there already, or
    /// came from there.
    fn clearance(
        &mut self,
        hovering: &Hovering,
        to_in_body: &Point3<f64>,
        leaving_m: f64,
    ) -> FlightClearance;

    /// Frontier of a vertex was put off, or with `is_last` is about to be given up: a map that holds it against views
    /// near in the graph only holds it against farther ones now. Others do nothing.
    fn compare_farther(&mut self, _vertex: VertexId, _is_last: bool, _probe: &mut dyn Map3dProbe) {}

    /// Frontier within `radius_m` of any of these places does not count from now on.
    ///
    /// With `everywhere` the robot got as near as it may, looked, and it is still there: that holds for
    /// every volume in scope, now and later. Without, only frontier of the vertex where it hovers. Views are measured
    /// once, however many the places are.
    fn give_up(
        &mut self,
        hovering: &Hovering,
        places_in_body: &[Point3<f64>],
        radius_m: f64,
        everywhere: bool,
        probe: &mut dyn Map3dProbe,
    );

    /// What the map takes a point for, by all views near in the graph.
    fn knows(&self, hovering: &Hovering, point_in_body: &Point3<f64>) -> Known;

    /// For each straight line, whether all of it but its last `short_m` metres is free by the views near in the
    /// graph, whoever took them.
    fn free_lines(
        &mut self,
        hovering: &Hovering,
        lines_in_body: &[[Point3<f64>; 2]],
        short_m: f64,
    ) -> Vec<bool> {
        let is_free = |point: &Point3<f64>| self.knows(hovering, point) == Known::Free;
        lines_in_body.iter().map(|line| points_on(line, short_m).all(|p| is_free(&p))).collect()
    }

    /// Whether any of these points is taken for solid by the views near in the graph.
    fn meets_solid(&mut self, hovering: &Hovering, points_in_body: &[Point3<f64>]) -> bool {
        points_in_body.iter().any(|point| self.knows(hovering, point) == Known::Solid)
    }

    /// How views of other vertices than the one hovered at see a point, as far along the graph as frontier is
    /// ever held against; a map that does not know its views says nothing.
    fn sights_of(&mut self, _hovering: &Hovering, _point_in_body: &Point3<f64>) -> Sights {
        Sights::default()
    }

    /// What the map did so far; all zero for maps that count nothing.
    fn work(&self) -> MapWork {
        MapWork::default()
    }

    /// Memory held, bytes.
    fn bytes(&self) -> usize;
}

/// Points of a line are looked at so far apart, metres.
const LINE_STEP_M: f64 = 0.15;

/// Points along a line but its last `short_m` metres, the far end first: it is what is unknown most often.
pub(crate) fn points_on(
    [from, to]: &[Point3<f64>; 2],
    short_m: f64,
) -> impl Iterator<Item = Point3<f64>> {
    let (from, way) = (*from, to - from);
    let length_m = way.norm();
    let seen_m = (length_m - short_m).max(0.0);
    let steps = (seen_m / LINE_STEP_M).ceil().clamp(0.0, 1e6) as usize;
    let step = way * (seen_m / (length_m * steps.max(1) as f64).max(1e-12));
    (1..=steps).rev().map(move |i| from + step * i as f64)
}
