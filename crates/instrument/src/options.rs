//! What a recording holds, as chosen before the run.

use std::path::PathBuf;

use geometry::Point2;

/// How much is recorded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// Nothing: no file is written, and no probe is on.
    Off,
    /// The state at the end of each step: truth, belief around the robot, graph, goal, plots.
    Summary,
    /// The summary and every event of every algorithm, in order.
    Full,
}

/// A family of intermediates that can be thinned on its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Family {
    /// Rays, hits, misses, view polygons.
    Sensing,
    /// Vertices, edges, the shortest-path tree of the scope.
    PoseGraph,
    /// Pairs compared, parts closed and opened again, what is left; the belief.
    Consolidation,
    /// Cells changed, rebuilds; the belief of grids.
    Grid,
    /// State, candidates, goal, way.
    Planner,
    /// Optimisations of the whole graph: what they cost, how far vertices moved.
    Correction,
    /// Intersections, unions, loops, the region that comes out, the dual graph.
    Polygons,
    /// Tetrahedra, the dual graph over them, what A* opened and closed, the cone programmes.
    Tetrahedra,
    /// True pose, view, coverage, and the plots.
    Truth,
}

impl Family {
    /// All families.
    pub const ALL: [Self; 9] = [
        Self::Sensing,
        Self::PoseGraph,
        Self::Consolidation,
        Self::Grid,
        Self::Planner,
        Self::Correction,
        Self::Polygons,
        Self::Tetrahedra,
        Self::Truth,
    ];

    /// The name in configs and in entity paths.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Sensing => "sensing",
            Self::PoseGraph => "pose_graph",
            Self::Consolidation => "consolidation",
            Self::Grid => "grid",
            Self::Planner => "planner",
            Self::Correction => "correction",
            Self::Polygons => "polygons",
            Self::Tetrahedra => "tetrahedra",
            Self::Truth => "truth",
        }
    }
}

/// Per family: record every n-th step only.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Every([u32; Family::ALL.len()]);

impl Every {
    /// Every step of every family.
    pub const STEP: Self = Self([1; Family::ALL.len()]);

    /// The same, but only every `n`-th step of one family; 0 counts as 1.
    pub fn with(mut self, family: Family, n: u32) -> Self {
        self.0[family as usize] = n.max(1);
        self
    }

    /// Whether the family is recorded at a step.
    pub fn takes(&self, family: Family, step: u64) -> bool {
        step.is_multiple_of(u64::from(self.0[family as usize]))
    }
}

impl Default for Every {
    fn default() -> Self {
        Self::STEP
    }
}

/// How the belief of a map is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Centre {
    /// Around the robot, which is what a map without a global frame knows.
    Robot,
    /// In the map's own global frame, laid onto the truth where the robot started.
    Start,
}

/// One map of the run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MapOptions {
    /// The name of the map: the first part of all its entity paths.
    pub name: String,
    /// How its belief is drawn.
    pub centre: Centre,
}

impl MapOptions {
    /// A map by its kind: relative maps are drawn around the robot, all others from the start.
    pub fn of_kind(kind: &str) -> Self {
        let around_robot = ["relative", "extended"].contains(&kind);
        let centre = if around_robot { Centre::Robot } else { Centre::Start };
        Self { name: kind.to_owned(), centre }
    }
}

/// What a recording holds, and what it says about itself.
#[derive(Clone, Debug)]
pub struct RecordingOptions {
    /// The file, under its final name; it is overwritten.
    pub path: PathBuf,
    /// The name of the experiment.
    pub name: String,
    /// How much is recorded.
    pub level: Level,
    /// Which steps of which family.
    pub every: Every,
    /// The maps of the run, in the order in which they are shown.
    pub maps: Vec<MapOptions>,
    /// What the experiment is about, in words (Markdown); first on the text page.
    pub about: String,
    /// The resolved config, TOML.
    pub config: String,
    /// Lower-left and upper-right corner of the place in the world frame, for the first look.
    pub bounds_in_world: (Point2, Point2),
    /// How far around the robot its belief is shown, metres.
    pub sight_m: f64,
    /// Whether the viewer opens at the last step and follows a run that goes on, instead of
    /// pausing at the first step.
    pub follow: bool,
}
