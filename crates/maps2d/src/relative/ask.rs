//! What a policy asks: frontiers in view, clearance, the way to the next frontier.

use geometry::{Point2, Vector2};
use probe::VertexId;

use super::{Chain, RelativeMap, VolumeState};
use crate::{Candidate, Clearance, MapProbe, Route, Standing};

/// Where along a run of frontier a goal is put: the middle first, then the quarters.
const GOAL_SHARES: [f64; 3] = [0.5, 0.25, 0.75];

impl RelativeMap {
    /// One candidate for each run of frontier in the volume that the robot stands on.
    pub(super) fn candidates(&self, standing: &Standing, out: &mut Vec<Candidate>) {
        out.clear();
        let Some(state) = self.volume(standing.vertex) else { return };
        for (tag, chain) in state.counting_chains().enumerate() {
            for spoke in [true, false] {
                let run = Run::of(state, chain, spoke);
                // A short end of a chain is seen on the way to the rest of it.
                let least_m = 0.4 * self.params.sliver_m.min(chain.length_m);
                if run.parts.is_empty() || run.length_m < least_m {
                    continue;
                }
                let goals = GOAL_SHARES
                    .map(|share| standing.vertex_from_body.inverse_transform(&run.at(share)));
                let body_from_vertex = standing.vertex_from_body.rotation.inverse();
                out.push(Candidate {
                    goals_in_body: goals,
                    normal_in_body: body_from_vertex * run.normal_at(GOAL_SHARES[0]),
                    length_m: run.length_m,
                    turn_only: spoke,
                    tag: 2 * tag as u64 + u64::from(spoke),
                });
            }
        }
    }

    /// Frontier of other volumes in scope that lies where nobody has looked from here.
    pub(super) fn candidates_around(&mut self, standing: &Standing, out: &mut Vec<Candidate>) {
        out.clear();
        self.take_scope(standing.vertex, &mut probe::Off);
        let Some(here) = self.volume(standing.vertex) else { return };
        let reach_m = here.volume.radius_m();
        for row in self.scope.placed().iter().skip(1) {
            let Some(state) = self.volume(row.vertex) else { continue };
            let apart_m = row.root_from_vertex.translation.norm();
            if !state.counts() || apart_m > reach_m + state.volume.radius_m() {
                continue;
            }
            for (tag, chain) in state.counting_chains().enumerate() {
                for part in &chain.parts {
                    let edge = &state.volume.frontier[part.edge];
                    let middle = row.root_from_vertex.transform(&edge.at(part.span.middle()));
                    if here.volume.is_unseen_towards(&middle) {
                        out.push(Candidate {
                            goals_in_body: [standing.vertex_from_body.inverse_transform(&middle);
                                3],
                            normal_in_body: Vector2::zeros(),
                            length_m: part.length_m,
                            turn_only: true,
                            tag: (u64::from(row.vertex.0) << 32) | tag as u64,
                        });
                    }
                }
            }
        }
    }

    /// How near the straight motion from the anchor comes to what is solid in the volume there.
    ///
    /// Only the volume that the robot stands on is asked: it is the one without drift.
    pub(super) fn motion_clearance(&self, standing: &Standing, to_in_body: &Point2) -> Clearance {
        let Some(state) = self.volume(standing.vertex) else { return Clearance::NONE };
        state.volume.motion_clearance(&standing.vertex_from_body.transform(to_in_body))
    }

    /// The way along the graph to the nearest vertex with frontier that counts (\[ISRR19\] 5), of
    /// those that come now.
    pub(super) fn way_to_frontier(
        &mut self,
        standing: &Standing,
        comes_now: &dyn Fn(VertexId) -> bool,
    ) -> Option<Route> {
        if self.totals.places == 0 {
            return None;
        }
        let volumes = &self.volumes;
        let far_m = f64::INFINITY;
        let way =
            self.scratch.way_to_nearest(&self.skeleton, standing.vertex, far_m, |vertex| {
                volumes.get(vertex).and_then(Option::as_deref).is_some_and(VolumeState::counts)
                    && comes_now(vertex)
            })?;
        Some(Route::Repeat(way))
    }

    pub(super) fn give_up_near(
        &mut self,
        standing: &Standing,
        goal_in_body: &Point2,
        radius_m: f64,
        everywhere: bool,
        probe: &mut dyn MapProbe,
    ) {
        let place = standing.vertex_from_body.transform(goal_in_body);
        let found = self.volumes.get_mut(standing.vertex).and_then(Option::as_deref_mut);
        let Some(state) = found else { return };
        state.given_up.push((place, radius_m));
        if everywhere {
            self.compare_with_scope(standing.vertex, probe);
            return;
        }
        self.take_scope(standing.vertex, probe);
        self.work.pairs.clear();
        self.work.pairs.push((0, 0));
        self.consolidate(probe);
        if let Some(state) = self.volumes[standing.vertex].as_deref_mut() {
            state.given_up.pop();
        }
        self.silence(standing.vertex, probe);
    }

    /// A volume with frontier that cannot be reached from it closes none of others any more; what it
    /// had closed is open again unless another volume accounts for it.
    ///
    /// Frontier of volumes nearer by, from which it might be reached, lies inside this one.
    fn silence(&mut self, vertex: VertexId, probe: &mut dyn MapProbe) {
        let Some(state) = self.volumes[vertex].as_deref_mut() else { return };
        if std::mem::replace(&mut state.blocked, true) {
            return;
        }
        for other in state.closed_in.clone() {
            let lost = self.reopen_what_closed(other, vertex, probe);
            self.restore_if_it_counts(other, probe);
            if self.any_open(other, &lost) {
                self.compare_with_scope(other, probe);
            }
        }
    }
}

/// The parts of a chain that are all spokes, or all chords, laid end to end.
struct Run {
    parts: Vec<(Point2, Point2, f64)>,
    length_m: f64,
}

impl Run {
    fn of(state: &VolumeState, chain: &Chain, spoke: bool) -> Self {
        let parts: Vec<(Point2, Point2, f64)> = chain
            .parts
            .iter()
            .zip(chain.segments(&state.volume))
            .filter(|(part, _)| state.volume.frontier[part.edge].spoke == spoke)
            .map(|(part, (from, to))| (from, to, part.length_m))
            .collect();
        let length_m = parts.iter().map(|part| part.2).sum();
        Self { parts, length_m }
    }

    /// The point at a share of the length.
    fn at(&self, share: f64) -> Point2 {
        let Some((part, along)) = self.part_at(share) else { return Point2::origin() };
        let (from, to, _) = &self.parts[part];
        from + (to - from) * along
    }

    /// Unit vector into the unknown at a share of the length: to the right, because boundaries run
    /// counter-clockwise around what is known.
    fn normal_at(&self, share: f64) -> Vector2 {
        let Some((part, _)) = self.part_at(share) else { return Vector2::zeros() };
        let (from, to, _) = &self.parts[part];
        let along = to - from;
        Vector2::new(along.y, -along.x).try_normalize(0.0).unwrap_or_else(Vector2::zeros)
    }

    /// The part at a share of the length, and how far along it.
    fn part_at(&self, share: f64) -> Option<(usize, f64)> {
        let mut left_m = share * self.length_m;
        for (i, &(_, _, length_m)) in self.parts.iter().enumerate() {
            if left_m <= length_m && length_m > 0.0 {
                return Some((i, left_m / length_m));
            }
            left_m -= length_m;
        }
        self.parts.len().checked_sub(1).map(|last| (last, 1.0))
    }
}
