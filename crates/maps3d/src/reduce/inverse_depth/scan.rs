//! How far the pixels of a face lie from its lifted plane.

use super::plane::LiftedPlane;
use crate::image::{FilledImage, Pixel};
use crate::triangulate::{Span, rows_of};

/// Number of pixels that are looked at together.
pub(super) const LANES: usize = 8;

/// Something of eight pixels.
pub(super) type Lanes = [f32; LANES];

/// The place of each lane.
pub(super) const RAMP: Lanes = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];

/// One for each lane that counts, where only so many do.
pub(super) const HEADS: [Lanes; LANES + 1] = {
    let mut heads = [[0.0; LANES]; LANES + 1];
    let mut count = 0;
    while count <= LANES {
        let mut lane = 0;
        while lane < count {
            heads[count][lane] = 1.0;
            lane += 1;
        }
        count += 1;
    }
    heads
};

/// The same done to each lane; a plain loop, which compilers turn into few instructions.
#[inline(always)]
pub(super) fn each(mut of_lane: impl FnMut(usize) -> f32) -> Lanes {
    let mut lanes = [0.0; LANES];
    for (lane, out) in lanes.iter_mut().enumerate() {
        *out = of_lane(lane);
    }
    lanes
}

/// Depths of an image for scans: negative where missing, if that matters; padded, so that lanes may
/// read past the end.
#[derive(Clone, Debug)]
pub(super) struct Sheet {
    columns: usize,
    depths_m: Vec<f32>,
}

impl Sheet {
    /// `depths_m` belong to the image, or are made of it; `signed` marks missing pixels. O(pixels).
    pub fn new(image: &FilledImage, mut depths_m: Vec<f32>, signed: bool) -> Self {
        if signed {
            image.for_each_missing(|at| depths_m[at] = -depths_m[at]);
        }
        depths_m.resize(depths_m.len() + LANES, 0.0);
        Self { columns: image.columns(), depths_m }
    }

    /// The depth of a pixel, metres.
    pub fn depth_m(&self, [column, row]: Pixel) -> f64 {
        f64::from(self.depths_m[usize::from(row) * self.columns + usize::from(column)].abs())
    }

    /// The depths of a span, eight at a time, and how many of the last eight count.
    pub fn lanes(&self, span: &Span) -> (&[Lanes], &Lanes, usize) {
        let count = span.last - span.first + 1;
        let start = span.row * self.columns + span.first;
        let (chunks, _) = self.depths_m[start..].as_chunks::<LANES>();
        let whole = count / LANES;
        // After the whole ones there is room for one more: the padding sees to that.
        (&chunks[..whole], &chunks[whole], count % LANES)
    }
}

/// How distances count.
#[derive(Clone, Copy, Debug)]
pub(super) struct Count {
    /// None counts for more, metres.
    pub cap_m: f32,
    /// How much those of missing pixels count.
    pub missing: f32,
    /// Of how many rows one is looked at: 1, 2 or 4.
    pub stride: usize,
}

/// What a scan over a face found.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Scanned {
    /// The largest distance, metres.
    pub worst_m: f32,
    /// The sum of the distances, none counted above the cap, metres.
    pub sum_m: f32,
    /// Of how many rows one was looked at.
    pub stride: usize,
}

/// The line of a plane along a row of pixels.
#[derive(Clone, Copy)]
struct Line {
    step: f32,
    offset_m: f32,
    missing: f32,
}

impl Line {
    fn new(plane: &LiftedPlane, missing: f32) -> Self {
        #[expect(clippy::cast_possible_truncation, reason = "depths are measured to fewer digits")]
        Self { step: plane.per_column as f32, offset_m: plane.offset_m as f32, missing }
    }

    /// Distances of eight pixels, weighted.
    #[inline(always)]
    fn errors(&self, depths_m: &Lanes, along: f32) -> Lanes {
        let weights = each(|lane| if depths_m[lane] < 0.0 { self.missing } else { 1.0 });
        let along = each(|lane| along + RAMP[lane] * self.step);
        each(|lane| (depths_m[lane].abs() * along[lane] - self.offset_m).abs() * weights[lane])
    }
}

/// The largest of each lane and their sum, none above the cap.
#[inline(always)]
fn gather(worst: &mut Lanes, sums: &mut Lanes, errors: &Lanes, cap_m: f32) {
    *worst = each(|lane| if errors[lane] > worst[lane] { errors[lane] } else { worst[lane] });
    let capped = each(|lane| if errors[lane] < cap_m { errors[lane] } else { cap_m });
    *sums = each(|lane| sums[lane] + capped[lane]);
}

fn rows_at(corners: [Pixel; 3], stride: usize) -> impl Iterator<Item = Span> {
    rows_of(corners).filter(move |span| span.row & (stride - 1) == 0)
}

