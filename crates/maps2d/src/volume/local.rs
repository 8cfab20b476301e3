//! One view: a star polygon with labelled edges.

use std::fmt;

use geometry::Point2;
use geometry::planar::StarPolygon;
use geometry::planar::{box_gap, point_segment_distance, segment_segment_distance};

use super::Rim;
use crate::Clearance;

/// Which boundary edge of a volume: a chord, or one of the two spokes of a gap.
///
/// Even keys `2 i` are the chord after vertex `i`, or the spoke from it to the sensor; odd keys
/// `2 i + 1` the spoke from the sensor to the vertex after.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct EdgeKey(pub u32);

impl fmt::Debug for EdgeKey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "edge{}{}", self.0 / 2, if self.0 % 2 == 1 { "out" } else { "" })
    }
}

/// An edge behind which nothing is known; counter-clockwise along the boundary, anchor frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrontierEdge {
    /// Which edge.
    pub key: EdgeKey,
    /// Where it starts.
    pub from: Point2,
    /// Where it ends.
    pub to: Point2,
    /// Whether it is a spoke, an edge at the sensor: turning is enough to look behind it.
    pub spoke: bool,
}

impl FrontierEdge {
    /// Length, metres.
    pub fn length_m(&self) -> f64 {
        (self.to - self.from).norm()
    }

    /// The point at parameter `t`.
    pub fn at(&self, t: f64) -> Point2 {
        self.from + (self.to - self.from) * t
    }
}

/// An edge along something solid; counter-clockwise along the boundary, anchor frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ObstacleEdge {
    /// Which edge.
    pub key: EdgeKey,
    /// Where it starts.
    pub from: Point2,
    /// Where it ends.
    pub to: Point2,
}

/// The free space seen from one place, in the frame of its vertex (the anchor). Never changes.
#[derive(Clone, Debug, PartialEq)]
pub struct LocalVolume {
    /// The view as measured.
    pub polygon: StarPolygon,
    /// The view pulled in by the strictness margin: what lies in it is free for certain.
    pub inner: StarPolygon,
    /// Frontier edges in boundary order.
    pub frontier: Vec<FrontierEdge>,
    /// Obstacle edges in boundary order.
    pub obstacles: Vec<ObstacleEdge>,
    /// Hits that bound no obstacle edge, such as a lone thin post; anchor frame.
    pub posts: Vec<Point2>,
    /// All of these by direction.
    pub(crate) rim: Rim,
}

impl LocalVolume {
    /// A view of nothing.
    pub fn empty() -> Self {
        Self {
            polygon: StarPolygon::empty(),
            inner: StarPolygon::empty(),
            frontier: Vec::new(),
            obstacles: Vec::new(),
            posts: Vec::new(),
            rim: Rim::empty(),
        }
    }

    /// Whether frontier edge `i` ends where the next one in boundary order starts.
    pub fn continues(&self, i: usize) -> bool {
        let next = if i + 1 == self.frontier.len() { 0 } else { i + 1 };
        self.frontier[i].to == self.frontier[next].from
    }

    /// An upper bound of the distance of any boundary point from the anchor, metres.
    pub fn radius_m(&self) -> f64 {
        self.polygon.outer_radius()
    }

