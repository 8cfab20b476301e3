//! A scan changes cells (\[ISRR19\] 6.2, eq. 6).

use std::collections::BTreeSet;

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
        let mut changed: Vec<(Cell, CellState, CellState)> = Vec::new();
        for (cell, state) in evidence {
            let before = self.cells.set(cell, state);
            match changed.iter_mut().find(|(c, _, _)| *c == cell) {
                Some(entry) => entry.2 = state,
                None => changed.push((cell, before, state)),
            }
        }
        changed.retain(|(_, before, now)| before != now);
        changed.sort_unstable_by_key(|(cell, _, _)| *cell);
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
        let mut inside = Vec::new();
        for row in low.row..=high.row {
            for column in low.column..=high.column {
                let cell = Cell { column, row };
                let middle = self.cells.centre(cell);
                let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| {
                    let corner = Point2::new(middle.x + x * half_m, middle.y + y * half_m);
                    odom_from_sensor.inverse_transform(&corner)
                });
                if holds(polygon, &corners) {
                    inside.push(cell);
                }
            }
        }
        inside
    }
}

/// Whether a convex quadrilateral lies inside the polygon: its corners do, and no edge of the
/// polygon cuts in.
fn holds(polygon: &StarPolygon, corners: &[Point2; 4]) -> bool {
    corners.iter().all(|corner| polygon.contains(corner))
        && !polygon.boundary().any(|edge| {
            (0..4).any(|i| segments_meet(&edge.from, &edge.to, &corners[i], &corners[(i + 1) % 4]))
        })
}
