//! Depth images: levels of grey images as metres, and headerless floats.

use crate::error::{Position, check_size};
use crate::{FormatError, GrayImage};

/// Depths as a file holds them: row-major, the top row first; NaN where there is no reading.
#[derive(Clone, Debug)]
pub struct DepthPixels {
    /// Number of columns.
    pub columns: usize,
    /// Number of rows.
    pub rows: usize,
    /// One depth per pixel, metres.
    pub depths_m: Vec<f32>,
}

/// The depths of a grey image that counts `units_per_metre`.
///
/// Level 0 is no reading, and so is the highest level of 16 bits, at which counters stop (7-Scenes
/// marks invalid pixels with it). Transparent pixels are no readings either.
///
/// # Errors
/// [`FormatError::Scale`] unless the scale is a positive, finite number.
pub fn from_levels(image: &GrayImage, units_per_metre: f64) -> Result<DepthPixels, FormatError> {
    check_scale(units_per_metre)?;
    let transparent = image.transparent();
    let depths_m = image
        .levels()
        .iter()
        .enumerate()
        .map(|(at, &level)| {
            let clear = transparent.get(at).is_some_and(|&clear| clear);
            if clear { f32::NAN } else { of_level(level, units_per_metre) }
        })
        .collect();
    Ok(DepthPixels { columns: image.columns(), rows: image.rows(), depths_m })
}

/// A grey image of 16 bits that counts `units_per_metre`: the way back of [`from_levels`].
///
/// No reading is level 0, and so is a depth that 16 bits cannot count.
///
/// # Errors
/// [`FormatError::Scale`] unless the scale is a positive, finite number; what [`GrayImage::new`]
/// refuses.
pub fn to_levels(depth: &DepthPixels, units_per_metre: f64) -> Result<GrayImage, FormatError> {
    check_scale(units_per_metre)?;
    let level = |&depth_m: &f32| {
        let units = (f64::from(depth_m) * units_per_metre).round();
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "in range")]
        if units > 0.0 && units < f64::from(u16::MAX) { units as u16 } else { 0 }
    };
    let levels = depth.depths_m.iter().map(level).collect();
    GrayImage::new(depth.columns, depth.rows, u16::MAX, levels)
}

/// Reads little-endian 32-bit floats without a header, row by row; metres times `units_per_metre`.
///
/// # Errors
/// [`FormatError::Unexpected`] unless the bytes are exactly `columns * rows` floats;
/// [`FormatError::TooLarge`]; [`FormatError::Scale`].
pub fn read_raw(
    bytes: &[u8],
    columns: usize,
    rows: usize,
    units_per_metre: f64,
) -> Result<DepthPixels, FormatError> {
    check_scale(units_per_metre)?;
    let (columns, rows) = check_size(Position::Byte(0), columns as u64, rows as u64)?;
    if bytes.len() != 4 * columns * rows {
        let found = format!("{} bytes", bytes.len());
        let expected = format!("{} bytes: {columns} x {rows} floats", 4 * columns * rows);
        return Err(FormatError::unexpected(Position::Byte(bytes.len()), found, expected));
    }
    let (floats, _) = bytes.as_chunks::<4>();
    let depths_m = floats
        .iter()
        .map(|&four| metres(f64::from(f32::from_le_bytes(four)), units_per_metre))
        .collect();
    Ok(DepthPixels { columns, rows, depths_m })
}

pub(crate) fn check_scale(units_per_metre: f64) -> Result<(), FormatError> {
    if units_per_metre.is_finite() && units_per_metre > 0.0 {
        return Ok(());
    }
    Err(FormatError::Scale { found: units_per_metre.to_string() })
}

/// The depth of one level, metres; NaN for the levels that are no reading.
pub(crate) fn of_level(level: u16, units_per_metre: f64) -> f32 {
    if level == 0 || level == u16::MAX {
        f32::NAN
    } else {
        metres(f64::from(level), units_per_metre)
    }
}

#[expect(clippy::cast_possible_truncation, reason = "depths are kept as sensors give them")]
pub(crate) fn metres(value: f64, units_per_metre: f64) -> f32 {
    (value / units_per_metre) as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_become_metres() {
        let image = GrayImage::new(2, 2, 65535, vec![0, 1500, 65535, 1]).expect("fits");
        let depth = from_levels(&image, 1000.0).expect("a scale");
        assert_eq!((depth.columns, depth.rows), (2, 2));
        assert!(depth.depths_m[0].is_nan() && depth.depths_m[2].is_nan());
        assert_eq!((depth.depths_m[1], depth.depths_m[3]), (1.5, 0.001));
        for scale in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(from_levels(&image, scale).is_err(), "{scale}");
        }
    }

    #[test]
    fn metres_become_levels_and_come_back() {
        let depths_m = vec![f32::NAN, 1.5004, 0.001, 70.0, -1.0, 65.534];
        let depth = DepthPixels { columns: 3, rows: 2, depths_m };
        let image = to_levels(&depth, 1000.0).expect("fits");
        assert_eq!(image.levels(), [0, 1500, 1, 0, 0, 65534]);
        let back = from_levels(&image, 1000.0).expect("a scale");
        assert_eq!(to_levels(&back, 1000.0).expect("fits").levels(), image.levels());
        assert!(to_levels(&depth, 0.0).is_err());
    }

    #[test]
    fn raw_floats_must_fill_the_image() {
        let bytes: Vec<u8> =
            [1.0_f32, f32::NAN, 3.0, 4.5].iter().flat_map(|x| x.to_le_bytes()).collect();
        let depth = read_raw(&bytes, 2, 2, 1.0).expect("four floats");
        assert_eq!(depth.depths_m[3], 4.5);
        assert!(depth.depths_m[1].is_nan());
        let error = read_raw(&bytes[..15], 2, 2, 1.0).expect_err("short");
        assert_eq!(error.to_string(), "byte 15: found 15 bytes, expected 16 bytes: 2 x 2 floats");
        assert!(read_raw(&[], 0, 4, 1.0).is_err());
        assert!(read_raw(&[], usize::MAX, 4, 1.0).is_err());
    }
}
