//! Messages of Foxglove's schemas as protocol buffers.

use std::sync::Arc;

use pose::Se3;
use sensing::Camera;

use super::blocks::{self, MAX_COEFFICIENTS, MAX_RAYS, MAX_TRANSFORMS};
use super::decoder::ScanExtras;
use super::packed::{self, Number, Shape};
use super::proto::{Field, Fields};
use super::{Frames, Malformed, own_proto};
use crate::log::{
    CameraMessage, CloudMessage, Content, ContentKind, DepthMessage, Header, PoseMessage,
    ScanMessage, Stamp, Transform,
};

/// What one message says; `several` tells a message of transforms from a single one.
pub(crate) fn decode(
    kind: ContentKind,
    several: bool,
    bytes: &[u8],
    frames: &mut Frames,
    extras: &ScanExtras,
    units_per_metre: f64,
) -> Result<Content, Malformed> {
    Ok(match kind {
        ContentKind::Scan => Content::Scan(scan(bytes, frames, extras)?),
        ContentKind::Transforms if several => Content::Transforms(transforms(bytes, frames)?),
        ContentKind::Transforms => {
            Content::Transforms(vec![transform(Fields::new(bytes), 0, frames)?])
        }
        ContentKind::Cloud => Content::Cloud(cloud(bytes, frames)?),
        ContentKind::Depth => Content::Depth(image(bytes, frames, units_per_metre)?),
        ContentKind::Camera => Content::Camera(camera(bytes, frames)?),
        ContentKind::Pose => Content::Pose(pose_in_frame(bytes, frames)?),
        ContentKind::Edge => Content::Edge(own_proto::edge(bytes)?),
        ContentKind::Standing => Content::Standing(own_proto::standing(bytes)?),
        ContentKind::Decision => Content::Decision(own_proto::decision(bytes)?),
        ContentKind::Odometry => {
            return Err(Malformed { at: 0, found: "a type that Foxglove does not have" });
        }
    })
}

/// Walks over all fields of a message.
pub(super) fn each<'a>(
    mut fields: Fields<'a>,
    mut on: impl FnMut(Field<'a>) -> Result<(), Malformed>,
) -> Result<(), Malformed> {
    while let Some(field) = fields.next_field()? {
        on(field)?;
    }
    Ok(())
}

pub(super) fn stamp(field: &Field<'_>) -> Result<Stamp, Malformed> {
    let (mut secs, mut nanos) = (0, 0);
    each(field.message()?, |part| {
        match part.number {
            1 => secs = part.varint()? as i64,
            2 => nanos = part.varint()? as u32,
            _ => {}
        }
        Ok(())
    })?;
    Ok(Stamp::from_parts(secs, nanos))
}

/// Numbered doubles from 1 on, as in vectors and quaternions.
pub(super) fn numbers<const N: usize>(field: &Field<'_>) -> Result<[f64; N], Malformed> {
    let mut numbers = [0.0; N];
    each(field.message()?, |part| {
        if let Some(number) = numbers.get_mut(part.number as usize - 1) {
            *number = part.double()?;
        }
        Ok(())
    })?;
    Ok(numbers)
}

/// The pose of a field; what is left out of it is no motion.
fn pose(field: &Field<'_>) -> Result<Se3, Malformed> {
    let mut position = [0.0; 3];
    let mut xyzw = None;
    each(field.message()?, |part| {
        match part.number {
            1 => position = numbers(&part)?,
            2 => xyzw = Some(numbers(&part)?),
            _ => {}
        }
        Ok(())
    })?;
    blocks::pose(position, xyzw.unwrap_or([0.0, 0.0, 0.0, 1.0]), field.at)
}

/// Stamp and frame, as they come.
struct Head {
    stamp: Stamp,
    frame: Arc<str>,
}

impl Head {
    fn new(frames: &mut Frames) -> Self {
        Self { stamp: Stamp::default(), frame: frames.name("") }
    }

    fn header(self) -> Header {
        Header { stamp: self.stamp, frame: self.frame }
    }
}

fn scan(bytes: &[u8], frames: &mut Frames, extras: &ScanExtras) -> Result<ScanMessage, Malformed> {
    let mut head = Head::new(frames);
    let mut frame_from_sensor = None;
    let (mut first_rad, mut last_rad) = (0.0, 0.0);
    let mut ranges_m = Vec::new();
    each(Fields::new(bytes), |field| {
        match field.number {
            1 => head.stamp = stamp(&field)?,
            2 => head.frame = frames.name(field.text()?),
            3 => frame_from_sensor = Some(pose(&field)?).filter(|pose| *pose != Se3::identity()),
            4 => first_rad = field.double()?,
            5 => last_rad = field.double()?,
            6 => field.doubles(&mut ranges_m, MAX_RAYS)?,
            _ => {}
        }
        Ok(())
    })?;
    let scan = extras.scan(first_rad, last_rad, ranges_m)?;
    let range_min_m = extras.range_min_m;
    Ok(ScanMessage { header: head.header(), scan, range_min_m, frame_from_sensor })
}

fn transforms(bytes: &[u8], frames: &mut Frames) -> Result<Vec<Transform>, Malformed> {
    let mut transforms = Vec::new();
    each(Fields::new(bytes), |field| {
        if field.number == 1 {
            if transforms.len() == MAX_TRANSFORMS {
                return field.malformed("more transforms than one message may have");
            }
            transforms.push(transform(field.message()?, field.at, frames)?);
        }
        Ok(())
    })?;
    Ok(transforms)
}

