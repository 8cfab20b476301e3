//! A grey image in memory.

use crate::FormatError;
use crate::error::{MAX_CELLS, Position, check_size};

/// A grey image: row 0 is the top row, as in the files.
///
/// Levels run from 0 (black) to [`white`](Self::white); a pixel may be transparent, that is without
/// a meaning. Holds at all times: `columns * rows` levels, none above `white`, 1 to [`MAX_CELLS`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GrayImage {
    columns: usize,
    rows: usize,
    white: u16,
    levels: Vec<u16>,
    /// Empty when no pixel is transparent.
    transparent: Vec<bool>,
}

impl GrayImage {
    /// An opaque image from row-major levels, top row first.
    ///
    /// # Errors
    /// [`FormatError::Image`] when the count of levels is not `columns * rows`, when the image is
    /// empty or too large, when `white` is 0 or when a level is above it.
    pub fn new(
        columns: usize,
        rows: usize,
        white: u16,
        levels: Vec<u16>,
    ) -> Result<Self, FormatError> {
        if check_size(Position::Byte(0), columns as u64, rows as u64).is_err() {
            let found = (columns as u64).saturating_mul(rows as u64);
            return Err(FormatError::Image { part: "size", found, expected: MAX_CELLS });
        }
        if levels.len() != columns * rows {
            return Err(FormatError::Image {
                part: "levels",
                found: levels.len() as u64,
                expected: (columns * rows) as u64,
            });
        }
        if white == 0 {
            return Err(FormatError::Image { part: "white", found: 0, expected: 255 });
        }
        if let Some(&level) = levels.iter().find(|&&level| level > white) {
            let (found, expected) = (u64::from(level), u64::from(white));
            return Err(FormatError::Image { part: "level", found, expected });
        }
        Ok(Self { columns, rows, white, levels, transparent: Vec::new() })
    }

    /// The same image with some pixels transparent; one flag per pixel.
    ///
    /// # Errors
    /// [`FormatError::Image`] when the count of flags is not the count of pixels.
    pub fn with_transparent(mut self, transparent: Vec<bool>) -> Result<Self, FormatError> {
        if transparent.len() != self.levels.len() {
            return Err(FormatError::Image {
                part: "transparent",
                found: transparent.len() as u64,
                expected: self.levels.len() as u64,
            });
        }
        self.transparent = if transparent.contains(&true) { transparent } else { Vec::new() };
        Ok(self)
    }

    /// Number of columns.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// The level of white, at least 1: 255 for images of 8 bits.
    pub fn white(&self) -> u16 {
        self.white
    }

    /// Levels, row-major from the top row.
    pub fn levels(&self) -> &[u16] {
        &self.levels
    }

    /// One flag per pixel, or an empty slice when every pixel is opaque.
    pub fn transparent(&self) -> &[bool] {
        &self.transparent
    }

    /// Levels scaled to 0 (black) .. 255 (white), rounded to the nearest; exact for 8-bit images.
    pub fn levels_u8(&self) -> Vec<u8> {
        let white = u32::from(self.white);
        self.levels
            .iter()
            .map(|&level| ((u32::from(level) * 255 + white / 2) / white) as u8)
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_must_fit() {
        assert!(GrayImage::new(2, 2, 255, vec![0; 3]).is_err());
        assert!(GrayImage::new(0, 2, 255, vec![]).is_err());
        assert!(GrayImage::new(usize::MAX, 2, 255, vec![]).is_err());
        assert!(GrayImage::new(1, 1, 0, vec![0]).is_err());
        assert!(GrayImage::new(1, 1, 10, vec![11]).is_err());
        let image = GrayImage::new(2, 1, 255, vec![0, 255]).expect("fits");
        assert!(image.clone().with_transparent(vec![true]).is_err());
        assert!(image.with_transparent(vec![false; 2]).expect("fits").transparent().is_empty());
    }

    #[test]
    fn sixteen_bits_scale_to_eight() {
        let image = GrayImage::new(3, 1, 65535, vec![0, 65535, 205 * 257]).expect("fits");
        assert_eq!(image.levels_u8(), [0, 255, 205]);
        let bitmap = GrayImage::new(2, 1, 1, vec![0, 1]).expect("fits");
        assert_eq!(bitmap.levels_u8(), [0, 255]);
    }
}
