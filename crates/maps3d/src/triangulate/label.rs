//! Obstacle or frontier, for the faces of any triangulation of the image.

use solid::Label;

use crate::image::Pixel;

use super::{FrontierSquares, ImageMesh, orient};

/// The label of each face: frontier where more than `share` of the grid faces that it overlaps are.
///
/// With a share of 0, the default everywhere, a face is frontier as soon as its inside overlaps one
/// frontier face of the full grid. So a face with a missing-data vertex is frontier, and stays so
/// when that vertex is removed (\[Mos15\] 5.7.1 looks at vertices, and forgets those that are
/// gone). It does not matter by which way a reduction came to its faces. Overlap is exact, in whole
/// numbers. O(rows that each face spans), and for a share above 0 O(pixels).
pub fn label(mesh: &ImageMesh, squares: &FrontierSquares, share: f64) -> Vec<Label> {
    let is_frontier = |&triangle: &[u32; 3]| {
        let corners = mesh.corner_pixels(triangle);
        if share > 0.0 {
            let [frontier, all] = count(corners, squares);
            f64::from(frontier) > share * f64::from(all)
        } else {
            overlaps_any(corners, squares)
        }
    };
    let label = |frontier| if frontier { Label::Frontier } else { Label::Obstacle };
    mesh.triangles.iter().map(|triangle| label(is_frontier(triangle))).collect()
}

fn overlaps_any(corners: [Pixel; 3], squares: &FrontierSquares) -> bool {
    strips(corners).any(|(row, first, last)| {
        squares.within(row, first, last).any(|column| {
            let frontier = squares.faces(column, row);
            let faces = halves(column, row);
            (0..2).any(|half| frontier[half] && overlap(corners, faces[half]))
        })
    })
}

/// How many frontier faces of the grid, and how many in all, a face overlaps.
fn count(corners: [Pixel; 3], squares: &FrontierSquares) -> [u32; 2] {
    let mut counts = [0; 2];
    for (row, first, last) in strips(corners) {
        for column in first..=last {
            let frontier = squares.faces(column, row);
            let faces = halves(column, row);
            for half in 0..2 {
                if overlap(corners, faces[half]) {
                    counts[0] += u32::from(frontier[half]);
                    counts[1] += 1;
                }
            }
        }
    }
    counts
}

/// The lower left and the upper right face of a square.
fn halves(column: usize, row: usize) -> [[Pixel; 3]; 2] {
    let (c, r) = (column as u16, row as u16);
    [[[c, r], [c + 1, r + 1], [c, r + 1]], [[c, r], [c + 1, r], [c + 1, r + 1]]]
}

/// Whether two triangles of positive turn share inner points: no side of one has the other beyond.
fn overlap(a: [Pixel; 3], b: [Pixel; 3]) -> bool {
    let separates = |a: [Pixel; 3], b: [Pixel; 3]| {
        (0..3).any(|side| b.iter().all(|&p| orient(a[side], a[(side + 1) % 3], p) <= 0))
    };
    !separates(a, b) && !separates(b, a)
}