fn transform(fields: Fields<'_>, at: usize, frames: &mut Frames) -> Result<Transform, Malformed> {
    let mut head = Head::new(frames);
    let mut child_frame = frames.name("");
    let mut position = [0.0; 3];
    let mut xyzw = [0.0, 0.0, 0.0, 1.0];
    each(fields, |field| {
        match field.number {
            1 => head.stamp = stamp(&field)?,
            2 => head.frame = frames.name(field.text()?),
            3 => child_frame = frames.name(field.text()?),
            4 => position = numbers(&field)?,
            5 => xyzw = numbers(&field)?,
            _ => {}
        }
        Ok(())
    })?;
    let parent_from_child = blocks::pose(position, xyzw, at)?;
    Ok(Transform { header: head.header(), child_frame, parent_from_child })
}

fn cloud(bytes: &[u8], frames: &mut Frames) -> Result<CloudMessage, Malformed> {
    let mut head = Head::new(frames);
    let mut frame_from_sensor = Se3::identity();
    let mut point_step = 0;
    let mut xyz = [None; 3];
    let mut data: &[u8] = &[];
    each(Fields::new(bytes), |field| {
        match field.number {
            1 => head.stamp = stamp(&field)?,
            2 => head.frame = frames.name(field.text()?),
            3 => frame_from_sensor = pose(&field)?,
            4 => point_step = field.fixed32()?,
            5 => {
                let (mut name, mut offset, mut number) = ("", 0, None);
                each(field.message()?, |part| {
                    match part.number {
                        1 => name = part.text()?,
                        2 => offset = part.fixed32()?,
                        3 => number = Number::of_foxglove(part.varint()?),
                        _ => {}
                    }
                    Ok(())
                })?;
                if let (Some(axis), Some(number)) = (packed::axis(name), number) {
                    xyz[axis] = Some(packed::Field { offset, number });
                }
            }
            6 => data = field.bytes()?,
            _ => {}
        }
        Ok(())
    })?;
    let cloud = packed::stream(point_step, xyz, data, &frame_from_sensor)?;
    Ok(CloudMessage { header: head.header(), cloud })
}

fn image(
    bytes: &[u8],
    frames: &mut Frames,
    units_per_metre: f64,
) -> Result<DepthMessage, Malformed> {
    let mut head = Head::new(frames);
    let (mut columns, mut rows, mut row_step) = (0, 0, 0);
    let mut encoding = "";
    let mut data: &[u8] = &[];
    each(Fields::new(bytes), |field| {
        match field.number {
            1 => head.stamp = stamp(&field)?,
            7 => head.frame = frames.name(field.text()?),
            2 => columns = field.fixed32()?,
            3 => rows = field.fixed32()?,
            4 => encoding = field.text()?,
            5 => row_step = field.fixed32()?,
            6 => data = field.bytes()?,
            _ => {}
        }
        Ok(())
    })?;
    let shape = Shape { columns, rows, point_step: 0, row_step, big_endian: false };
    let pixels = packed::depth(&shape, encoding, data, units_per_metre, 0)?;
    Ok(DepthMessage { header: head.header(), pixels })
}

fn camera(bytes: &[u8], frames: &mut Frames) -> Result<CameraMessage, Malformed> {
    let mut head = Head::new(frames);
    let (mut columns, mut rows) = (0, 0);
    let mut distortion_model = String::new();
    let (mut distortion, mut intrinsics) = (Vec::new(), Vec::new());
    each(Fields::new(bytes), |field| {
        match field.number {
            1 => head.stamp = stamp(&field)?,
            9 => head.frame = frames.name(field.text()?),
            2 => columns = field.fixed32()?,
            3 => rows = field.fixed32()?,
            4 => distortion_model = field.text()?.to_owned(),
            5 => field.doubles(&mut distortion, MAX_COEFFICIENTS)?,
            6 => field.doubles(&mut intrinsics, 9)?,
            _ => {}
        }
        Ok(())
    })?;
    let camera = intrinsics_of(&intrinsics)?;
    let header = head.header();
    Ok(CameraMessage { header, columns, rows, camera, distortion_model, distortion })
}

/// The camera of a row-major 3 × 3 matrix.
pub(crate) fn intrinsics_of(matrix: &[f64]) -> Result<Camera, Malformed> {
    match *matrix {
        [fx, _, cx, _, fy, cy, _, _, _] => Ok(Camera::new(fx, fy, cx, cy)),
        _ => Err(Malformed { at: 0, found: "a camera without the nine numbers of its matrix" }),
    }
}

fn pose_in_frame(bytes: &[u8], frames: &mut Frames) -> Result<PoseMessage, Malformed> {
    let mut head = Head::new(frames);
    let mut frame_from_body = Se3::identity();
    each(Fields::new(bytes), |field| {
        match field.number {
            1 => head.stamp = stamp(&field)?,
            2 => head.frame = frames.name(field.text()?),
            3 => frame_from_body = pose(&field)?,
            _ => {}
        }
        Ok(())
    })?;
    Ok(PoseMessage { header: head.header(), frame_from_body })
}
