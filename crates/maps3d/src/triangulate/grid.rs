//! The triangulation of all pixels.

use crate::image::FilledImage;

use super::ImageMesh;

/// Every pixel as a vertex, every square of four pixels as two faces (\[Mos15\] 3.4.2).
///
/// The diagonal runs from the upper left pixel to the lower right. O(pixels).
pub fn grid(image: &FilledImage) -> ImageMesh {
    ImageMesh {
        pixels: (0..image.pixels()).map(|index| image.pixel(index)).collect(),
        depths_m: image.depths_m().iter().map(|&depth_m| f64::from(depth_m)).collect(),
        triangles: grid_faces(image.columns(), image.rows()).collect(),
    }
}

/// The faces of [`grid`], in rows of squares: the lower left half of a square, then the upper right.
///
/// Vertices count row by row.
pub fn grid_faces(columns: usize, rows: usize) -> impl Iterator<Item = [u32; 3]> {
    let squares = (0..rows.saturating_sub(1))
        .flat_map(move |row| (0..columns.saturating_sub(1)).map(move |column| (row, column)));
    squares.flat_map(move |(row, column)| {
        let [here, below] = [row, row + 1].map(|row| (row * columns + column) as u32);
        // \[Mos15\] 3.4.3 connects a point with its neighbours down, right-down and right.
        [[here, below + 1, below], [here, here + 1, below + 1]]
    })
}

#[cfg(test)]
mod tests {
    use super::super::check_planar;
    use super::*;
    use crate::image::{PrepareOptions, prepare};
    use sensing::{Camera, DepthImage};

    #[test]
    fn counts_are_those_of_the_thesis() {
        // \[Mos15\] 6.2: 307,200 points; printed as 6,112,162 polygons, which has a digit too many.
        assert_eq!(grid_faces(640, 480).count(), 612_162);
        // \[Mos15\] fig. 6.1 and 6.3 count 410,400 and 246,400, with its off-by-one in cropping.
        assert_eq!(grid_faces(541, 381).count(), 410_400);
        assert_eq!(grid_faces(441, 281).count(), 246_400);
    }

    #[test]
    fn the_grid_is_planar() {
        for (columns, rows) in [(2, 2), (3, 2), (2, 5), (7, 6)] {
            let camera = Camera::new(10.0, 10.0, 1.0, 1.0);
            let image = DepthImage::new(columns, camera, vec![1.0; columns * rows]);
            let image = prepare(&image, &PrepareOptions::default()).expect("large enough");
            assert_eq!(check_planar(&grid(&image), columns, rows), Ok(()));
        }
    }
}
