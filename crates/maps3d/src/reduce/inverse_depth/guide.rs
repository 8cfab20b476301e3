//! The image that vertices are chosen by: single outliers are gone, depth steps are where they were.

use crate::image::FilledImage;

/// The median of each pixel and its eight neighbours; at the border the pixels that there are,
/// repeated. O(pixels), without branches inside a row.
pub(super) fn median_of_nine(image: &FilledImage) -> Vec<f32> {
    let (columns, rows, depths) = (image.columns(), image.rows(), image.depths_m());
    let mut out = vec![0.0; depths.len()];
    for row in 0..rows {
        let line = |row: usize| &depths[row * columns..(row + 1) * columns];
        let (above, here) = (line(row.saturating_sub(1)), line(row));
        let below = line((row + 1).min(rows - 1));
        let target = &mut out[row * columns..(row + 1) * columns];
        let at = |column: usize| {
            let (left, right) = (column.saturating_sub(1), (column + 1).min(columns - 1));
            median([
                above[left],
                above[column],
                above[right],
                here[left],
                here[column],
                here[right],
                below[left],
                below[column],
                below[right],
            ])
        };
        let mut column = 0;
        while column < columns {
            if column > 0 && column + LANES < columns {
                let lanes = |line: &[f32], from: usize| -> [f32; LANES] {
                    std::array::from_fn(|lane| line[from..from + LANES][lane])
                };
                let middle =
                    median_of_lanes([above, here, below].map(|line| {
                        [column - 1, column, column + 1].map(|from| lanes(line, from))
                    }));
                target[column..column + LANES].copy_from_slice(&middle);
                column += LANES;
            } else {
                target[column] = at(column);
                column += 1;
            }
        }
    }
    out
}

/// Columns that are worked on together.
const LANES: usize = 8;

/// Exchanges that leave the median of nine in the middle.
const EXCHANGES: [(usize, usize); 19] = [
    (1, 2),
    (4, 5),
    (7, 8),
    (0, 1),
    (3, 4),
    (6, 7),
    (1, 2),
    (4, 5),
    (7, 8),
    (0, 3),
    (5, 8),
    (4, 7),
    (3, 6),
    (1, 4),
    (2, 5),
    (4, 7),
    (4, 2),
    (6, 4),
    (4, 2),
];

fn median(v: [f32; 9]) -> f32 {
    let mut v = v.map(|x| [x]);
    exchange(&mut v);
    v[4][0]
}

#[inline]
fn median_of_lanes([a, b, c]: [[[f32; LANES]; 3]; 3]) -> [f32; LANES] {
    let mut v = [a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2]];
    exchange(&mut v);
    v[4]
}

#[inline(always)]
fn exchange<const N: usize>(v: &mut [[f32; N]; 9]) {
    for (low, high) in EXCHANGES {
        let (a, b) = (v[low], v[high]);
        for lane in 0..N {
            v[low][lane] = if a[lane] < b[lane] { a[lane] } else { b[lane] };
            v[high][lane] = if a[lane] < b[lane] { b[lane] } else { a[lane] };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image::{PrepareOptions, prepare};
    use sensing::{Camera, DepthImage};

    #[test]
    fn it_is_the_median_of_the_neighbourhood() {
        let mut seed = 3_u32;
        for (columns, rows) in [(2, 2), (3, 5), (17, 9), (2, 7)] {
            let depths = (0..columns * rows)
                .map(|_| {
                    seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                    1.0 + (seed >> 20) as f32
                })
                .collect();
            let image = DepthImage::new(columns, Camera::new(1.0, 1.0, 0.0, 0.0), depths);
            let image = prepare(&image, &PrepareOptions::default()).expect("valid");
            let found = median_of_nine(&image);
            for row in 0..rows {
                for column in 0..columns {
                    let mut around = Vec::new();
                    for dr in -1..=1_isize {
                        for dc in -1..=1_isize {
                            let r = row.saturating_add_signed(dr).min(rows - 1);
                            let c = column.saturating_add_signed(dc).min(columns - 1);
                            around.push(image.depths_m()[r * columns + c]);
                        }
                    }
                    around.sort_by(f32::total_cmp);
                    assert_eq!(found[row * columns + column], around[4]);
                }
            }
        }
    }
}
