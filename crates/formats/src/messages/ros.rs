//! Messages of ROS 1 and ROS 2.
//!
//! Both have the same fields in the same order; only the header of ROS 1 begins with a counter.

use std::sync::Arc;

use pose::Se3;
use sensing::Camera;

use super::blocks::{self, MAX_COEFFICIENTS, MAX_RAYS, MAX_TRANSFORMS};
use super::packed::{self, Field, Number};
use super::wire::{Layout, Wire};
use super::{Frames, Malformed};
use crate::log::{
    CameraMessage, CloudMessage, Content, ContentKind, DepthMessage, Header, OdometryMessage,
    PoseMessage, ScanMessage, Stamp, Transform,
};

/// What messages of a type say; `None` for types that are not read.
pub(crate) fn kind_of(schema: &str) -> Option<ContentKind> {
    let (package, name) = schema.split_once('/')?;
    let name = name.strip_prefix("msg/").unwrap_or(name);
    match (package, name) {
        ("sensor_msgs", "LaserScan") => Some(ContentKind::Scan),
        ("sensor_msgs", "PointCloud2") => Some(ContentKind::Cloud),
        ("sensor_msgs", "Image") => Some(ContentKind::Depth),
        ("sensor_msgs", "CameraInfo") => Some(ContentKind::Camera),
        ("nav_msgs", "Odometry") => Some(ContentKind::Odometry),
        ("geometry_msgs", "PoseStamped") => Some(ContentKind::Pose),
        ("tf2_msgs", "TFMessage") | ("tf", "tfMessage") => Some(ContentKind::Transforms),
        _ => None,
    }
}

/// What one message says; `units_per_metre` is that of depth images of whole numbers.
pub(crate) fn decode(
    kind: ContentKind,
    layout: Layout,
    bytes: &[u8],
    frames: &mut Frames,
    units_per_metre: f64,
) -> Result<Content, Malformed> {
    let wire = &mut Wire::new(bytes, layout)?;
    Ok(match kind {
        ContentKind::Scan => Content::Scan(scan(wire, frames)?),
        ContentKind::Odometry => Content::Odometry(odometry(wire, frames)?),
        ContentKind::Transforms => Content::Transforms(transforms(wire, frames)?),
        ContentKind::Cloud => Content::Cloud(cloud(wire, frames)?),
        ContentKind::Depth => Content::Depth(image(wire, frames, units_per_metre)?),
        ContentKind::Camera => Content::Camera(camera(wire, frames)?),
        ContentKind::Pose => {
            let header = header(wire, frames)?;
            Content::Pose(PoseMessage { header, frame_from_body: pose(wire)? })
        }
        ContentKind::Edge | ContentKind::Standing | ContentKind::Decision => {
            return wire.malformed("a type that ROS does not have");
        }
    })
}

fn header(wire: &mut Wire<'_>, frames: &mut Frames) -> Result<Header, Malformed> {
    let secs = match wire.layout {
        Layout::Ros1 => {
            wire.u32()?;
            i64::from(wire.u32()?)
        }
        Layout::Cdr => i64::from(wire.i32()?),
    };
    let stamp = Stamp::from_parts(secs, wire.u32()?);
    Ok(Header { stamp, frame: frame(wire, frames)? })
}

fn frame(wire: &mut Wire<'_>, frames: &mut Frames) -> Result<Arc<str>, Malformed> {
    Ok(frames.name(wire.text()?))
}

fn pose(wire: &mut Wire<'_>) -> Result<Se3, Malformed> {
    let at = wire.at();
    let position = wire.floats::<3>()?;
    blocks::pose(position, wire.floats::<4>()?, at)
}

