//! One pose per row: where a frame lies in the frame of its parent.

use std::sync::Arc;

use pose::Se2;
use rerun::external::arrow::array::{ArrayRef, FixedSizeListArray, Float32Array};
use rerun::external::arrow::datatypes::{DataType, Field};
use rerun::{EntityPath, RecordingStream, Transform3D};

use super::send::Column;
use super::{Now, Times, fixed, send};
use crate::InstrumentError;

/// Held rows of the pose of a frame, `parent_from_frame`.
pub(crate) struct Poses {
    path: EntityPath,
    times: Times,
    translations: Vec<f32>,
    quaternions: Vec<f32>,
    scales: Vec<f32>,
    /// Whether the frame is one to look from: its y axis points down, as on a screen.
    upside_down: bool,
}

/// The transform of a frame to look from: the viewer draws y downwards, and turns that round.
pub(crate) fn eye(stream: &RecordingStream, path: &str) -> Result<(), InstrumentError> {
    fixed(stream, &path.into(), &Transform3D::from_scale([1.0, -1.0, 1.0]))
}

/// A frame that stays where it is.
pub(crate) fn fixed_pose(
    stream: &RecordingStream,
    path: &str,
    parent_from_frame: &Se2,
) -> Result<(), InstrumentError> {
    let transform = Transform3D::from_translation(translation(parent_from_frame))
        .with_quaternion(rerun::Quaternion::from_xyzw(quaternion(parent_from_frame)));
    fixed(stream, &path.into(), &transform)
}

fn translation(pose: &Se2) -> [f32; 3] {
    [pose.translation.x as f32, pose.translation.y as f32, 0.0]
}

fn quaternion(pose: &Se2) -> [f32; 4] {
    let (sin, cos) = (0.5 * pose.angle()).sin_cos();
    [0.0, 0.0, sin as f32, cos as f32]
}

impl Poses {
    /// No rows yet.
    pub fn new(path: &str) -> Self {
        Self {
            path: path.into(),
            times: Times::default(),
            translations: Vec::new(),
            quaternions: Vec::new(),
            scales: Vec::new(),
            upside_down: false,
        }
    }

    /// No rows yet, for a frame to look from.
    pub fn eye(path: &str) -> Self {
        Self { upside_down: true, ..Self::new(path) }
    }

    /// Adds a row.
    pub fn push(&mut self, parent_from_frame: &Se2, now: &Now) {
        self.translations.extend(translation(parent_from_frame));
        self.quaternions.extend(quaternion(parent_from_frame));
        if self.upside_down {
            self.scales.extend([1.0, -1.0, 1.0]);
        }
        self.times.push(now);
    }

    /// Sends what is held.
    pub fn send(&mut self, stream: &RecordingStream) -> Result<(), InstrumentError> {
        let lengths = vec![1; self.times.len()];
        let mut columns = vec![
            (Transform3D::descriptor_translation(), tuples(&mut self.translations, 3)),
            (Transform3D::descriptor_quaternion(), tuples(&mut self.quaternions, 4)),
        ];
        if self.upside_down {
            columns.push((Transform3D::descriptor_scale(), tuples(&mut self.scales, 3)));
        }
        let columns = columns.into_iter().map(|(descriptor, instances)| Column {
            descriptor,
            instances,
            lengths: lengths.clone(),
        });
        send(stream, &self.path, &mut self.times, columns)
    }
}

fn tuples(numbers: &mut Vec<f32>, size: i32) -> ArrayRef {
    let item = Arc::new(Field::new("item", DataType::Float32, false));
    let numbers = Float32Array::from(std::mem::take(numbers));
    Arc::new(FixedSizeListArray::new(item, size, Arc::new(numbers), None))
}
