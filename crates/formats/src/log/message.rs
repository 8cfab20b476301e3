//! What a message of a log says.

use std::sync::Arc;

use nalgebra::{UnitQuaternion, Vector3};
use pose::{Se2, Se3};
use sensing::{Camera, Scan};

use super::{ContentKind, Stamp};
use crate::{Cloud, DepthPixels};

/// One message.
#[derive(Clone, Debug)]
pub struct Message {
    /// Index of its topic in the topics of the log.
    pub topic: usize,
    /// When the recorder wrote it.
    pub logged: Stamp,
    /// What it says.
    pub content: Content,
}

/// What a message says.
#[derive(Clone, Debug)]
pub enum Content {
    /// A planar range scan.
    Scan(ScanMessage),
    /// Where the body is, as its odometry says.
    Odometry(OdometryMessage),
    /// Where frames are in other frames.
    Transforms(Vec<Transform>),
    /// A cloud of points.
    Cloud(CloudMessage),
    /// A depth image.
    Depth(DepthMessage),
    /// How the images of a camera map to space.
    Camera(CameraMessage),
    /// Where something is.
    Pose(PoseMessage),
    /// An edge of a pose graph.
    Edge(EdgeMessage),
    /// The vertex of a pose graph at which the next scans are taken.
    Standing(StandingMessage),
    /// What a policy told its map.
    Decision(DecisionMessage),
}

impl Content {
    /// The kind.
    pub fn kind(&self) -> ContentKind {
        match self {
            Self::Scan(_) => ContentKind::Scan,
            Self::Odometry(_) => ContentKind::Odometry,
            Self::Transforms(_) => ContentKind::Transforms,
            Self::Cloud(_) => ContentKind::Cloud,
            Self::Depth(_) => ContentKind::Depth,
            Self::Camera(_) => ContentKind::Camera,
            Self::Pose(_) => ContentKind::Pose,
            Self::Edge(_) => ContentKind::Edge,
            Self::Standing(_) => ContentKind::Standing,
            Self::Decision(_) => ContentKind::Decision,
        }
    }
}

/// When something was measured, and in which frame it is given.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Header {
    /// When it was measured.
    pub stamp: Stamp,
    /// Name of the frame, without a slash before it; empty where the log names none.
    pub frame: Arc<str>,
}

impl Header {
    /// A header from its parts.
    pub fn new(stamp: Stamp, frame: impl Into<Arc<str>>) -> Self {
        Self { stamp, frame: frame.into() }
    }
}

/// A planar range scan.
///
/// Bearings run counter-clockwise whatever the sensor does; ranges are those of the file. A range that
/// the file calls unmeasured (NaN, infinite, from `range_max_m` on) is a miss of the
/// [`Scan`]. A range below `range_min_m` is too near to be measured: it is no sign of free space.
#[derive(Clone, Debug, PartialEq)]
pub struct ScanMessage {
    /// Stamp, and the frame of the sensor.
    pub header: Header,
    /// The scan; its range is infinite where the file tells none.
    pub scan: Scan,
    /// Range below which the sensor measures nothing, metres.
    pub range_min_m: f64,
    /// The sensor in the frame of the header, where that frame is not the sensor's own.
    pub frame_from_sensor: Option<Se3>,
}

/// Where the body is, as its odometry says.
#[derive(Clone, Debug, PartialEq)]
pub struct OdometryMessage {
    /// Stamp, and the frame `odom`.
    pub header: Header,
    /// Name of the body's frame.
    pub child_frame: Arc<str>,
    /// The body.
    pub odom_from_body: Se3,
}

/// Where one frame is in another.
#[derive(Clone, Debug, PartialEq)]
pub struct Transform {
    /// Stamp, and the parent frame.
    pub header: Header,
    /// Name of the child frame.
    pub child_frame: Arc<str>,
    /// The child frame.
    pub parent_from_child: Se3,
}

/// A cloud of points.
#[derive(Clone, Debug)]
pub struct CloudMessage {
    /// Stamp, and the frame of the points.
    pub header: Header,
    /// The points.
    pub cloud: Cloud,
}