fn scan(wire: &mut Wire<'_>, frames: &mut Frames) -> Result<ScanMessage, Malformed> {
    let header = header(wire, frames)?;
    let at = wire.at();
    let first_rad = f64::from(wire.f32()?);
    let _last_rad = wire.f32()?;
    let step_rad = f64::from(wire.f32()?);
    let _time_between_rays = wire.f32()?;
    let _time_between_scans = wire.f32()?;
    let range_min_m = f64::from(wire.f32()?);
    let range_max_m = f64::from(wire.f32()?);
    let ranges_m = wire.widened(MAX_RAYS)?;
    let intensities = wire.count()?;
    wire.skip(intensities, 4)?;
    let scan = blocks::scan(first_rad, step_rad, ranges_m, range_max_m, at)?;
    Ok(ScanMessage { header, scan, range_min_m, frame_from_sensor: None })
}

fn odometry(wire: &mut Wire<'_>, frames: &mut Frames) -> Result<OdometryMessage, Malformed> {
    let header = header(wire, frames)?;
    let child_frame = frame(wire, frames)?;
    let odom_from_body = pose(wire)?;
    // The covariance of the pose, the velocity and its covariance.
    wire.skip(36 + 6 + 36, 8)?;
    Ok(OdometryMessage { header, child_frame, odom_from_body })
}

fn transforms(wire: &mut Wire<'_>, frames: &mut Frames) -> Result<Vec<Transform>, Malformed> {
    let count = wire.count()?;
    if count > MAX_TRANSFORMS {
        return wire.malformed("more transforms than one message may have");
    }
    let mut transforms = Vec::new();
    for _ in 0..count {
        let header = header(wire, frames)?;
        let child_frame = frame(wire, frames)?;
        transforms.push(Transform { header, child_frame, parent_from_child: pose(wire)? });
    }
    Ok(transforms)
}

fn cloud(wire: &mut Wire<'_>, frames: &mut Frames) -> Result<CloudMessage, Malformed> {
    let header = header(wire, frames)?;
    let at = wire.at();
    let (rows, columns) = (wire.u32()?, wire.u32()?);
    let mut xyz = [None; 3];
    for _ in 0..wire.count()? {
        let name = wire.text()?;
        let offset = wire.u32()?;
        let number = Number::of_ros(wire.u8()?);
        let _count = wire.u32()?;
        if let (Some(axis), Some(number)) = (packed::axis(name), number) {
            xyz[axis] = Some(Field { offset, number });
        }
    }
    let big_endian = wire.u8()? != 0;
    let point_step = wire.u32()?;
    let row_step = wire.u32()?;
    let data = wire.blob()?;
    let shape = packed::Shape { columns, rows, point_step, row_step, big_endian };
    Ok(CloudMessage { header, cloud: packed::cloud(&shape, xyz, data, at)? })
}

fn image(
    wire: &mut Wire<'_>,
    frames: &mut Frames,
    units_per_metre: f64,
) -> Result<DepthMessage, Malformed> {
    let header = header(wire, frames)?;
    let at = wire.at();
    let (rows, columns) = (wire.u32()?, wire.u32()?);
    let encoding = wire.text()?;
    let big_endian = wire.u8()? != 0;
    let step = wire.u32()?;
    let data = wire.blob()?;
    let shape = packed::Shape { columns, rows, point_step: 0, row_step: step, big_endian };
    Ok(DepthMessage { header, pixels: packed::depth(&shape, encoding, data, units_per_metre, at)? })
}

fn camera(wire: &mut Wire<'_>, frames: &mut Frames) -> Result<CameraMessage, Malformed> {
    let header = header(wire, frames)?;
    let (rows, columns) = (wire.u32()?, wire.u32()?);
    let distortion_model = wire.text()?.to_owned();
    let count = wire.count()?;
    if count > MAX_COEFFICIENTS {
        return wire.malformed("more coefficients than a model of distortion has");
    }
    let distortion = (0..count).map(|_| wire.f64()).collect::<Result<_, _>>()?;
    let [fx, _, cx, _, fy, cy, ..] = wire.floats::<9>()?;
    // The rectification and the projection.
    wire.skip(9 + 12, 8)?;
    let camera = Camera::new(fx, fy, cx, cy);
    Ok(CameraMessage { header, columns, rows, camera, distortion_model, distortion })
}
