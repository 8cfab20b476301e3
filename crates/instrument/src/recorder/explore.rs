//! The pose graph as it grows, and the policy.

use explore::{Ending, GiveUp, GraphEvent, PlannerEvent, State};
use geometry::Point2;
use maps2d::Route;
use pose::Se2;
use posegraph::EdgeKind;
use probe::Probe;

use super::Recorder;
use super::planner::coloured;
use super::steps::Inner;
use crate::{Family, palette};

impl Probe<GraphEvent> for Recorder {
    /// At every level: the recorder has to know where vertices are drawn.
    fn on(&self) -> bool {
        self.inner.is_some()
    }

    fn emit(&mut self, event: GraphEvent) {
        let Some(inner) = &mut self.inner else { return };
        inner.now.event += 1;
        match event {
            GraphEvent::VertexAdded { vertex, odom_from_vertex } => {
                inner.places.learn(vertex, odom_from_vertex);
                inner.graph.vertex(vertex, &inner.places);
                inner.standing.vertex = vertex;
                inner.standing.vertex_from_body = Se2::identity();
            }
            GraphEvent::EdgeAdded { edge, kind, a, b, .. } => {
                inner.graph.edge(edge, kind, a, b, &inner.places);
            }
            GraphEvent::EdgeWithdrawn { edge } => inner.graph.withdraw(edge, &inner.places),
        }
        if inner.full(Family::PoseGraph) {
            inner.write_graph(&event);
        }
    }
}

impl Probe<PlannerEvent<'_>> for Recorder {
    /// At every level: motions move the recorder's clock, goals are part of the summary.
    fn on(&self) -> bool {
        self.inner.is_some()
    }

    fn emit(&mut self, event: PlannerEvent<'_>) {
        let Some(inner) = &mut self.inner else { return };
        inner.now.event += 1;
        inner.follow_planner(&event);
        if inner.full(Family::Planner) {
            inner.write_planner(&event);
        }
    }
}

