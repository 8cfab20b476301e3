//! A cloud of points in memory.

/// Points in the frame of the sensor that took them, metres; NaN where a pixel has none.
///
/// Organised clouds have a point per pixel, row by row from the top; others have one row.
#[derive(Clone, Debug)]
pub struct Cloud {
    /// Points per row.
    pub columns: usize,
    /// Number of rows; 1 where the points are in no image.
    pub rows: usize,
    /// The points, `columns * rows` of them.
    pub points_in_sensor: Vec<[f32; 3]>,
}
