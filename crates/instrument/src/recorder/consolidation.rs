//! Frontier consolidation, event by event, and the belief that comes out.

use geometry::Point2;
use geometry::planar::Interval;
use maps2d::relative::{Cause, ConsolidationEvent, ReopenCause};
use maps2d::volume::FrontierEdge;
use pose::Se2;
use probe::{EdgeId, Probe};

use super::Recorder;
use super::belief::scope_links;
use super::steps::Inner;
use crate::{Family, Level, palette};

impl Probe<ConsolidationEvent<'_>> for Recorder {
    /// Also at `summary`, because the belief is drawn from the last event of each step.
    fn on(&self) -> bool {
        self.inner.as_ref().is_some_and(|inner| inner.takes(Family::Consolidation))
    }

    fn emit(&mut self, event: ConsolidationEvent<'_>) {
        let Some(inner) = &mut self.inner else { return };
        inner.now.event += 1;
        inner.follow(&event);
        if inner.full(Family::Consolidation) {
            inner.write_down(&event);
        }
    }
}

impl Inner {
    /// Keeps the picture of the scope and of the belief up to date.
    fn follow(&mut self, event: &ConsolidationEvent<'_>) {
        let now = self.now;
        match event {
            ConsolidationEvent::ScopeTaken { scope, .. } => {
                self.places.lay_out(scope);
                let places = &self.places;
                self.graph.scope(scope_links(scope, |vertex| places.by_odometry(vertex)));
            }
            ConsolidationEvent::Settled { map, standing } => {
                self.standing.vertex = *standing;
                if self.takes(Family::Consolidation) {
                    self.places.lay_out(map.scope());
                    let keep_rows = self.level == Level::Full;
                    self.belief.settled(map, &self.places, keep_rows, &now);
                    if self.level == Level::Full {
                        let places = &self.places;
                        let links = scope_links(map.scope(), |vertex| places.of(vertex));
                        self.belief.scope(links, &now);
                    }
                }
            }
            _ => {}
        }
    }

    fn write_down(&mut self, event: &ConsolidationEvent<'_>) {
        let now = self.now;
        let places = &self.places;
        let happened = &mut self.happened;
        let anchor = |vertex| Point2::from(places.of(vertex).translation);
        let variant = event.variant();
        let tell = |happened: &mut super::happened::Happened, line: std::fmt::Arguments<'_>| {
            happened.event(Family::Consolidation, variant, line, &now);
        };
        match *event {
            ConsolidationEvent::ScopeTaken { scope, .. } => {
                for (at, parent) in scope_links(scope, |vertex| places.of(vertex)) {
                    happened.points.point(&at, palette::SCOPE);
                    if let Some(parent) = parent {
                        happened.lines.segment(&parent, &at, palette::SCOPE);
                    }
                }
                let count = scope.placed().len();
                let reach_m = scope.placed().last().map_or(0.0, |row| row.distance_m);
                let root = scope.root().unwrap_or(self.standing.vertex);
                tell(happened, format_args!("{count} vertices within {reach_m:.2} m of {root}"));
            }
            ConsolidationEvent::PairCompared { volume, against, closed_m, .. } => {
                let closes = closed_m > 0.0;
                let colour = if closes { palette::FREE } else { palette::NOTHING_CLOSED };
                happened.lines.segment(&anchor(volume), &anchor(against), colour);
                tell(
                    happened,
                    format_args!("frontier of {volume} against {against}: {closed_m:.2} m closed"),
                );
            }
            ConsolidationEvent::Closed { volume, edge, span, cause, by, path } => {
                let place = places.of(volume);
                let (from, to) = ends(&place, edge, &span);
                happened.lines.segment(&from, &to, palette::of_cause(cause));
                let why = match cause {
                    Cause::Inside => "inside",
                    Cause::Wall => "along a wall of",
                    Cause::Unreachable => "given up at",
                };
                let length_m = span.share() * edge.length_m();
                let key = edge.key;
                tell(
                    happened,
                    format_args!(
                        "{length_m:.3} m of {volume} {key:?} {why} {by}, path {}",
                        Path(path)
                    ),
                );
            }
            ConsolidationEvent::Reopened { volume, edge, span, cause } => {
                let (from, to) = ends(&places.of(volume), edge, &span);
                happened.lines.segment(&from, &to, palette::REOPENED);
                let length_m = span.share() * edge.length_m();
                let key = edge.key;
                match cause {
                    ReopenCause::EdgeWithdrawn(relied) => tell(
                        happened,
                        format_args!("{length_m:.3} m of {volume} {key:?}: {relied} was withdrawn"),
                    ),
                    ReopenCause::VolumeReplaced(by) => tell(
                        happened,
                        format_args!("{length_m:.3} m of {volume} {key:?}: {by} was replaced"),
                    ),
                    ReopenCause::LastLook => tell(
                        happened,
                        format_args!("{length_m:.3} m of {volume} {key:?}: the last look"),
                    ),
                }
            }
            ConsolidationEvent::Retired { volume } => {
                happened.points.point(&anchor(volume), palette::NOTHING_CLOSED);
                tell(happened, format_args!("{volume} adds nothing: out of later comparisons"));
            }
            ConsolidationEvent::Restored { volume } => {
                happened.points.point(&anchor(volume), palette::REOPENED);
                tell(happened, format_args!("{volume} is compared again"));
            }
            ConsolidationEvent::Settled { map, standing } => {
                let left = maps2d::ExplorationMap::frontier(map);
                let volumes = self.belief.volumes_in_scope;
                tell(
                    happened,
                    format_args!(
                        "at {standing}: {volumes} volumes in scope, {:.2} m of frontier open in {} places, {:.2} m ignored",
                        left.open_m, left.places, left.ignored_m
                    ),
                );
            }
        }
    }
}

fn ends(place: &Se2, edge: &FrontierEdge, span: &Interval) -> (Point2, Point2) {
    (place.transform(&edge.at(span.from)), place.transform(&edge.at(span.to)))
}

/// Measured edges in walking order.
struct Path<'a>(&'a [EdgeId]);

impl std::fmt::Display for Path<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for (i, edge) in self.0.iter().enumerate() {
            if i > 0 {
                write!(f, " ")?;
            }
            write!(f, "{edge}")?;
        }
        Ok(())
    }
}
