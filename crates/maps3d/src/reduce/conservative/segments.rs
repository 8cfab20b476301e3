//! Stretches of lines on which both surfaces are affine in inverse depth.

use sensing::Camera;

use crate::image::FilledImage;
use crate::triangulate::ImageMesh;

/// A stretch of a line of the image that no side of the mesh and no line of the grid crosses.
#[derive(Clone, Copy, Debug)]
pub(super) struct Segment {
    pub ends: [Place; 2],
}

impl Segment {
    /// Whether the mesh lies beyond the measured surface anywhere along it: then it does so at an end.
    pub fn is_beyond(&self) -> bool {
        !self.ends.iter().all(|end| end.mesh >= end.measured)
    }
}

/// A place of the image, and how far both surfaces are there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    /// Column and row.
    pub at: [f64; 2],
    /// Inverse depth of the mesh.
    pub mesh: f64,
    /// Inverse depth of the full grid.
    pub measured: f64,
}

impl Place {
    /// Some share of the way from one end of a segment to the other.
    pub fn between([a, b]: &[Self; 2], along: f64) -> Self {
        let mix = |from: f64, to: f64| (1.0 - along) * from + along * to;
        Self {
            at: [mix(a.at[0], b.at[0]), mix(a.at[1], b.at[1])],
            mesh: mix(a.mesh, b.mesh),
            measured: mix(a.measured, b.measured),
        }
    }

    /// Metres along the ray per metre of depth.
    pub fn stretch(&self, camera: &Camera) -> f64 {
        let [x, y] = camera.slope_of(self.at[0], self.at[1]);
        (x * x + y * y + 1.0).sqrt()
    }
}

/// Visits the border of every piece that a face of the mesh and one of the full grid have in common:
/// each stretch of it, with the vertices of the mesh that hold it up.
///
/// Where lines cross is computed in whole numbers, and inverse depths are mixed with positive shares
/// alone, so no digits are lost across deep steps. O(pixels + length of all edges in pixels).
pub(super) fn visit(image: &FilledImage, mesh: &ImageMesh, mut look: impl FnMut(&[u32], &Segment)) {
    let mut cuts = Vec::new();
    for triangle in &mesh.triangles {
        let corners = triangle.map(|vertex| {
            let [column, row] = mesh.pixels[vertex as usize].map(i64::from);
            Corner { column, row, inverse: 1.0 / mesh.depths_m[vertex as usize] }
        });
        for side in 0..3 {
            let next = (side + 1) % 3;
            along_side(image, corners[side], corners[next], &mut cuts, |segment| {
                look(&[triangle[side], triangle[next]], segment);
            });
        }
        for lines in LINES {
            across_face(image, corners, lines, |segment| look(triangle, segment));
        }
    }
}

#[derive(Clone, Copy)]
struct Corner {
    column: i64,
    row: i64,
    /// Inverse depth of the mesh.
    inverse: f64,
}

/// Parallel lines of the grid, each known by a whole number.
#[derive(Clone, Copy)]
enum Lines {
    Columns,
    Rows,
    /// From the upper left to the lower right; the number is the column less the row.
    Diagonals,
}

const LINES: [Lines; 3] = [Lines::Columns, Lines::Rows, Lines::Diagonals];

impl Lines {
    /// On which of these lines a corner lies, and how far along.
    fn of(self, corner: &Corner) -> [i64; 2] {
        let Corner { column, row, .. } = *corner;
        match self {
            Self::Columns => [column, row],
            Self::Rows => [row, column],
            Self::Diagonals => [column - row, column],
        }
    }

    /// The column and row of a place so far along a line.
    fn place<T: Copy + std::ops::Sub<Output = T>>(self, line: T, along: T) -> [T; 2] {
        match self {
            Self::Columns => [line, along],
            Self::Rows => [along, line],
            Self::Diagonals => [along, along - line],
        }
    }
}

