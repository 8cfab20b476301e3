//! Points and pixels that stand in a message as raw bytes.

use pose::Se3;

use super::Malformed;
use crate::{Cloud, DepthPixels};

/// The most pixels or points of one message, 2^24.
const MAX_ITEMS: u64 = 1 << 24;

/// The type of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Number {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Number {
    /// By the numbers of `sensor_msgs/PointField`.
    pub(crate) fn of_ros(datatype: u8) -> Option<Self> {
        use Number::*;
        [I8, U8, I16, U16, I32, U32, F32, F64].get(usize::from(datatype).checked_sub(1)?).copied()
    }

    /// By the numbers of `foxglove.PackedElementField`.
    pub(crate) fn of_foxglove(kind: u64) -> Option<Self> {
        use Number::*;
        let index = usize::try_from(kind).ok()?.checked_sub(1)?;
        [U8, I8, U16, I16, U32, I32, F32, F64].get(index).copied()
    }

    fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    /// The number at the start of `bytes`, as far as single precision holds it.
    fn read(self, bytes: &[u8], big_endian: bool) -> Option<f32> {
        let mut turned = [0; 8];
        let turned = turned.get_mut(..self.size())?;
        turned.copy_from_slice(bytes.get(..self.size())?);
        if big_endian {
            turned.reverse();
        }
        Some(match (self, &*turned) {
            (Self::I8, &[a]) => f32::from(a as i8),
            (Self::U8, &[a]) => f32::from(a),
            (Self::I16, &[a, b]) => f32::from(i16::from_le_bytes([a, b])),
            (Self::U16, &[a, b]) => f32::from(u16::from_le_bytes([a, b])),
            (Self::I32, &[a, b, c, d]) => i32::from_le_bytes([a, b, c, d]) as f32,
            (Self::U32, &[a, b, c, d]) => u32::from_le_bytes([a, b, c, d]) as f32,
            (Self::F32, &[a, b, c, d]) => f32::from_le_bytes([a, b, c, d]),
            (Self::F64, &[a, b, c, d, e, f, g, h]) => {
                f64::from_le_bytes([a, b, c, d, e, f, g, h]) as f32
            }
            _ => return None,
        })
    }
}

/// Where a coordinate stands in a point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Field {
    pub offset: u32,
    pub number: Number,
}

/// How items lie in the bytes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shape {
    pub columns: u32,
    pub rows: u32,
    pub point_step: u32,
    /// Bytes from one row to the next; 0 where rows follow each other without gaps.
    pub row_step: u32,
    pub big_endian: bool,
}

/// Which coordinate a field of this name holds.
pub(crate) fn axis(name: &str) -> Option<usize> {
    ["x", "y", "z"].iter().position(|axis| *axis == name)
}

/// The points; all sizes are held against the bytes before memory is asked for.
pub(crate) fn cloud(
    shape: &Shape,
    xyz: [Option<Field>; 3],
    data: &[u8],
    at: usize,
) -> Result<Cloud, Malformed> {
    let refused = |found| Err(Malformed { at, found });
    let [Some(x), Some(y), Some(z)] = xyz else {
        return refused("a cloud without numbers named x, y and z");
    };
    let (columns, rows) = (shape.columns as usize, shape.rows as usize);
    let step = shape.point_step as usize;
    let count = u64::from(shape.columns) * u64::from(shape.rows);
    if count > MAX_ITEMS {
        return refused("more points than a cloud may have");
    }
    if [x, y, z].iter().any(|field| field.offset as usize + field.number.size() > step) {
        return refused("coordinates that reach beyond their point");
    }
    // A point takes as much memory as it does in the message, or less; or there are few.
    if step < 12 && count > 1 << 20 {
        return refused("more points of less than 12 bytes than a cloud may have");
    }
    let row_bytes = columns * step;
    let row_step = if shape.row_step == 0 { row_bytes } else { shape.row_step as usize };
    let needed = (rows.saturating_sub(1)).checked_mul(row_step).map(|skipped| skipped + row_bytes);
    if row_step < row_bytes || (count > 0 && needed.is_none_or(|needed| needed > data.len())) {
        return refused("fewer bytes than its points need");
    }
    let mut points_in_sensor = Vec::with_capacity(count as usize);
    if count > 0 {
        for row in 0..rows {
            let row = &data[row * row_step..][..row_bytes];
            for point in row.chunks_exact(step) {
                let of = |field: Field| {
                    let bytes = point.get(field.offset as usize..).unwrap_or(&[]);
                    field.number.read(bytes, shape.big_endian).unwrap_or(f32::NAN)
                };
                points_in_sensor.push([of(x), of(y), of(z)]);
            }
        }
    }
    let rows = if count > 0 { rows } else { 0 };
    Ok(Cloud { columns: if rows > 0 { columns } else { 0 }, rows, points_in_sensor })
}

