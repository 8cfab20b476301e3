//! Which decoder reads the messages of a channel.

use std::collections::BTreeMap;

use super::blocks;
use super::wire::Layout;
use super::{Frames, Malformed, foxglove_json, foxglove_proto, ros};
use crate::log::{Content, ContentKind};
use sensing::Scan;

/// What Foxglove's message of a scan does not tell; written into the metadata of the channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ScanExtras {
    pub range_min_m: f64,
    pub range_max_m: f64,
    /// The exact angle between rays, which the first and the last bearing tell up to rounding only.
    pub bearing_step_rad: Option<f64>,
}

/// Names in the metadata of a channel.
pub(crate) const RANGE_MIN: &str = "driftlab.range_min_m";
pub(crate) const RANGE_MAX: &str = "driftlab.range_max_m";
pub(crate) const BEARING_STEP: &str = "driftlab.bearing_step_rad";
pub(crate) const COPY_OF: &str = "driftlab.copy_of";

impl ScanExtras {
    fn of(metadata: &BTreeMap<String, String>) -> Self {
        let number = |key: &str| metadata.get(key).and_then(|text| text.parse::<f64>().ok());
        let positive = |x: &f64| *x > 0.0;
        Self {
            range_min_m: number(RANGE_MIN).filter(|x| *x >= 0.0).unwrap_or(0.0),
            range_max_m: number(RANGE_MAX).filter(positive).unwrap_or(f64::INFINITY),
            bearing_step_rad: number(BEARING_STEP).filter(|x| x.is_finite() && *x > 0.0),
        }
    }

    /// The scan between two bearings.
    pub(crate) fn scan(
        &self,
        first_rad: f64,
        last_rad: f64,
        ranges_m: Vec<f64>,
    ) -> Result<Scan, Malformed> {
        let gaps = ranges_m.len().saturating_sub(1) as f64;
        let step_rad = if gaps > 0.0 { (last_rad - first_rad) / gaps } else { 0.0 };
        let exact = self
            .bearing_step_rad
            .filter(|&step| first_rad + step * gaps == last_rad || (step - step_rad).abs() < 1e-12);
        let exact = exact.or(self.bearing_step_rad.filter(|_| gaps == 0.0));
        blocks::scan(first_rad, exact.unwrap_or(step_rad), ranges_m, self.range_max_m, 0)
    }
}

/// How the messages of one channel are read.
#[derive(Clone, Debug)]
pub(crate) struct Decoder {
    kind: ContentKind,
    encoding: Encoding,
    /// Whether a message holds a list of transforms.
    several: bool,
    extras: ScanExtras,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Encoding {
    Ros(Layout),
    Protobuf,
    Json,
}

impl Decoder {
    /// The decoder of a channel; `None` where its messages are not read.
    pub(crate) fn of(
        schema: &str,
        encoding: &str,
        metadata: &BTreeMap<String, String>,
    ) -> Option<Self> {
        let (kind, encoding) = match encoding {
            "cdr" => (ros::kind_of(schema)?, Encoding::Ros(Layout::Cdr)),
            "ros1" => (ros::kind_of(schema)?, Encoding::Ros(Layout::Ros1)),
            "protobuf" => (foxglove_kind(schema)?, Encoding::Protobuf),
            "json" => (foxglove_kind(schema)?, Encoding::Json),
            _ => return None,
        };
        let own = matches!(kind, ContentKind::Edge | ContentKind::Standing | ContentKind::Decision);
        if own && encoding != Encoding::Protobuf {
            return None;
        }
        let several = schema.ends_with("Transforms");
        Some(Self { kind, encoding, several, extras: ScanExtras::of(metadata) })
    }

    /// The topic that a channel repeats less exactly.
    pub(crate) fn copy_of(metadata: &BTreeMap<String, String>) -> Option<&str> {
        metadata.get(COPY_OF).map(String::as_str)
    }

    /// What the messages say.
    pub(crate) fn kind(&self) -> ContentKind {
        self.kind
    }

    /// What one message says.
    pub(crate) fn decode(
        &self,
        bytes: &[u8],
        frames: &mut Frames,
        units_per_metre: f64,
    ) -> Result<Content, Malformed> {
        let Self { kind, several, extras, .. } = self;
        match self.encoding {
            Encoding::Ros(layout) => ros::decode(*kind, layout, bytes, frames, units_per_metre),
            Encoding::Protobuf => {
                foxglove_proto::decode(*kind, *several, bytes, frames, extras, units_per_metre)
            }
            Encoding::Json => {
                foxglove_json::decode(*kind, *several, bytes, frames, extras, units_per_metre)
            }
        }
    }
}

fn foxglove_kind(schema: &str) -> Option<ContentKind> {
    if let Some(own) = schema.strip_prefix("driftlab.") {
        return match own {
            "Edge" => Some(ContentKind::Edge),
            "Standing" => Some(ContentKind::Standing),
            "Decision" => Some(ContentKind::Decision),
            _ => None,
        };
    }
    match schema.strip_prefix("foxglove.")? {
        "LaserScan" => Some(ContentKind::Scan),
        "PointCloud" => Some(ContentKind::Cloud),
        "RawImage" => Some(ContentKind::Depth),
        "CameraCalibration" => Some(ContentKind::Camera),
        "FrameTransform" | "FrameTransforms" => Some(ContentKind::Transforms),
        "PoseInFrame" => Some(ContentKind::Pose),
        _ => None,
    }
}