/// A depth image.
#[derive(Clone, Debug)]
pub struct DepthMessage {
    /// Stamp, and the frame of the camera.
    pub header: Header,
    /// Depths, metres.
    pub pixels: DepthPixels,
}

/// How the images of a camera map to space.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraMessage {
    /// Stamp, and the frame of the camera.
    pub header: Header,
    /// Columns of its images.
    pub columns: u32,
    /// Rows of its images.
    pub rows: u32,
    /// The camera; distortion is not part of it.
    pub camera: Camera,
    /// Name of the model of distortion.
    pub distortion_model: String,
    /// Coefficients of the distortion.
    pub distortion: Vec<f64>,
}

/// Where something is.
#[derive(Clone, Debug, PartialEq)]
pub struct PoseMessage {
    /// Stamp, and the frame that the pose is given in.
    pub header: Header,
    /// What has the pose.
    pub frame_from_body: Se3,
}

/// An edge of a pose graph, exact to the last bit.
#[derive(Clone, Debug, PartialEq)]
pub struct EdgeMessage {
    /// When it was added.
    pub stamp: Stamp,
    /// The vertex that the pose is given in.
    pub a: u32,
    /// The other vertex.
    pub b: u32,
    /// Whether a recognised place brought it, not odometry.
    pub place: bool,
    /// The vertex `b` in the frame of `a`.
    pub a_from_b: Se2,
}

/// The vertex of a pose graph at which the next scans are taken, exact to the last bit.
#[derive(Clone, Debug, PartialEq)]
pub struct StandingMessage {
    /// When the robot stood there.
    pub stamp: Stamp,
    /// The vertex.
    pub vertex: u32,
    /// The body in the frame of the vertex.
    pub vertex_from_body: Se2,
}

/// What a policy told the map that it asks: no measurement, but labels depend on it; exact to the last bit.
#[derive(Clone, Debug, PartialEq)]
pub struct DecisionMessage {
    /// When it was decided.
    pub stamp: Stamp,
    /// The map that was told, by its kind.
    pub map: Arc<str>,
    /// What.
    pub decision: Decision,
}

/// What a policy tells its map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Decision {
    /// Frontier about a goal does not count any more.
    GaveUp {
        /// The vertex that the robot stood at.
        vertex: u32,
        /// The body in the frame of the vertex.
        vertex_from_body: Se2,
        /// The goal, in the frame of the body, metres.
        goal_in_body: [f64; 2],
        /// How far about the goal, metres.
        radius_m: f64,
        /// Whether that holds for all volumes, not only for the one at the vertex.
        everywhere: bool,
    },
    /// Nothing counted any more: what is least sure was to be opened once more.
    LookedAgain,
}

/// A motion in space that keeps to the plane `z = 0`.
pub fn spatial(motion: &Se2) -> Se3 {
    let turn = Vector3::new(0.0, 0.0, motion.angle());
    Se3::new(
        Vector3::new(motion.translation.x, motion.translation.y, 0.0),
        UnitQuaternion::from_scaled_axis(turn),
    )
}

/// What a motion in space does seen from above: its translation without z, its turn about z.
///
/// The turn is that of the x axis; where that points straight up or down it is 0.
pub fn planar(motion: &Se3) -> Se2 {
    let ahead = motion.rotation * Vector3::x();
    Se2::new(motion.translation.x, motion.translation.y, ahead.y.atan2(ahead.x))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_plane_and_space_agree() {
        for angle in [-3.1, -1.0, 0.0, 0.3, 3.1] {
            let motion = Se2::new(1.5, -2.5, angle);
            let back = planar(&spatial(&motion));
            assert_eq!(back.translation, motion.translation);
            assert!((back.angle() - motion.angle()).abs() < 1e-15);
        }
        let up = Se3::new(Vector3::zeros(), UnitQuaternion::from_scaled_axis(Vector3::z() * 0.0));
        assert_eq!(planar(&up), Se2::identity());
    }
}
