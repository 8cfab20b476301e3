//! The maps: each table under `[map]` is one representation.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

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
}

impl Maps {
    /// The keys of the representations that are built, in the order in which they run.
    pub fn keys(&self) -> Vec<&'static str> {
        let all = [("relative", self.relative.is_some()), ("grid", self.grid.is_some())];
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
    #[schemars(range(min = 0.0))]
    pub certainty_sigmas: f64,
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
        Self { cell_m: 1.0, cell_margin: 0.1, occlusion_gap_m: 1.0 }
    }
}
