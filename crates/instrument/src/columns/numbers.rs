//! One number per row: a plot.

use std::sync::Arc;

use rerun::external::arrow::array::Float64Array;
use rerun::{EntityPath, RecordingStream, Scalars, SeriesLines};

use super::send::Column;
use super::{Now, Rgba, Times, fixed, send};
use crate::InstrumentError;

/// Held rows of a plotted number.
///
/// A number that stays the same is written where that begins and where it ends: the plotted line is
/// the same.
pub(crate) struct Numbers {
    path: EntityPath,
    times: Times,
    values: Vec<f64>,
    /// The last number, and when it came.
    last: Option<(f64, Now)>,
    /// Whether that row is left out so far.
    left_out: bool,
    /// Name in the legend and colour, until they are sent.
    look: Option<(String, Rgba)>,
}

impl Numbers {
    /// No rows yet.
    pub fn new(path: &str, name: String, colour: Rgba) -> Self {
        let look = Some((name, colour));
        Self {
            path: path.into(),
            times: Times::default(),
            values: Vec::new(),
            last: None,
            left_out: false,
            look,
        }
    }

    /// Adds a row.
    pub fn push(&mut self, value: f64, now: &Now) {
        let same = self.last.is_some_and(|(last, _)| last.to_bits() == value.to_bits());
        if !same {
            self.write_left_out();
            self.values.push(value);
            self.times.push(now);
        }
        self.left_out = same;
        self.last = Some((value, *now));
    }

    fn write_left_out(&mut self) {
        if let (true, Some((value, now))) = (self.left_out, &self.last) {
            self.values.push(*value);
            self.times.push(now);
        }
        self.left_out = false;
    }

    /// Sends what is held.
    pub fn send(&mut self, stream: &RecordingStream) -> Result<(), InstrumentError> {
        self.write_left_out();
        if let Some((name, colour)) = self.look.take() {
            let look = SeriesLines::new()
                .with_names([name])
                .with_colors([rerun::Color::from_u32(colour)])
                .with_widths([1.5]);
            fixed(stream, &self.path, &look)?;
        }
        let lengths = vec![1; self.values.len()];
        let values = Float64Array::from(std::mem::take(&mut self.values));
        let descriptor = Scalars::descriptor_scalars();
        let column = Column { descriptor, instances: Arc::new(values), lengths };
        send(stream, &self.path, &mut self.times, [column])
    }
}
