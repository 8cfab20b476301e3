//! Depths of the vertices, fitted to all pixels.

use sensing::Camera;

use super::InverseDepth;
use super::plane::LiftedPlane;
use super::scan::{HEADS, LANES, Lanes, RAMP, Sheet, each};
use crate::image::FilledImage;
use crate::tolerance::FITTED_SHARE;
use crate::triangulate::{ImageMesh, orient, rows_of};

/// Rounds of weighting and solving.
const ROUNDS: usize = 2;
/// Steps of conjugate gradients in each round.
const STEPS: usize = 25;
/// How much a vertex is drawn to where it was, as a share of the weight of its pixels.
const TIE: f64 = 1e-3;

/// Moves vertices along their rays so that faces pass the pixels better; pixels stay where they are.
///
/// The inverse depth of a face is affine in pixels, so the sum of squared distances from all pixels
/// to the planes of their faces is a quadratic form of the vertices' inverse depths once the planes'
/// normals are taken as they are: a pixel at depth z is `offset z |change|` off, with the distance
/// `offset` of its plane from the camera. Pixels that are more than the cap off count no more the
/// farther they are (weight `1 / (1 + (e / cap)^2)^2`, Geman and McClure): they belong to something
/// else than the face. Solved by conjugate gradients from where the vertices are.
/// O(pixels) per round, [`ROUNDS`] rounds.
pub(super) fn fit(
    image: &FilledImage,
    sheet: &Sheet,
    mesh: &mut ImageMesh,
    options: &InverseDepth,
) {
    let mut inverse: Vec<f64> = mesh.depths_m.iter().map(|depth_m| 1.0 / depth_m).collect();
    let mut system = System::default();
    let (near, far) = image
        .depths_m()
        .iter()
        .fold((f32::INFINITY, 0.0_f32), |(near, far), &z| (near.min(z), far.max(z)));
    let range = [1.0 / f64::from(far), 1.0 / f64::from(near)];
    for _ in 0..ROUNDS {
        system.assemble(image, sheet, mesh, &inverse, options);
        system.solve(mesh, &mut inverse, range);
    }
    for (depth_m, inverse) in mesh.depths_m.iter_mut().zip(&inverse) {
        *depth_m = 1.0 / inverse;
    }
}

/// A symmetric system: a diagonal, and three couplings per face.
#[derive(Default)]
struct System {
    diagonal: Vec<f64>,
    /// Between corners 0 and 1, 1 and 2, 2 and 0.
    couplings: Vec<[f64; 3]>,
    right: Vec<f64>,
}

impl System {
    fn assemble(
        &mut self,
        image: &FilledImage,
        sheet: &Sheet,
        mesh: &ImageMesh,
        inverse: &[f64],
        options: &InverseDepth,
    ) {
        let vertices = mesh.pixels.len();
        self.diagonal.clear();
        self.diagonal.resize(vertices, 0.0);
        self.right.clear();
        self.right.resize(vertices, 0.0);
        self.couplings.clear();
        for &triangle in &mesh.triangles {
            let sums = face_sums(image, sheet, mesh, triangle, inverse, options);
            let [a, b, c] = triangle.map(|v| v as usize);
            for (vertex, square, right) in
                [(a, sums[0], sums[6]), (b, sums[1], sums[7]), (c, sums[2], sums[8])]
            {
                self.diagonal[vertex] += square;
                self.right[vertex] += right;
            }
            self.couplings.push([sums[3], sums[4], sums[5]]);
        }
        let most = self.diagonal.iter().copied().fold(0.0, f64::max);
        for (vertex, inverse) in inverse.iter().enumerate() {
            // A vertex without pixels of its own stays.
            let tie = (TIE * self.diagonal[vertex]).max(1e-9 * most).max(f64::MIN_POSITIVE);
            self.diagonal[vertex] += tie;
            self.right[vertex] += tie * inverse;
        }
    }

    fn times(&self, mesh: &ImageMesh, x: &[f64], out: &mut [f64]) {
        for ((out, x), diagonal) in out.iter_mut().zip(x).zip(&self.diagonal) {
            *out = diagonal * x;
        }
        for (&triangle, [ab, bc, ca]) in mesh.triangles.iter().zip(&self.couplings) {
            let [a, b, c] = triangle.map(|v| v as usize);
            out[a] += ab * x[b] + ca * x[c];
            out[b] += ab * x[a] + bc * x[c];
            out[c] += bc * x[b] + ca * x[a];
        }
    }

    /// Conjugate gradients, preconditioned by the diagonal; keeps depths within those of the image.
    fn solve(&self, mesh: &ImageMesh, x: &mut [f64], [least, most]: [f64; 2]) {
        let n = x.len();
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let start = x.to_vec();
        let mut image = vec![0.0; n];
        self.times(mesh, x, &mut image);
        let mut left: Vec<f64> = self.right.iter().zip(&image).map(|(b, ax)| b - ax).collect();
        let mut scaled: Vec<f64> = left.iter().zip(&self.diagonal).map(|(r, d)| r / d).collect();
        let mut along = scaled.clone();
        let mut size = dot(&left, &scaled);
        let enough = FITTED_SHARE * size;
        for _ in 0..STEPS {
            if size <= enough || !size.is_finite() {
                break;
            }
            self.times(mesh, &along, &mut image);
            let step = size / dot(&along, &image);
            for i in 0..n {
                x[i] += step * along[i];
                left[i] -= step * image[i];
                scaled[i] = left[i] / self.diagonal[i];
            }
            let now = dot(&left, &scaled);
            for (along, scaled) in along.iter_mut().zip(&scaled) {
                *along = scaled + now / size * *along;
            }
            size = now;
        }
        for (x, start) in x.iter_mut().zip(start) {
            // A face seen edge-on can ask for anything.
            *x = if x.is_finite() { x.clamp(least, most) } else { start };
        }
    }
}

