//! PNG images as grey images.

use std::cell::Cell;
use std::io::{BufRead, Cursor, Read, Result as IoResult, Seek, SeekFrom};

use ::png::{BitDepth, ColorType, Decoder, DecodingError, Encoder, Limits, Transformations};

use crate::error::{MAX_CELLS, Position, check_size};
use crate::{FormatError, GrayImage};

/// The most bytes of decoded pixels, so that a small file cannot ask for all memory.
const MAX_DECODED_BYTES: usize = 1 << 30;

/// Reads a PNG image of any colour type as grey, 8 bits (`white` 255) or 16 (`white` 65535).
///
/// Colours become their luma (Rec. 601: 0.299 R + 0.587 G + 0.114 B); ROS's map_server takes the
/// plain mean, which differs for coloured pixels only. A pixel with less than half of full alpha is
/// transparent; above that its alpha is ignored. Of an animation the default image is read.
///
/// # Errors
/// [`FormatError::Unexpected`] with the byte offset up to which the decoder had read;
/// [`FormatError::TooLarge`] before allocation.
pub fn read(bytes: &[u8]) -> Result<GrayImage, FormatError> {
    let reached = Cell::new(0);
    let refused = |error: DecodingError| {
        let found = format!("data that the decoder refuses ({error})");
        FormatError::unexpected(Position::Byte(reached.get()), found, "a whole and valid PNG image")
    };
    let source = Counted { inner: Cursor::new(bytes), reached: &reached };
    let mut decoder = Decoder::new_with_limits(source, Limits { bytes: MAX_DECODED_BYTES });
    decoder.set_transformations(Transformations::EXPAND);
    let info = decoder.read_header_info().map_err(refused)?;
    // Width and height stand at a fixed place: after the signature and the head of the first chunk.
    let size_at = Position::Byte(16);
    let (columns, rows) = check_size(size_at, info.width.into(), info.height.into())?;
    let mut reader = decoder.read_info().map_err(refused)?;
    let too_large = FormatError::TooLarge {
        at: size_at,
        columns: columns as u64,
        rows: rows as u64,
        limit: MAX_CELLS,
    };
    let size = match reader.output_buffer_size() {
        Some(size) if size <= MAX_DECODED_BYTES => size,
        _ => return Err(too_large),
    };
    let mut decoded = vec![0; size];
    let frame = reader.next_frame(&mut decoded).map_err(refused)?;
    let (channels, colour, alpha) = match frame.color_type {
        ColorType::Grayscale | ColorType::Indexed => (1, false, false),
        ColorType::GrayscaleAlpha => (2, false, true),
        ColorType::Rgb => (3, true, false),
        ColorType::Rgba => (4, true, true),
    };
    let wide = frame.bit_depth == BitDepth::Sixteen;
    let white: u16 = if wide { 65535 } else { 255 };
    let mut levels = Vec::with_capacity(columns * rows);
    let mut transparent = Vec::new();
    let mut sample = [0_u16; 4];
    for pixel in decoded[..frame.buffer_size()].chunks_exact(channels * (1 + usize::from(wide))) {
        if wide {
            for (value, pair) in sample.iter_mut().zip(pixel.chunks_exact(2)) {
                *value = u16::from_be_bytes([pair[0], pair[1]]);
            }
        } else {
            for (value, byte) in sample.iter_mut().zip(pixel) {
                *value = u16::from(*byte);
            }
        }
        levels.push(if colour { luma(sample[0], sample[1], sample[2]) } else { sample[0] });
        if alpha {
            transparent.push(sample[channels - 1] <= white / 2);
        }
    }
    let image = GrayImage::new(columns, rows, white, levels)?;
    if alpha { image.with_transparent(transparent) } else { Ok(image) }
}

