//! Clouds of points in PLY files: the vertices, whatever else the file holds.

use crate::error::{Position, check_size};
use crate::{Cloud, FormatError, ply};

/// Reads the x, y and z of the vertices.
///
/// A cloud is organised where the header has `obj_info num_cols` and `num_rows` whose product is the
/// count of vertices. Cost: linear in the bytes.
///
/// # Errors
/// As [`ply::read`]; [`FormatError::Unexpected`] where there are no vertices with x, y and z.
pub fn read(bytes: &[u8]) -> Result<Cloud, FormatError> {
    let file = ply::read(bytes)?;
    let start = Position::Line { line: 1, column: 1 };
    let columns = file.element("vertex").map(|vertices| {
        (
            vertices.count,
            ["x", "y", "z"].map(|name| vertices.column(name).filter(|c| c.ends.is_empty())),
        )
    });
    let Some((count, [Some(x), Some(y), Some(z)])) = columns else {
        let found = "no element `vertex` with numbers x, y and z";
        return Err(FormatError::unexpected(start, found, "a cloud of points"));
    };
    check_size(start, count as u64, 1)?;
    #[expect(clippy::cast_possible_truncation, reason = "points are kept as sensors give them")]
    let points_in_sensor =
        (0..count).map(|i| [x, y, z].map(|column| column.values[i] as f32)).collect();
    let (columns, rows) = match grid(bytes) {
        [Some(columns), Some(rows)] if columns.checked_mul(rows) == Some(count) => (columns, rows),
        _ => (count, 1),
    };
    Ok(Cloud { columns, rows, points_in_sensor })
}

/// `obj_info num_cols` and `num_rows` of the header.
fn grid(bytes: &[u8]) -> [Option<usize>; 2] {
    let mut grid = [None; 2];
    for line in
        bytes.split(|&byte| byte == b'\n').take_while(|line| !line.starts_with(b"end_header"))
    {
        let line = String::from_utf8_lossy(line);
        if let ["obj_info", key, value] = *line.split_whitespace().collect::<Vec<_>>()
            && let Some(axis) = ["num_cols", "num_rows"].iter().position(|name| *name == key)
        {
            grid[axis] = value.parse().ok();
        }
    }
    grid
}

#[cfg(test)]
mod tests {
    use super::*;

    const ASCII: &str = "ply\nformat ascii 1.0\nobj_info num_cols 1\nobj_info num_rows 2\n\
        element vertex 2\nproperty float x\nproperty uchar red\nproperty double y\n\
        property float z\nend_header\n1 255 2 3\nnan 0 5 6\n";

    #[test]
    fn vertices_are_points() {
        let cloud = read(ASCII.as_bytes()).expect("a cloud");
        assert_eq!((cloud.columns, cloud.rows), (1, 2));
        assert_eq!(format!("{:?}", cloud.points_in_sensor), "[[1.0, 2.0, 3.0], [NaN, 5.0, 6.0]]");
        let plain = read(ASCII.replace("num_cols 1", "num_cols 3").as_bytes()).expect("a cloud");
        assert_eq!((plain.columns, plain.rows), (2, 1));
        let flat = read(ASCII.replace("float x", "float q").as_bytes()).expect_err("no x");
        assert!(flat.to_string().contains("no element `vertex` with numbers x"), "{flat}");
    }
}