/// Rows of squares that a triangle reaches, with the first and last column that it may overlap.
fn strips(corners: [Pixel; 3]) -> impl Iterator<Item = (usize, usize, usize)> {
    let [a, b, c] = corners.map(|p| p.map(i64::from));
    let top = a[1].min(b[1]).min(c[1]);
    let bottom = a[1].max(b[1]).max(c[1]);
    // Corners lie on whole rows, so between two rows the triangle is as wide as on either.
    let reach = move |row: i64| {
        let (mut first, mut last) = (i64::MAX, i64::MIN);
        for ([px, py], [qx, qy]) in [(a, b), (b, c), (c, a)] {
            let (dx, dy) = (qx - px, qy - py);
            if dy == 0 {
                if row == py {
                    (first, last) = (first.min(px.min(qx)), last.max(px.max(qx)));
                }
            } else if (row - py) * (row - qy) <= 0 {
                let (ahead, dy) = (dx * (row - py) * dy.signum(), dy.abs());
                first = first.min(px + ahead.div_euclid(dy));
                last = last.max(px - (-ahead).div_euclid(dy));
            }
        }
        (first, last)
    };
    (top..bottom).map(move |row| {
        let (here, below) = (reach(row), reach(row + 1));
        let (first, last) = (here.0.min(below.0), here.1.max(below.1));
        (row as usize, first as usize, (last - 1).max(first) as usize)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image::{PrepareOptions, prepare};
    use crate::triangulate::{Occlusion, grid};
    use sensing::{Camera, DepthImage};

    fn squares(depths_m: Vec<f32>, columns: usize, gap: bool) -> (FrontierSquares, ImageMesh) {
        let camera = Camera::new(10.0, 10.0, 1.0, 1.0);
        let image = DepthImage::new(columns, camera, depths_m);
        let image = prepare(&image, &PrepareOptions::default()).expect("valid");
        let occlusion = gap.then(Occlusion::default);
        (FrontierSquares::of(&image, occlusion.as_ref()), grid(&image))
    }

    #[test]
    fn six_faces_around_a_missing_pixel_are_frontier() {
        let mut depths = vec![1.0; 25];
        depths[12] = f32::NAN;
        let (squares, mesh) = squares(depths, 5, false);
        let labels = label(&mesh, &squares, 0.0);
        let touches = |t: &[u32; 3]| t.contains(&12);
        for (triangle, label) in mesh.triangles.iter().zip(&labels) {
            assert_eq!(*label == Label::Frontier, touches(triangle));
        }
        assert_eq!(labels.iter().filter(|l| **l == Label::Frontier).count(), 6);
        // Two faces over everything keep it, whether or not the pixel is a vertex of theirs.
        let coarse = ImageMesh {
            pixels: vec![[0, 0], [4, 0], [4, 4], [0, 4]],
            depths_m: vec![1.0; 4],
            triangles: vec![[0, 1, 2], [0, 2, 3]],
        };
        assert_eq!(label(&coarse, &squares, 0.0), [Label::Frontier; 2]);
        assert_eq!(label(&coarse, &squares, 0.5), [Label::Obstacle; 2]);
    }

    #[test]
    fn a_depth_gap_is_frontier_where_that_is_asked() {
        let depths: Vec<f32> = (0..25).map(|i| if i % 5 < 2 { 1.0 } else { 2.0 }).collect();
        let (with, mesh) = squares(depths.clone(), 5, true);
        let frontier = |squares: &FrontierSquares| {
            label(&mesh, squares, 0.0).iter().filter(|l| **l == Label::Frontier).count()
        };
        assert_eq!(frontier(&with), 8);
        let (without, _) = self::squares(depths, 5, false);
        assert_eq!(frontier(&without), 0);
    }

    #[test]
    fn labels_agree_with_a_look_at_every_pair() {
        let mut seed = 7_u32;
        let mut next = move |n: u32| {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (seed >> 16) % n
        };
        for _ in 0..200 {
            let columns = 70 + next(70) as usize;
            let depths =
                (0..columns * 9).map(|_| if next(150) == 0 { f32::NAN } else { 1.0 }).collect();
            let (squares, grid) = squares(depths, columns, false);
            let frontier = label(&grid, &squares, 0.0);
            let corner = |n: u32, m: u32| [n as u16, m as u16];
            let corners = loop {
                let mut pick = || corner(next(columns as u32), next(9));
                let corners = [pick(), pick(), pick()];
                if orient(corners[0], corners[1], corners[2]) > 0 {
                    break corners;
                }
            };
            let one = ImageMesh {
                pixels: corners.to_vec(),
                depths_m: vec![1.0; 3],
                triangles: vec![[0, 1, 2]],
            };
            let expected = grid.triangles.iter().zip(&frontier).any(|(&t, &label)| {
                label == Label::Frontier && overlap(corners, grid.corner_pixels(t))
            });
            assert_eq!(label(&one, &squares, 0.0)[0] == Label::Frontier, expected);
        }
    }
}
