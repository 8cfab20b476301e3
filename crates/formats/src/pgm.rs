//! Netpbm grey maps: `P2` (decimal) and `P5` (bytes), up to 16 bits.

use crate::error::{Position, check_size, quote};
use crate::{FormatError, GrayImage};

/// Reads a `P2` or `P5` image; levels stay as in the file, `white` is its maxval.
///
/// Comments may stand anywhere in the header and in a `P2` body. Bytes after the first image are
/// ignored, as Netpbm allows several images in one file. Cost: linear in the bytes.
///
/// # Errors
/// [`FormatError::Unexpected`] with the byte offset; [`FormatError::TooLarge`] before allocation.
pub fn read(bytes: &[u8]) -> Result<GrayImage, FormatError> {
    let plain = match bytes {
        [b'P', b'2', ..] => true,
        [b'P', b'5', ..] => false,
        _ => {
            let found = shown(bytes, 0);
            return Err(FormatError::unexpected(Position::Byte(0), found, "`P2` or `P5`"));
        }
    };
    let mut cursor = Cursor { bytes, offset: 2 };
    let size_at = Position::Byte(cursor.peek_number());
    let columns = cursor.number("the width", u32::MAX)?;
    let rows = cursor.number("the height", u32::MAX)?;
    let (columns, rows) = check_size(size_at, columns.into(), rows.into())?;
    let white_at = cursor.peek_number();
    let white = cursor.number("the maxval", 65535)? as u16;
    if white == 0 {
        let at = Position::Byte(white_at);
        return Err(FormatError::unexpected(at, "maxval 0", "a maxval from 1 to 65535"));
    }
    let levels = if plain {
        read_decimal(&mut cursor, columns * rows, white)?
    } else {
        read_bytes(&mut cursor, columns * rows, white)?
    };
    GrayImage::new(columns, rows, white, levels)
}

/// Writes the image as `P5`; transparent pixels keep their level, the format has no transparency.
pub fn write(image: &GrayImage) -> Vec<u8> {
    let mut out = header("P5", image);
    if image.white() < 256 {
        out.extend(image.levels().iter().map(|&level| level as u8));
    } else {
        out.extend(image.levels().iter().flat_map(|level| level.to_be_bytes()));
    }
    out
}

/// Writes the image as `P2`, one row of the image per line.
pub fn write_decimal(image: &GrayImage) -> Vec<u8> {
    let mut out = header("P2", image);
    for row in image.levels().chunks(image.columns()) {
        let row: Vec<String> = row.iter().map(u16::to_string).collect();
        out.extend(row.join(" ").into_bytes());
        out.push(b'\n');
    }
    out
}

fn header(magic: &str, image: &GrayImage) -> Vec<u8> {
    format!("{magic}\n{} {}\n{}\n", image.columns(), image.rows(), image.white()).into_bytes()
}

fn read_decimal(
    cursor: &mut Cursor<'_>,
    count: usize,
    white: u16,
) -> Result<Vec<u16>, FormatError> {
    // Each level takes a digit and a separator, so a short file is told before memory is asked for.
    let left = cursor.bytes.len() - cursor.offset;
    if left < 2 * count {
        let found = format!("{left} bytes of levels");
        let expected = format!("{count} decimal levels");
        return Err(FormatError::unexpected(Position::Byte(cursor.offset), found, expected));
    }
    let mut levels = Vec::with_capacity(count);
    for _ in 0..count {
        levels.push(cursor.number("a level", white.into())? as u16);
    }
    Ok(levels)
}

fn read_bytes(cursor: &mut Cursor<'_>, count: usize, white: u16) -> Result<Vec<u16>, FormatError> {
    let wide = white > 255;
    let needed = if wide { 2 * count } else { count };
    match cursor.bytes.get(cursor.offset) {
        Some(byte) if byte.is_ascii_whitespace() => cursor.offset += 1,
        _ => {
            let at = Position::Byte(cursor.offset);
            let found = shown(cursor.bytes, cursor.offset);
            return Err(FormatError::unexpected(at, found, "one whitespace after the maxval"));
        }
    }
    let mut body = &cursor.bytes[cursor.offset..];
    // Files that went through a Windows text editor end the header with two bytes.
    if cursor.bytes[cursor.offset - 1] == b'\r' && body.first() == Some(&b'\n') {
        let longer = body.len() > needed;
        body = if longer { &body[1..] } else { body };
        cursor.offset += usize::from(longer);
    }
    if body.len() < needed {
        let found = format!("{} bytes of levels up to the end of the file", body.len());
        let at = Position::Byte(cursor.offset);
        return Err(FormatError::unexpected(at, found, format!("{needed} bytes")));
    }
    let levels: Vec<u16> = if wide {
        body[..needed].chunks_exact(2).map(|pair| u16::from_be_bytes([pair[0], pair[1]])).collect()
    } else {
        body[..needed].iter().map(|&byte| u16::from(byte)).collect()
    };
    if let Some(index) = levels.iter().position(|&level| level > white) {
        let at = Position::Byte(cursor.offset + if wide { 2 * index } else { index });
        let found = format!("level {}", levels[index]);
        return Err(FormatError::unexpected(at, found, format!("at most the maxval {white}")));
    }
    Ok(levels)
}

