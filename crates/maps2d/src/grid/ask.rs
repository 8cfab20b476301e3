//! The grid's own frontier planner (\[ISRR19\] 6.2): frontier cells in view, else Dijkstra's search
//! over free cells.

use geometry::{Point2, Vector2};
use probe::VertexId;
use search::{Graph, dijkstra_nearest};

use super::{Cell, CellState, Cells, GridMap};
use crate::volume::LocalVolume;
use crate::{Candidate, Route, Standing};

impl GridMap {
    /// Frontier cells whose centre lies in what is seen from where the robot stands.
    pub(super) fn cells_in_view(&self, standing: &Standing, out: &mut Vec<Candidate>) {
        self.near_cells(standing, out, |view, centre_in_anchor, here| {
            here || view.polygon.contains(centre_in_anchor)
        });
    }

    /// Frontier cells in reach of the sensor in directions that were not looked into from here.
    pub(super) fn cells_around(&self, standing: &Standing, out: &mut Vec<Candidate>) {
        self.near_cells(standing, out, |view, centre_in_anchor, here| {
            !here && view.is_unseen_towards(centre_in_anchor)
        });
        for candidate in out {
            candidate.turn_only = true;
        }
    }

    fn near_cells(
        &self,
        standing: &Standing,
        out: &mut Vec<Candidate>,
        counts: impl Fn(&LocalVolume, &Point2, bool) -> bool,
    ) {
        out.clear();
        if self.view_at != Some(standing.vertex) {
            return;
        }
        let odom_from_body = self.odom_from_body(standing);
        let reach_m = self.view.radius_m();
        let body = Point2::from(odom_from_body.translation);
        let low = self.cells.at(&Point2::new(body.x - reach_m, body.y - reach_m));
        let high = self.cells.at(&Point2::new(body.x + reach_m, body.y + reach_m));
        for column in low.column..=high.column {
            let column_cells = Cell { column, row: low.row }..=Cell { column, row: high.row };
            for &cell in self.frontier.range(column_cells) {
                let centre_in_body = odom_from_body.inverse_transform(&self.cells.centre(cell));
                let centre_in_anchor = standing.vertex_from_body.transform(&centre_in_body);
                let here = self.cells.at(&body) == cell;
                if counts(&self.view, &centre_in_anchor, here) {
                    out.push(Candidate {
                        goals_in_body: [centre_in_body; 3],
                        normal_in_body: Vector2::zeros(),
                        length_m: self.params.cell_m,
                        turn_only: here,
                        tag: pack(cell),
                    });
                }
            }
        }
    }

    /// The shortest way over free cells to the nearest frontier cell, from centre to centre.
    pub(super) fn way_over_free_cells(
        &mut self,
        standing: &Standing,
        clearance_m: f64,
    ) -> Option<Route> {
        let odom_from_body = self.odom_from_body(standing);
        let start = self.cells.at(&Point2::from(odom_from_body.translation));
        // Where the robot stands may never have been seen.
        self.cells.grow_to(start);
        let from = VertexId(self.cells.slot(start)? as u32);
        // Cells beside something occupied are left out first, where the clearance asks for it.
        for shy in [clearance_m >= 0.1, false] {
            let walk = FreeCells { cells: &self.cells, shy, start };
            let frontier = &self.frontier;
            let cells = &self.cells;
            let found = dijkstra_nearest(
                &walk,
                from,
                f64::INFINITY,
                |node| node != from && frontier.contains(&cells.cell(node.0 as usize)),
                &mut self.search,
            );
            let Ok(found) = found else { continue };
            let Some(path) = found.goal.and_then(|goal| found.tree.path_to(goal.node)) else {
                continue;
            };
            let way = path
                .iter()
                .skip(1)
                .map(|node| {
                    odom_from_body.inverse_transform(&cells.centre(cells.cell(node.0 as usize)))
                })
                .collect();
            return Some(Route::Drive(way));
        }
        // What no way over free cells leads to is believed to be out of reach.
        for cell in std::mem::take(&mut self.frontier) {
            self.cells.give_up(cell);
            self.ignored.insert(cell);
        }
        None
    }

    pub(super) fn give_up_near(
        &mut self,
        standing: &Standing,
        goal_in_body: &Point2,
        radius_m: f64,
    ) {
        let goal = self.odom_from_body(standing).transform(goal_in_body);
        let reach_m = radius_m.max(0.5 * self.params.cell_m);
        let low = self.cells.at(&Point2::new(goal.x - reach_m, goal.y - reach_m));
        let high = self.cells.at(&Point2::new(goal.x + reach_m, goal.y + reach_m));
        // A reach beyond the grid costs no more than the columns that have frontier.
        let (Some(first), Some(last)) = (self.frontier.first(), self.frontier.last()) else {
            return;
        };
        for column in low.column.max(first.column)..=high.column.min(last.column) {
            let cells = Cell { column, row: low.row }..=Cell { column, row: high.row };
            let near: Vec<Cell> = self
                .frontier
                .range(cells)
                .copied()
                .filter(|&cell| {
                    (self.cells.centre(cell) - goal).norm() <= reach_m
                        || self.cells.at(&goal) == cell
                })
                .collect();
            for cell in near {
                self.frontier.remove(&cell);
                self.cells.give_up(cell);
                self.ignored.insert(cell);
            }
        }
    }
}

fn pack(cell: Cell) -> u64 {
    (u64::from(cell.column as u32) << 32) | u64::from(cell.row as u32)
}

/// Free cells as a graph: steps along sides and diagonals that cut no corner.
struct FreeCells<'a> {
    cells: &'a Cells,
    shy: bool,
    start: Cell,
}

impl FreeCells<'_> {
    fn open(&self, cell: Cell) -> bool {
        let free = self.cells.state(cell) == CellState::Free;
        let pressed = self.shy
            && cell.sides().into_iter().any(|s| self.cells.state(s) == CellState::Occupied);
        cell == self.start || (free && (!pressed || self.cells.is_frontier(cell)))
    }
}

impl Graph for FreeCells<'_> {
    type Node = VertexId;

    fn node_bound(&self) -> usize {
        self.cells.slots()
    }

    fn for_each_edge(&self, from: VertexId, mut visit: impl FnMut(VertexId, f64)) {
        let cell = self.cells.cell(from.0 as usize);
        for (dx, dy) in [(1, 0), (0, 1), (-1, 0), (0, -1), (1, 1), (-1, 1), (-1, -1), (1, -1)] {
            let at = |dx: i32, dy: i32| Cell { column: cell.column + dx, row: cell.row + dy };
            let to = at(dx, dy);
            let cuts = dx != 0 && dy != 0 && !(self.open(at(dx, 0)) && self.open(at(0, dy)));
            if cuts || !self.open(to) {
                continue;
            }
            if let Some(slot) = self.cells.slot(to) {
                visit(VertexId(slot as u32), f64::from(dx).hypot(f64::from(dy)));
            }
        }
    }
}
