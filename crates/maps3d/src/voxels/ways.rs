//! Flying through cells: how near a straight flight comes to what is occupied or unknown, and the way to
//! the nearest frontier.

use std::collections::{BTreeMap, VecDeque};

use nalgebra::Point3;

use super::VoxelMap;
use super::blocks::Cell;
use super::frontier::{BESIDE, beside};
use super::walk::walk;
use crate::{FlightClearance, Hovering, Known};

/// Distances are looked up to here, metres.
const SEARCHED_M: f64 = 0.6;

/// A way is sought over so many cells at most.
const MOST_CELLS: usize = 4_000_000;

/// How near to frontier a way has to come, metres.
const ARRIVED_M: f64 = 1.0;

impl VoxelMap {
    /// Distances between the middles of cells, less half a cell's diagonal: never more than they are.
    pub(super) fn motion_clearance(
        &self,
        hovering: &Hovering,
        to_in_body: &Point3<f64>,
        leaving_m: f64,
    ) -> FlightClearance {
        let Some(map_from_body) = self.map_from_body(hovering) else {
            return FlightClearance::NONE;
        };
        let from = Point3::from(map_from_body.translation);
        let to = map_from_body.transform(to_in_body);
        if !to.iter().all(|x| x.is_finite()) {
            return FlightClearance::NONE;
        }
        let start = self.nearest(&from);
        let end = self.nearest(&to);
        let (mut solid_m, mut unseen_m) = (start[0].min(end[0]), f64::INFINITY);
        let cell_m = self.params.cell_m;
        let mut cells: Vec<Cell> = Vec::new();
        walk(&(from / cell_m), &(to / cell_m), |cell| cells.push(cell));
        for cell in cells {
            let middle = self.middle_of(cell);
            let near = self.nearest(&middle);
            solid_m = solid_m.min(near[0]);
            if (middle - from).norm() > leaving_m {
                unseen_m = unseen_m.min(near[1]);
            }
        }
        FlightClearance {
            solid_at_start_m: start[0],
            solid_m,
            solid_at_end_m: end[0],
            unseen_m,
            unseen_at_end_m: end[1],
        }
    }

    /// Distances of a point from the nearest occupied and the nearest unknown cell, as far as is looked.
    fn nearest(&self, point: &Point3<f64>) -> [f64; 2] {
        let cell_m = self.params.cell_m;
        let reach = (SEARCHED_M / cell_m).ceil() as i32;
        let at = self.cell_of(point);
        let mut least_m = [SEARCHED_M; 2];
        for dz in -reach..=reach {
            for dy in -reach..=reach {
                for dx in -reach..=reach {
                    let cell = beside(at, [dx, dy, dz]);
                    let known = self.known(cell);
                    let which = match known {
                        Known::Free => continue,
                        Known::Solid => 0,
                        Known::Unknown => 1,
                    };
                    let low = Point3::from(cell.map(|at| f64::from(at) * cell_m));
                    let off = (0..3).map(|axis| {
                        let by = (low[axis] - point[axis]).max(point[axis] - low[axis] - cell_m);
                        by.max(0.0).powi(2)
                    });
                    least_m[which] = least_m[which].min(off.sum::<f64>().sqrt());
                }
            }
        }
        least_m
    }

    /// The way through free cells, breadth first, to the nearest from which frontier is near; its corners in
    /// the frame `body`. Cells nearer than the clearance to what is occupied are left out.
    pub(super) fn way_to_frontier(
        &self,
        hovering: &Hovering,
        clearance_m: f64,
    ) -> Option<Vec<Point3<f64>>> {
        if self.patches.is_empty() {
            return None;
        }
        let map_from_body = self.map_from_body(hovering)?;
        let from = self.cell_of(&Point3::from(map_from_body.translation));
        let mut before: BTreeMap<Cell, Cell> = BTreeMap::new();
        let mut open: VecDeque<Cell> = VecDeque::new();
        before.insert(from, from);
        open.push_back(from);
        let mut goal = None;
        while let Some(cell) = open.pop_front() {
            let middle = self.middle_of(cell);
            if self.is_goal(&middle, ARRIVED_M) {
                goal = Some(cell);
                break;
            }
            if before.len() > MOST_CELLS {
                break;
            }
            for next in BESIDE.map(|by| beside(cell, by)) {
                let passes = !before.contains_key(&next)
                    && self.known(next) == Known::Free
                    && self.keeps(next, clearance_m);
                if passes {
                    before.insert(next, cell);
                    open.push_back(next);
                }
            }
        }
        let mut cells = vec![goal?];
        while let Some(&cell) = cells.last().filter(|cell| **cell != from) {
            cells.push(before[&cell]);
        }
        cells.reverse();
        let corners = self.straightened(&cells, clearance_m);
        let in_body = |cell: &Cell| map_from_body.inverse_transform(&self.middle_of(*cell));
        Some(corners.iter().skip(1).map(in_body).collect())
    }

    /// Whether no cell within a distance is occupied.
    fn keeps(&self, cell: Cell, clearance_m: f64) -> bool {
        let reach = (clearance_m / self.params.cell_m).ceil() as i32;
        let limit = (clearance_m / self.params.cell_m).powi(2);
        (-reach..=reach).all(|dz| {
            (-reach..=reach).all(|dy| {
                (-reach..=reach).all(|dx| {
                    f64::from(dx * dx + dy * dy + dz * dz) > limit
                        || self.known(beside(cell, [dx, dy, dz])) != Known::Solid
                })
            })
        })
    }

    /// Leaves cells of a way out where the straight line between others passes as well.
    fn straightened(&self, cells: &[Cell], clearance_m: f64) -> Vec<Cell> {
        let Some(&first) = cells.first() else { return Vec::new() };
        let mut kept = vec![first];
        let mut at = 0;
        while at + 1 < cells.len() {
            let mut next = at + 1;
            // The farthest by doubling, so that long ways stay linear.
            let mut ahead = 2;
            while at + ahead < cells.len()
                && self.is_straight(cells[at], cells[at + ahead], clearance_m)
            {
                next = at + ahead;
                ahead *= 2;
            }
            kept.push(cells[next]);
            at = next;
        }
        kept
    }

    fn is_straight(&self, from: Cell, to: Cell, clearance_m: f64) -> bool {
        let cell_m = self.params.cell_m;
        let mut free = true;
        let [from, to] = [from, to].map(|cell| self.middle_of(cell) / cell_m);
        walk(&from, &to, |cell| {
            free &= self.known(cell) == Known::Free && self.keeps(cell, clearance_m);
        });
        free
    }
}
