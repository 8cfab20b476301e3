//! A region as cells, for those who know grids only.

use geometry::Point2;
use geometry::planar::overlay::{EdgeLabel, Region};

use pose::Se2;

use super::Tag;
use crate::GlobalBelief;
use crate::grid::{Cell, CellState, Cells};

/// The cells of a region: free where the centre lies inside, occupied where an obstacle edge passes
/// through, for which each is walked along in steps of a tenth of a cell; unknown elsewhere.
///
/// Cost: a ray along every row of cells, each cast at all edges once, and the length of the walls.
pub fn cells_of(region: &Region<Tag>, cell_m: f64) -> Cells {
    let mut cells = Cells::new(cell_m);
    let points = || region.rings.iter().flat_map(|ring| &ring.points);
    let (mut low, mut high) = (Point2::new(f64::MAX, f64::MAX), Point2::new(-f64::MAX, -f64::MAX));
    for point in points() {
        low = low.inf(point);
        high = high.sup(point);
    }
    if low.x > high.x {
        return cells;
    }
    let (first, last) = (cells.at(&low), cells.at(&high));
    let mut crossings: Vec<(f64, i32)> = Vec::new();
    for row in first.row..=last.row {
        let y = cells.centre(Cell { column: 0, row }).y;
        crossings.clear();
        for edge in region.edges() {
            if (edge.from.y <= y) != (edge.to.y <= y) {
                let share = (y - edge.from.y) / (edge.to.y - edge.from.y);
                let x = edge.from.x + share * (edge.to.x - edge.from.x);
                crossings.push((x, if edge.to.y < edge.from.y { 1 } else { -1 }));
            }
        }
        crossings.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (mut next, mut winding) = (0, 0);
        for column in first.column..=last.column {
            let cell = Cell { column, row };
            let x = cells.centre(cell).x;
            while crossings.get(next).is_some_and(|crossing| crossing.0 <= x) {
                winding += crossings[next].1;
                next += 1;
            }
            if winding != 0 {
                cells.set(cell, CellState::Free);
            }
        }
    }
    for edge in region.edges().filter(|edge| edge.label == EdgeLabel::Obstacle) {
        let along = edge.to - edge.from;
        let steps = (along.norm() / (0.1 * cell_m)).ceil().clamp(1.0, 1e6) as usize;
        // A hair to the right, where the wall is.
        let aside = geometry::Vector2::new(along.y, -along.x).try_normalize(0.0);
        let aside = aside.unwrap_or_else(geometry::Vector2::zeros) * 1e-3;
        for k in 0..=steps {
            let point = edge.from + along * (k as f64 / steps as f64) + aside;
            let cell = cells.at(&point);
            cells.set(cell, CellState::Occupied);
        }
    }
    cells
}

/// Side of the cells by which a region is judged, metres.
const JUDGED_CELL_M: f64 = 0.25;

/// A region and its poses as what a map believes.
pub(crate) fn global_of(region: &Region<Tag>, map_from_vertex: &[Se2]) -> GlobalBelief {
    let solid = region.edges().filter(|edge| edge.label == EdgeLabel::Obstacle);
    GlobalBelief {
        walls: solid.map(|edge| (edge.from, edge.to)).collect(),
        cells: cells_of(region, JUDGED_CELL_M),
        map_from_vertex: map_from_vertex.to_vec(),
    }
}