struct Cursor<'a> {
    bytes: &'a [u8],
    offset: usize,
}

impl Cursor<'_> {
    /// Skips whitespace and comments; the offset of what follows.
    fn peek_number(&mut self) -> usize {
        while let Some(byte) = self.bytes.get(self.offset) {
            if *byte == b'#' {
                let rest = &self.bytes[self.offset..];
                let end = rest.iter().position(|byte| matches!(byte, b'\n' | b'\r'));
                self.offset += end.unwrap_or(rest.len());
            } else if byte.is_ascii_whitespace() {
                self.offset += 1;
            } else {
                break;
            }
        }
        self.offset
    }

    fn number(&mut self, what: &str, limit: u32) -> Result<u32, FormatError> {
        let start = self.peek_number();
        let digits = self.bytes[start..].iter().take_while(|byte| byte.is_ascii_digit()).count();
        let expected = || format!("{what}, a decimal number up to {limit}");
        if digits == 0 {
            let found = shown(self.bytes, start);
            return Err(FormatError::unexpected(Position::Byte(start), found, expected()));
        }
        self.offset = start + digits;
        let text = String::from_utf8_lossy(&self.bytes[start..self.offset]);
        match text.parse::<u32>() {
            Ok(number) if number <= limit => Ok(number),
            _ => Err(FormatError::unexpected(Position::Byte(start), quote(&text), expected())),
        }
    }
}

/// What stands at an offset, for a message.
fn shown(bytes: &[u8], offset: usize) -> String {
    let rest = bytes.get(offset..).unwrap_or_default();
    if rest.is_empty() {
        return "the end of the file".into();
    }
    let word: Vec<u8> =
        rest.iter().take(12).take_while(|byte| byte.is_ascii_graphic()).copied().collect();
    if word.is_empty() {
        format!("byte 0x{:02x}", rest[0])
    } else {
        quote(&String::from_utf8_lossy(&word))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_forms_with_comments() {
        let plain = b"P2 # made by hand\n# size\n3 2\n255\n0 10 20\n# body\n30 40 255\n";
        let image = read(plain).expect("valid");
        assert_eq!((image.columns(), image.rows(), image.white()), (3, 2, 255));
        assert_eq!(image.levels(), [0, 10, 20, 30, 40, 255]);
        let mut raw = b"P5\n# x\n3 2\n255\n".to_vec();
        raw.extend([0, 10, 20, 30, 40, 255]);
        assert_eq!(read(&raw).expect("valid"), image);
        // A body byte that looks like whitespace belongs to the body.
        let newline = read(b"P5 1 1 255\n\n").expect("valid");
        assert_eq!(newline.levels(), [10]);
    }

    #[test]
    fn sixteen_bits_are_big_endian() {
        let image = read(b"P5 2 1 65535\n\x01\x02\xff\xfe").expect("valid");
        assert_eq!(image.levels(), [0x0102, 0xfffe]);
    }

    #[test]
    fn windows_line_ends() {
        let image = read(b"P5\r\n2 1\r\n255\r\n\x07\x08").expect("valid");
        assert_eq!(image.levels(), [7, 8]);
        let image = read(b"P5 2 1 255\r\n\x08").expect("valid: the body starts with a newline");
        assert_eq!(image.levels(), [10, 8]);
    }

    #[test]
    fn errors_say_where() {
        let cases: [(&[u8], &str); 11] = [
            (b"", "byte 0: found the end of the file, expected `P2` or `P5`"),
            (b"P6 1 1 255\n", "byte 0: found `P6`, expected `P2` or `P5`"),
            (b"P5 x", "byte 3: found `x`, expected the width, a decimal number up to 4294967295"),
            (
                b"P5 2 ",
                "byte 5: found the end of the file, expected the height, a decimal number up to 4294967295",
            ),
            (
                b"P5 0 2 255\n",
                "byte 3: found a size of 0 x 2, expected at least one column and one row",
            ),
            (
                b"P5 99999 99999 255\n",
                "byte 3: found 99999 x 99999 cells, expected at most 268435456 in all",
            ),
            (b"P5 1 1 0\n\x00", "byte 7: found maxval 0, expected a maxval from 1 to 65535"),
            (
                b"P5 1 1 70000\n",
                "byte 7: found `70000`, expected the maxval, a decimal number up to 65535",
            ),
            (
                b"P5 2 2 255\n\x00\x00",
                "byte 11: found 2 bytes of levels up to the end of the file, expected 4 bytes",
            ),
            (b"P5 2 1 9\n\x09\x0a", "byte 10: found level 10, expected at most the maxval 9"),
            (b"P2 2 1 9\n7 x\n", "byte 11: found `x`, expected a level, a decimal number up to 9"),
        ];
        for (bytes, message) in cases {
            assert_eq!(read(bytes).expect_err("broken").to_string(), message);
        }
    }
}
