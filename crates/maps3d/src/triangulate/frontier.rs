//! Which squares of the image hold frontier.

use sensing::Camera;

use crate::Maps3dError;
use crate::image::FilledImage;

/// When a face between neighbouring pixels hides something, instead of being a surface.
///
/// Between depths a < b there is a gap where `b - a` exceeds both `gap_m` and `gap_share * a`: a
/// surface seen at a grazing angle changes its depth in proportion to the depth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Occlusion {
    /// The least difference of depth that is a gap, metres.
    pub gap_m: f64,
    /// The least difference that is a gap, as a share of the nearer depth.
    pub gap_share: f64,
}

impl Default for Occlusion {
    fn default() -> Self {
        Self { gap_m: 0.1, gap_share: 0.05 }
    }
}

impl Occlusion {
    /// # Errors
    /// [`Maps3dError::Option`] for a limit that is negative or not a number.
    pub fn check(&self) -> Result<(), Maps3dError> {
        let expected = "a number from 0 up";
        for (option, found) in [("gap_m", self.gap_m), ("gap_share", self.gap_share)] {
            if found.is_nan() || found < 0.0 {
                return Err(Maps3dError::Option { option, found, expected });
            }
        }
        Ok(())
    }

    /// The same, but with no gap on a flat surface that is seen under at least `grazing_rad`: between pixels of a
    /// coarse image its depth changes by a larger share.
    pub fn for_grazing(&self, camera: &Camera, grazing_rad: f64) -> Self {
        let seen = 1.0 / (camera.fx.abs().min(camera.fy.abs()) * grazing_rad.tan());
        let gap_share = if seen.is_finite() { self.gap_share.max(seen) } else { self.gap_share };
        Self { gap_share, ..*self }
    }

    /// Whether there is a gap between two depths, metres.
    #[inline]
    pub fn is_gap(&self, a_m: f32, b_m: f32) -> bool {
        let (a, b) = (f64::from(a_m.min(b_m)), f64::from(a_m.max(b_m)));
        b - a > self.gap_m.max(self.gap_share * a)
    }
}

/// For each square of four pixels, which of its two grid faces are frontier.
///
/// A grid face is frontier when one of its pixels is missing (\[Mos15\] 5.7.1), or when an edge of it
/// crosses a gap. Two bits per square, and for each row how many squares before each column hold
/// frontier, in steps of 64: whether a stretch of squares holds any is a matter of a few words.
#[derive(Clone, Debug, PartialEq)]
pub struct FrontierSquares {
    columns: usize,
    rows: usize,
    words: usize,
    /// Lower left faces, one bit each, row by row.
    lower: Vec<u64>,
    /// Upper right faces.
    upper: Vec<u64>,
}

impl FrontierSquares {
    /// Looks at every grid face; without `occlusion`, missing data alone is frontier. O(pixels).
    pub fn of(image: &FilledImage, occlusion: Option<&Occlusion>) -> Self {
        let (columns, rows) = (image.columns() - 1, image.rows() - 1);
        let words = columns.div_ceil(64);
        let mut squares = Self {
            columns,
            rows,
            words,
            lower: vec![0; words * rows],
            upper: vec![0; words * rows],
        };
        let depths = image.depths_m();
        let is_frontier = |corners: [usize; 3]| {
            corners.iter().any(|&at| image.is_missing(at))
                || occlusion.is_some_and(|occlusion| {
                    let [a, b, c] = corners.map(|at| depths[at]);
                    occlusion.is_gap(a, b) || occlusion.is_gap(b, c) || occlusion.is_gap(c, a)
                })
        };
        for row in 0..rows {
            for column in 0..columns {
                let here = row * image.columns() + column;
                let below = here + image.columns();
                let (word, bit) = (row * words + column / 64, column % 64);
                squares.lower[word] |= u64::from(is_frontier([here, below + 1, below])) << bit;
                squares.upper[word] |= u64::from(is_frontier([here, here + 1, below + 1])) << bit;
            }
        }
        squares
    }

    /// Number of columns of squares.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Number of rows of squares.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Whether the lower left and the upper right face of a square are frontier.
    #[inline]
    pub fn faces(&self, column: usize, row: usize) -> [bool; 2] {
        let (word, bit) = (row * self.words + column / 64, column % 64);
        [self.lower[word] >> bit & 1 == 1, self.upper[word] >> bit & 1 == 1]
    }

    /// The columns, in a stretch of a row, of the squares that hold frontier.
    pub(super) fn within(
        &self,
        row: usize,
        first: usize,
        last: usize,
    ) -> impl Iterator<Item = usize> + '_ {
        let words = if first > last { 0..0 } else { first / 64..last / 64 + 1 };
        words.flat_map(move |word| {
            let at = row * self.words + word;
            let mut bits = self.lower[at] | self.upper[at];
            if word == first / 64 {
                bits &= u64::MAX << (first % 64);
            }
            if word == last / 64 {
                bits &= u64::MAX >> (63 - last % 64);
            }
            std::iter::from_fn(move || {
                let bit = bits.trailing_zeros() as usize;
                bits &= bits.wrapping_sub(1);
                (bit < 64).then_some(word * 64 + bit)
            })
        })
    }
}