/// The points of a message without rows, moved into the frame of its header.
pub(crate) fn stream(
    point_step: u32,
    xyz: [Option<Field>; 3],
    data: &[u8],
    frame_from_sensor: &Se3,
) -> Result<Cloud, Malformed> {
    let found = "more points than a cloud may have";
    let count = data.len().checked_div(point_step as usize).unwrap_or(0);
    let columns = u32::try_from(count).map_err(|_| Malformed { at: 0, found })?;
    let shape = Shape { columns, rows: 1, point_step, row_step: 0, big_endian: false };
    let mut cloud = cloud(&shape, xyz, data, 0)?;
    if *frame_from_sensor != Se3::identity() {
        for point in &mut cloud.points_in_sensor {
            let moved = frame_from_sensor.transform(&point.map(f64::from).into());
            *point = [moved.x as f32, moved.y as f32, moved.z as f32];
        }
    }
    Ok(cloud)
}

/// The depths of an image: `16UC1` and `mono16` in units, `32FC1` in metres.
pub(crate) fn depth(
    shape: &Shape,
    encoding: &str,
    data: &[u8],
    units_per_metre: f64,
    at: usize,
) -> Result<DepthPixels, Malformed> {
    let refused = |found| Err(Malformed { at, found });
    let size = match encoding {
        "16UC1" | "mono16" => 2,
        "32FC1" => 4,
        _ => return refused("an image that is no depth image (neither 16UC1 nor 32FC1)"),
    };
    if u64::from(shape.columns) * u64::from(shape.rows) > MAX_ITEMS {
        return refused("more pixels than an image may have");
    }
    let (columns, rows) = (shape.columns as usize, shape.rows as usize);
    if columns == 0 || rows == 0 {
        return refused("an image without pixels");
    }
    let row_bytes = columns * size;
    let row_step = if shape.row_step == 0 { row_bytes } else { shape.row_step as usize };
    let needed = (rows - 1).checked_mul(row_step).map(|skipped| skipped + row_bytes);
    if row_step < row_bytes || needed.is_none_or(|needed| needed > data.len()) {
        return refused("fewer bytes than its pixels need");
    }
    let mut depths_m = Vec::with_capacity(columns * rows);
    for row in 0..rows {
        let row = &data[row * row_step..][..row_bytes];
        if size == 4 {
            let turned = if shape.big_endian { f32::from_be_bytes } else { f32::from_le_bytes };
            depths_m.extend(row.as_chunks::<4>().0.iter().map(|&four| turned(four)));
        } else {
            let turned = if shape.big_endian { u16::from_be_bytes } else { u16::from_le_bytes };
            let metres = |two| crate::depth::of_level(turned(two), units_per_metre);
            depths_m.extend(row.as_chunks::<2>().0.iter().map(|&two| metres(two)));
        }
    }
    Ok(DepthPixels { columns, rows, depths_m })
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHAPE: Shape =
        Shape { columns: 1, rows: 2, point_step: 8, row_step: 9, big_endian: true };

    #[test]
    fn points_of_any_number_are_read() {
        let field = |offset, number| Some(Field { offset, number });
        let xyz = [field(0, Number::I16), field(2, Number::U8), field(4, Number::F32)];
        let mut data = vec![0xff, 0xfe, 7, 0, 0x3f, 0xc0, 0, 0, 99];
        data.extend([0, 3, 8, 0, 0xbf, 0xc0, 0, 0]);
        let read = cloud(&SHAPE, xyz, &data, 0).expect("two points");
        assert_eq!(read.points_in_sensor, [[-2.0, 7.0, 1.5], [3.0, 8.0, -1.5]]);
        assert!(cloud(&SHAPE, xyz, &data[..16], 0).is_err());
        assert!(cloud(&SHAPE, [xyz[0], None, xyz[2]], &data, 0).is_err());
        let huge = Shape { columns: u32::MAX, rows: u32::MAX, ..SHAPE };
        assert!(cloud(&huge, xyz, &data, 0).is_err());
        let beyond = [field(7, Number::I16), xyz[1], xyz[2]];
        assert!(cloud(&SHAPE, beyond, &data, 0).is_err());
        let none = Shape { rows: 0, ..SHAPE };
        assert!(cloud(&none, xyz, &[], 0).expect("no points").points_in_sensor.is_empty());
    }

    #[test]
    fn depths_become_metres() {
        let shape = Shape { columns: 1, rows: 2, point_step: 0, row_step: 3, big_endian: false };
        let read = depth(&shape, "16UC1", &[0xe8, 3, 0, 0, 0], 1000.0, 0).expect("an image");
        assert_eq!((read.columns, read.rows), (1, 2));
        assert!(read.depths_m[0] == 1.0 && read.depths_m[1].is_nan());
        assert!(depth(&shape, "rgb8", &[0; 9], 1000.0, 0).is_err());
        assert!(depth(&shape, "32FC1", &[0; 9], 1000.0, 0).is_err());
        assert!(depth(&Shape { rows: 0, ..shape }, "16UC1", &[], 1000.0, 0).is_err());
    }
}
