//! TIFF images as depths: one sample per pixel, whole numbers or floats.

use std::io::Cursor;

use ::tiff::ColorType;
use ::tiff::decoder::{Decoder, DecodingResult, Limits};

use crate::FormatError;
use crate::depth::{DepthPixels, check_scale, metres};
use crate::error::{Position, check_size};

/// The most bytes of decoded pixels, so that a small file cannot ask for all memory.
const MAX_DECODED_BYTES: usize = 1 << 30;

/// Reads the first image of a TIFF file: grey, 8 to 64 bits, plain, LZW or deflate.
///
/// Whole numbers: 0 is no reading, and so is the highest of 16 bits. Floats are taken as they are.
///
/// # Errors
/// [`FormatError::Unexpected`] with what the decoder refuses; [`FormatError::TooLarge`] before
/// allocation; [`FormatError::Scale`].
pub fn read(bytes: &[u8], units_per_metre: f64) -> Result<DepthPixels, FormatError> {
    check_scale(units_per_metre)?;
    let refused = |error: ::tiff::TiffError| {
        let found = format!("data that the decoder refuses ({error})");
        FormatError::unexpected(Position::Byte(0), found, "a whole and valid TIFF image")
    };
    let mut limits = Limits::default();
    limits.decoding_buffer_size = MAX_DECODED_BYTES;
    limits.intermediate_buffer_size = MAX_DECODED_BYTES;
    let mut decoder = Decoder::new(Cursor::new(bytes)).map_err(refused)?.with_limits(limits);
    let (columns, rows) = decoder.dimensions().map_err(refused)?;
    let (columns, rows) = check_size(Position::Byte(0), columns.into(), rows.into())?;
    let colour = decoder.colortype().map_err(refused)?;
    if !matches!(colour, ColorType::Gray(_)) {
        let found = format!("pixels of {colour:?}");
        let expected = "one grey sample per pixel";
        return Err(FormatError::unexpected(Position::Byte(0), found, expected));
    }
    let whole = |value: f64, most: f64| {
        if value == 0.0 || value >= most { f32::NAN } else { metres(value, units_per_metre) }
    };
    let counted = f64::INFINITY;
    let depths_m: Vec<f32> = match decoder.read_image().map_err(refused)? {
        DecodingResult::U8(all) => all.iter().map(|&x| whole(x.into(), counted)).collect(),
        DecodingResult::U16(all) => all.iter().map(|&x| whole(x.into(), 65535.0)).collect(),
        DecodingResult::U32(all) => all.iter().map(|&x| whole(x.into(), counted)).collect(),
        DecodingResult::U64(all) => all.iter().map(|&x| whole(x as f64, counted)).collect(),
        DecodingResult::I8(all) => all.iter().map(|&x| whole(x.into(), counted)).collect(),
        DecodingResult::I16(all) => all.iter().map(|&x| whole(x.into(), counted)).collect(),
        DecodingResult::I32(all) => all.iter().map(|&x| whole(x.into(), counted)).collect(),
        DecodingResult::I64(all) => all.iter().map(|&x| whole(x as f64, counted)).collect(),
        DecodingResult::F16(all) => {
            all.iter().map(|x| metres(x.to_f64(), units_per_metre)).collect()
        }
        DecodingResult::F32(all) => {
            all.iter().map(|&x| metres(x.into(), units_per_metre)).collect()
        }
        DecodingResult::F64(all) => all.iter().map(|&x| metres(x, units_per_metre)).collect(),
    };
    if depths_m.len() != columns * rows {
        let found = format!("{} samples", depths_m.len());
        let expected = format!("{columns} x {rows} samples");
        return Err(FormatError::unexpected(Position::Byte(0), found, expected));
    }
    Ok(DepthPixels { columns, rows, depths_m })
}

#[cfg(test)]
mod tests {
    use super::*;
    use ::tiff::encoder::{TiffEncoder, colortype};

    #[test]
    fn whole_numbers_and_floats() {
        let mut file = Cursor::new(Vec::new());
        TiffEncoder::new(&mut file)
            .expect("header")
            .write_image::<colortype::Gray16>(2, 2, &[0, 1500, 65535, 5])
            .expect("encodes");
        let depth = read(file.get_ref(), 1000.0).expect("16 bits");
        assert_eq!((depth.columns, depth.rows, depth.depths_m[1]), (2, 2, 1.5));
        assert!(depth.depths_m[0].is_nan() && depth.depths_m[2].is_nan());
        let mut file = Cursor::new(Vec::new());
        TiffEncoder::new(&mut file)
            .expect("header")
            .write_image::<colortype::Gray32Float>(3, 1, &[1.25, 0.0, f32::NAN])
            .expect("encodes");
        let depth = read(file.get_ref(), 1.0).expect("floats");
        assert_eq!(depth.depths_m[..2], [1.25, 0.0]);
        assert!(depth.depths_m[2].is_nan());
        let mut file = Cursor::new(Vec::new());
        TiffEncoder::new(&mut file)
            .expect("header")
            .write_image::<colortype::RGB8>(1, 1, &[1, 2, 3])
            .expect("encodes");
        assert!(read(file.get_ref(), 1.0).expect_err("colour").to_string().contains("grey"));
        assert!(read(b"II*\0 nothing", 1.0).is_err());
    }
}
