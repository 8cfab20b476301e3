//! Which known places the robot recognises (\[ISRR19\] sec. 6, in space).

use geometry::Point3;
use pose::Se3;
use pose::nalgebra::Vector3;
use probe::{Id, VertexId};
use sensing::SpaceMatch;

use super::SimFlyer;
use super::motion::yaw;
use crate::robot::random::{Draw, Purpose};

impl SimFlyer {
    /// Place matches of the vertex where the robot hovers, by id.
    ///
    /// All candidates are judged against the graph as it was before the call; only then are the matches
    /// joined to it. Linear in the number of vertices.
    pub(super) fn matches(&mut self) -> Vec<SpaceMatch> {
        let places = self.params.places.clone();
        let Some(here) = self.hovers_at.filter(|_| places.enabled) else { return Vec::new() };
        let Some(world_from_here) = self.world_from_vertex(here) else { return Vec::new() };
        self.links.search(here, places.exclude_factor * places.radius_m);
        let origin = Point3::from(world_from_here.translation);
        let mut found: Vec<(VertexId, f64)> = (0..self.marks.len())
            .map(VertexId::from_index)
            .filter(|&known| known != here && !self.links.reached(known))
            .filter_map(|known| {
                let at = Point3::from(self.marks[known.index()]?.translation);
                let distance_m = (at - origin).norm();
                let is_near = distance_m < places.radius_m;
                let recall = || {
                    let draw = self.streams.draw(Purpose::Recall, self.mark_count, known.0.into());
                    { draw }.uniform() < places.recall
                };
                let in_sight = || !self.world.caster().blocked(&origin, &at);
                (is_near && in_sight() && (places.recall >= 1.0 || recall()))
                    .then_some((known, distance_m))
            })
            .collect();
        if let Some(limit) = places.max_matches
            && found.len() > limit
        {
            found.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
            found.truncate(limit);
            found.sort_by_key(|(known, _)| *known);
        }
        let matches: Vec<SpaceMatch> = found
            .iter()
            .filter_map(|&(known, _)| {
                let exact = self.world_from_vertex(known)?.inverse_mul(&world_from_here);
                let draw =
                    self.streams.draw(Purpose::RelativePose, self.mark_count, known.0.into());
                let sigmas = (places.sigma_translation_m, places.sigma_rotation_rad);
                Some(SpaceMatch { vertex: known, known_from_current: exact * error(draw, sigmas) })
            })
            .collect();
        for place in &matches {
            self.links.link(here, place.vertex, place.known_from_current.distance());
        }
        self.tally.place_edges += matches.len() as u64;
        matches
    }
}

/// A small random motion with these standard deviations of position (each axis) and yaw; the identity,
/// exactly, where both are 0.
pub(super) fn error(mut draw: Draw, (sigma_m, sigma_rad): (f64, f64)) -> Se3 {
    if sigma_m == 0.0 && sigma_rad == 0.0 {
        return Se3::identity();
    }
    let [x, y, z] = draw.normals3();
    let turn = yaw(sigma_rad * draw.normals2()[0]);
    Se3::new(Vector3::new(sigma_m * x, sigma_m * y, sigma_m * z), turn.rotation)
}
