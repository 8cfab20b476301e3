//! Labelled regions: rings of edges, each with a label and data of the caller's.

use crate::Point2;
use crate::planar::{StarPolygon, point_segment_distance};
use crate::predicates::orient;

/// What is at an edge; greater ones win where edges coincide.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub enum EdgeLabel {
    /// Free space on both sides.
    #[default]
    Free,
    /// Nobody has looked beyond.
    Frontier,
    /// Something solid.
    Obstacle,
}

/// What an edge carries.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct RingEdge<T> {
    /// What is there.
    pub label: EdgeLabel,
    /// Whatever the caller wants to know of it; goes with every piece of the edge.
    pub data: T,
}

/// A closed chain of edges; the inside of the region lies to the left.
#[derive(Clone, Debug, PartialEq)]
pub struct Ring<T> {
    /// The corners, metres.
    pub points: Vec<Point2>,
    /// The edge from each corner to the next, cyclically; as many as corners.
    pub edges: Vec<RingEdge<T>>,
}

/// So many corners in a row are left out at most, so that thinning a long wall stays linear.
const MOST_LEFT_OUT: usize = 32;

impl<T> Ring<T> {
    /// Twice the signed area, square metres: positive for an outer ring, negative for a hole.
    pub fn twice_area_m2(&self) -> f64 {
        let Some(first) = self.points.first() else { return 0.0 };
        // From a corner of its own, so that nothing cancels far from the origin.
        self.points.windows(2).map(|pair| (pair[0] - first).perp(&(pair[1] - first))).sum()
    }

    /// See [`Region::thinned`].
    fn thinned(&self, slack_m: f64, alike: &impl Fn(&RingEdge<T>, &RingEdge<T>) -> bool) -> Self
    where
        T: Copy,
    {
        let n = self.points.len();
        let mut points: Vec<Point2> = Vec::with_capacity(n);
        let mut edges: Vec<RingEdge<T>> = Vec::with_capacity(n);
        // Corners left out since the last one kept, which the straight edge has to keep near to.
        let mut left_out: Vec<Point2> = Vec::new();
        for i in 0..n {
            let (point, after) = (self.points[i], self.points[self.next(i)]);
            if let (Some(from), Some(edge)) = (points.last(), edges.last())
                && alike(edge, &self.edges[i])
            {
                left_out.push(point);
                let ahead = (after - from).dot(&(point - from)) > 0.0;
                let near = |p: &Point2| point_segment_distance(p, from, &after) <= slack_m;
                if ahead && left_out.len() <= MOST_LEFT_OUT && left_out.iter().all(near) {
                    continue;
                }
            }
            left_out.clear();
            points.push(point);
            edges.push(self.edges[i]);
        }
        if points.len() < 3 { self.clone() } else { Self { points, edges } }
    }

    /// Whether it bounds a hole.
    pub fn is_hole(&self) -> bool {
        self.twice_area_m2() < 0.0
    }

    /// The corner after corner `i`, cyclically.
    pub fn next(&self, i: usize) -> usize {
        if i + 1 == self.points.len() { 0 } else { i + 1 }
    }
}

/// How often a closed chain of points winds around a point, counter-clockwise; on the chain itself
/// it may go either way. Exact. Cost: the points.
pub fn winding(chain: impl Iterator<Item = Point2> + Clone, point: &Point2) -> i32 {
    let mut winding = 0;
    let ends = chain.clone().skip(1).chain(chain.clone().take(1));
    for (from, to) in chain.zip(ends) {
        if (from.y <= point.y) == (to.y <= point.y) {
            continue;
        }
        let left = orient(&from, &to, point);
        if from.y <= point.y && left > 0.0 {
            winding += 1;
        } else if from.y > point.y && left < 0.0 {
            winding -= 1;
        }
    }
    winding
}

/// One edge of a region.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RegionEdge<T> {
    /// Which ring.
    pub ring: usize,
    /// Which edge of it.
    pub edge: usize,
    /// Where it starts.
    pub from: Point2,
    /// Where it ends; the inside lies to the left.
    pub to: Point2,
    /// What is there.
    pub label: EdgeLabel,
    /// The caller's data.
    pub data: T,
}

/// A region of the plane: outer rings counter-clockwise, each followed by its holes, clockwise.
///
/// Rings may touch in points. What an operation returns holds these rules; what it is given may
/// overlap itself, and counts as inside where rings wind around it.
#[derive(Clone, Debug, PartialEq)]
pub struct Region<T> {
    /// The rings.
    pub rings: Vec<Ring<T>>,
}

