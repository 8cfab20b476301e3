//! What can be typed.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};

use super::graph::GraphArgs;
use super::log::LogArgs;
use super::mesh::MeshArgs;
use crate::sweep::Shard;

const VERSION: &str = if env!("DRIFTLAB_GIT_HASH").is_empty() {
    env!("CARGO_PKG_VERSION")
} else {
    concat!(env!("CARGO_PKG_VERSION"), " (", env!("DRIFTLAB_GIT_HASH"), ")")
};

#[derive(Debug, Parser)]
#[command(
    name = "driftlab",
    version = VERSION,
    about = "A workbench for exploration maps that survive pose drift",
    long_about = "A workbench for exploration maps that survive pose drift.\n\n\
        A robot whose wheels drift explores an unknown place. Driftlab builds its map in several \
        ways at once, tells for each when the robot believes that it has seen everything and what \
        was really seen, and records every step for the Rerun viewer.",
    after_help = "First steps:\n  \
        driftlab run configs/paper/maze.toml       explore the maze of the paper\n  \
        driftlab view recordings/maze/run.rrd      step through what happened\n  \
        driftlab config defaults                   every key of a config, explained\n\n\
        Exit codes: 0 done, 1 the work failed, 2 bad usage or bad input.",
    propagate_version = true,
    arg_required_else_help = true
)]
pub(super) struct Cli {
    #[command(flatten)]
    pub(super) global: Global,
    #[command(subcommand)]
    pub(super) command: Command,
}

#[derive(Debug, Args)]
pub(super) struct Global {
    /// Print the result as one JSON object on standard output, and nothing else there
    #[arg(long, global = true)]
    pub(super) json: bool,
    /// No messages and no progress bar, only errors
    #[arg(short, long, global = true, conflicts_with = "verbose")]
    pub(super) quiet: bool,
    /// More messages
    #[arg(short, long, global = true, action = clap::ArgAction::Count)]
    pub(super) verbose: u8,
}

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Run one experiment and leave a folder with its recording and results
    #[command(
        long_about = "Run one experiment and leave a folder with its recording and results.\n\n\
            The folder holds run.rrd (the recording), run.toml (the resolved config), metrics.json, \
            steps.parquet, timing.json and provenance.toml. The same config, seed and program give the \
            same metrics.json and steps.parquet, byte for byte. A run that is killed leaves a recording \
            that opens up to its last flush.",
        after_help = "Examples:\n  \
            driftlab run configs/paper/maze.toml\n  \
            driftlab run configs/paper/maze.toml --set seed=7 --set odometry.scale=0.5 --out /tmp/try\n  \
            driftlab run configs/maps/building.toml --world floor.yaml --json"
    )]
    Run(RunArgs),
    /// Feed the maps of a config with a log of a real robot or a depth camera
    #[command(
        long_about = "Feed the maps of a config with a log of a real robot or a depth camera.\n\n\
            LOG is an MCAP file or a bag of ROS 1 with laser scans and odometry, a text log of CARMEN, or a \
            JSON map of scans, packed with gzip or not. Keyframes, steps and recognised places are made from \
            the scans; nothing else is known. A log of an exported run holds its pose graph, which is then \
            taken as it is.\n\n\
            Or LOG is a folder of depth images with poses (7-Scenes, TUM RGB-D, or numbered files), or an MCAP \
            file of such: the maps of space of the config are fed, and each is asked for the way to the nearest \
            frontier. The folder holds the maps as labelled meshes and the poses of the camera, beside the \
            recording and the numbers.\n\n\
            Of a log with scans the folder holds what a run's does, and odometry.tum, tracked.tum and optimised.tum (the sensor at \
            every scan), graph.g2o, and closures.txt, which --places takes.",
        after_help = "Examples:\n  \
            driftlab replay my.log configs/logs/laser.toml --out recordings/mine\n  \
            driftlab replay drive.mcap configs/logs/laser.toml --set 'replay.scan_topic=\"/front\"'\n  \
            driftlab replay intel.log configs/logs/laser.toml --relations intel.relations --json\n  \
            driftlab replay my.log configs/logs/laser.toml --places seen.txt\n  \
            driftlab replay scene/seq-01 configs/3d/depth_folder.toml --set replay3d.every=10"
    )]
    Replay(ReplayArgs),
    /// Do the same work over many inputs and leave a table
    #[command(
        long_about = "Do the same work over many inputs and leave a table.\n\n\
            An experiment with a table [sweep] is run for every combination of its axes' values and \
            every seed: seed, seed + 1, and so on. The folder holds results.parquet, one row for each \
            run and map, timing.parquet with what depends on the clock, and curves.parquet with the \
            coverage over the distance; `driftlab report` makes tables and plots of them.\n\n\
            In a config of pose graphs, [graph.outliers] adds wrong loop closures to pose graphs and lets \
            robust methods find them: one row for each graph, share, seed and method.\n\n\
            Finished jobs are noted in a journal in the folder. A sweep that was killed goes on from \
            there when it is started again; the results are the same, byte for byte.",
        after_help = "Examples:\n  \
            driftlab sweep configs/paper/noise.toml\n  \
            driftlab sweep configs/paper/noise.toml --set sweep.seeds=30 --out /tmp/noise\n  \
            driftlab sweep configs/graph/outliers.toml --threads 1 --csv --out /tmp/outliers\n  \
            driftlab sweep configs/paper/noise.toml --shard 2/8 --out /shared/noise\n  \
            driftlab sweep configs/paper/noise.toml --merge --out /shared/noise"
    )]
    Sweep(SweepArgs),
    /// Tables and plots from the folders of sweeps and runs
    #[command(
        long_about = "Tables and plots from the folders of sweeps and runs.\n\n\
            Leaves report.html, one page that holds everything, and report.md with its plots in a \
            folder beside it. Numbers that the sources print stand beside ours, where the config is \
            theirs.",
        after_help = "Examples:\n  \
            driftlab report recordings/noise recordings/radius --out /tmp/report"
    )]
    Report(ReportArgs),
    /// Pose-graph files: tell, optimise, compare, convert, make up
    Graph(GraphArgs),
    /// Meshes: make them of depth images, tell, reduce, combine, fill with tetrahedra, plan paths inside
    Mesh(MeshArgs),
    /// Logs of robots: tell what they hold, write them as MCAP
    Log(LogArgs),
    /// Tell what a recording holds: entities, timelines, rows, events, final metrics
    Inspect(InspectArgs),
    /// Open a recording in the Rerun viewer
    #[command(long_about = "Open a recording in the Rerun viewer.\n\n\
        Looks for the `rerun` program on the PATH. Where there is none: `pip install \
        rerun-sdk==0.36.3` brings it.")]
    View(ViewArgs),
    /// Show a resolved config, the defaults, or the JSON schema
    Config(ConfigArgs),
    /// Print a completion script for a shell
    Completions(CompletionsArgs),
}

