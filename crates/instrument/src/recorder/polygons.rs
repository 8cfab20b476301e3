//! Maps of united polygons: the region with its labels, unions, corrections, the dual graph.

use geometry::Point2;
use geometry::planar::overlay::{EdgeLabel, Region};
use maps2d::polygons::{PolygonEvent, Tag, cells_of};
use pose::Se2;
use probe::{Probe, VertexId};

use super::Recorder;
use super::happened::Happened;
use crate::{Family, Level, palette};

/// Side of the cells that a region is drawn as, metres.
const CELL_M: f64 = 0.5;

impl Probe<PolygonEvent<'_>> for Recorder {
    /// Also at `summary`, because the belief is drawn from the last event of each step.
    fn on(&self) -> bool {
        self.inner.as_ref().is_some_and(|inner| inner.takes(Family::Polygons))
    }

    fn emit(&mut self, event: PolygonEvent<'_>) {
        let Some(inner) = &mut self.inner else { return };
        inner.now.event += 1;
        let now = inner.now;
        if let PolygonEvent::Settled { region, open, .. } = event
            && inner.takes(Family::Polygons)
        {
            let keep_rows = inner.level == Level::Full;
            inner.belief.region(region, open, keep_rows, &now);
            inner.belief.region_cells(&cells_of(region, CELL_M));
        }
        if let PolygonEvent::Extended { root, region, .. } = event
            && inner.takes(Family::Polygons)
        {
            let keep_rows = inner.level == Level::Full;
            let place = inner.places.by_odometry(root);
            inner.belief.region(&placed(region, &place), &Default::default(), keep_rows, &now);
        }
        if inner.full(Family::Polygons) {
            let place = |vertex| inner.places.of(vertex);
            write_down(&event, &mut inner.happened, place, &now);
        }
    }
}

/// A region of a vertex's frame, where that vertex is drawn.
fn placed(region: &Region<Tag>, place: &Se2) -> Region<Tag> {
    let mut region = region.clone();
    for point in region.rings.iter_mut().flat_map(|ring| &mut ring.points) {
        *point = place.transform(point);
    }
    region
}

fn write_down(
    event: &PolygonEvent<'_>,
    happened: &mut Happened,
    place: impl Fn(VertexId) -> Se2,
    now: &crate::columns::Now,
) {
    let variant = event.variant();
    let tell = |happened: &mut Happened, line: std::fmt::Arguments<'_>| {
        happened.event(Family::Polygons, variant, line, now);
    };
    match *event {
        PolygonEvent::Intersected { at, entry } => {
            let colour = if entry { palette::BEST } else { palette::HIT };
            happened.points.point(&at, colour);
            let what = if entry { "entry" } else { "exit" };
            tell(happened, format_args!("{what} at ({:.3}, {:.3})", at.x, at.y));
        }
        PolygonEvent::Merged { at } => {
            happened.points.point(&at, palette::ROUTE);
            tell(happened, format_args!("at ({:.3}, {:.3})", at.x, at.y));
        }
        PolygonEvent::LoopClosed { corners, area_m2 } => {
            let what = if area_m2 < 0.0 { "a hole" } else { "an outer loop" };
            tell(happened, format_args!("{what} of {corners} corners, {area_m2:.3} m2"));
        }
        PolygonEvent::United { vertex, view, region } => {
            draw(view, happened, palette::TRUE_VIEW);
            let (edges, area_m2) = (region.edge_count(), region.area_m2());
            tell(
                happened,
                format_args!("the view from {vertex}: now {edges} edges, {area_m2:.2} m2"),
            );
        }
        PolygonEvent::Rebuilt { views, region } => {
            draw(region, happened, palette::CORRECTED);
            let area_m2 = region.area_m2();
            tell(happened, format_args!("{views} views united again: {area_m2:.2} m2"));
        }
        PolygonEvent::Settled { standing, open, .. } => {
            let left = open.summary();
            tell(
                happened,
                format_args!(
                    "at {standing}: {:.2} m of frontier open in {} places, {:.2} m ignored",
                    left.open_m, left.places, left.ignored_m
                ),
            );
        }
        PolygonEvent::Extended { root, members, region } => {
            draw(&placed(region, &place(root)), happened, palette::CORRECTED);
            let (count, area_m2) = (members.len(), region.area_m2());
            tell(happened, format_args!("around {root}: {count} polygons, {area_m2:.2} m2"));
        }
        PolygonEvent::MarkedFree { vertex, count } => {
            happened.points.point(&Point2::from(place(vertex).translation), palette::FREE);
            tell(happened, format_args!("{count} corners of {vertex}"));
        }
        PolygonEvent::Followed { vertex, found } => {
            tell(
                happened,
                format_args!("view from {vertex}: {found} crossings outside the active area"),
            );
        }
        PolygonEvent::CornersMoved { moved_max_m, region } => {
            draw(region, happened, palette::CORRECTED);
            tell(happened, format_args!("with their anchors, by up to {moved_max_m:.3} m"));
        }
        PolygonEvent::Untwisted { at, flipped, removed } => {
            at.iter().for_each(|point| happened.points.point(point, palette::REOPENED));
            let count = at.len();
            tell(
                happened,
                format_args!("{count} splits, {flipped} parts turned round, {removed} removed"),
            );
        }
        PolygonEvent::Invalid { vertex, why } => {
            happened.points.point(&Point2::from(place(vertex).translation), palette::HIT);
            let why = why.name();
            tell(happened, format_args!("the view from {vertex} is left out: {why}"));
        }
        PolygonEvent::WayPlanned { dual, way } => {
            for (from, to) in dual.pieces() {
                happened.lines.segment(&from, &to, palette::SCOPE);
            }
            happened.lines.strip(way.iter().copied(), palette::ROUTE);
            for goal in &dual.nodes[dual.goals()] {
                happened.points.point(goal, palette::FRONTIER);
            }
            let (triangles, goals, count) = (dual.triangles, dual.goals().len(), way.len());
            tell(
                happened,
                format_args!("{triangles} triangles, {goals} goals, a way of {count} points"),
            );
        }
    }
}

