//! The nearest surface to a point.

use geometry::Point2;

use crate::SurfacePoint;

/// Points of surfaces, sorted into cells.
#[derive(Clone, Debug)]
pub struct Surfaces {
    cell_m: f64,
    origin: Point2,
    columns: usize,
    rows: usize,
    /// Where each cell's points start; one more than there are cells.
    starts: Vec<u32>,
    points: Vec<SurfacePoint>,
}

/// Cells along one side, at most.
const MOST: usize = 1024;

impl Surfaces {
    /// Sorts points into cells of a size, metres.
    pub fn new(points: &[SurfacePoint], cell_m: f64) -> Self {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for SurfacePoint { point, .. } in points {
            low = [low[0].min(point.x), low[1].min(point.y)];
            high = [high[0].max(point.x), high[1].max(point.y)];
        }
        if points.is_empty() {
            (low, high) = ([0.0; 2], [0.0; 2]);
        }
        let cells = |low: f64, high: f64| (((high - low) / cell_m).floor() as usize + 1).min(MOST);
        let (columns, rows) = (cells(low[0], high[0]), cells(low[1], high[1]));
        let origin = Point2::new(low[0], low[1]);
        let of = |point: &Point2| {
            let offset = (point - origin) / cell_m;
            let column = (offset.x as usize).min(columns - 1);
            (offset.y as usize).min(rows - 1) * columns + column
        };
        let mut starts = vec![0_u32; columns * rows + 1];
        for point in points {
            starts[of(&point.point) + 1] += 1;
        }
        for i in 1..starts.len() {
            starts[i] += starts[i - 1];
        }
        let mut next = starts.clone();
        let blank = SurfacePoint { point: Point2::origin(), normal: geometry::Vector2::zeros() };
        let mut sorted = vec![blank; points.len()];
        for point in points {
            let slot = &mut next[of(&point.point)];
            sorted[*slot as usize] = *point;
            *slot += 1;
        }
        Self { cell_m, origin, columns, rows, starts, points: sorted }
    }

    /// The nearest of the points within `within_m`: in the cells around the point's own where those can
    /// tell, else as far as is asked.
    pub fn nearest(&self, point: &Point2, within_m: f64) -> Option<&SurfacePoint> {
        let far = (within_m / self.cell_m).ceil() as isize;
        let (squared, nearest) = self.nearest_in(point, 1);
        if far <= 1 || squared <= self.cell_m * self.cell_m {
            return nearest.filter(|_| squared <= within_m * within_m);
        }
        let (squared, nearest) = self.nearest_in(point, far);
        nearest.filter(|_| squared <= within_m * within_m)
    }

    /// The nearest point of the cells up to `reach` cells from that of a point, and its squared distance.
    fn nearest_in(&self, point: &Point2, reach: isize) -> (f64, Option<&SurfacePoint>) {
        let offset = (point - self.origin) / self.cell_m;
        let (x, y) = (offset.x.floor() as isize, offset.y.floor() as isize);
        let mut best: (f64, Option<&SurfacePoint>) = (f64::INFINITY, None);
        let (low, high) = ((x - reach).max(0), (x + reach).min(self.columns as isize - 1));
        if low > high {
            return best;
        }
        for row in (y - reach).max(0)..=(y + reach).min(self.rows as isize - 1) {
            let base = row as usize * self.columns;
            let from = self.starts[base + low as usize] as usize;
            let to = self.starts[base + high as usize + 1] as usize;
            for candidate in &self.points[from..to] {
                let squared = (candidate.point - point).norm_squared();
                if squared < best.0 {
                    best = (squared, Some(candidate));
                }
            }
        }
        best
    }

    /// All points.
    pub fn points(&self) -> &[SurfacePoint] {
        &self.points
    }
}
