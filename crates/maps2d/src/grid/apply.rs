//! A scan changes cells (\[ISRR19\] 6.2, eq. 6).

use std::collections::{BTreeMap, BTreeSet};

use geometry::Point2;
use geometry::planar::StarPolygon;
use geometry::planar::segments_meet;
use pose::Se2;
use sensing::{Reading, Scan};

use super::{Cell, CellState, GridMap};
use crate::volume::{Samples, build};

/// How far a hit is pushed along its ray, metres: the face of a wall belongs to the cell behind it.
const INTO_WALL_M: f64 = 1e-3;

impl GridMap {
    /// Applies one scan; returns the cells whose state changed, in order.
    pub(super) fn apply(
        &mut self,
        scan: &Scan,
        odom_from_sensor: &Se2,
    ) -> Vec<(Cell, CellState, CellState)> {
        let mut evidence: Vec<(Cell, CellState)> = self
            .cells_inside(scan, odom_from_sensor)
            .into_iter()
            .map(|cell| (cell, CellState::Free))
            .collect();
        // Hits come after: a cell that is hit is occupied, whatever the polygon says.
        for (bearing_rad, reading) in scan.readings() {
            if let Reading::Hit(range_m) = reading {
                let range_m = range_m + INTO_WALL_M;
                let hit = Point2::new(range_m * bearing_rad.cos(), range_m * bearing_rad.sin());
                let cell = self.cells.at(&odom_from_sensor.transform(&hit));
                evidence.push((cell, CellState::Occupied));
            }
        }
        let mut by_cell: BTreeMap<Cell, (CellState, CellState)> = BTreeMap::new();
        for (cell, state) in evidence {
            let before = self.cells.set(cell, state);
            by_cell.entry(cell).or_insert((before, state)).1 = state;
        }
        let changed: Vec<(Cell, CellState, CellState)> = by_cell
            .into_iter()
            .filter(|(_, (before, now))| before != now)
            .map(|(cell, (before, now))| (cell, before, now))
            .collect();
        let around: BTreeSet<Cell> = changed
            .iter()
            .flat_map(|(cell, _, _)| cell.sides().into_iter().chain([*cell]))
            .collect();
        for cell in around {
            self.note_frontier(cell);
        }
        changed
    }

    /// Forgets all cells and applies every scan again, in order.
    pub(super) fn rebuild(&mut self) {
        self.cells.clear();
        self.frontier.clear();
        self.ignored.clear();
        let scans = std::mem::take(&mut self.scans);
        for (vertex, vertex_from_sensor, scan) in &scans {
            let odom_from_sensor = self.odom_from_vertex[*vertex] * *vertex_from_sensor;
            self.apply(scan, &odom_from_sensor);
        }
        self.scans = scans;
    }

    pub(super) fn note_frontier(&mut self, cell: Cell) {
        self.frontier.remove(&cell);
        self.ignored.remove(&cell);
        if self.cells.is_frontier(cell) {
            let given_up = self.cells.is_given_up(cell);
            let of = if given_up { &mut self.ignored } else { &mut self.frontier };
            of.insert(cell);
        }
    }

    /// The cells that lie fully inside the polygon of one scan, but for the margin.
    fn cells_inside(&self, scan: &Scan, odom_from_sensor: &Se2) -> Vec<Cell> {
        let mut samples = Samples::new();
        samples.add(scan, &Se2::identity());
        let Ok(volume) = build(&samples, &self.params.volume) else { return Vec::new() };
        let polygon = &volume.polygon;
        let reach_m = polygon.outer_radius();
        let centre = Point2::from(odom_from_sensor.translation);
        let low = self.cells.at(&Point2::new(centre.x - reach_m, centre.y - reach_m));
        let high = self.cells.at(&Point2::new(centre.x + reach_m, centre.y + reach_m));
        let half_m = (0.5 - self.params.cell_margin) * self.params.cell_m;
        let fence = Fence::around(polygon);
        let mut inside = Vec::new();
        for row in low.row..=high.row {
            for column in low.column..=high.column {
                let cell = Cell { column, row };
                let middle = self.cells.centre(cell);
                let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| {
                    let corner = Point2::new(middle.x + x * half_m, middle.y + y * half_m);
                    odom_from_sensor.inverse_transform(&corner)
                });
                if fence.holds(&corners) {
                    inside.push(cell);
                }
            }
        }
        inside
    }
}

/// Edges of a boundary that share a box.
const TOGETHER: usize = 8;

/// A polygon and its boundary, with boxes around edges that follow each other: most cells are far from
/// most of it.
struct Fence<'a> {
    polygon: &'a StarPolygon,
    edges: Vec<[Point2; 2]>,
    /// Around every so many edges: the low and the high corner.
    boxes: Vec<[Point2; 2]>,
}

impl<'a> Fence<'a> {
    fn around(polygon: &'a StarPolygon) -> Self {
        let edges: Vec<[Point2; 2]> = polygon.boundary().map(|edge| [edge.from, edge.to]).collect();
        let boxes = edges.chunks(TOGETHER).map(|some| box_of(some.as_flattened())).collect();
        Self { polygon, edges, boxes }
    }

    /// Whether a convex quadrilateral lies inside the polygon: its corners do, and no edge of the
    /// polygon cuts in.
    fn holds(&self, corners: &[Point2; 4]) -> bool {
        if !corners.iter().all(|corner| self.polygon.contains(corner)) {
            return false;
        }
        let [low, high] = box_of(corners);
        let meets = |of: &[Point2; 2]| {
            of[0].x <= high.x && of[1].x >= low.x && of[0].y <= high.y && of[1].y >= low.y
        };
        let near = self.boxes.iter().zip(self.edges.chunks(TOGETHER)).filter(|(of, _)| meets(of));
        let cuts = |[from, to]: &[Point2; 2]| {
            (0..4).any(|i| segments_meet(from, to, &corners[i], &corners[(i + 1) % 4]))
        };
        !near.flat_map(|(_, edges)| edges).any(cuts)
    }
}

/// The box around points: its low and its high corner.
fn box_of(points: &[Point2]) -> [Point2; 2] {
    let (high, low) = (Point2::new(f64::MIN, f64::MIN), Point2::new(f64::MAX, f64::MAX));
    points.iter().fold([low, high], |[low, high], point| [low.inf(point), high.sup(point)])
}
