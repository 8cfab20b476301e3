//! The policy's questions to a map with a global region.

use geometry::planar::Triangulation;
use geometry::planar::overlay::Region;
use geometry::{Point2, Vector2};
use pose::Se2;
use probe::VertexId;
use search::Scratch;

use super::open::point_along;
use super::{DualGraph, Here, OpenFrontier, OpenPart, Tag};
use crate::{Candidate, Route, Standing};

/// Where along open frontier a goal is put: the middle first, then the quarters.
const GOAL_SHARES: [f64; 3] = [0.5, 0.25, 0.75];

/// Legs of a way are cut into pieces no longer than this, metres: a triangle may be longer than what
/// is seen from one place, and a robot goes by what it sees.
const LEG_M: f64 = 0.9;

/// Points of a way so near to the robot say nothing about where it goes, metres.
const AT_ROBOT_M: f64 = 0.05;

/// Candidates and ways, from a region, its open frontier and the view from here.
#[derive(Clone, Debug, Default)]
pub(crate) struct GlobalPlanner {
    scratch: Scratch<VertexId>,
    /// The graph and the way planned last, until they are told.
    planned: Option<(DualGraph, Vec<Point2>)>,
}

impl GlobalPlanner {
    /// Open frontier in view.
    pub fn in_view(
        &self,
        here: &Here,
        open: &OpenFrontier,
        map_from_body: &Se2,
        standing: &Standing,
        out: &mut Vec<Candidate>,
    ) {
        out.clear();
        for (index, chain) in open.counting().enumerate() {
            let own = |part: &OpenPart| part.tag.spoke && part.tag.vertex == standing.vertex;
            for (run, parts) in chain.parts.chunk_by(|a, b| own(a) == own(b)).enumerate() {
                let length_m: f64 = parts.iter().map(OpenPart::length_m).sum();
                if length_m <= 0.0 {
                    continue;
                }
                let turn_only = own(&parts[0]);
                let placed = GOAL_SHARES.map(|share| point_along(parts, share * length_m));
                let goals = placed.map(|(goal, _)| map_from_body.inverse_transform(&goal));
                let Some(best) = goals.iter().position(|goal| here.sees(standing, goal)) else {
                    continue;
                };
                let mut goals_in_body = goals;
                goals_in_body.swap(0, best);
                for i in 1..goals_in_body.len() {
                    if !here.sees(standing, &goals_in_body[i]) {
                        goals_in_body[i] = goals_in_body[0];
                    }
                }
                out.push(Candidate {
                    goals_in_body,
                    normal_in_body: map_from_body.rotation.inverse() * placed[best].1,
                    length_m,
                    turn_only,
                    tag: ((index as u64) << 16) | run as u64,
                });
            }
        }
    }

    /// Open frontier in reach, in directions that were not looked into from here.
    pub fn around(
        &self,
        here: &Here,
        open: &OpenFrontier,
        map_from_body: &Se2,
        standing: &Standing,
        out: &mut Vec<Candidate>,
    ) {
        out.clear();
        for (index, chain) in open.counting().enumerate() {
            for (at, part) in chain.parts.iter().enumerate() {
                let middle = Point2::from((part.from.coords + part.to.coords) * 0.5);
                let goal = map_from_body.inverse_transform(&middle);
                if here.is_unseen_towards(standing, &goal) {
                    out.push(Candidate {
                        goals_in_body: [goal; 3],
                        normal_in_body: Vector2::zeros(),
                        length_m: part.length_m(),
                        turn_only: true,
                        tag: ((index as u64) << 16) | at as u64,
                    });
                }
            }
        }
    }

    /// The way to the nearest open frontier through the region; `None` where there is none.
    pub fn route(
        &mut self,
        region: &Region<Tag>,
        open: &OpenFrontier,
        map_from_body: &Se2,
    ) -> Option<Route> {
        let goals: Vec<Point2> = open.counting().map(|chain| chain.at(0.5).0).collect();
        if goals.is_empty() {
            return None;
        }
        let mesh = Triangulation::of(region).ok()?;
        let start = Point2::from(map_from_body.translation);
        let dual = DualGraph::new(&mesh, &goals, &start);
        let way = dual.way(&mut self.scratch);
        let in_body = way.as_ref().map(|way| {
            let in_body = way.iter().map(|point| map_from_body.inverse_transform(point));
            in_short_legs(&in_body.collect::<Vec<_>>())
        });
        self.planned = Some((dual, way.unwrap_or_default()));
        in_body.map(Route::Drive)
    }

    /// The graph and the way planned since this was asked last.
    pub fn take_planned(&mut self) -> Option<(DualGraph, Vec<Point2>)> {
        self.planned.take()
    }
}

/// A way from the origin with more points on its legs, and none where it starts.
fn in_short_legs(way: &[Point2]) -> Vec<Point2> {
    let mut points = Vec::new();
    let mut from = Point2::origin();
    for to in way {
        let along = to - from;
        let pieces = (along.norm() / LEG_M).clamp(1.0, 1e6).ceil() as u32;
        let on = (1..pieces).map(|i| from + along * (f64::from(i) / f64::from(pieces)));
        points.extend(on.chain([*to]).filter(|point| point.coords.norm() >= AT_ROBOT_M));
        from = *to;
    }
    // A goal where the robot stands is one still, even if the way to it leads elsewhere first.
    points.extend(way.last().filter(|goal| goal.coords.norm() < AT_ROBOT_M));
    points
}
