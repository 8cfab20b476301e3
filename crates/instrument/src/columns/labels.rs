//! Words at places of the plane.

use std::sync::Arc;

use geometry::Point2;
use rerun::external::arrow::array::{StringArray, UInt32Array};
use rerun::{EntityPath, Points2D, RecordingStream};

use super::points::{positions, rounded};
use super::send::{Column, fixed};
use super::{Now, Rgba, Times, send};
use crate::InstrumentError;

/// Held rows of labelled points, one per row; each stands until the next.
pub(crate) struct Labels {
    path: EntityPath,
    times: Times,
    xy: Vec<f32>,
    colours: Vec<Rgba>,
    texts: Vec<String>,
    /// Draw order, until it is sent.
    draw_order: Option<f32>,
}

impl Labels {
    /// No rows yet.
    pub fn new(path: impl AsRef<str>, draw_order: f32) -> Self {
        Self {
            path: path.as_ref().into(),
            times: Times::default(),
            xy: Vec::new(),
            colours: Vec::new(),
            texts: Vec::new(),
            draw_order: Some(draw_order),
        }
    }

    /// Writes words at a point from now on.
    pub fn put(&mut self, at: &Point2, text: &str, colour: Rgba, now: &Now) {
        self.xy.extend([rounded(at.x), rounded(at.y)]);
        self.colours.push(colour);
        self.texts.push(text.to_owned());
        self.times.push(now);
    }

    /// Sends what is held.
    pub fn send(&mut self, stream: &RecordingStream) -> Result<(), InstrumentError> {
        let rows = self.times.len();
        if rows == 0 {
            return Ok(());
        }
        if let Some(draw_order) = self.draw_order.take() {
            let look = Points2D::update_fields()
                .with_radii([rerun::Radius::new_ui_points(3.0)])
                .with_draw_order(draw_order);
            fixed(stream, &self.path, &look)?;
        }
        let columns = [
            Column {
                descriptor: Points2D::descriptor_positions(),
                instances: positions(std::mem::take(&mut self.xy)),
                lengths: vec![1; rows],
            },
            Column {
                descriptor: Points2D::descriptor_colors(),
                instances: Arc::new(UInt32Array::from(std::mem::take(&mut self.colours))),
                lengths: vec![1; rows],
            },
            Column {
                descriptor: Points2D::descriptor_labels(),
                instances: Arc::new(StringArray::from(std::mem::take(&mut self.texts))),
                lengths: vec![1; rows],
            },
        ];
        send(stream, &self.path, &mut self.times, columns)
    }
}
