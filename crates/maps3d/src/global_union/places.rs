//! Step 4: frontier that was given up, by place.

use probe::VertexId;
use solid::Point3;

use super::poses::Poses;

/// A ball in which frontier does not count, tied to a vertex: it moves with it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub vertex: VertexId,
    pub in_vertex: Point3,
    pub radius_m: f64,
}

/// All of them, where they are in the map now.
#[derive(Clone, Debug, Default)]
pub(super) struct GivenUp {
    places: Vec<Place>,
}

impl GivenUp {
    pub fn add(&mut self, place: Place) {
        self.places.push(place);
    }

    /// The balls in the frame `map`.
    pub fn in_map(&self, poses: &Poses) -> Vec<(Point3, f64)> {
        let at = |place: &Place| poses.of(place.vertex).transform(&place.in_vertex);
        self.places.iter().map(|place| (at(place), place.radius_m)).collect()
    }

    /// Memory held on the heap, bytes.
    pub fn heap_bytes(&self) -> usize {
        size_of_val(&self.places[..])
    }
}

/// Frontier that was looked at and was still there afterwards: where, and how often.
#[derive(Clone, Debug, Default)]
pub(super) struct InVain {
    places: Vec<(Place, u32)>,
}

impl InVain {
    /// Notes one look at a place; tells how many there were within the place's radius of one.
    pub fn note(&mut self, place: Place, poses: &Poses) -> u32 {
        let at = poses.of(place.vertex).transform(&place.in_vertex);
        let is_there = |known: &Place| {
            let there = poses.of(known.vertex).transform(&known.in_vertex);
            (there - at).norm() <= place.radius_m
        };
        match self.places.iter_mut().find(|(known, _)| is_there(known)) {
            Some((_, looks)) => {
                *looks += 1;
                *looks
            }
            None => {
                self.places.push((place, 1));
                1
            }
        }
    }

    /// Memory held on the heap, bytes.
    pub fn heap_bytes(&self) -> usize {
        size_of_val(&self.places[..])
    }
}

/// Whether a point lies in one of the balls.
pub(super) fn is_in(balls: &[(Point3, f64)], point: &Point3) -> bool {
    balls.iter().any(|(centre, radius_m)| (point - centre).norm() <= *radius_m)
}
