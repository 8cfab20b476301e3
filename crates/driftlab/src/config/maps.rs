//! The maps: each table under `[map]` is one representation.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How far off the optimiser takes a recognised place to be, unless told otherwise, metres.
const PLACE_SIGMA_M: f64 = 0.01;
/// The same of its heading, degrees.
const PLACE_SIGMA_DEG: f64 = 0.1;

/// Which representations are built.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Maps {
    /// Local polygons on a pose graph, consolidated relative to each other (\[ISRR19\] 4).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub relative: Option<RelativeMap>,
    /// An occupancy grid in the frame of the odometry (\[ISRR19\] 6.2).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub grid: Option<GridMap>,
    /// An occupancy grid whose poses are optimised at every place recognition (\[ISRR19\] 6.2).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub grid_corrected: Option<GridCorrectedMap>,
    /// All views united into one region, placed by an optimised pose graph: the strongest map with
    /// loop closure (\[Zie18\] 4.4).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub corrected_polygons: Option<CorrectedPolygonsMap>,
    /// One global polygon, merged inside an active area only (\[Zie18\] 2.7).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub active_area: Option<ActiveAreaMap>,
    /// Local polygons whose corners become free inside each other (\[Zie18\] 2.8).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub extended: Option<ExtendedMap>,
}

impl Maps {
    /// The keys of the representations that are built, in the order in which they run.
    pub fn keys(&self) -> Vec<&'static str> {
        let all = [
            ("relative", self.relative.is_some()),
            ("grid", self.grid.is_some()),
            ("grid_corrected", self.grid_corrected.is_some()),
            ("corrected_polygons", self.corrected_polygons.is_some()),
            ("active_area", self.active_area.is_some()),
            ("extended", self.extended.is_some()),
        ];
        all.into_iter().filter(|(_, there)| *there).map(|(key, _)| key).collect()
    }
}

/// Parameters of `[map.relative]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct RelativeMap {
    /// Polygons within this distance along the graph are compared, metres (\[ISRR19\] 4.3).
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub consolidation_radius_m: f64,
    /// As how many metres a metre along a place edge counts in that. Place edges do not drift:
    /// below 1 polygons are placed along ways with less odometry, rather than along the shortest.
    #[schemars(extend("exclusiveMinimum" = 0.0), range(max = 1.0))]
    pub place_weight: f64,
    /// Two neighbouring samples are one wall if their ranges differ by less; metres (\[ISRR19\] 4.1).
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub occlusion_gap_m: f64,
    /// Polygons are shrunk by this much before they free another's frontier, metres: else rounding
    /// frees walls that both share.
    #[schemars(range(min = 0.0))]
    pub strict_margin_m: f64,
    /// Frontier within this distance of a wall that is in scope is closed as wall, metres.
    #[schemars(range(min = 0.0))]
    pub wall_closing_m: f64,
    /// A connected chain of frontier shorter than this is not worth a visit, metres.
    #[schemars(range(min = 0.0))]
    pub sliver_m: f64,
    /// Frontier counts as inside another polygon only if it stays inside when their relative pose
    /// is wrong by so many standard deviations of the odometry between them. 0 trusts placement, as
    /// the paper does.
    #[schemars(range(min = 0.0, max = 1e6))]
    pub certainty_sigmas: f64,
    /// The same for the last look: when nothing is left, what is less sure than this opens again, once,
    /// and the robot goes on until nothing is left. No more than `certainty_sigmas`: no last look; and less:
    /// polygons are compared along longer ways than the shortest between them, too.
    #[schemars(range(min = 0.0, max = 1e6))]
    pub last_look_sigmas: f64,
    /// Take volumes that add nothing out of later comparisons; no frontier changes by it.
    pub retire: bool,
    /// When two neighbouring hits belong to different things.
    pub occlusion: Occlusion,
    /// Put a frontier vertex into the middle of each edge that spans an occlusion (\[Zie18\] 2.4).
    pub insert_occlusion_vertex: bool,
    /// Drop hits closer than this to the hit kept before, metres; 0 keeps all (\[Zie18\] 2.4).
    #[schemars(range(min = 0.0))]
    pub thin_m: f64,
}

/// When two neighbouring hits belong to different things.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Occlusion {
    /// Their ranges differ by the gap or more (\[ISRR19\] 4.1).
    Range,
    /// Their forward coordinates differ by more than the gap, and only in one sense (\[Zie18\] 2.4).
    ForwardSigned,
}

impl Default for RelativeMap {
    fn default() -> Self {
        Self {
            consolidation_radius_m: 10.0,
            place_weight: 1.0,
            occlusion_gap_m: 1.0,
            strict_margin_m: 0.01,
            wall_closing_m: 0.3,
            sliver_m: 0.4,
            certainty_sigmas: 0.0,
            last_look_sigmas: 1.0,
            retire: true,
            occlusion: Occlusion::Range,
            insert_occlusion_vertex: false,
            thin_m: 0.0,
        }
    }
}

/// Parameters of `[map.grid]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct GridMap {
    /// Where the poses come from.
    pub poses: Poses,
    /// Side of a cell, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub cell_m: f64,
    /// A cell is free when a scan covers it but for this share of its side all around; else cells in
    /// corners, which no rays ever fill, would stay unknown.
    #[schemars(range(min = 0.0, max = 0.49))]
    pub cell_margin: f64,
    /// Two neighbouring samples are one wall if their ranges differ by less; metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub occlusion_gap_m: f64,
}

