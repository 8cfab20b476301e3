//! Which known places the robot recognises (\[ISRR19\] sec. 6).

use pose::Se2;
use probe::VertexId;
use sensing::PlaceMatch;

use super::SimRobot;
use super::random::{Draw, Purpose};

/// How often a wrong place is looked for before the call goes without one.
const FALSE_PLACE_TRIES: usize = 8;

impl SimRobot {
    /// Place matches of the vertex that the robot stands on, by id.
    ///
    /// All candidates are judged against the graph as it was before the call; only then are the
    /// matches joined to it.
    pub(super) fn matches(&mut self) -> Vec<PlaceMatch> {
        let places = self.params.places.clone();
        let Some(here) = self.standing_on.filter(|_| places.enabled) else { return Vec::new() };
        let Some(&world_from_here) = self.marks.pose(here) else { return Vec::new() };
        self.marks.search(here, places.exclude_factor * places.radius_m);

        let mut found = self.true_places(here, &world_from_here);
        if let Some(limit) = places.max_matches
            && found.len() > limit
        {
            found.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
            found.truncate(limit);
        }
        let mut matches: Vec<PlaceMatch> = found
            .iter()
            .filter_map(|&(known, _)| {
                let exact = self.marks.pose(known)?.inverse_mul(&world_from_here);
                let draw =
                    self.streams.draw(Purpose::RelativePose, self.mark_count, known.0.into());
                let sigmas = (places.sigma_translation_m, places.sigma_rotation_rad);
                Some(PlaceMatch { vertex: known, known_from_current: exact * error(draw, sigmas) })
            })
            .collect();
        if let Some(wrong) = self.wrong_place(here, &world_from_here) {
            self.false_links.insert((here, wrong.vertex), wrong.known_from_current.inverse());
            self.false_links.insert((wrong.vertex, here), wrong.known_from_current);
            matches.push(wrong);
        }
        matches.sort_by_key(|place| place.vertex);
        for place in &matches {
            self.marks.link(here, place.vertex, place.known_from_current.distance());
        }
        self.tally.place_edges += matches.len() as u64;
        matches
    }

    /// Known places near in truth and in sight, far along the graph, and not missed by chance.
    fn true_places(&self, here: VertexId, world_from_here: &Se2) -> Vec<(VertexId, f64)> {
        let places = &self.params.places;
        let position = world_from_here.translation.into();
        let mut found = self.marks.near(&position, places.radius_m);
        found.retain(|&(known, _)| {
            known != here
                && !self.marks.reached(known)
                && self.in_sight(world_from_here, known)
                && (places.recall >= 1.0
                    || self
                        .streams
                        .draw(Purpose::Recall, self.mark_count, known.0.into())
                        .uniform()
                        < places.recall)
        });
        found
    }

    /// Whether nothing stands between a pose and a known vertex.
    pub(super) fn in_sight(&self, world_from_here: &Se2, known: VertexId) -> bool {
        self.marks.pose(known).is_some_and(|pose| {
            let (from, to) = (world_from_here.translation.into(), pose.translation.into());
            !self.world.caster().blocked(&from, &to)
        })
    }

    /// By chance, a place that is not here: out of the radius or out of sight, and far along the
    /// graph. Its reported pose is uniform over the disc of the radius and over all headings.
    fn wrong_place(&self, here: VertexId, world_from_here: &Se2) -> Option<PlaceMatch> {
        let places = &self.params.places;
        if places.false_positive_rate <= 0.0 {
            return None;
        }
        let mut draw = self.streams.draw(Purpose::FalsePositive, self.mark_count, 0);
        if draw.uniform() >= places.false_positive_rate {
            return None;
        }
        let radius_m = places.radius_m * draw.uniform().sqrt();
        let bearing_rad = std::f64::consts::TAU * draw.uniform();
        let heading_rad = std::f64::consts::TAU * draw.uniform();
        let known = self.marks.order();
        (0..FALSE_PLACE_TRIES).find_map(|_| {
            let pick = (draw.uniform() * known.len() as f64) as usize;
            let vertex = *known.get(pick)?;
            let gap_m = self.marks.pose(vertex)?.inverse_mul(world_from_here).distance();
            let is_wrong = gap_m >= places.radius_m || !self.in_sight(world_from_here, vertex);
            (vertex != here && is_wrong && !self.marks.reached(vertex)).then(|| PlaceMatch {
                vertex,
                known_from_current: Se2::new(
                    radius_m * bearing_rad.cos(),
                    radius_m * bearing_rad.sin(),
                    heading_rad,
                ),
            })
        })
    }
}

/// A small random motion with these standard deviations of position (each axis) and heading; the
/// identity, exactly, where both are 0.
pub(super) fn error(mut draw: Draw, (sigma_m, sigma_rad): (f64, f64)) -> Se2 {
    if sigma_m == 0.0 && sigma_rad == 0.0 {
        return Se2::identity();
    }
    let [x, y, theta] = draw.normals3();
    Se2::new(sigma_m * x, sigma_m * y, sigma_rad * theta)
}
