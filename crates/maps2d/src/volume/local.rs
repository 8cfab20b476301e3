//! One view: a star polygon with labelled edges.

use std::fmt;

use geometry::Point2;
use geometry::planar::StarPolygon;

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
}

impl LocalVolume {
    /// Whether frontier edge `i` ends where the next one in boundary order starts.
    pub fn continues(&self, i: usize) -> bool {
        let next = if i + 1 == self.frontier.len() { 0 } else { i + 1 };
        self.frontier[i].to == self.frontier[next].from
    }

    /// An upper bound of the distance of any boundary point from the anchor, metres.
    pub fn radius_m(&self) -> f64 {
        self.polygon.outer_radius()
    }

    /// Memory held on the heap, bytes.
    pub fn heap_bytes(&self) -> usize {
        (self.polygon.len() + self.inner.len()) * (size_of::<Point2>() + 1)
            + self.frontier.capacity() * size_of::<FrontierEdge>()
            + self.obstacles.capacity() * size_of::<ObstacleEdge>()
            + self.posts.capacity() * size_of::<Point2>()
    }
}