    /// How near the straight motion from the anchor to `to_in_anchor` comes to what is solid here.
    pub fn motion_clearance(&self, to_in_anchor: &Point2) -> Clearance {
        let reach_m = self.polygon.radius_towards(to_in_anchor);
        if to_in_anchor.coords.norm() > reach_m + 1e-9 {
            return Clearance::NONE;
        }
        let origin = Point2::origin();
        let posts = self.posts.iter().map(|post| (*post, *post));
        let walls = self.obstacles.iter().map(|wall| (wall.from, wall.to)).chain(posts);
        let mut clearance = Clearance {
            at_start_m: f64::MAX,
            along_m: f64::MAX,
            after_m: f64::MAX,
            at_end_m: f64::MAX,
        };
        let length_m = to_in_anchor.coords.norm();
        let first_m = Clearance::LEAVING_M.min(length_m);
        let away = if length_m > 0.0 {
            Point2::from(to_in_anchor.coords * (first_m / length_m))
        } else {
            origin
        };
        for (from, to) in walls {
            let Clearance { at_start_m, after_m, at_end_m, .. } = clearance;
            let farthest_m = at_start_m.max(after_m).max(at_end_m);
            if box_gap(&origin, to_in_anchor, &from, &to) >= farthest_m {
                continue;
            }
            let along_m = segment_segment_distance(&origin, to_in_anchor, &from, &to);
            clearance.along_m = clearance.along_m.min(along_m);
            let after_m = segment_segment_distance(&away, to_in_anchor, &from, &to);
            clearance.after_m = clearance.after_m.min(after_m);
            let start_m = point_segment_distance(&origin, &from, &to);
            clearance.at_start_m = clearance.at_start_m.min(start_m);
            let end_m = point_segment_distance(to_in_anchor, &from, &to);
            clearance.at_end_m = clearance.at_end_m.min(end_m);
        }
        clearance
    }

    /// A point in view from which `goal_in_anchor` can be reached: both straight ways, from the
    /// anchor to it and from it to the goal, keep the clearance. Of those tried, the one with the
    /// shortest way.
    ///
    /// Tries points at shares of the rays. Cost: O(n) for each of them; meant as a rescue.
    pub fn detour(&self, goal_in_anchor: &Point2, clearance_m: f64) -> Option<Point2> {
        const RAYS: usize = 48;
        const SHARES: [f64; 5] = [0.15, 0.3, 0.5, 0.7, 0.85];
        let every = self.polygon.len().div_ceil(RAYS).max(1);
        let mut stops: Vec<(f64, Point2)> = Vec::new();
        for vertex in self.polygon.vertices().iter().step_by(every) {
            for share in SHARES {
                let stop = Point2::from(vertex.coords * share);
                stops.push((stop.coords.norm() + (goal_in_anchor - stop).norm(), stop));
            }
        }
        stops.sort_by(|a, b| a.0.total_cmp(&b.0));
        stops.into_iter().map(|(_, stop)| stop).find(|stop| {
            // Few see the goal, and the clearance from the start is the dear one.
            self.keeps_clear(stop, goal_in_anchor, clearance_m)
                && self.motion_clearance(stop).keeps(clearance_m)
        })
    }

    /// Whether a straight way in view keeps a distance from what is solid here.
    fn keeps_clear(&self, from: &Point2, to: &Point2, clearance_m: f64) -> bool {
        // The goal lies on the boundary, so the way is inside but for its last bit.
        let mut inside = Vec::new();
        self.polygon.clip(from, to, &mut inside);
        let seen = inside.len() == 1 && inside[0].from <= 0.0 && inside[0].to >= 0.99;
        seen && self
            .obstacles
            .iter()
            .filter(|wall| box_gap(from, to, &wall.from, &wall.to) < clearance_m)
            .all(|wall| segment_segment_distance(from, to, &wall.from, &wall.to) >= clearance_m)
            && self.posts.iter().all(|post| point_segment_distance(post, from, to) >= clearance_m)
    }

    /// Whether a point lies in a direction that was not looked into, within the reach of the view.
    pub fn is_unseen_towards(&self, point_in_anchor: &Point2) -> bool {
        let near = point_in_anchor.coords.norm() <= self.radius_m();
        near && self.polygon.radius_towards(point_in_anchor) == 0.0
    }

    /// Memory held on the heap, bytes.
    pub fn heap_bytes(&self) -> usize {
        (self.polygon.len() + self.inner.len()) * (size_of::<Point2>() + 1)
            + self.frontier.capacity() * size_of::<FrontierEdge>()
            + self.obstacles.capacity() * size_of::<ObstacleEdge>()
            + self.posts.capacity() * size_of::<Point2>()
            + self.rim.heap_bytes()
    }
}
