//! Messages of Foxglove's schemas as JSON; lists of bytes are texts in base64.

use std::sync::Arc;

use pose::Se3;

use super::blocks::{self, MAX_COEFFICIENTS, MAX_RAYS, MAX_TRANSFORMS};
use super::decoder::ScanExtras;
use super::foxglove_proto::intrinsics_of;
use super::json::{Json, base64};
use super::packed::{self, Number, Shape};
use super::{Frames, Malformed};
use crate::log::{
    CameraMessage, CloudMessage, Content, ContentKind, DepthMessage, Header, PoseMessage,
    ScanMessage, Stamp, Transform,
};

/// The longest message, bytes: numbers take up to eight times the memory of their text.
const MAX_BYTES: usize = 8 << 20;

/// What one message says; `several` tells a message of transforms from a single one.
pub(crate) fn decode(
    kind: ContentKind,
    several: bool,
    bytes: &[u8],
    frames: &mut Frames,
    extras: &ScanExtras,
    units_per_metre: f64,
) -> Result<Content, Malformed> {
    if bytes.len() > MAX_BYTES {
        return Err(Malformed { at: 0, found: "a JSON message of more than 8 MiB" });
    }
    let mut json = Json::new(bytes);
    let parts = Parts::read(&mut json, frames)?;
    json.end()?;
    let header = Header { stamp: parts.stamp, frame: parts.frame };
    Ok(match kind {
        ContentKind::Scan => {
            let scan = extras.scan(parts.start_angle, parts.end_angle, parts.ranges)?;
            let frame_from_sensor = parts.pose.filter(|pose| *pose != Se3::identity());
            let range_min_m = extras.range_min_m;
            Content::Scan(ScanMessage { header, scan, range_min_m, frame_from_sensor })
        }
        ContentKind::Transforms if several => Content::Transforms(parts.transforms),
        ContentKind::Transforms => {
            let parent_from_child = blocks::pose(parts.translation, parts.rotation, 0)?;
            let child_frame = parts.child_frame;
            Content::Transforms(vec![Transform { header, child_frame, parent_from_child }])
        }
        ContentKind::Cloud => {
            let pose = parts.pose.unwrap_or_default();
            let cloud = packed::stream(parts.point_stride, parts.xyz, &parts.data, &pose)?;
            Content::Cloud(CloudMessage { header, cloud })
        }
        ContentKind::Depth => {
            let [columns, rows] = parts.size;
            let shape =
                Shape { columns, rows, point_step: 0, row_step: parts.step, big_endian: false };
            let pixels = packed::depth(&shape, &parts.encoding, &parts.data, units_per_metre, 0)?;
            Content::Depth(DepthMessage { header, pixels })
        }
        ContentKind::Camera => Content::Camera(CameraMessage {
            header,
            columns: parts.size[0],
            rows: parts.size[1],
            camera: intrinsics_of(&parts.intrinsics)?,
            distortion_model: parts.distortion_model,
            distortion: parts.distortion,
        }),
        ContentKind::Pose => {
            let frame_from_body = parts.pose.unwrap_or_default();
            Content::Pose(PoseMessage { header, frame_from_body })
        }
        ContentKind::Odometry
        | ContentKind::Edge
        | ContentKind::Standing
        | ContentKind::Decision => {
            return Err(Malformed { at: 0, found: "a type that is not written as JSON" });
        }
    })
}

/// The fields of all schemas; none has a name for two meanings.
struct Parts {
    stamp: Stamp,
    frame: Arc<str>,
    child_frame: Arc<str>,
    pose: Option<Se3>,
    translation: [f64; 3],
    rotation: [f64; 4],
    start_angle: f64,
    end_angle: f64,
    ranges: Vec<f64>,
    transforms: Vec<Transform>,
    point_stride: u32,
    xyz: [Option<packed::Field>; 3],
    size: [u32; 2],
    encoding: String,
    step: u32,
    data: Vec<u8>,
    distortion_model: String,
    distortion: Vec<f64>,
    intrinsics: Vec<f64>,
}

impl Parts {
    fn new(frames: &mut Frames) -> Self {
        Self {
            stamp: Stamp::default(),
            frame: frames.name(""),
            child_frame: frames.name(""),
            pose: None,
            translation: [0.0; 3],
            rotation: [0.0, 0.0, 0.0, 1.0],
            start_angle: 0.0,
            end_angle: 0.0,
            ranges: Vec::new(),
            transforms: Vec::new(),
            point_stride: 0,
            xyz: [None; 3],
            size: [0; 2],
            encoding: String::new(),
            step: 0,
            data: Vec::new(),
            distortion_model: String::new(),
            distortion: Vec::new(),
            intrinsics: Vec::new(),
        }
    }

    fn read(json: &mut Json<'_>, frames: &mut Frames) -> Result<Self, Malformed> {
        let mut parts = Self::new(frames);
        json.object(|json, key| parts.field(json, key, frames))?;
        Ok(parts)
    }

