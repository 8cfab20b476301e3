//! What can be typed after `driftlab mesh`.

use std::path::PathBuf;

use clap::{Args, Subcommand};

#[derive(Debug, Args)]
pub(in crate::command) struct MeshArgs {
    #[command(subcommand)]
    pub(super) command: MeshCommand,
}

#[derive(Debug, Subcommand)]
pub(super) enum MeshCommand {
    /// Tell what a mesh holds, and how valid it is
    #[command(
        long_about = "Tell what a mesh holds, and how valid it is.\n\n\
            Reads PLY, OBJ, STL, OFF and TetGen's .node, .poly and .smesh, told by content where it \
            can be. Says whether the mesh is closed, oriented, a 2-manifold and free of \
            self-intersections, and what is wrong where: edges, vertices, and faces that meet. \
            Self-intersection is decided exactly.",
        after_help = "Examples:\n  \
            driftlab mesh info view.ply\n  \
            driftlab mesh info part.stl --json"
    )]
    Info(InfoArgs),
}

/// A mesh to read.
#[derive(Debug, Args)]
pub(super) struct MeshInput {
    /// Make vertices at exactly the same place one; triangles of STL always are
    #[arg(long)]
    pub(super) weld: bool,
}

#[derive(Debug, Args)]
pub(super) struct InfoArgs {
    /// The mesh: PLY, OBJ, STL, OFF, .node, .poly or .smesh
    pub(super) file: PathBuf,
    #[command(flatten)]
    pub(super) input: MeshInput,
}
