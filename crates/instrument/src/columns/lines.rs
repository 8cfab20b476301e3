//! Line strips of the plane, some per row.

use std::sync::Arc;

use geometry::Point2;
use rerun::external::arrow::array::{ListArray, UInt32Array};
use rerun::external::arrow::buffer::{OffsetBuffer, ScalarBuffer};
use rerun::external::arrow::datatypes::Field;
use rerun::external::re_sdk_types::Loggable as _;
use rerun::{EntityPath, LineStrips2D, RecordingStream};

use super::points::{positions, rounded};
use super::send::{Column, fixed, lengths};
use super::sleeve::Sleeve;
use super::{Now, Rgba, Times, send};
use crate::InstrumentError;

/// Held rows of line strips, each strip with a colour.
pub(crate) struct Lines {
    path: EntityPath,
    times: Times,
    xy: Vec<f32>,
    /// Where each strip ends, in points; begins with 0.
    strip_ends: Vec<i32>,
    colours: Vec<Rgba>,
    row_ends: Vec<i32>,
    shows_any: bool,
    /// Strips of one colour that lie no farther apart are joined, metres.
    joint_m: f32,
    /// Points are left out where the line passes them by no more than this, metres.
    straight_m: f32,
    /// The straight line at the end of what was written.
    sleeve: Sleeve,
    /// Radius and draw order, until they are sent.
    look: Option<(f32, f32)>,
}

impl Lines {
    /// No rows yet; `radius` in screen points where negative, else in metres.
    pub fn new(path: impl AsRef<str>, radius: f32, draw_order: f32) -> Self {
        Self {
            path: path.as_ref().into(),
            times: Times::default(),
            xy: Vec::new(),
            strip_ends: vec![0],
            colours: Vec::new(),
            row_ends: Vec::new(),
            shows_any: false,
            joint_m: 0.0,
            straight_m: 0.0,
            sleeve: Sleeve::at([0.0; 2]),
            look: Some((radius, draw_order)),
        }
    }

    /// The same, but strips that lie no farther apart are joined, metres: each costs its border.
    pub fn joining(self, joint_m: f32) -> Self {
        Self { joint_m, ..self }
    }

    /// The same, but points are left out where the line passes them by no more than this, metres:
    /// a wall is seen by dozens of rays, and drawn by two points.
    pub fn straightening(self, straight_m: f32) -> Self {
        Self { straight_m, ..self }
    }

    /// Adds a strip to the row being written; one that starts where the last one of the same
    /// colour ended is joined to it.
    pub fn strip(&mut self, points: impl IntoIterator<Item = Point2>, colour: Rgba) {
        let before = self.xy.len();
        let mut points = points.into_iter();
        let Some(first) = points.next() else { return };
        let first = [rounded(first.x), rounded(first.y)];
        let row_start = self.row_ends.last().copied().unwrap_or(0) as usize;
        let joins = self.colours.len() > row_start
            && self.colours.last() == Some(&colour)
            && (self.xy[before - 2] - first[0]).abs() <= self.joint_m
            && (self.xy[before - 1] - first[1]).abs() <= self.joint_m;
        if joins {
            self.strip_ends.pop();
        } else {
            self.xy.extend(first);
            self.colours.push(colour);
            self.sleeve = Sleeve::at(first);
        }
        for point in points {
            self.point([rounded(point.x), rounded(point.y)]);
        }
        self.strip_ends.push((self.xy.len() / 2) as i32);
    }

    /// Adds a point to the strip being written.
    fn point(&mut self, next: [f32; 2]) {
        let end = self.xy.len();
        if self.straight_m > 0.0 {
            let last = [self.xy[end - 2], self.xy[end - 1]];
            if self.sleeve.take(last, next, self.straight_m) {
                self.xy.truncate(end - 2);
            }
        }
        self.xy.extend(next);
    }

    /// Adds a straight line to the row being written.
    pub fn segment(&mut self, from: &Point2, to: &Point2, colour: Rgba) {
        self.strip([*from, *to], colour);
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
        let strips = self.row_ends.last().copied().unwrap_or(0) as usize;
        self.colours.truncate(strips);
        self.strip_ends.truncate(strips + 1);
        self.xy.truncate(2 * self.strip_ends[strips] as usize);
    }

    /// Takes back the last row where it belongs to the same step, because a newer state replaces
    /// it.
    pub fn drop_row_of(&mut self, step: i64) {
        if self.times.last_step() != Some(step) {
            return;
        }
        self.times.pop();
        self.row_ends.pop();
        self.forget();
        // What the row before showed may have been sent already: an empty row wipes it for certain.
        self.shows_any = true;
    }

    /// Size of what is held, bytes.
    pub fn held_bytes(&self) -> usize {
        self.xy.len() * 4 + self.colours.len() * 8 + self.times.len() * 48
    }

    /// Sends all rows that were ended.
    pub fn send(&mut self, stream: &RecordingStream) -> Result<(), InstrumentError> {
        self.forget();
        if self.times.len() == 0 {
            return Ok(());
        }
        if let Some((radius, draw_order)) = self.look.take() {
            let look = LineStrips2D::update_fields()
                .with_radii([rerun::Radius::from(radius)])
                .with_draw_order(draw_order);
            fixed(stream, &self.path, &look)?;
        }
        let per_row = lengths(&std::mem::take(&mut self.row_ends));
        let strip_ends = std::mem::replace(&mut self.strip_ends, vec![0]);
        let item = Arc::new(Field::new("item", rerun::Vec2D::arrow_datatype(), false));
        let offsets = OffsetBuffer::new(ScalarBuffer::from(strip_ends));
        let strips = ListArray::new(item, offsets, positions(std::mem::take(&mut self.xy)), None);
        let columns = [
            Column {
                descriptor: LineStrips2D::descriptor_strips(),
                instances: Arc::new(strips),
                lengths: per_row.clone(),
            },
            Column {
                descriptor: LineStrips2D::descriptor_colors(),
                instances: Arc::new(UInt32Array::from(std::mem::take(&mut self.colours))),
                lengths: per_row,
            },
        ];
        send(stream, &self.path, &mut self.times, columns)
    }
}