/// Reads a PNG image of levels: grey of 16 bits, with or without alpha.
///
/// Colours and 8 bits are a picture of something, and are refused by name: as depths they would mean
/// nothing.
///
/// # Errors
/// As [`read`], and [`FormatError::Unexpected`] for any other kind of pixels.
pub fn read_levels(bytes: &[u8]) -> Result<GrayImage, FormatError> {
    let mut decoder =
        Decoder::new_with_limits(Cursor::new(bytes), Limits { bytes: MAX_DECODED_BYTES });
    if let Ok(info) = decoder.read_header_info() {
        let (colour, bits) = (info.color_type, info.bit_depth as u8);
        let is_grey = matches!(colour, ColorType::Grayscale | ColorType::GrayscaleAlpha);
        if !is_grey || bits != 16 {
            let colour = match colour {
                ColorType::Grayscale => "grey",
                ColorType::GrayscaleAlpha => "grey with alpha",
                ColorType::Rgb => "RGB",
                ColorType::Rgba => "RGB with alpha",
                ColorType::Indexed => "a palette",
            };
            // After the signature, the head of the first chunk, width and height.
            let found = format!("a PNG image of {colour}, {bits} bits");
            let expected = "grey of 16 bits: a depth image, not a picture";
            return Err(FormatError::unexpected(Position::Byte(24), found, expected));
        }
    }
    read(bytes)
}

/// Writes the image as grey PNG, with alpha only when a pixel is transparent.
///
/// Up to `white` 255 the levels are scaled to 8 bits, above to 16 bits.
///
/// # Errors
/// [`FormatError::Encode`] when the encoder refuses the image.
pub fn write(image: &GrayImage) -> Result<Vec<u8>, FormatError> {
    let encode = |error: ::png::EncodingError| FormatError::Encode { reason: error.to_string() };
    let wide = image.white() > 255;
    let transparent = image.transparent();
    let mut pixels = Vec::new();
    let narrow = if wide { Vec::new() } else { image.levels_u8() };
    for (index, &level) in image.levels().iter().enumerate() {
        if wide {
            let white = u32::from(image.white());
            let level = (u32::from(level) * 65535 + white / 2) / white;
            pixels.extend((level as u16).to_be_bytes());
        } else {
            pixels.push(narrow[index]);
        }
        if let Some(&clear) = transparent.get(index) {
            pixels.extend(std::iter::repeat_n(if clear { 0 } else { 255 }, 1 + usize::from(wide)));
        }
    }
    let mut out = Vec::new();
    let mut encoder = Encoder::new(&mut out, image.columns() as u32, image.rows() as u32);
    encoder.set_color(if transparent.is_empty() {
        ColorType::Grayscale
    } else {
        ColorType::GrayscaleAlpha
    });
    encoder.set_depth(if wide { BitDepth::Sixteen } else { BitDepth::Eight });
    let mut writer = encoder.write_header().map_err(encode)?;
    writer.write_image_data(&pixels).map_err(encode)?;
    writer.finish().map_err(encode)?;
    Ok(out)
}

fn luma(red: u16, green: u16, blue: u16) -> u16 {
    let sum = 299 * u32::from(red) + 587 * u32::from(green) + 114 * u32::from(blue);
    ((sum + 500) / 1000) as u16
}

/// Bytes in memory that tell how far they were read.
struct Counted<'a> {
    inner: Cursor<&'a [u8]>,
    reached: &'a Cell<usize>,
}

impl Counted<'_> {
    fn note(&self) {
        self.reached.set(self.inner.position() as usize);
    }
}

impl Read for Counted<'_> {
    fn read(&mut self, into: &mut [u8]) -> IoResult<usize> {
        let count = self.inner.read(into)?;
        self.note();
        Ok(count)
    }
}

impl BufRead for Counted<'_> {
    fn fill_buf(&mut self) -> IoResult<&[u8]> {
        self.inner.fill_buf()
    }

    fn consume(&mut self, count: usize) {
        self.inner.consume(count);
        self.note();
    }
}