/// Sums over the pixels of a face: three squares of weights, three products, three right sides.
#[expect(clippy::cast_possible_truncation, reason = "depths are measured to fewer digits")]
fn face_sums(
    image: &FilledImage,
    sheet: &Sheet,
    mesh: &ImageMesh,
    triangle: [u32; 3],
    inverse: &[f64],
    options: &InverseDepth,
) -> [f64; 9] {
    let camera: &Camera = image.camera();
    let corners = mesh.corner_pixels(triangle);
    let at_corners = triangle.map(|v| inverse[v as usize]);
    let plane = LiftedPlane::through(camera, corners, at_corners);
    let area = orient(corners[0], corners[1], corners[2]) as f64;
    // Shares of corners 0 and 1 as affine functions of pixels.
    let share = |p: [u16; 2], q: [u16; 2], [column, row]: [f64; 2]| {
        let ([px, py], [qx, qy]) = (p.map(f64::from), q.map(f64::from));
        ((qx - px) * (row - py) - (qy - py) * (column - px)) / area
    };
    let [step_a, step_b] = [(1, 2), (2, 0)]
        .map(|(p, q)| -(f64::from(corners[q][1]) - f64::from(corners[p][1])) / area);
    let steps = [step_a, step_b, -step_a - step_b];
    let [wa, wb, wc] = at_corners;
    let step_w = steps[0] * wa + steps[1] * wb + steps[2] * wc;
    let offset = plane.offset_m * plane.emphasis(at_corners, options.edge_on);
    let (per_cap, missing) = ((offset / options.fit_m) as f32, options.missing_weight as f32);
    let mut totals = [0.0_f64; 9];
    for span in rows_of(corners) {
        let start = [span.first as f64, span.row as f64];
        let first_a = share(corners[1], corners[2], start);
        let first_b = share(corners[2], corners[0], start);
        let first = [first_a, first_b, 1.0 - first_a - first_b];
        let first_w = first[0] * wa + first[1] * wb + first[2] * wc;
        // Shares are affine along the row, so powers of the place in it are all that is summed:
        // of the weights up to the second, of weight times target up to the first.
        let mut sums = [[0.0; LANES]; 5];
        let line = [first_w as f32, step_w as f32, per_cap, missing];
        let (chunks, last, rest) = sheet.lanes(&span);
        for (chunk, depths_m) in chunks.iter().enumerate() {
            add(&mut sums, depths_m, (chunk * LANES) as f32, &HEADS[LANES], line);
        }
        if rest > 0 {
            add(&mut sums, last, (chunks.len() * LANES) as f32, &HEADS[rest], line);
        }
        let scale = offset * offset;
        let [w0, w1, w2, t0, t1] = sums.map(|lanes| scale * f64::from(lanes.iter().sum::<f32>()));
        let product = |p: usize, q: usize| {
            let ([p0, q0], [ps, qs]) = ([first[p], first[q]], [steps[p], steps[q]]);
            p0 * q0 * w0 + (p0 * qs + q0 * ps) * w1 + ps * qs * w2
        };
        let right = |p: usize| first[p] * t0 + steps[p] * t1;
        let terms = [
            product(0, 0),
            product(1, 1),
            product(2, 2),
            product(0, 1),
            product(1, 2),
            product(2, 0),
            right(0),
            right(1),
            right(2),
        ];
        for (total, term) in totals.iter_mut().zip(terms) {
            *total += term;
        }
    }
    totals
}

/// Adds eight pixels to sums over a row: weights by the place's power 0, 1, 2, and weights times
/// targets by the power 0, 1. `line` is the inverse depth at place 0, its step, one over the distance
/// at which pixels hardly count, and what missing ones count.
#[inline(always)]
fn add(
    sums: &mut [Lanes; 5],
    depths_m: &Lanes,
    base: f32,
    counts: &Lanes,
    [first_w, step_w, per_cap, missing]: [f32; 4],
) {
    let at = each(|lane| base + RAMP[lane]);
    let shares = each(|lane| if depths_m[lane] < 0.0 { missing } else { 1.0 });
    let depths_m = each(|lane| depths_m[lane].abs());
    let errors = each(|lane| ((first_w + at[lane] * step_w) * depths_m[lane] - 1.0) * per_cap);
    let calm = each(|lane| 1.0 / (1.0 + errors[lane] * errors[lane]));
    let targets =
        each(|lane| shares[lane] * counts[lane] * calm[lane] * calm[lane] * depths_m[lane]);
    let weights = each(|lane| targets[lane] * depths_m[lane]);
    let [w0, w1, w2, t0, t1] = sums;
    *w0 = each(|lane| w0[lane] + weights[lane]);
    *t0 = each(|lane| t0[lane] + targets[lane]);
    let weights_at = each(|lane| weights[lane] * at[lane]);
    *w1 = each(|lane| w1[lane] + weights_at[lane]);
    *w2 = each(|lane| w2[lane] + weights_at[lane] * at[lane]);
    *t1 = each(|lane| t1[lane] + targets[lane] * at[lane]);
}
