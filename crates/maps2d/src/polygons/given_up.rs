//! Frontier that does not count any more, by place.

use geometry::Point2;
use pose::Se2;
use probe::VertexId;

use super::OpenFrontier;

/// A place fixed to a vertex, so that it moves with its correction.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Place {
    vertex: VertexId,
    at_in_vertex: Point2,
    radius_m: f64,
}

/// Discs within which frontier was given up.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct GivenUp {
    places: Vec<Place>,
}

impl GivenUp {
    /// Gives up what lies within a radius of a point in the frame of a vertex.
    pub fn add(&mut self, vertex: VertexId, at_in_vertex: Point2, radius_m: f64) {
        self.places.push(Place { vertex, at_in_vertex, radius_m });
    }

    /// Gives up all open frontier that counts, fixed to one vertex.
    pub fn add_all(&mut self, open: &OpenFrontier, vertex: VertexId, map_from_vertex: &Se2) {
        for part in open.counting().flat_map(|chain| &chain.parts) {
            let middle = Point2::from((part.from.coords + part.to.coords) * 0.5);
            let at_in_vertex = map_from_vertex.inverse_transform(&middle);
            self.add(vertex, at_in_vertex, 0.5 * part.length_m() + 1e-6);
        }
    }

    /// Centres in the map's frame, and radii, with the poses of now.
    pub fn discs(&self, pose: impl Fn(VertexId) -> Se2) -> Vec<(Point2, f64)> {
        let disc =
            |place: &Place| (pose(place.vertex).transform(&place.at_in_vertex), place.radius_m);
        self.places.iter().map(disc).collect()
    }

    pub fn heap_bytes(&self) -> usize {
        self.places.len() * size_of::<Place>()
    }
}