    fn field(
        &mut self,
        json: &mut Json<'_>,
        key: &str,
        frames: &mut Frames,
    ) -> Result<(), Malformed> {
        match key {
            "timestamp" => self.stamp = stamp(json)?,
            "frame_id" | "parent_frame_id" => self.frame = frames.name(&json.text()?),
            "child_frame_id" => self.child_frame = frames.name(&json.text()?),
            "pose" => self.pose = Some(pose(json)?),
            "translation" => self.translation = axes(json, [0.0; 3])?,
            "rotation" => self.rotation = axes(json, [0.0, 0.0, 0.0, 1.0])?,
            "start_angle" => self.start_angle = json.number()?,
            "end_angle" => self.end_angle = json.number()?,
            "ranges" => json.numbers(&mut self.ranges, MAX_RAYS)?,
            "transforms" => json.list(|json| {
                if self.transforms.len() == MAX_TRANSFORMS {
                    return json.malformed("more transforms than one message may have");
                }
                let mut one = OneTransform::new(frames);
                json.object(|json, key| one.field(json, key, frames))?;
                self.transforms.push(one.done()?);
                Ok(())
            })?,
            "point_stride" => self.point_stride = json.count()?,
            "fields" => json.list(|json| {
                let (mut name, mut offset, mut number) = (String::new(), 0, None);
                json.object(|json, key| {
                    match key {
                        "name" => name = json.text()?.into_owned(),
                        "offset" => offset = json.count()?,
                        "type" => number = Number::of_foxglove(u64::from(json.count()?)),
                        _ => json.skip()?,
                    }
                    Ok(())
                })?;
                if let (Some(axis), Some(number)) = (packed::axis(&name), number) {
                    self.xyz[axis] = Some(packed::Field { offset, number });
                }
                Ok(())
            })?,
            "width" => self.size[0] = json.count()?,
            "height" => self.size[1] = json.count()?,
            "encoding" => self.encoding = json.text()?.into_owned(),
            "step" => self.step = json.count()?,
            "data" => self.data = base64(&json.text()?, 0)?,
            "distortion_model" => self.distortion_model = json.text()?.into_owned(),
            "D" => json.numbers(&mut self.distortion, MAX_COEFFICIENTS)?,
            "K" => json.numbers(&mut self.intrinsics, 9)?,
            _ => json.skip()?,
        }
        Ok(())
    }
}

/// One of a list of transforms: few fields, since there can be many.
struct OneTransform {
    stamp: Stamp,
    frame: Arc<str>,
    child_frame: Arc<str>,
    translation: [f64; 3],
    rotation: [f64; 4],
}

impl OneTransform {
    fn new(frames: &mut Frames) -> Self {
        let none = frames.name("");
        Self {
            stamp: Stamp::default(),
            frame: Arc::clone(&none),
            child_frame: none,
            translation: [0.0; 3],
            rotation: [0.0, 0.0, 0.0, 1.0],
        }
    }

    fn field(
        &mut self,
        json: &mut Json<'_>,
        key: &str,
        frames: &mut Frames,
    ) -> Result<(), Malformed> {
        match key {
            "timestamp" => self.stamp = stamp(json)?,
            "parent_frame_id" => self.frame = frames.name(&json.text()?),
            "child_frame_id" => self.child_frame = frames.name(&json.text()?),
            "translation" => self.translation = axes(json, [0.0; 3])?,
            "rotation" => self.rotation = axes(json, [0.0, 0.0, 0.0, 1.0])?,
            _ => json.skip()?,
        }
        Ok(())
    }

    fn done(self) -> Result<Transform, Malformed> {
        let header = Header { stamp: self.stamp, frame: self.frame };
        let parent_from_child = blocks::pose(self.translation, self.rotation, 0)?;
        Ok(Transform { header, child_frame: self.child_frame, parent_from_child })
    }
}

fn stamp(json: &mut Json<'_>) -> Result<Stamp, Malformed> {
    let (mut secs, mut nanos) = (0, 0);
    json.object(|json, key| {
        match key {
            "sec" => secs = json.whole()?,
            "nsec" => nanos = json.count()?,
            _ => json.skip()?,
        }
        Ok(())
    })?;
    Ok(Stamp::from_parts(secs, nanos))
}

/// The numbers named x, y, z and w.
fn axes<const N: usize>(json: &mut Json<'_>, unset: [f64; N]) -> Result<[f64; N], Malformed> {
    let mut numbers = unset;
    json.object(|json, key| {
        let axis = ["x", "y", "z", "w"].iter().position(|axis| *axis == key);
        match axis.and_then(|axis| numbers.get_mut(axis)) {
            Some(number) => *number = json.number()?,
            None => json.skip()?,
        }
        Ok(())
    })?;
    Ok(numbers)
}

fn pose(json: &mut Json<'_>) -> Result<Se3, Malformed> {
    let (mut position, mut xyzw) = ([0.0; 3], [0.0, 0.0, 0.0, 1.0]);
    json.object(|json, key| {
        match key {
            "position" => position = axes(json, position)?,
            "orientation" => xyzw = axes(json, [0.0, 0.0, 0.0, 1.0])?,
            _ => json.skip()?,
        }
        Ok(())
    })?;
    blocks::pose(position, xyzw, 0)
}
