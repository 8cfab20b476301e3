//! The header: fields, size, and how the points follow.

use crate::FormatError;
use crate::error::{Position, check_size, quote};

/// How the points follow the header.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Data {
    Ascii,
    Binary,
    Compressed,
}

/// One field of the header.
#[derive(Clone, Copy)]
pub(super) struct Field {
    /// 0, 1, 2 for x, y, z.
    pub(super) axis: Option<usize>,
    pub(super) size: usize,
    pub(super) kind: u8,
    pub(super) count: usize,
}

pub(super) struct Header {
    pub(super) fields: Vec<Field>,
    pub(super) columns: usize,
    pub(super) rows: usize,
    pub(super) data: Data,
    /// Bytes and lines before the points.
    pub(super) offset: usize,
    pub(super) lines: usize,
}

pub(super) fn read_header(bytes: &[u8]) -> Result<Header, FormatError> {
    let mut offset = 0;
    let (mut fields, mut sizes, mut kinds, mut counts) = (vec![], vec![], vec![], vec![]);
    let (mut width, mut height, mut points) = (None, None, None);
    let mut lines = 0;
    loop {
        lines += 1;
        let at = |column: usize| Position::Line { line: lines, column };
        let rest = &bytes[offset..];
        let Some(end) = rest.iter().position(|&b| b == b'\n') else {
            let found = "the end of the file";
            return Err(FormatError::unexpected(at(1), found, "a header that ends with DATA"));
        };
        let line = String::from_utf8_lossy(&rest[..end]);
        offset += end + 1;
        let mut words = line.split_whitespace();
        let Some(key) = words.next().filter(|word| !word.starts_with('#')) else { continue };
        let values: Vec<&str> = words.collect();
        let number = |text: &str| -> Result<u64, FormatError> {
            text.parse().map_err(|_| {
                let expected = format!("a whole number after {key}");
                FormatError::unexpected(at(key.len() + 2), quote(text), expected)
            })
        };
        let numbers = || values.iter().map(|text| number(text)).collect::<Result<Vec<_>, _>>();
        let one = || number(values.first().copied().unwrap_or(""));
        match key {
            "VERSION" | "VIEWPOINT" => {}
            "FIELDS" | "COLUMNS" => fields = values.iter().map(ToString::to_string).collect(),
            "SIZE" => sizes = numbers()?,
            "TYPE" => kinds = values.iter().map(|word| word.as_bytes()[0]).collect::<Vec<u8>>(),
            "COUNT" => counts = numbers()?,
            "WIDTH" => width = Some(one()?),
            "HEIGHT" => height = Some(one()?),
            "POINTS" => points = Some(one()?),
            "DATA" => {
                let data = match values.first().copied().unwrap_or("") {
                    "ascii" => Data::Ascii,
                    "binary" => Data::Binary,
                    "binary_compressed" => Data::Compressed,
                    other => {
                        let expected = "ascii, binary or binary_compressed";
                        return Err(FormatError::unexpected(at(6), quote(other), expected));
                    }
                };
                let fields = checked_fields(at(1), &fields, &sizes, &kinds, &counts)?;
                let width = width.or(points).unwrap_or(0);
                let height = height.unwrap_or(1);
                let (columns, rows) = check_size(at(1), width, height)?;
                if points.is_some_and(|points| points != width * height) {
                    let found = format!("{} POINTS", points.unwrap_or(0));
                    let expected = format!("WIDTH x HEIGHT = {}", width * height);
                    return Err(FormatError::unexpected(at(1), found, expected));
                }
                return Ok(Header { fields, columns, rows, data, offset, lines });
            }
            other => {
                let expected =
                    "VERSION, FIELDS, SIZE, TYPE, COUNT, WIDTH, HEIGHT, VIEWPOINT, POINTS or DATA";
                return Err(FormatError::unexpected(at(1), quote(other), expected));
            }
        }
    }
}

fn checked_fields(
    at: Position,
    names: &[String],
    sizes: &[u64],
    kinds: &[u8],
    counts: &[u64],
) -> Result<Vec<Field>, FormatError> {
    let counts = if counts.is_empty() { vec![1; names.len()] } else { counts.to_vec() };
    if sizes.len() != names.len() || kinds.len() != names.len() || counts.len() != names.len() {
        let (s, t, c) = (sizes.len(), kinds.len(), counts.len());
        let found = format!("{} FIELDS, {s} SIZE, {t} TYPE, {c} COUNT", names.len());
        return Err(FormatError::unexpected(at, found, "as many of each"));
    }
    let mut fields = Vec::with_capacity(names.len());
    for (index, name) in names.iter().enumerate() {
        let axis = ["x", "y", "z"].iter().position(|axis| axis == name);
        let (size, kind, count) = (sizes[index], kinds[index], counts[index]);
        let known = match kind {
            b'F' => matches!(size, 4 | 8),
            b'I' | b'U' => matches!(size, 1 | 2 | 4 | 8),
            _ => false,
        };
        if !known || count > 1 << 16 || (axis.is_some() && count != 1) {
            let found =
                format!("field {} of type {} {size} x {count}", quote(name), char::from(kind));
            let expected = "F of 4 or 8 bytes, I or U of 1, 2, 4 or 8; x, y, z once";
            return Err(FormatError::unexpected(at, found, expected));
        }
        fields.push(Field { axis, size: size as usize, kind, count: count as usize });
    }
    for (axis, name) in ["x", "y", "z"].iter().enumerate() {
        let times = fields.iter().filter(|field| field.axis == Some(axis)).count();
        if times != 1 {
            let found = format!("{times} fields {name}");
            return Err(FormatError::unexpected(at, found, "one field each of x, y and z"));
        }
    }
    Ok(fields)
}
