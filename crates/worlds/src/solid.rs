//! Which points of the plane are solid.

use geometry::Point2;

use crate::CellMap;

/// What fills a world.
#[derive(Clone, Debug, PartialEq)]
pub enum Solid {
    /// Solid cells; everything outside the map is solid.
    Cells(CellMap),
    /// Closed rings, each point joined to the next and the last to the first: a point is free
    /// inside an odd number of them (even-odd rule).
    Rings(Vec<Vec<Point2>>),
}

impl Solid {
    /// Whether a point is free; on the border itself either answer may come.
    ///
    /// O(1) for cells, O(edges) for rings.
    pub fn is_free(&self, point_in_world: &Point2) -> bool {
        match self {
            Self::Cells(cells) => {
                let (column, row) = cells.cell_of(point_in_world);
                !cells.is_solid(column, row)
            }
            Self::Rings(rings) => {
                let p = point_in_world;
                let mut inside = false;
                for (a, b) in rings.iter().flat_map(|ring| ring_edges(ring)) {
                    inside ^= crossing(&a, &b, p.y).is_some_and(|x| p.x < x);
                }
                inside
            }
        }
    }

    /// Whether each of `count` points in a row is free; the first is given, and each next lies
    /// `step_m` to the right.
    ///
    /// The same answers as [`is_free`](Self::is_free), but rings are walked once per row.
    pub fn free_in_row(&self, first_in_world: &Point2, step_m: f64, count: usize) -> Vec<bool> {
        let x_of = |i: usize| first_in_world.x + i as f64 * step_m;
        let Self::Rings(rings) = self else {
            return (0..count)
                .map(|i| self.is_free(&Point2::new(x_of(i), first_in_world.y)))
                .collect();
        };
        let y = first_in_world.y;
        let edges = rings.iter().flat_map(|ring| ring_edges(ring));
        let mut crossings: Vec<f64> = edges.filter_map(|(a, b)| crossing(&a, &b, y)).collect();
        crossings.sort_by(f64::total_cmp);
        (0..count)
            .map(|i| (crossings.len() - crossings.partition_point(|&x| x <= x_of(i))) % 2 == 1)
            .collect()
    }

    /// The border between solid and free as segments.
    ///
    /// Cells: each maximal straight run of cell sides is one segment; linear in the number of
    /// cells. Rings: their edges, without those of length 0.
    pub fn border(&self) -> Vec<(Point2, Point2)> {
        match self {
            Self::Cells(cells) => cell_border(cells),
            Self::Rings(rings) => {
                rings.iter().flat_map(|ring| ring_edges(ring)).filter(|(a, b)| a != b).collect()
            }
        }
    }
}

/// x where an edge crosses the level `y`; the lower end belongs to the edge, the upper does not.
fn crossing(a: &Point2, b: &Point2, y: f64) -> Option<f64> {
    ((a.y > y) != (b.y > y)).then(|| a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x))
}

/// The edges of a closed ring.
fn ring_edges(ring: &[Point2]) -> impl Iterator<Item = (Point2, Point2)> + '_ {
    (0..ring.len()).map(|i| (ring[i], ring[(i + 1) % ring.len()]))
}

fn cell_border(cells: &CellMap) -> Vec<(Point2, Point2)> {
    let (columns, rows) = (cells.columns as i64, cells.rows as i64);
    let corner = |column: i64, row: i64| {
        Point2::new(
            cells.origin_in_world.x + column as f64 * cells.cell_m,
            cells.origin_in_world.y + row as f64 * cells.cell_m,
        )
    };
    let mut segments = Vec::new();
    for row in 0..=rows {
        runs(columns, |column| cells.is_solid(column, row - 1) != cells.is_solid(column, row))
            .for_each(|(from, to)| segments.push((corner(from, row), corner(to, row))));
    }
    for column in 0..=columns {
        runs(rows, |row| cells.is_solid(column - 1, row) != cells.is_solid(column, row))
            .for_each(|(from, to)| segments.push((corner(column, from), corner(column, to))));
    }
    segments
}

/// The maximal runs `from..to` of indices below `count` that are marked.
fn runs(count: i64, marked: impl Fn(i64) -> bool) -> impl Iterator<Item = (i64, i64)> {
    let mut next = 0;
    std::iter::from_fn(move || {
        while next < count && !marked(next) {
            next += 1;
        }
        let from = next;
        while next < count && marked(next) {
            next += 1;
        }
        (from < next).then_some((from, next))
    })
}