impl<T> Default for Region<T> {
    fn default() -> Self {
        Self { rings: Vec::new() }
    }
}

impl<T: Copy> Region<T> {
    /// The region inside one ring, given by corners in counter-clockwise order, each with the edge
    /// that starts there.
    pub fn from_ring(corners: impl IntoIterator<Item = (Point2, RingEdge<T>)>) -> Self {
        let (points, edges): (Vec<_>, Vec<_>) = corners.into_iter().unzip();
        Self { rings: vec![Ring { points, edges }] }
    }

    /// The region inside a view, placed by `place`, each boundary edge with what `edge` says of it.
    ///
    /// `edge` is asked with the number of the edge in boundary order.
    pub fn from_view(
        view: &StarPolygon,
        place: impl Fn(&Point2) -> Point2,
        edge: impl Fn(crate::planar::BoundaryEdge) -> RingEdge<T>,
    ) -> Self {
        if view.is_empty() {
            return Self::default();
        }
        Self::from_ring(view.boundary().map(|side| (place(&side.from), edge(side))))
    }

    /// Whether there is no ring.
    pub fn is_empty(&self) -> bool {
        self.rings.is_empty()
    }

    /// The area, square metres.
    pub fn area_m2(&self) -> f64 {
        0.5 * self.rings.iter().map(Ring::twice_area_m2).sum::<f64>()
    }

    /// All edges, ring by ring.
    pub fn edges(&self) -> impl Iterator<Item = RegionEdge<T>> + '_ {
        (0..self.rings.len()).flat_map(|ring| self.edges_of(ring))
    }

    /// The edges of one ring.
    ///
    /// # Panics
    /// If there is no such ring.
    pub fn edges_of(&self, ring: usize) -> impl Iterator<Item = RegionEdge<T>> + '_ {
        let Ring { points, edges } = &self.rings[ring];
        edges.iter().enumerate().map(move |(i, edge)| RegionEdge {
            ring,
            edge: i,
            from: points[i],
            to: points[if i + 1 == points.len() { 0 } else { i + 1 }],
            label: edge.label,
            data: edge.data,
        })
    }

    /// The number of edges.
    pub fn edge_count(&self) -> usize {
        self.rings.iter().map(|ring| ring.edges.len()).sum()
    }

    /// Whether a point is inside; on the boundary it may go either way. Cost: the edges.
    pub fn contains(&self, point: &Point2) -> bool {
        self.rings.iter().map(|ring| winding(ring.points.iter().copied(), point)).sum::<i32>() != 0
    }

    /// The rings in groups: an outer ring and its holes. In the order of the rings.
    pub fn sheets(&self) -> Vec<std::ops::Range<usize>> {
        let mut sheets: Vec<std::ops::Range<usize>> = Vec::new();
        for (i, ring) in self.rings.iter().enumerate() {
            match sheets.last_mut() {
                Some(last) if ring.is_hole() => last.end = i + 1,
                _ => sheets.push(i..i + 1),
            }
        }
        sheets
    }

    /// The same region with other data on its edges.
    pub fn map<U>(&self, mut data: impl FnMut(RegionEdge<T>) -> RingEdge<U>) -> Region<U> {
        let mut rings: Vec<Ring<U>> = self
            .rings
            .iter()
            .map(|ring| Ring { points: ring.points.clone(), edges: Vec::new() })
            .collect();
        for edge in self.edges() {
            let ring = edge.ring;
            let changed = data(edge);
            rings[ring].edges.push(changed);
        }
        Region { rings }
    }

    /// The region with fewer corners: one between two edges that `alike` holds for goes where the
    /// boundary moves by at most `slack_m`. The edge that stays keeps what the first one carries.
    ///
    /// Unions of many views leave a corner on every wall for every ray that hit it. Rings with an
    /// inside keep one; edges may come to cross others that are nearer than the slack. Linear.
    pub fn thinned(
        &self,
        slack_m: f64,
        alike: impl Fn(&RingEdge<T>, &RingEdge<T>) -> bool,
    ) -> Self {
        let rings = self.rings.iter().map(|ring| ring.thinned(slack_m, &alike)).collect();
        Self { rings }
    }

    /// Memory held on the heap, bytes.
    pub fn heap_bytes(&self) -> usize {
        let edge = size_of::<Point2>() + size_of::<RingEdge<T>>();
        self.rings.len() * size_of::<Ring<T>>() + self.edge_count() * edge
    }
}
