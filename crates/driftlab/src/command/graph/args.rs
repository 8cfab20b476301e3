//! What can be typed after `driftlab graph`.

use std::path::PathBuf;

use clap::builder::PossibleValue;
use clap::{Args, Subcommand, ValueEnum};

#[derive(Debug, Args)]
pub(in crate::command) struct GraphArgs {
    #[command(subcommand)]
    pub(super) command: GraphCommand,
}

#[derive(Debug, Subcommand)]
pub(super) enum GraphCommand {
    /// Count what a pose graph holds: poses, edges, components, conditioning
    Info(InfoArgs),
    /// Find the poses that fit the edges of a graph best
    #[command(
        long_about = "Find the poses that fit the edges of a graph best.\n\n\
            Reads g2o (VERTEX_SE2, VERTEX_SE3:QUAT, EDGE_SE2, EDGE_SE3:QUAT, FIX) and TORO (VERTEX2, \
            VERTEX3, EDGE2, EDGE3), told by content. Minimises chi2, the sum of e' I e with g2o's \
            error: translation and, in 3D, the vector part of the quaternion. In each component \
            without a FIX the first vertex is held.\n\n\
            Without --init the chordal start is tried first. Where noise cannot explain what it leads \
            to, or a loop is wound, others follow and the lowest wins: `synchronized` (SE-Sync's \
            solution), `odometry`, `spanning-tree`, `surest-tree` (edges that measure rotations best), \
            `loosened-tree` and `loosened-odometry` (after edges were allowed to disagree), `damped` \
            (the lowest of all, after damped steps). `init` and `init_trials` of --json tell which.",
        after_help = "Examples:\n  \
            driftlab graph optimize sphere.g2o -o out.g2o\n  \
            driftlab graph optimize sphere.g2o --solver lm --record sphere.rrd\n  \
            driftlab graph optimize manhattan.g2o --json"
    )]
    Optimize(OptimizeArgs),
    /// Align the poses of B to those of A and print the absolute and relative error
    #[command(
        long_about = "Align the poses of B to those of A and print the absolute and relative error.\n\n\
            A is the reference. Each may be g2o, TORO or a TUM trajectory. Poses of graphs match by \
            id, those of trajectories by the nearest time; an id counts as a time in seconds where a \
            graph meets a trajectory. ATE: distances of aligned positions. RPE: errors of the motion \
            over --delta poses, from every pose. Definitions as in evo."
    )]
    Compare(CompareArgs),
    /// Write a graph or trajectory in another format
    #[command(long_about = "Write a graph or trajectory in another format.\n\n\
            The format is told by the extension of OUT: .g2o, .graph or .toro (TORO), .tum; or by \
            --to. Poses of a graph become a trajectory with their ids as times; a trajectory becomes \
            a graph without edges.")]
    Convert(ConvertArgs),
    /// Make up a graph, with the poses that it was made from
    Generate(GenerateArgs),
}

/// Formats that are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum FileFormat {
    /// VERTEX_SE2, EDGE_SE3:QUAT, ...
    G2o,
    /// VERTEX2, EDGE3, ...
    Toro,
    /// timestamp tx ty tz qx qy qz qw
    Tum,
}

#[derive(Debug, Args)]
pub(super) struct InfoArgs {
    /// The graph: g2o or TORO
    pub(super) file: PathBuf,
}

/// Where a start comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Init {
    /// The vertices of the file, completed along edges; there and nowhere else
    File,
    /// The chain of edges from each vertex to the next; others too where the end cannot be believed
    Odometry,
    /// The fewest edges from the first vertex; others too where the end cannot be believed
    SpanningTree,
    /// All edges at once by linear systems, rotations first; there and nowhere else
    Chordal,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum SolverName {
    /// Gauss-Newton
    Gn,
    /// Levenberg-Marquardt
    Lm,
    /// Powell's dogleg
    Dogleg,
}

/// How wrong loop closures are dealt with, as the library names it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Robust(pub(super) posegraph::Robust);

const METHODS: [Robust; posegraph::Robust::ALL.len()] = {
    let mut methods = [Robust(posegraph::Robust::None); posegraph::Robust::ALL.len()];
    let mut at = 0;
    while at < methods.len() {
        methods[at] = Robust(posegraph::Robust::ALL[at]);
        at += 1;
    }
    methods
};