/// Looks at the pixels of a face. O(pixels); 8 at a time.
pub(super) fn scan(
    sheet: &Sheet,
    corners: [Pixel; 3],
    plane: &LiftedPlane,
    count: &Count,
) -> Scanned {
    let line = Line::new(plane, count.missing);
    let (mut worst, mut sums): (Lanes, Lanes) = ([0.0; LANES], [0.0; LANES]);
    for span in rows_at(corners, count.stride) {
        let (chunks, last, rest) = sheet.lanes(&span);
        let mut along = plane.at_start(&span);
        for chunk in chunks {
            gather(&mut worst, &mut sums, &line.errors(chunk, along), count.cap_m);
            along += LANES as f32 * line.step;
        }
        if rest > 0 {
            let errors = line.errors(last, along);
            let errors = each(|lane| errors[lane] * HEADS[rest][lane]);
            gather(&mut worst, &mut sums, &errors, count.cap_m);
        }
    }
    let worst_m = worst.iter().copied().fold(0.0, f32::max);
    let sum_m = sums.iter().sum::<f32>() * count.stride as f32;
    Scanned { worst_m, sum_m, stride: count.stride }
}

/// The first pixel of a face whose distance is the largest that a scan has found.
pub(super) fn worst_pixel(
    sheet: &Sheet,
    corners: [Pixel; 3],
    plane: &LiftedPlane,
    missing: f32,
    found: &Scanned,
) -> Option<Pixel> {
    let line = Line::new(plane, missing);
    for span in rows_at(corners, found.stride) {
        let (chunks, last, rest) = sheet.lanes(&span);
        let mut along = plane.at_start(&span);
        let tail = (rest > 0).then_some((last, rest));
        let whole = chunks.iter().map(|chunk| (chunk, LANES));
        for (at, (chunk, count)) in whole.chain(tail).enumerate() {
            let errors = line.errors(chunk, along);
            let largest = errors.iter().fold(0.0, |a: f32, &b| if b > a { b } else { a });
            if largest >= found.worst_m
                && let Some(lane) = (0..count).find(|&lane| errors[lane] >= found.worst_m)
            {
                return Some([(span.first + at * LANES + lane) as u16, span.row as u16]);
            }
            along += LANES as f32 * line.step;
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image::{PrepareOptions, prepare};
    use crate::triangulate::orient;
    use sensing::{Camera, DepthImage};

    /// Lanes, tails and the place of the worst, against one pixel after the other.
    #[test]
    fn a_scan_finds_what_a_look_at_every_pixel_finds() {
        let (columns, rows) = (41, 19);
        let mut seed = 5_u32;
        let mut next = move |n: u32| {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (seed >> 8) % n
        };
        let depths = (0..columns * rows).map(|_| next(4000) as f32 * 1e-3).collect();
        let camera = Camera::new(40.0, 38.0, 19.0, 9.0);
        let image = DepthImage::new(columns, camera, depths);
        let image = prepare(&image, &PrepareOptions::default()).expect("valid");
        let sheet = Sheet::new(&image, image.depths_m().to_vec(), true);
        let mut seen = 0;
        while seen < 300 {
            let corners: [Pixel; 3] =
                std::array::from_fn(|_| [next(columns as u32) as u16, next(rows as u32) as u16]);
            if orient(corners[0], corners[1], corners[2]) <= 0 {
                continue;
            }
            seen += 1;
            let inverse = corners.map(|corner| 1.0 / sheet.depth_m(corner));
            let plane = LiftedPlane::through(&camera, corners, inverse);
            let count = Count { cap_m: 0.7, missing: 0.25, stride: 1 << (seen % 3) };
            let found = scan(&sheet, corners, &plane, &count);
            let (mut worst, mut sum) = (0.0_f64, 0.0);
            let distance_m = |[column, row]: Pixel| {
                let at = image.index([column, row]);
                let depth_m = f64::from(image.depths_m()[at]);
                let weight = if image.is_missing(at) { 0.25 } else { 1.0 };
                weight * plane.distance_m([column, row].map(f64::from), depth_m)
            };
            for span in rows_of(corners).filter(|span| span.row.is_multiple_of(count.stride)) {
                for column in span.first..=span.last {
                    let distance_m = distance_m([column as u16, span.row as u16]);
                    worst = worst.max(distance_m);
                    sum += distance_m.min(0.7) * count.stride as f64;
                }
            }
            assert!((f64::from(found.worst_m) - worst).abs() < 1e-5, "{found:?} {worst}");
            assert!((f64::from(found.sum_m) - sum).abs() < 1e-4 * (1.0 + sum), "{found:?} {sum}");
            if worst > 0.0 {
                let pixel = worst_pixel(&sheet, corners, &plane, 0.25, &found);
                let pixel = pixel.expect("the scan has seen it");
                assert!((distance_m(pixel) - worst).abs() < 1e-5);
            }
        }
    }
}
