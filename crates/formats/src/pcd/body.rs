//! The points: lines, bytes, or bytes that are packed.

use super::header::{Field, Header};
use crate::FormatError;
use crate::error::{Position, quote};
use crate::lzf;

pub(super) fn need(
    found: usize,
    stride: usize,
    count: usize,
    offset: usize,
) -> Result<(), FormatError> {
    let needed = stride as u64 * count as u64;
    if (found as u64) < needed {
        let expected = format!("{needed} bytes: {count} points of {stride}");
        let at = Position::Byte(offset);
        return Err(FormatError::unexpected(at, format!("{found} bytes of points"), expected));
    }
    Ok(())
}

pub(super) fn read_ascii(
    body: &[u8],
    header: &Header,
    count: usize,
) -> Result<Vec<[f32; 3]>, FormatError> {
    let text = String::from_utf8_lossy(body);
    // A point takes at least two bytes, so a short file is told before memory is asked for.
    need(body.len() + 1, 2, count, header.offset)?;
    let mut points = Vec::with_capacity(count);
    let lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
    for (index, line) in lines.take(count) {
        let at = |column| Position::Line { line: header.lines + index + 1, column };
        let mut words = line.split_whitespace();
        let mut point = [0.0; 3];
        for field in &header.fields {
            for _ in 0..field.count {
                let Some(word) = words.next() else {
                    let found = "the end of the line";
                    return Err(FormatError::unexpected(at(line.len() + 1), found, "a number"));
                };
                if let Some(axis) = field.axis {
                    point[axis] = fast_float2::parse(word).map_err(|_| {
                        let column = word.as_ptr() as usize - line.as_ptr() as usize + 1;
                        FormatError::unexpected(at(column), quote(word), "a coordinate in metres")
                    })?;
                }
            }
        }
        points.push(point);
    }
    if points.len() < count {
        let line = header.lines + text.lines().count() + 1;
        let found = format!("the end of the file after {} points", points.len());
        let at = Position::Line { line, column: 1 };
        return Err(FormatError::unexpected(at, found, format!("{count} points")));
    }
    Ok(points)
}

pub(super) fn unpack(body: &[u8], header: &Header, count: usize) -> Result<Vec<u8>, FormatError> {
    let size_at = |at: usize| {
        let four = body.get(at..at + 4).and_then(|four| four.try_into().ok());
        four.map(u32::from_le_bytes).map(|size| size as usize)
    };
    let (Some(packed), Some(unpacked)) = (size_at(0), size_at(4)) else {
        let found = format!("{} bytes after the header", body.len());
        let at = Position::Byte(header.offset);
        return Err(FormatError::unexpected(at, found, "two sizes of 4 bytes"));
    };
    let stride: usize = header.fields.iter().map(|f| f.size * f.count).sum();
    if unpacked as u64 != stride as u64 * count as u64 {
        let found = format!("{unpacked} bytes unpacked");
        let expected = format!("{count} points of {stride} bytes");
        return Err(FormatError::unexpected(Position::Byte(header.offset + 4), found, expected));
    }
    let start = header.offset + 8;
    let Some(data) = body[8..].get(..packed) else {
        let found = format!("{} bytes", body.len() - 8);
        let expected = format!("{packed} packed bytes");
        return Err(FormatError::unexpected(Position::Byte(start), found, expected));
    };
    lzf::decompress(data, unpacked).map_err(|at| {
        let found = "a step of LZF that does not fit";
        let expected = format!("LZF data that unpacks to {unpacked} bytes");
        FormatError::unexpected(Position::Byte(start + at), found, expected)
    })
}

/// Picks x, y, z out of bytes; `place` tells where a field of a point is.
pub(super) fn gather(
    bytes: &[u8],
    header: &Header,
    count: usize,
    place: impl Fn(usize, &Field, usize) -> usize,
) -> Vec<[f32; 3]> {
    let mut points = vec![[0.0; 3]; count];
    let mut field_at = 0;
    for field in &header.fields {
        if let Some(axis) = field.axis {
            for (index, point) in points.iter_mut().enumerate() {
                let at = place(field_at, field, index);
                point[axis] = number(field, &bytes[at..at + field.size]);
            }
        }
        field_at += field.size * field.count;
    }
    points
}

#[expect(clippy::cast_possible_truncation, reason = "points are kept as sensors give them")]
fn number(field: &Field, bytes: &[u8]) -> f32 {
    let mut eight = [0; 8];
    eight[..bytes.len()].copy_from_slice(bytes);
    let raw = u64::from_le_bytes(eight);
    match (field.kind, field.size) {
        (b'F', 4) => f32::from_bits(raw as u32),
        (b'F', _) => f64::from_bits(raw) as f32,
        (b'I', size) => {
            let unused = 64 - 8 * size as u32;
            ((raw << unused) as i64 >> unused) as f32
        }
        _ => raw as f32,
    }
}
