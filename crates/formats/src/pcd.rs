//! PCD clouds: `ascii`, `binary` and `binary_compressed`.

use crate::error::{Position, check_size, quote};
use crate::lzf;
use crate::{Cloud, FormatError};

/// How the points follow the header.
#[derive(Clone, Copy, PartialEq)]
enum Data {
    Ascii,
    Binary,
    Compressed,
}

/// One field of the header.
#[derive(Clone, Copy)]
struct Field {
    /// 0, 1, 2 for x, y, z.
    axis: Option<usize>,
    size: usize,
    kind: u8,
    count: usize,
}

struct Header {
    fields: Vec<Field>,
    columns: usize,
    rows: usize,
    data: Data,
    /// Bytes and lines before the points.
    offset: usize,
    lines: usize,
}

/// Reads x, y and z of a cloud; other fields are skipped.
///
/// The viewpoint is not applied: points stay in the frame of the sensor. Coordinates may be floats of
/// 4 or 8 bytes or whole numbers. Cost: linear in the bytes.
///
/// # Errors
/// [`FormatError::Unexpected`] with line or byte; [`FormatError::TooLarge`] before allocation.
pub fn read(bytes: &[u8]) -> Result<Cloud, FormatError> {
    let header = read_header(bytes)?;
    let count = header.columns * header.rows;
    let body = &bytes[header.offset..];
    let points_in_sensor = match header.data {
        Data::Ascii => read_ascii(body, &header, count)?,
        Data::Binary => {
            let stride: usize = header.fields.iter().map(|f| f.size * f.count).sum();
            need(body.len(), stride, count, header.offset)?;
            gather(body, &header, count, |field_at, _, point| field_at + point * stride)
        }
        Data::Compressed => {
            let unpacked = unpack(body, &header, count)?;
            // Field by field, all points of each.
            gather(&unpacked, &header, count, |field_at, field, point| {
                field_at * count + point * field.size * field.count
            })
        }
    };
    Ok(Cloud { columns: header.columns, rows: header.rows, points_in_sensor })
}

fn need(found: usize, stride: usize, count: usize, offset: usize) -> Result<(), FormatError> {
    let needed = stride as u64 * count as u64;
    if (found as u64) < needed {
        let expected = format!("{needed} bytes: {count} points of {stride}");
        let at = Position::Byte(offset);
        return Err(FormatError::unexpected(at, format!("{found} bytes of points"), expected));
    }
    Ok(())
}

fn read_header(bytes: &[u8]) -> Result<Header, FormatError> {
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

fn read_ascii(body: &[u8], header: &Header, count: usize) -> Result<Vec<[f32; 3]>, FormatError> {
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

fn unpack(body: &[u8], header: &Header, count: usize) -> Result<Vec<u8>, FormatError> {
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
fn gather(
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

#[cfg(test)]
mod tests {
    use super::*;

    const HEAD: &str = "# .PCD v0.7\nVERSION 0.7\nFIELDS x rgb y z\nSIZE 4 4 4 4\nTYPE F U F F\n\
        COUNT 1 1 1 1\nWIDTH 2\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\n";

    fn points(cloud: &Cloud) -> String {
        format!("{} {} {:?}", cloud.columns, cloud.rows, cloud.points_in_sensor)
    }

    #[test]
    fn all_three_forms_agree() {
        let ascii = format!("{HEAD}DATA ascii\n1 7 2 3\nnan 8 nan 6\n");
        let expected = "2 1 [[1.0, 2.0, 3.0], [NaN, NaN, 6.0]]";
        assert_eq!(points(&read(ascii.as_bytes()).expect("ascii")), expected);
        let rows = [[1.0, 9.0, 2.0, 3.0], [f32::NAN, 8.0, f32::NAN, 6.0]];
        let mut binary = format!("{HEAD}DATA binary\n").into_bytes();
        binary.extend(rows.iter().flatten().flat_map(|x| x.to_le_bytes()));
        assert_eq!(points(&read(&binary).expect("binary")), expected);
        let columns: Vec<u8> =
            (0..4).flat_map(|c| rows.map(|r| r[c])).flat_map(f32::to_le_bytes).collect();
        let mut packed = format!("{HEAD}DATA binary_compressed\n").into_bytes();
        packed.extend(33_u32.to_le_bytes());
        packed.extend(32_u32.to_le_bytes());
        packed.push(31);
        packed.extend(&columns);
        assert_eq!(points(&read(&packed).expect("packed")), expected);
    }

    #[test]
    fn errors_say_where() {
        let told = |text: String| read(text.as_bytes()).expect_err("broken").to_string();
        assert_eq!(
            told(format!("{HEAD}DATA ascii\n1 7 2 3\n4 8 x 6\n")),
            "line 13, column 5: found `x`, expected a coordinate in metres"
        );
        assert_eq!(
            told(format!("{HEAD}DATA ascii\n1 7 2 3\n")),
            "line 13, column 1: found the end of the file after 1 points, expected 2 points"
        );
        assert_eq!(told(format!("{HEAD}DATA binary\nshort")).split(':').next(), Some("byte 143"));
        assert!(told(HEAD.replace("x rgb", "q rgb") + "DATA ascii\n").contains("0 fields x"));
        assert!(told(HEAD.replace("WIDTH 2", "WIDTH -2")).contains("`-2`"));
        assert!(told(HEAD.replace("POINTS 2", "POINTS 3") + "DATA ascii\n").contains("3 POINTS"));
        assert!(told(HEAD.replace("4 4 4 4", "4 4 3 4") + "DATA ascii\n").contains("type F 3"));
        assert!(told(HEAD.to_owned()).contains("end of the file"));
        assert!(told(format!("{HEAD}DATA binary_compressed\n")).contains("two sizes"));
        let huge = HEAD.replace("WIDTH 2", "WIDTH 99999999").replace("HEIGHT 1", "HEIGHT 9999");
        assert!(matches!(
            read((huge + "DATA ascii\n").as_bytes()),
            Err(FormatError::TooLarge { .. })
        ));
    }
}
