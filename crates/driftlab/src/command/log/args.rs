//! What can be typed after `driftlab log`.

use std::path::PathBuf;

use clap::{Args, Subcommand};

#[derive(Debug, Args)]
pub(in crate::command) struct LogArgs {
    #[command(subcommand)]
    pub(super) command: LogCommand,
}

/// What is read, for both commands.
const READ: &str = "Reads MCAP (messages of ROS 2, ROS 1 and Foxglove), bags of ROS 1 (plain or lz4), logs of CARMEN, \
     JSON maps of scans, files of relations, TUM trajectories, and folders of depth images (7-Scenes, \
     TUM RGB-D, numbered), told by content; text may be packed with gzip. A recording that is damaged \
     or cut off is read up to there, with a warning that says where.";

#[derive(Debug, Subcommand)]
pub(super) enum LogCommand {
    /// Tell what a log holds: topics, types, counts, rates, time span, damage
    #[command(
        long_about = format!("Tell what a log holds: topics, types, counts, rates, time span, damage.\n\n{READ}"),
        after_help = "Examples:\n  \
            driftlab log info drive.mcap\n  \
            driftlab log info intel.log.gz --json"
    )]
    Info(InfoArgs),
    /// Write a log as MCAP, for Foxglove and ROS 2
    #[command(
        long_about = format!(
            "Write a log as MCAP, for Foxglove and ROS 2.\n\n{READ}\n\n\
             What is understood is written, as messages of ROS 2 where it has a type for them; scans twice, \
             as ROS has them and with all digits (foxglove.LaserScan under /exact). What is not is left \
             out and told."
        ),
        after_help = "Examples:\n  \
            driftlab log convert intel.log.gz intel.mcap\n  \
            driftlab log convert drive.bag drive.mcap --json"
    )]
    Convert(ConvertArgs),
}

#[derive(Debug, Args)]
pub(super) struct InfoArgs {
    /// The log: a file, or a folder of depth images
    pub(super) file: PathBuf,
}

#[derive(Debug, Args)]
pub(super) struct ConvertArgs {
    /// The log: a file, or a folder of depth images
    pub(super) input: PathBuf,
    /// The MCAP file to be written
    pub(super) output: PathBuf,
    /// Replace the file that is there already
    #[arg(long)]
    pub(super) force: bool,
}