impl Seek for Counted<'_> {
    fn seek(&mut self, to: SeekFrom) -> IoResult<u64> {
        let position = self.inner.seek(to)?;
        self.note();
        Ok(position)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn encoded(colour: ColorType, depth: BitDepth, size: (u32, u32), data: &[u8]) -> Vec<u8> {
        let mut out = Vec::new();
        let mut encoder = Encoder::new(&mut out, size.0, size.1);
        encoder.set_color(colour);
        encoder.set_depth(depth);
        if colour == ColorType::Indexed {
            encoder.set_palette(vec![255, 255, 255, 0, 0, 0, 255, 0, 0, 9, 9, 9]);
            encoder.set_trns(vec![255, 255, 255, 0]);
        }
        let mut writer = encoder.write_header().expect("header");
        writer.write_image_data(data).expect("data");
        writer.finish().expect("end");
        out
    }

    #[test]
    fn every_colour_type_becomes_grey() {
        use BitDepth::{Eight, One, Sixteen, Two};
        let one = read(&encoded(ColorType::Grayscale, One, (3, 1), &[0b1010_0000])).expect("1 bit");
        assert_eq!(one.levels(), [255, 0, 255]);
        let alpha = [9, 255, 200, 0, 7, 128, 7, 127];
        let alpha =
            read(&encoded(ColorType::GrayscaleAlpha, Eight, (4, 1), &alpha)).expect("alpha");
        assert_eq!(alpha.levels(), [9, 200, 7, 7]);
        assert_eq!(alpha.transparent(), [false, true, false, true]);
        let rgb = [255, 215, 0, 0, 0, 255];
        let rgb = read(&encoded(ColorType::Rgb, Eight, (2, 1), &rgb)).expect("rgb");
        assert_eq!(rgb.levels(), [202, 29]);
        assert!(rgb.transparent().is_empty());
        let rgba = [0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x80, 0x00];
        let rgba = read(&encoded(ColorType::Rgba, Sixteen, (1, 1), &rgba)).expect("rgba 16");
        assert_eq!((rgba.white(), rgba.levels()), (65535, &[65535_u16][..]));
        assert!(rgba.transparent().is_empty());
        let indexed = encoded(ColorType::Indexed, Two, (4, 1), &[0b00_01_10_11]);
        let indexed = read(&indexed).expect("palette");
        assert_eq!(indexed.levels(), [255, 0, 76, 9]);
        assert_eq!(indexed.transparent(), [false, false, false, true]);
    }

    #[test]
    fn a_picture_holds_no_levels() {
        use BitDepth::{Eight, Four, Sixteen};
        for (colour, depth, data, words) in [
            (ColorType::Rgb, Eight, &[1, 2, 3][..], "RGB, 8 bits"),
            (ColorType::Rgba, Sixteen, &[0; 8], "RGB with alpha, 16 bits"),
            (ColorType::Indexed, Four, &[0], "a palette, 4 bits"),
            (ColorType::Grayscale, Eight, &[7], "grey, 8 bits"),
        ] {
            let error = read_levels(&encoded(colour, depth, (1, 1), data)).expect_err("a picture");
            let text = error.to_string();
            assert!(text.starts_with("byte 24: found") && text.contains(words), "{text}");
            assert!(text.contains("expected grey of 16 bits"), "{text}");
        }
        let grey = encoded(ColorType::Grayscale, Sixteen, (1, 1), &[1, 2]);
        assert_eq!(read_levels(&grey).expect("levels").levels(), [258]);
        assert!(read_levels(b"\x89PNG and no more").is_err());
    }

    #[test]
    fn errors_say_where() {
        let image = encoded(ColorType::Grayscale, BitDepth::Eight, (40, 30), &[7; 1200]);
        for bytes in [&image[..0], &image[..20], &image[..image.len() - 16], b"not a PNG at all"] {
            let error = read(bytes).expect_err("broken");
            let FormatError::Unexpected { at: Position::Byte(offset), .. } = &error else {
                panic!("{error}")
            };
            assert!(*offset <= bytes.len(), "{error}");
        }
        let mut broken = image.clone();
        broken[17] ^= 1;
        assert!(read(&broken).expect_err("checksum").to_string().contains("CRC"));
    }

    #[test]
    fn huge_images_are_refused_early() {
        // A valid header of 60000 x 60000 pixels and no data.
        let mut out = Vec::new();
        let writer = Encoder::new(&mut out, 60_000, 60_000).write_header().expect("header");
        drop(writer);
        assert!(matches!(read(&out), Err(FormatError::TooLarge { columns: 60_000, .. })));
    }
}
