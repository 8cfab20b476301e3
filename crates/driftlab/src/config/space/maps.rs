//! The maps of space: each table under `[map3d]` is one representation.

use maps3d::global_union::{UnionCorrection, UnionParams};
use maps3d::reduce::{InverseDepth, Method, ReduceOptions, Stop};
use maps3d::relative::RelativeParams;
use maps3d::{ViewOptions, VoxelParams};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::super::Odometry;

/// Vertices of a view, unless told otherwise.
const VERTICES: u32 = 684;

/// Which representations of space are built.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Maps3d {
    /// Local polyhedra on a pose graph, consolidated relative to each other (after \[ISRR19\] 4.4).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub relative: Option<RelativeMap3d>,
    /// All views united into one polyhedron, placed by odometry or by an optimised pose graph (\[Mos15\]).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub global_union: Option<GlobalUnionMap3d>,
    /// Occupancy voxels with log odds, where odometry puts them: the baseline.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub voxels: Option<VoxelsMap3d>,
}

impl Maps3d {
    /// The keys of the representations that are built, in the order in which they run.
    pub fn keys(&self) -> Vec<&'static str> {
        let all = [
            ("relative", self.relative.is_some()),
            ("global_union", self.global_union.is_some()),
            ("voxels", self.voxels.is_some()),
        ];
        all.into_iter().filter(|(_, there)| *there).map(|(key, _)| key).collect()
    }
}

/// Parameters of `[map3d.relative]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct RelativeMap3d {
    /// Vertices of each view's polyhedron, the camera not counted (\[Mos15\] 6: 684).
    #[schemars(range(min = 4, max = 16_384))]
    pub vertices: u32,
    /// Views nearer than this along the graph are consolidated, metres (R in \[ISRR19\] 4.3).
    #[schemars(range(min = 0.0))]
    pub consolidation_radius_m: f64,
    /// By how much a volume is smaller than its polyhedron where it closes frontier of others, metres of
    /// depth.
    #[schemars(range(min = 0.0))]
    pub shrink_m: f64,
    /// Frontier so near behind an obstacle face of another view is closed as wall, metres; 0 for none.
    #[schemars(range(min = 0.0))]
    pub wall_closing_m: f64,
    /// Frontier that hangs together over less than this does not count, square metres.
    #[schemars(range(min = 0.0, max = 1e6))]
    pub sliver_m2: f64,
    /// Large frontier is told as points about so far apart, metres.
    #[schemars(range(min = 0.01))]
    pub point_spacing_m: f64,
}

impl Default for RelativeMap3d {
    fn default() -> Self {
        let good = RelativeParams::default();
        Self {
            vertices: VERTICES,
            consolidation_radius_m: good.consolidation_radius_m,
            shrink_m: good.shrink_m,
            wall_closing_m: good.wall_closing_m,
            sliver_m2: good.sliver_m2,
            point_spacing_m: good.point_spacing_m,
        }
    }
}

impl From<&RelativeMap3d> for RelativeParams {
    fn from(map: &RelativeMap3d) -> Self {
        Self {
            view: view_of(map.vertices, Self::default().view),
            consolidation_radius_m: map.consolidation_radius_m,
            shrink_m: map.shrink_m,
            wall_closing_m: map.wall_closing_m,
            sliver_m2: map.sliver_m2,
            point_spacing_m: map.point_spacing_m,
            ..Self::default()
        }
    }
}

/// The same view, but reduced to so many vertices.
fn view_of(vertices: u32, view: ViewOptions) -> ViewOptions {
    let method = Method::InverseDepth(InverseDepth::default());
    let reduce = Some(ReduceOptions::new(method, Stop::Vertices(vertices as usize)));
    ViewOptions { reduce, ..view }
}

/// Parameters of `[map3d.global_union]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct GlobalUnionMap3d {
    /// Vertices of each view's polyhedron, the camera not counted (\[Mos15\] 6: 684).
    #[schemars(range(min = 4, max = 16_384))]
    pub vertices: u32,
    /// Whether poses are optimised at every place recognition, and the union is built anew.
    pub corrected: bool,
    /// How far off the optimiser takes a recognised place to be, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub place_sigma_m: f64,
    /// The same of its heading, degrees.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub place_sigma_deg: f64,
    /// Frontier that hangs together over less than this does not count, square metres.
    #[schemars(range(min = 0.0, max = 1e6))]
    pub sliver_m2: f64,
    /// Frontier so near behind obstacle faces of other views, along their rays, is part of the wall, metres; 0 for
    /// none.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub wall_m: f64,
}

impl Default for GlobalUnionMap3d {
    fn default() -> Self {
        let good = UnionParams::default();
        Self {
            vertices: VERTICES,
            corrected: true,
            place_sigma_m: 0.01,
            place_sigma_deg: 0.1,
            sliver_m2: good.sliver_m2,
            wall_m: good.wall_m,
        }
    }
}

impl GlobalUnionMap3d {
    /// What the map is made with; the optimiser is told the noise of the odometry as the data sheet has it,
    /// without the experiment's scale.
    pub(crate) fn params(&self, odometry: &Odometry) -> UnionParams {
        let correction = self.corrected.then(|| UnionCorrection {
            sigma_translation: odometry.sigma_translation,
            sigma_rotation_rad: odometry.sigma_rotation.to_radians(),
            place_sigma_m: self.place_sigma_m,
            place_sigma_rotation_rad: self.place_sigma_deg.to_radians(),
            ..UnionCorrection::default()
        });
        UnionParams {
            view: view_of(self.vertices, UnionParams::default().view),
            sliver_m2: self.sliver_m2,
            wall_m: self.wall_m,
            correction,
            ..UnionParams::default()
        }
    }
}

/// Parameters of `[map3d.voxels]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct VoxelsMap3d {
    /// Side of a voxel, metres.
    #[schemars(range(min = 0.001, max = 10.0))]
    pub cell_m: f64,
    /// Depth up to which a ray tells anything, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub range_m: f64,
    /// Frontier that hangs together over less than this does not count, square metres.
    #[schemars(range(min = 0.0, max = 1e6))]
    pub sliver_m2: f64,
}

impl Default for VoxelsMap3d {
    fn default() -> Self {
        let VoxelParams { cell_m, range_m, sliver_m2, .. } = VoxelParams::default();
        Self { cell_m, range_m, sliver_m2 }
    }
}

impl From<&VoxelsMap3d> for VoxelParams {
    fn from(map: &VoxelsMap3d) -> Self {
        let VoxelsMap3d { cell_m, range_m, sliver_m2 } = *map;
        Self { cell_m, range_m, sliver_m2, ..Self::default() }
    }
}