impl ValueEnum for Robust {
    fn value_variants<'a>() -> &'a [Self] {
        &METHODS
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        Some(PossibleValue::new(self.0.name()).help(self.0.about()))
    }
}

#[derive(Debug, Args)]
pub(super) struct OptimizeArgs {
    /// The graph: g2o or TORO
    pub(super) file: PathBuf,
    /// Write the graph with its new poses; the extension tells the format
    #[arg(short, long, value_name = "OUT")]
    pub(super) output: Option<PathBuf>,
    /// Format of OUT, whatever its extension
    #[arg(long, requires = "output")]
    pub(super) to: Option<FileFormat>,
    /// Replace OUT where it exists
    #[arg(long)]
    pub(super) force: bool,
    /// Start here instead of the best start that can be computed
    #[arg(long, value_name = "START")]
    pub(super) init: Option<Init>,
    /// How steps are found
    #[arg(long, default_value = "gn")]
    pub(super) solver: SolverName,
    /// What is done about wrong loop closures
    #[arg(long, default_value = "none")]
    pub(super) robust: Robust,
    /// Solve SE-Sync's problem too, and tell whether its solution is the global optimum
    #[arg(long)]
    pub(super) certify: bool,
    /// End each optimisation after this many iterations; a start may take several optimisations, and
    /// its certificate up to 40 iterations of its own
    #[arg(long, value_name = "N", default_value_t = 100)]
    pub(super) max_iterations: usize,
    /// Threads that may work at the same time; results do not depend on it
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub(super) threads: usize,
    /// Record every iteration for the Rerun viewer
    #[arg(long, value_name = "FILE.rrd")]
    pub(super) record: Option<PathBuf>,
}

/// How B is moved before it is compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Align {
    /// Moved and turned to fit best
    Rigid,
    /// Moved, turned and scaled to fit best
    Similarity,
    /// First poses laid onto each other
    Origin,
    /// Not at all
    None,
}

#[derive(Debug, Args)]
pub(super) struct CompareArgs {
    /// The reference
    pub(super) a: PathBuf,
    /// The estimate
    pub(super) b: PathBuf,
    /// How B is laid onto A
    #[arg(long, default_value = "rigid")]
    pub(super) align: Align,
    /// Poses between the ends of the motions that RPE compares
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub(super) delta: usize,
    /// Times that differ by at most this match, seconds
    #[arg(long, value_name = "SECS", default_value_t = 0.01)]
    pub(super) max_diff: f64,
}

#[derive(Debug, Args)]
pub(super) struct ConvertArgs {
    /// The file to read: g2o, TORO or TUM, told by content
    pub(super) input: PathBuf,
    /// The file to write
    pub(super) output: PathBuf,
    /// Format of OUT, whatever its extension
    #[arg(long)]
    pub(super) to: Option<FileFormat>,
    /// Replace OUT where it exists
    #[arg(long)]
    pub(super) force: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Shape {
    /// 3D: a spiral from pole to pole
    Sphere,
    /// 3D: a spiral around a tube
    Torus,
    /// 3D: back and forth through a cube
    Lattice,
    /// 2D: a circle with one closure
    Ring,
    /// 2D: a random walk with a crossing every two steps
    Manhattan,
    /// 2D: long streets
    City,
}

#[derive(Debug, Args)]
pub(super) struct GenerateArgs {
    /// What the robot drives along
    pub(super) shape: Shape,
    /// The file to write; the extension tells the format
    #[arg(short, long, value_name = "OUT")]
    pub(super) output: PathBuf,
    /// Number of poses, about: rounded up to whole rounds or cubes
    #[arg(long, value_name = "N")]
    pub(super) poses: Option<usize>,
    /// Seed of everything that is random
    #[arg(long, default_value_t = 1)]
    pub(super) seed: u64,
    /// Standard deviation of every translation axis, metres
    #[arg(long, value_name = "M")]
    pub(super) noise_m: Option<f64>,
    /// Standard deviation of every rotation axis, degrees
    #[arg(long, value_name = "DEG")]
    pub(super) noise_deg: Option<f64>,
    /// Write the true poses here, too
    #[arg(long, value_name = "FILE")]
    pub(super) truth: Option<PathBuf>,
    /// Format of the files, whatever their extensions
    #[arg(long)]
    pub(super) to: Option<FileFormat>,
    /// Replace files that exist
    #[arg(long)]
    pub(super) force: bool,
}
