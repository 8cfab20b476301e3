//! The star polygon: construction with exact checks, and its measures.

use super::PlanarError;
use crate::Point2;
use crate::predicates::{compare_bearing_from, cross, in_envelope};

/// A view: a polygon that is star-shaped around the origin of its own frame.
///
/// Vertices have strictly increasing bearing within one turn and are never at the origin. Edge `i`
/// joins vertex `i` to the next one, cyclically. It is a *chord*, a straight edge spanning less
/// than half a turn, or a *gap*, where the boundary runs from vertex `i` to the origin (a spoke in)
/// and on to the next vertex (a spoke out). The inside is open: the boundary belongs to the
/// outside. Immutable; metres.
#[derive(Clone, Debug, PartialEq)]
pub struct StarPolygon {
    pub(super) vertices: Vec<Point2>,
    pub(super) gap_after: Vec<bool>,
    /// The first vertex at half a turn or more from vertex 0.
    pub(super) half: usize,
    pub(super) has_gap: bool,
    pub(super) outer_radius: f64,
}

impl StarPolygon {
    /// Checks and takes vertices in counter-clockwise order and, for each, whether a gap follows.
    ///
    /// No vertices at all give the polygon without an inside. O(n), exact.
    ///
    /// # Errors
    /// [`PlanarError`] names the first vertex that breaks a rule of [`StarPolygon`], or lies outside
    /// the envelope of the predicates.
    pub fn try_new(vertices: Vec<Point2>, gap_after: Vec<bool>) -> Result<Self, PlanarError> {
        let n = vertices.len();
        if gap_after.len() != n {
            return Err(PlanarError::FlagCount { vertices: n, flags: gap_after.len() });
        }
        for (vertex, p) in vertices.iter().enumerate() {
            if !in_envelope(p) {
                return Err(PlanarError::OutsideEnvelope { vertex, x: p.x, y: p.y });
            }
            if p.x == 0.0 && p.y == 0.0 {
                return Err(PlanarError::AtOrigin { vertex });
            }
        }
        for vertex in 1..n {
            let before = vertex - 1;
            let order = compare_bearing_from(&vertices[0], &vertices[before], &vertices[vertex]);
            if !order.is_lt() {
                return Err(PlanarError::BearingOrder { vertex, before });
            }
        }
        for vertex in 0..n {
            let next = if vertex + 1 == n { 0 } else { vertex + 1 };
            if !gap_after[vertex] && cross(&vertices[vertex], &vertices[next]) <= 0.0 {
                return Err(PlanarError::WideChord { vertex, next });
            }
        }
        Ok(Self::from_checked(vertices, gap_after))
    }

    /// The polygon without vertices and without an inside.
    pub fn empty() -> Self {
        Self::from_checked(Vec::new(), Vec::new())
    }

    pub(super) fn from_checked(vertices: Vec<Point2>, gap_after: Vec<bool>) -> Self {
        let half = vertices.first().map_or(0, |first| {
            vertices.partition_point(|p| !crate::predicates::half_turn_or_more(first, p))
        });
        let has_gap = vertices.is_empty() || gap_after.contains(&true);
        // Rounded up, so that a quick refusal by radius never refuses a point inside.
        let outer_radius = vertices.iter().map(|p| p.x.hypot(p.y)).fold(0.0, f64::max)
            * (1.0 + 4.0 * f64::EPSILON);
        Self { vertices, gap_after, half, has_gap, outer_radius }
    }

    /// How many vertices, and as many edges.
    pub fn len(&self) -> usize {
        self.vertices.len()
    }

    /// Whether there is no vertex.
    pub fn is_empty(&self) -> bool {
        self.vertices.is_empty()
    }

    /// The vertices, counter-clockwise.
    pub fn vertices(&self) -> &[Point2] {
        &self.vertices
    }

    /// Vertex `i`.
    ///
    /// # Panics
    /// If there is no vertex `i`.
    pub fn vertex(&self, i: usize) -> Point2 {
        self.vertices[i]
    }

    /// The vertex after vertex `i`, cyclically.
    #[inline]
    pub fn next(&self, i: usize) -> usize {
        if i + 1 == self.vertices.len() { 0 } else { i + 1 }
    }

    /// The vertex before vertex `i`, cyclically.
    #[inline]
    pub fn previous(&self, i: usize) -> usize {
        if i == 0 { self.vertices.len().saturating_sub(1) } else { i - 1 }
    }

    /// Whether edge `i` is a gap.
    ///
    /// # Panics
    /// If there is no edge `i`.
    #[inline]
    pub fn is_gap(&self, i: usize) -> bool {
        self.gap_after[i]
    }

    /// Whether any edge is a gap: then the origin is on the boundary, else it is inside.
    pub fn has_gap(&self) -> bool {
        self.has_gap
    }

    /// An upper bound, tight to a few units in the last place, of the distance of any vertex.
    pub fn outer_radius(&self) -> f64 {
        self.outer_radius
    }

    /// The area of the inside, square metres.
    pub fn area(&self) -> f64 {
        let twice: f64 = (0..self.len())
            .filter(|&i| !self.gap_after[i])
            .map(|i| cross(&self.vertices[i], &self.vertices[self.next(i)]))
            .sum();
        0.5 * twice
    }
}