impl Default for GridMap {
    fn default() -> Self {
        Self { poses: Poses::Odometry, cell_m: 1.0, cell_margin: 0.05, occlusion_gap_m: 1.0 }
    }
}

/// Where the poses of a map come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Poses {
    /// The wheels, with their drift.
    Odometry,
    /// The simulator: the baseline without any drift (\[Zie18\] 3.3).
    True,
}

/// Parameters of `[map.grid_corrected]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct GridCorrectedMap {
    /// Side of a cell, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub cell_m: f64,
    /// A cell is free when a scan covers it but for this share of its side all around.
    #[schemars(range(min = 0.0, max = 0.49))]
    pub cell_margin: f64,
    /// Two neighbouring samples are one wall if their ranges differ by less; metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub occlusion_gap_m: f64,
    /// How sure the optimiser is of a recognised place along each axis, metres. Odometry weighs
    /// as `odometry.sigma_*` says, whatever its scale.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub place_sigma_m: f64,
    /// The same for its heading, degrees.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub place_sigma_deg: f64,
}

impl Default for GridCorrectedMap {
    fn default() -> Self {
        Self {
            cell_m: 1.0,
            cell_margin: 0.05,
            occlusion_gap_m: 1.0,
            place_sigma_m: PLACE_SIGMA_M,
            place_sigma_deg: PLACE_SIGMA_DEG,
        }
    }
}

/// Parameters of `[map.corrected_polygons]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CorrectedPolygonsMap {
    /// Two neighbouring samples are one wall if their ranges differ by less; metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub occlusion_gap_m: f64,
    /// Frontier within this distance of a wall that another view saw does not count, metres.
    #[schemars(range(min = 0.0))]
    pub wall_closing_m: f64,
    /// A connected chain of frontier shorter than this is not worth a visit, metres.
    #[schemars(range(min = 0.0))]
    pub sliver_m: f64,
    /// How sure the optimiser is of a recognised place along each axis, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub place_sigma_m: f64,
    /// The same for its heading, degrees.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub place_sigma_deg: f64,
}

impl Default for CorrectedPolygonsMap {
    fn default() -> Self {
        Self {
            occlusion_gap_m: 1.0,
            wall_closing_m: 0.3,
            sliver_m: 0.4,
            place_sigma_m: PLACE_SIGMA_M,
            place_sigma_deg: PLACE_SIGMA_DEG,
        }
    }
}

/// Parameters of `[map.active_area]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ActiveAreaMap {
    /// How many edges of the pose graph the active area reaches (n in \[Zie18\] eq. 2.8, where its
    /// value is not printed).
    pub area_edges: u32,
    /// Make corners of the points where polygons cross (\[Zie18\] 2.7.4).
    pub keep_intersections: bool,
    /// What becomes of parts of a ring that run the wrong way round (\[Zie18\] 2.7.5).
    pub twisted: Twisted,
    /// Two neighbouring samples are one wall if their ranges differ by less; metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub occlusion_gap_m: f64,
    /// Views are pulled in by this much before they are united, metres.
    #[schemars(range(min = 0.0))]
    pub strict_margin_m: f64,
    /// Frontier within this distance of a wall that another view saw does not count, metres.
    #[schemars(range(min = 0.0))]
    pub wall_closing_m: f64,
    /// A connected chain of frontier shorter than this is not worth a visit, metres.
    #[schemars(range(min = 0.0))]
    pub sliver_m: f64,
    /// How sure the optimiser is of a recognised place along each axis, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub place_sigma_m: f64,
    /// The same for its heading, degrees.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub place_sigma_deg: f64,
}

/// What becomes of parts of a ring that run the wrong way round.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Twisted {
    /// They are turned round: what the thesis does.
    Flip,
    /// They are removed.
    Remove,
}

impl Default for ActiveAreaMap {
    fn default() -> Self {
        Self {
            area_edges: 10,
            keep_intersections: true,
            twisted: Twisted::Flip,
            occlusion_gap_m: 1.0,
            strict_margin_m: 0.01,
            wall_closing_m: 0.3,
            sliver_m: 0.4,
            place_sigma_m: PLACE_SIGMA_M,
            place_sigma_deg: PLACE_SIGMA_DEG,
        }
    }
}

/// Parameters of `[map.extended]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ExtendedMap {
    /// Two neighbouring samples are one wall if their ranges differ by less; metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub occlusion_gap_m: f64,
    /// Polygons are shrunk by this much before corners of others count as inside, metres.
    #[schemars(range(min = 0.0))]
    pub strict_margin_m: f64,
    /// Corners within this distance of a wall that another polygon saw are settled, metres; 0 is the
    /// thesis.
    #[schemars(range(min = 0.0))]
    pub wall_closing_m: f64,
    /// When two neighbouring hits belong to different things.
    pub occlusion: Occlusion,
    /// Put a frontier vertex into the middle of each edge that spans an occlusion (\[Zie18\] 2.4).
    pub insert_occlusion_vertex: bool,
    /// Drop hits closer than this to the hit kept before, metres; 0 keeps all (\[Zie18\] 2.4).
    #[schemars(range(min = 0.0))]
    pub thin_m: f64,
}

impl Default for ExtendedMap {
    fn default() -> Self {
        Self {
            occlusion_gap_m: 1.0,
            strict_margin_m: 0.01,
            wall_closing_m: 0.3,
            occlusion: Occlusion::Range,
            insert_occlusion_vertex: true,
            thin_m: 0.0,
        }
    }
}
