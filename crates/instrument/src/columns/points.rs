//! Points of the plane, some per row.

use std::sync::Arc;

use geometry::Point2;
use rerun::external::arrow::array::{ArrayRef, FixedSizeListArray, Float32Array, UInt32Array};
use rerun::external::arrow::datatypes::{DataType, Field};
use rerun::{EntityPath, Points2D, RecordingStream};

use super::send::{Column, fixed, lengths};
use super::{Now, Rgba, Times, send};
use crate::InstrumentError;

/// Coordinates are kept to 1/1024 m: far below what a screen shows, and rows that repeat what the
/// row before held are then equal to the bit, which compresses well.
#[inline]
pub(super) fn rounded(metres: f64) -> f32 {
    // Adding 1.5 * 2^52 rounds to a whole number; `round` is a call on plain x86-64.
    const SHIFT: f64 = 6_755_399_441_055_744.0;
    (((metres * 1024.0 + SHIFT) - SHIFT) * (1.0 / 1024.0)) as f32
}

/// Pairs of coordinates, end to end, as the viewer's points.
pub(super) fn positions(xy: Vec<f32>) -> ArrayRef {
    let item = Arc::new(Field::new("item", DataType::Float32, false));
    Arc::new(FixedSizeListArray::new(item, 2, Arc::new(Float32Array::from(xy)), None))
}

/// Held rows of points, each point with a colour.
pub(crate) struct Points {
    path: EntityPath,
    times: Times,
    xy: Vec<f32>,
    colours: Vec<Rgba>,
    row_ends: Vec<i32>,
    shows_any: bool,
    /// Radius and draw order, until they are sent.
    look: Option<(f32, f32)>,
}

impl Points {
    /// No rows yet; `radius` in screen points where negative, else in metres.
    pub fn new(path: impl AsRef<str>, radius: f32, draw_order: f32) -> Self {
        Self {
            path: path.as_ref().into(),
            times: Times::default(),
            xy: Vec::new(),
            colours: Vec::new(),
            row_ends: Vec::new(),
            shows_any: false,
            look: Some((radius, draw_order)),
        }
    }

    /// Adds a point to the row being written.
    pub fn point(&mut self, at: &Point2, colour: Rgba) {
        self.xy.push(rounded(at.x));
        self.xy.push(rounded(at.y));
        self.colours.push(colour);
    }

    /// Ends the row. An empty row is kept only where it wipes out one that was not empty.
    pub fn end_row(&mut self, now: &Now) {
        let start = self.row_ends.last().copied().unwrap_or(0);
        let end = self.colours.len() as i32;
        if end > start || self.shows_any {
            self.row_ends.push(end);
            self.times.push(now);
            self.shows_any = end > start;
        }
    }

    /// Takes back what was added to the row being written.
    pub fn forget(&mut self) {
        let points = self.row_ends.last().copied().unwrap_or(0) as usize;
        self.colours.truncate(points);
        self.xy.truncate(2 * points);
    }

    /// Size of what is held, bytes.
    pub fn held_bytes(&self) -> usize {
        self.xy.len() * 6 + self.times.len() * 48
    }

    /// Sends all rows that were ended.
    pub fn send(&mut self, stream: &RecordingStream) -> Result<(), InstrumentError> {
        self.forget();
        if self.times.len() == 0 {
            return Ok(());
        }
        if let Some((radius, draw_order)) = self.look.take() {
            let look = Points2D::update_fields()
                .with_radii([rerun::Radius::from(radius)])
                .with_draw_order(draw_order);
            fixed(stream, &self.path, &look)?;
        }
        let per_row = lengths(&std::mem::take(&mut self.row_ends));
        let columns = [
            Column {
                descriptor: Points2D::descriptor_positions(),
                instances: positions(std::mem::take(&mut self.xy)),
                lengths: per_row.clone(),
            },
            Column {
                descriptor: Points2D::descriptor_colors(),
                instances: Arc::new(UInt32Array::from(std::mem::take(&mut self.colours))),
                lengths: per_row,
            },
        ];
        send(stream, &self.path, &mut self.times, columns)
    }
}

#[cfg(test)]
mod tests {
    use super::rounded;

    #[test]
    fn coordinates_are_rounded_to_a_1024th_of_a_metre() {
        for (metres, kept) in [(0.0, 0.0), (1.0, 1.0), (-2.5, -2.5), (1e-4, 0.0), (-1e-4, -0.0)] {
            assert_eq!(rounded(metres), kept);
        }
        for i in -3000..3000 {
            let metres = f64::from(i) * 0.337;
            let kept = f64::from(rounded(metres));
            assert!((kept - metres).abs() <= 0.5 / 1024.0, "{metres} became {kept}");
            assert_eq!((kept * 1024.0).fract(), 0.0, "{metres} became {kept}");
        }
    }
}
