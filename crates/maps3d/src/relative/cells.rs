//! The image cut into square cells, so that what lies in a direction is found by looking at few faces.

use crate::image::Pixel;

/// By how much rounding may move a triangle, pixels.
const TRIANGLE_SLACK_PX: f64 = 1e-6;

/// About so many triangles per cell.
const TRIANGLES_PER_CELL: f64 = 2.0;

/// Which triangles reach into which cell, and between which depths.
#[derive(Clone, Debug)]
pub(super) struct Cells {
    cell_px: f64,
    counts: [usize; 2],
    /// Triangles of cell `i` are `faces[starts[i]..starts[i + 1]]`.
    starts: Box<[u32]>,
    faces: Box<[u16]>,
    /// Least and largest depth of the corners of its triangles, metres.
    depths_m: Box<[[f32; 2]]>,
}

impl Cells {
    /// Sorts triangles into cells. O(triangles + cells).
    pub fn new(
        extent: [u16; 2],
        pixels: &[Pixel],
        corner_depths_m: &[f32],
        triangles: &[[u16; 3]],
    ) -> Self {
        let [width, height] = extent.map(f64::from);
        let per_cell = width * height * TRIANGLES_PER_CELL / triangles.len().max(1) as f64;
        let cell_px = per_cell.sqrt().max(1.0);
        let counts = [width, height].map(|side| (side / cell_px) as usize + 1);
        let mut cells = Self {
            cell_px,
            counts,
            starts: Box::default(),
            faces: Box::default(),
            depths_m: vec![[f32::INFINITY, 0.0]; counts[0] * counts[1]].into(),
        };
        let mut pairs: Vec<(u32, u16)> = Vec::with_capacity(4 * triangles.len());
        for (face, corners) in triangles.iter().enumerate() {
            let at = corners.map(|corner| pixels[corner as usize].map(f64::from));
            cells.walk(&at, TRIANGLE_SLACK_PX, |cell| pairs.push((cell as u32, face as u16)));
        }
        pairs.sort_unstable();
        let mut starts = vec![0_u32; cells.depths_m.len() + 1];
        for &(cell, face) in &pairs {
            starts[cell as usize + 1] += 1;
            let [least, most] = &mut cells.depths_m[cell as usize];
            for corner in triangles[face as usize] {
                let depth_m = corner_depths_m[corner as usize];
                (*least, *most) = (least.min(depth_m), most.max(depth_m));
            }
        }
        for cell in 1..starts.len() {
            starts[cell] += starts[cell - 1];
        }
        cells.starts = starts.into();
        cells.faces = pairs.into_iter().map(|(_, face)| face).collect();
        cells
    }

    /// The triangles that reach into a cell, ascending.
    pub fn faces(&self, cell: usize) -> &[u16] {
        &self.faces[self.starts[cell] as usize..self.starts[cell + 1] as usize]
    }

    /// Least and largest depth of the triangles of a cell, metres.
    pub fn depths_m(&self, cell: usize) -> [f64; 2] {
        self.depths_m[cell].map(f64::from)
    }

    /// The cell of a place of the image; outside of it, the nearest.
    pub fn cell_of(&self, [column, row]: [f64; 2]) -> usize {
        let at = |x: f64, count: usize| ((x / self.cell_px).max(0.0) as usize).min(count - 1);
        at(row, self.counts[1]) * self.counts[0] + at(column, self.counts[0])
    }

    /// Calls with each cell that a convex polygon of the image reaches, or comes nearer to than the slack.
    /// What lies outside of the image reaches none.
    pub fn walk(&self, polygon: &[[f64; 2]], slack_px: f64, mut call: impl FnMut(usize)) {
        let (mut top, mut bottom) = (f64::INFINITY, f64::NEG_INFINITY);
        for &[_, y] in polygon {
            (top, bottom) = (top.min(y), bottom.max(y));
        }
        let Some(rows) = span(top - slack_px, bottom + slack_px, self.cell_px, self.counts[1])
        else {
            return;
        };
        for row in rows {
            let from = row as f64 * self.cell_px - slack_px;
            let to = from + self.cell_px + 2.0 * slack_px;
            let (mut left, mut right) = (f64::INFINITY, f64::NEG_INFINITY);
            let mut put = |x: f64| (left, right) = (left.min(x), right.max(x));
            let mut a = polygon[polygon.len() - 1];
            for &b in polygon {
                if (from..=to).contains(&b[1]) {
                    put(b[0]);
                }
                for y in [from, to] {
                    if (a[1] < y) != (b[1] < y) {
                        put(a[0] + (b[0] - a[0]) * ((y - a[1]) / (b[1] - a[1])));
                    }
                }
                a = b;
            }
            let columns = span(left - slack_px, right + slack_px, self.cell_px, self.counts[0]);
            for column in columns.into_iter().flatten() {
                call(row * self.counts[0] + column);
            }
        }
    }

    /// Memory held on the heap, bytes.
    pub fn heap_bytes(&self) -> usize {
        4 * self.starts.len() + 2 * self.faces.len() + 8 * self.depths_m.len()
    }
}

/// The steps of a side that a stretch of it reaches; none where it lies outside.
fn span(from: f64, to: f64, step: f64, count: usize) -> Option<std::ops::RangeInclusive<usize>> {
    let (first, last) = ((from / step).floor().max(0.0), (to / step).floor());
    (first <= last && first < count as f64)
        .then(|| first as usize..=(last.min(count as f64 - 1.0) as usize))
}
