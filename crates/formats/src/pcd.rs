//! PCD clouds: `ascii`, `binary` and `binary_compressed`.

mod body;
mod header;

use crate::{Cloud, FormatError};
use body::{gather, need, read_ascii, unpack};
use header::{Data, read_header};

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