fn draw(region: &Region<Tag>, happened: &mut Happened, colour: crate::columns::Rgba) {
    for ring in &region.rings {
        let closed = ring.points.iter().chain(ring.points.first()).copied();
        happened.lines.strip(closed, colour);
    }
}

impl super::belief::Belief {
    /// Draws a region by its labels. Cost: its edges.
    pub fn region(
        &mut self,
        region: &Region<Tag>,
        open: &maps2d::polygons::OpenFrontier,
        keep_rows: bool,
        now: &crate::columns::Now,
    ) {
        if !keep_rows {
            self.edge_lines().into_iter().for_each(|lines| lines.drop_row_of(now.step));
        }
        for edge in region.edges() {
            let (lines, colour) = match edge.label {
                EdgeLabel::Obstacle => (&mut self.obstacle, palette::OBSTACLE),
                EdgeLabel::Frontier => (&mut self.wall, palette::WALL_CLOSED),
                EdgeLabel::Free => (&mut self.free, palette::FREE),
            };
            lines.segment(&edge.from, &edge.to, colour);
        }
        for chain in &open.chains {
            let (lines, colour) = if chain.counts {
                (&mut self.frontier, palette::FRONTIER)
            } else {
                (&mut self.ignored, palette::IGNORED)
            };
            for part in &chain.parts {
                lines.segment(&part.from, &part.to, colour);
            }
        }
        for lines in self.edge_lines() {
            lines.end_row(now);
        }
    }

    /// Takes over a region as cells.
    pub fn region_cells(&mut self, believed: &maps2d::grid::Cells) {
        let path = &self.cells_path;
        let cells = self.cells.get_or_insert_with(|| {
            let side = geometry::Vector2::repeat(believed.cell_m());
            crate::columns::Tiles::new(path, side, Point2::origin(), 0.9, -10.0)
        });
        cells.clear();
        for slot in 0..believed.slots() {
            let cell = believed.cell(slot);
            let class = match believed.state(cell) {
                maps2d::grid::CellState::Unknown => continue,
                maps2d::grid::CellState::Free => palette::CELL_FREE,
                maps2d::grid::CellState::Occupied => palette::CELL_OCCUPIED,
            };
            cells.set(i64::from(cell.column), i64::from(cell.row), class);
        }
    }
}
