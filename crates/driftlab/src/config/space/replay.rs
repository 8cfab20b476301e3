//! How a log of depth images is replayed.

use maps3d::image::PrepareOptions;
use maps3d::reduce::{Contribution, HoleMethod, InverseDepth, Method};
use maps3d::triangulate::Occlusion;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How `driftlab replay` takes depth images: a folder of them with poses, or a recording.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Replay3d {
    /// Every so manieth image is taken.
    #[schemars(range(min = 1, max = 1_000_000))]
    pub every: u32,
    /// Pixels cut off on each side of an image (\[Mos15\] 5.4).
    #[schemars(range(max = 4096))]
    pub crop: u32,
    /// Depth at which missing data is placed, metres: what lies there is frontier (\[Mos15\] 6.1).
    #[schemars(range(min = 0.01, max = 1000.0))]
    pub far_m: f64,
    /// Readings beyond this depth count as missing, metres; left out, none do.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.01, max = 1000.0))]
    pub max_m: Option<f64>,
    /// Whether faces across depth gaps are frontier; the thesis's figures know none.
    pub occlusions: bool,
    /// How images are reduced to the vertices of a map.
    pub reduce: Reduction,
    /// Camera where the log names none: focal lengths and centre `[fx, fy, cx, cy]`, pixels.
    #[schemars(inner(range(min = -1e6, max = 1e6)))]
    pub intrinsics: [f64; 4],
    /// An image without a pose so near in time is left out, seconds.
    #[schemars(range(min = 0.0, max = 3600.0))]
    pub pose_within_secs: f64,
    /// An image with fewer readings is left out: what was not read counts as free up to `far_m`, so that one of a
    /// covered lens would free all that is before it. 0 takes every image.
    #[schemars(range(max = 1_000_000))]
    pub least_readings: u32,
    /// Radius of the body for which the way to the nearest frontier is sought, metres.
    #[schemars(range(min = 0.0, max = 100.0))]
    pub body_radius_m: f64,
}

/// How the mesh of a depth image is reduced.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Reduction {
    /// Ours: the error is bounded in inverse depth, as a camera sees it.
    InverseDepth,
    /// The distance to the plane through the centroid of the hole (\[Mos15\] 3.5).
    Centroid,
    /// The distance to the plane of least squares (\[Mos15\] 3.5).
    LeastSquares,
}

impl Default for Replay3d {
    fn default() -> Self {
        Self {
            every: 1,
            crop: 0,
            far_m: 8.0,
            max_m: None,
            occlusions: true,
            reduce: Reduction::InverseDepth,
            intrinsics: [525.0, 525.0, 319.5, 239.5],
            pose_within_secs: 0.05,
            least_readings: 32,
            body_radius_m: 0.1,
        }
    }
}

impl Replay3d {
    /// How an image is made ready.
    pub(crate) fn prepare(&self) -> PrepareOptions {
        let max_m = self.max_m.unwrap_or(f64::INFINITY);
        PrepareOptions { crop: self.crop as usize, far_m: self.far_m, max_m }
    }

    /// Which depth gaps hide something, if any do.
    pub(crate) fn occlusion(&self) -> Option<Occlusion> {
        self.occlusions.then(Occlusion::default)
    }

    /// The method of reduction, with its usual options.
    pub(crate) fn method(&self) -> Method {
        let removal = |contribution| Method::Removal { contribution, hole: HoleMethod::default() };
        match self.reduce {
            Reduction::InverseDepth => Method::InverseDepth(InverseDepth::default()),
            Reduction::Centroid => removal(Contribution::Centroid),
            Reduction::LeastSquares => removal(Contribution::LeastSquares),
        }
    }
}
