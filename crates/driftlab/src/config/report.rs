//! How maps are compared, judged and recorded.

use schemars::JsonSchema;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize};

/// How several maps share the experiment.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Compare {
    /// "each": every map steers its own robot, which meets the same noise. Or the name of the map
    /// that drives, while the others listen.
    pub drive: String,
}

impl Default for Compare {
    fn default() -> Self {
        Self { drive: "each".into() }
    }
}

/// How the belief is judged against the truth.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Metrics {
    /// Side of the cells that coverage is counted in, metres.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub cell_m: Option<f64>,
    /// Columns and rows of cells, in place of `cell_m`: equal ones over the extent of the world,
    /// square or not (\[Zie18\] 3.2).
    #[serde(skip_serializing_if = "Option::is_none", deserialize_with = "columns_and_rows")]
    #[schemars(inner(range(min = 1)))]
    pub grid: Option<[u32; 2]>,
    /// When a cell counts as seen.
    pub rule: Rule,
}

impl Default for Metrics {
    fn default() -> Self {
        Self { cell_m: Some(1.0), grid: None, rule: Rule::Rays }
    }
}

fn columns_and_rows<'de, D: Deserializer<'de>>(input: D) -> Result<Option<[u32; 2]>, D::Error> {
    // A plain `[u32; 2]` would take the first two numbers of a longer list and drop the rest.
    let list = Vec::<u32>::deserialize(input)?;
    let wrong = |list: Vec<u32>| {
        let found = format!("a list of {} numbers", list.len());
        D::Error::custom(format!("{found}, expected two numbers, [columns, rows]"))
    };
    list.try_into().map(Some).map_err(wrong)
}

/// When a cell counts as seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Rule {
    /// A ray touched it: the paper's rule.
    Rays,
    /// Its centre lay in the true view polygon: for cells finer than the spacing of the rays.
    View,
}

/// What the recording holds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Record {
    /// How much is recorded.
    pub level: Level,
    /// Per family: record every n-th step only.
    pub every: Every,
}

impl Default for Record {
    fn default() -> Self {
        Self { level: Level::Full, every: Every::default() }
    }
}

/// How much is recorded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Level {
    /// Nothing: no recording is written.
    Off,
    /// Per step: poses, the graph, labels, goals and the plots.
    Summary,
    /// Every event of every algorithm.
    Full,
}

/// Per family of intermediates: record every n-th step only.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Every {
    /// Rays, hits, misses, view polygons.
    #[schemars(range(min = 1))]
    pub sensing: u32,
    /// Vertices, edges, the scope's shortest-path tree.
    #[schemars(range(min = 1))]
    pub pose_graph: u32,
    /// Pairs, intervals relabelled, what remains frontier and why.
    #[schemars(range(min = 1))]
    pub consolidation: u32,
    /// Cells changed.
    #[schemars(range(min = 1))]
    pub grid: u32,
    /// State, candidates, goal, path.
    #[schemars(range(min = 1))]
    pub planner: u32,
    /// Optimisations of the whole graph.
    #[schemars(range(min = 1))]
    pub correction: u32,
    /// Unions of polygons, and what comes out.
    #[schemars(range(min = 1))]
    pub polygons: u32,
    /// Tetrahedra and the dual graph that ways are planned through, what A* opened and closed.
    #[schemars(range(min = 1))]
    pub tetrahedra: u32,
    /// True pose, coverage cells and the plots.
    #[schemars(range(min = 1))]
    pub truth: u32,
}

impl Default for Every {
    fn default() -> Self {
        Self {
            sensing: 1,
            pose_graph: 1,
            consolidation: 1,
            grid: 1,
            planner: 1,
            correction: 1,
            polygons: 1,
            tetrahedra: 1,
            truth: 1,
        }
    }
}