/// Where a side of the mesh crosses a line of the grid.
#[derive(Clone, Copy)]
struct Cut {
    /// How far along the line: whole pixels, and a share of the next.
    whole: i64,
    share: f64,
    /// Share of the side up to here.
    along_side: f64,
    mesh: f64,
    measured: f64,
}

impl Cut {
    /// The crossing of the side from `p` to `q` with a line between them, or through one of them.
    fn of(image: &FilledImage, lines: Lines, line: i64, p: &Corner, q: &Corner) -> Self {
        let ([from, start], [to, end]) = (lines.of(p), lines.of(q));
        let height = (to - from).abs();
        let reach = (end - start) * (line - from).abs();
        let (whole, rest) = (start + reach.div_euclid(height), reach.rem_euclid(height));
        let share = rest as f64 / height as f64;
        let along_side = (line - from).abs() as f64 / height as f64;
        let mut measured = inverse_at(image, lines.place(line, whole));
        if rest > 0 {
            let next = inverse_at(image, lines.place(line, whole + 1));
            measured = (1.0 - share) * measured + share * next;
        }
        let mesh = (1.0 - along_side) * p.inverse + along_side * q.inverse;
        Self { whole, share, along_side, mesh, measured }
    }

    fn along(&self) -> f64 {
        self.whole as f64 + self.share
    }

    fn place(&self, lines: Lines, line: i64) -> Place {
        let at = lines.place(line as f64, self.along());
        Place { at, mesh: self.mesh, measured: self.measured }
    }
}

/// The inverse depth of the full grid at a pixel.
fn inverse_at(image: &FilledImage, [column, row]: [i64; 2]) -> f64 {
    1.0 / f64::from(image.depths_m()[row as usize * image.columns() + column as usize])
}

/// The stretches of a side between the lines that it crosses.
fn along_side(
    image: &FilledImage,
    a: Corner,
    b: Corner,
    cuts: &mut Vec<(f64, Place)>,
    mut look: impl FnMut(&Segment),
) {
    let end = |corner: &Corner| Place {
        at: [corner.column as f64, corner.row as f64],
        mesh: corner.inverse,
        measured: inverse_at(image, [corner.column, corner.row]),
    };
    cuts.clear();
    for lines in LINES {
        let ([from, _], [to, _]) = (lines.of(&a), lines.of(&b));
        for line in from.min(to) + 1..from.max(to) {
            let cut = Cut::of(image, lines, line, &a, &b);
            cuts.push((cut.along_side, cut.place(lines, line)));
        }
    }
    cuts.sort_unstable_by(|(p, _), (q, _)| p.total_cmp(q));
    let mut last = end(&a);
    for &(_, place) in cuts.iter() {
        look(&Segment { ends: [last, place] });
        last = place;
    }
    look(&Segment { ends: [last, end(&b)] });
}

/// The stretches of lines of the grid inside a face, between pixels and up to its sides.
fn across_face(
    image: &FilledImage,
    mut corners: [Corner; 3],
    lines: Lines,
    mut look: impl FnMut(&Segment),
) {
    corners.sort_unstable_by_key(|corner| lines.of(corner));
    let [low, middle, high] = &corners;
    let [first, split, last] = [low, middle, high].map(|corner| lines.of(corner)[0]);
    for line in first + 1..last {
        let one = Cut::of(image, lines, line, low, high);
        let (p, q) = if line <= split { (low, middle) } else { (middle, high) };
        let other = Cut::of(image, lines, line, p, q);
        let (from, to) = if one.along() < other.along() { (one, other) } else { (other, one) };
        let (start, end) = (from.along(), to.along());
        let mut place = from.place(lines, line);
        let inner = from.whole + 1..to.whole + i64::from(to.share > 0.0);
        for along in inner {
            let share = (along as f64 - start) / (end - start);
            let next = Place {
                at: lines.place(line as f64, along as f64),
                mesh: (1.0 - share) * from.mesh + share * to.mesh,
                measured: inverse_at(image, lines.place(line, along)),
            };
            look(&Segment { ends: [place, next] });
            place = next;
        }
        look(&Segment { ends: [place, to.place(lines, line)] });
    }
}