/// A config and what is laid over it.
#[derive(Debug, Args)]
pub(super) struct ConfigInput {
    /// The experiment: a TOML file, see `driftlab config defaults`
    pub(super) config: PathBuf,
    /// Set one value of the config, as a TOML value; may be given again
    ///
    /// The path is the one of the config: `--set odometry.scale=0.5`, `--set 'record.level="off"'`,
    /// `--set 'planner.survey={}'`. Naming another world or planner than the config's replaces it.
    #[arg(long = "set", value_name = "PATH=VALUE")]
    pub(super) sets: Vec<String>,
    /// Explore this map file instead of the config's world
    ///
    /// For a robot on the floor a map_server YAML file, a PGM or PNG image, or a MovingAI `.map`, told
    /// by the content; for one that flies a mesh in metres, OBJ, STL, PLY or OFF, told by the name. The
    /// start of the config's own world is dropped. A plain image takes 0.05 m per
    /// pixel unless the config, or `--set world.image.resolution_m=...`, says otherwise.
    #[arg(long, value_name = "FILE")]
    pub(super) world: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(super) struct RunArgs {
    #[command(flatten)]
    pub(super) input: ConfigInput,
    /// Folder of the run [default: recordings/NAME]
    #[arg(long, value_name = "DIR")]
    pub(super) out: Option<PathBuf>,
    /// Write the recording here instead of into the run's folder
    #[arg(long, value_name = "FILE.rrd")]
    pub(super) record: Option<PathBuf>,
    /// Leave each robot's log, trajectories and pose graph in this folder, for other programs
    ///
    /// KIND.mcap (scans, odometry, tf, pose graph, volumes; for Foxglove, ROS 2 and `driftlab replay`),
    /// KIND.odom.tum and KIND.truth.tum (for evo), KIND.g2o; KIND is the map that steers.
    #[arg(long, value_name = "DIR")]
    pub(super) export: Option<PathBuf>,
    /// Replace the run and the export that are in the folders already
    #[arg(long)]
    pub(super) force: bool,
}

#[derive(Debug, Args)]
pub(super) struct ReplayArgs {
    /// The log
    pub(super) log: PathBuf,
    /// The experiment: a TOML file with a table [replay], or [replay3d] for depth images; its world is not asked
    pub(super) config: PathBuf,
    /// Set one value of the config, as a TOML value; may be given again
    #[arg(long = "set", value_name = "PATH=VALUE")]
    pub(super) sets: Vec<String>,
    /// Hold the result against published relative poses: lines `t1 t2 x y z roll pitch yaw`
    #[arg(long, value_name = "FILE")]
    pub(super) relations: Option<PathBuf>,
    /// Take recognised places from here instead of from the scans
    ///
    /// A file with lines `t_known t_current x y theta [sigma_m sigma_deg]`: the sensor at the later time in
    /// its frame at the earlier one. Or a topic of the log, with transforms between frames whose names
    /// end in the two stamps, or with edges between keyframes.
    #[arg(long, value_name = "FILE|/TOPIC")]
    pub(super) places: Option<PathBuf>,
    /// Folder of the results [default: recordings/NAME]
    #[arg(long, value_name = "DIR")]
    pub(super) out: Option<PathBuf>,
    /// Write the recording here instead of into the folder
    #[arg(long, value_name = "FILE.rrd")]
    pub(super) record: Option<PathBuf>,
    /// Replace the run that is in the folder already
    #[arg(long)]
    pub(super) force: bool,
}

impl ReplayArgs {
    /// The config and what is laid over it.
    pub(super) fn input(&self) -> ConfigInput {
        ConfigInput { config: self.config.clone(), sets: self.sets.clone(), world: None }
    }
}

#[derive(Debug, Args)]
pub(super) struct SweepArgs {
    #[command(flatten)]
    pub(super) input: ConfigInput,
    /// Folder of the results [default: recordings/NAME]
    #[arg(long, value_name = "DIR")]
    pub(super) out: Option<PathBuf>,
    /// Record every run into this folder, as the config's table [record] says; else none is
    #[arg(long, value_name = "DIR")]
    pub(super) record: Option<PathBuf>,
    /// Write results.csv, too
    #[arg(long)]
    pub(super) csv: bool,
    /// Threads to work on [default: all cores]; one for clean times
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub(super) threads: Option<u16>,
    /// Do only every n-th job, from the i-th on, so that n machines share the sweep
    #[arg(long, value_name = "I/N", conflicts_with = "merge")]
    pub(super) shard: Option<Shard>,
    /// Do nothing but put the results of all shards together: those in the folder, and those in
    /// these
    #[arg(long, value_name = "DIR", num_args = 0..)]
    pub(super) merge: Option<Vec<PathBuf>>,
    /// Begin anew: drop what a sweep left in the folder
    #[arg(long, conflicts_with = "merge")]
    pub(super) force: bool,
}

#[derive(Debug, Args)]
pub(super) struct ReportArgs {
    /// Folders that `driftlab sweep` or `driftlab run` left
    #[arg(required = true, value_name = "DIR")]
    pub(super) folders: Vec<PathBuf>,
    /// Folder of the report [default: recordings/report]
    #[arg(long, value_name = "DIR")]
    pub(super) out: Option<PathBuf>,
    /// Replace the report that is in the folder already
    #[arg(long)]
    pub(super) force: bool,
}

#[derive(Debug, Args)]
pub(super) struct InspectArgs {
    /// The recording, an `.rrd` file; or the folder of a run
    pub(super) file: PathBuf,
    /// Tell how this other recording differs in what it says
    #[arg(long, value_name = "OTHER")]
    pub(super) diff: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(super) struct ViewArgs {
    /// The recording, an `.rrd` file; or the folder of a run
    pub(super) file: PathBuf,
}

#[derive(Debug, Args)]
pub(super) struct ConfigArgs {
    #[command(subcommand)]
    pub(super) command: ConfigCommand,
}

#[derive(Debug, Subcommand)]
pub(super) enum ConfigCommand {
    /// Print a config with every default filled in, and where each value came from
    Show(ConfigInput),
    /// Print every key with its default and its meaning, as a config that runs
    Defaults,
    /// Print the JSON schema, for editors that complete keys
    Schema,
}

#[derive(Debug, Args)]
pub(super) struct CompletionsArgs {
    /// The shell
    pub(super) shell: clap_complete::Shell,
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_arguments_are_consistent() {
        Cli::command().debug_assert();
    }
}
