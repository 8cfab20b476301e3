//! The boundary as a closed chain of straight edges.

use super::StarPolygon;
use crate::Point2;

/// What a boundary edge is; the number is the polygon's edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum BoundaryKind {
    /// The chord from vertex `i` to the next.
    Chord(usize),
    /// The spoke from vertex `i`, before gap `i`, to the origin.
    SpokeIn(usize),
    /// The spoke from the origin to the vertex after gap `i`.
    SpokeOut(usize),
}

/// One straight edge of the boundary.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundaryEdge {
    /// What it is.
    pub kind: BoundaryKind,
    /// Its first point, in the polygon's frame.
    pub from: Point2,
    /// Its last point, where the next edge begins.
    pub to: Point2,
}

impl StarPolygon {
    /// The edges of the boundary, counter-clockwise from vertex 0: a chord, or two spokes per gap.
    pub fn boundary(&self) -> impl Iterator<Item = BoundaryEdge> + '_ {
        let zero = Point2::origin();
        (0..self.len()).flat_map(move |i| {
            let (v, w) = (self.vertices[i], self.vertices[self.next(i)]);
            let edge = |kind, from, to| Some(BoundaryEdge { kind, from, to });
            let edges = if self.gap_after[i] {
                [edge(BoundaryKind::SpokeIn(i), v, zero), edge(BoundaryKind::SpokeOut(i), zero, w)]
            } else {
                [edge(BoundaryKind::Chord(i), v, w), None]
            };
            edges.into_iter().flatten()
        })
    }
}