impl Inner {
    fn write_graph(&mut self, event: &GraphEvent) {
        let now = self.now;
        let happened = &mut self.happened;
        let at = |vertex| Point2::from(self.places.of(vertex).translation);
        let tell = |happened: &mut super::happened::Happened, line: std::fmt::Arguments<'_>| {
            happened.event(Family::PoseGraph, event.variant(), line, &now);
        };
        match *event {
            GraphEvent::VertexAdded { vertex, odom_from_vertex } => {
                happened.points.point(&at(vertex), palette::ODOMETRY);
                let (x, y) = (odom_from_vertex.translation.x, odom_from_vertex.translation.y);
                let heading_deg = odom_from_vertex.angle().to_degrees();
                tell(
                    happened,
                    format_args!(
                        "{vertex} at ({x:.2}, {y:.2}) m, {heading_deg:.1} deg by odometry"
                    ),
                );
            }
            GraphEvent::EdgeAdded { edge, kind, a, b, a_from_b } => {
                let (name, colour) = match kind {
                    EdgeKind::Odometry => ("odometry", palette::ODOMETRY),
                    EdgeKind::Place => ("place", palette::PLACE),
                };
                happened.lines.segment(&at(a), &at(b), colour);
                let length_m = a_from_b.distance();
                let turn_deg = a_from_b.angle().to_degrees();
                tell(
                    happened,
                    format_args!(
                        "{edge} ({name}) from {a} to {b}: {length_m:.2} m, {turn_deg:.1} deg"
                    ),
                );
            }
            GraphEvent::EdgeWithdrawn { edge } => {
                if let Some((a, b)) = self.graph.ends(edge) {
                    happened.lines.segment(&at(a), &at(b), palette::WITHDRAWN);
                }
                tell(happened, format_args!("{edge} was taken back"));
            }
        }
    }

    /// Keeps the robot's whereabouts, the clock and the picture of the plan up to date.
    fn follow_planner(&mut self, event: &PlannerEvent<'_>) {
        match *event {
            PlannerEvent::CandidatesScored { standing, scored } => {
                self.standing = standing;
                let body = self.places.of_body(&standing);
                self.planner.candidates(scored, &body);
            }
            PlannerEvent::GoalChosen { standing, goal_in_body } => {
                self.standing = standing;
                self.planner.goal(&goal_in_body, &self.places.of_body(&standing));
            }
            PlannerEvent::RoutePlanned { standing, route, .. } => {
                self.standing = standing;
                let body = self.places.of_body(&standing);
                match route {
                    Route::Repeat(legs) => {
                        let all =
                            || std::iter::once(standing.vertex).chain(legs.iter().map(|leg| leg.0));
                        let places = &self.places;
                        self.graph
                            .route(all().map(|v| Point2::from(places.by_odometry(v).translation)));
                        self.planner.way(all().map(|v| Point2::from(places.of(v).translation)));
                    }
                    Route::Drive(points) => {
                        let start = Point2::from(body.translation);
                        let points = points.iter().map(|point| body.transform(point));
                        self.planner.way(std::iter::once(start).chain(points));
                    }
                }
            }
            PlannerEvent::GoalGivenUp { standing, goal_in_body, .. } => {
                self.standing = standing;
                self.planner.given_up(&goal_in_body, &self.places.of_body(&standing));
            }
            PlannerEvent::Turned { angle_rad } => {
                self.standing.vertex_from_body =
                    self.standing.vertex_from_body * Se2::from_angle(angle_rad);
            }
            PlannerEvent::Drove { distance_m } => self.drove(distance_m),
            PlannerEvent::LegRepeated { to, length_m, .. } => {
                self.standing.vertex = to;
                self.drove(length_m);
            }
            PlannerEvent::StateChanged { .. } | PlannerEvent::Finished { .. } => {}
        }
    }

    fn write_planner(&mut self, event: &PlannerEvent<'_>) {
        let now = self.now;
        let happened = &mut self.happened;
        let places = &self.places;
        let anchor = |vertex| Point2::from(places.of(vertex).translation);
        let tell = |happened: &mut super::happened::Happened, line: std::fmt::Arguments<'_>| {
            happened.event(Family::Planner, event.variant(), line, &now);
        };
        match *event {
            PlannerEvent::StateChanged { from, to } => {
                tell(happened, format_args!("from {} to {}", state(from), state(to)));
            }
            PlannerEvent::CandidatesScored { standing, scored } => {
                let body = places.of_body(&standing);
                for (candidate, colour) in coloured(scored) {
                    happened.points.point(&body.transform(&candidate.goals_in_body[0]), colour);
                }
                tell(happened, format_args!("at {}: {}", standing.vertex, Scores(scored)));
            }
            PlannerEvent::GoalChosen { standing, goal_in_body } => {
                let body = places.of_body(&standing);
                let goal = body.transform(&goal_in_body);
                happened.points.point(&goal, palette::GOAL);
                happened.lines.segment(&Point2::from(body.translation), &goal, palette::ROUTE);
                tell(happened, format_args!("from {}: {}", standing.vertex, Goal(&goal_in_body)));
            }
            PlannerEvent::RoutePlanned { standing, route, length_m } => {
                let body = places.of_body(&standing);
                let start = Point2::from(body.translation);
                match route {
                    Route::Repeat(legs) => {
                        let points = legs.iter().map(|leg| anchor(leg.0));
                        let way = std::iter::once(start).chain(points);
                        happened.lines.strip(way, palette::ROUTE);
                        let count = legs.len();
                        let goal = legs.last().map_or(standing.vertex, |leg| leg.0);
                        tell(
                            happened,
                            format_args!(
                                "{length_m:.2} m over {count} links of the graph, from {} to {goal}",
                                standing.vertex
                            ),
                        );
                    }
                    Route::Drive(points) => {
                        let way = points.iter().map(|point| body.transform(point));
                        happened.lines.strip(std::iter::once(start).chain(way), palette::ROUTE);
                        let count = points.len();
                        tell(
                            happened,
                            format_args!(
                                "{length_m:.2} m in {count} straight legs over free cells"
                            ),
                        );
                    }
                }
            }
            PlannerEvent::Turned { angle_rad } => {
                tell(happened, format_args!("by {:.1} deg", angle_rad.to_degrees()));
            }
            PlannerEvent::Drove { distance_m } => {
                tell(happened, format_args!("{distance_m:.2} m straight ahead"));
            }
            PlannerEvent::LegRepeated { from, to, length_m } => {
                happened.lines.segment(&anchor(from), &anchor(to), palette::ROUTE);
                tell(happened, format_args!("{length_m:.2} m from {from} to {to}"));
            }
            PlannerEvent::GoalGivenUp { standing, goal_in_body, why } => {
                let body = places.of_body(&standing);
                happened.points.point(&body.transform(&goal_in_body), palette::GIVEN_UP);
                let why = match why {
                    GiveUp::Blocked => "no motion towards it keeps clear of obstacles",
                    GiveUp::NothingNew => "looked from as near as may be, nothing new",
                };
                let goal = Goal(&goal_in_body);
                tell(happened, format_args!("at {}: {goal}: {why}", standing.vertex));
            }
            PlannerEvent::Finished { ending } => {
                let why = match ending {
                    Ending::Complete => "no frontier is left that counts",
                    Ending::StepLimit => "the step limit is reached",
                    Ending::Stuck => "frontier is left, but no way to act on it",
                };
                tell(happened, format_args!("{why}"));
            }
        }
    }
}

fn state(state: State) -> &'static str {
    match state {
        State::Reactive => "reactive",
        State::Deliberate => "deliberate",
        State::Done => "done",
    }
}

/// A goal as a robot would say it.
struct Goal<'a>(&'a Point2);

impl std::fmt::Display for Goal<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let bearing_deg = self.0.y.atan2(self.0.x).to_degrees();
        write!(f, "goal {:.2} m away, bearing {bearing_deg:.1} deg", self.0.coords.norm())
    }
}

/// Candidates with their scores, the first few.
struct Scores<'a>(&'a [(maps2d::Candidate, f64)]);

impl std::fmt::Display for Scores<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} candidates", self.0.len())?;
        for (i, (candidate, score)) in self.0.iter().take(6).enumerate() {
            let mark = if candidate.turn_only { " (turn)" } else { "" };
            let sign = if i == 0 { ":" } else { "," };
            let tag = candidate.tag;
            write!(f, "{sign} #{tag} {:.2} m{mark} score {score:.3}", candidate.length_m)?;
        }
        if self.0.len() > 6 { write!(f, ", ...") } else { Ok(()) }
    }
}
