//! `driftlab mesh`: meshes, told about, combined, reduced, filled with tetrahedra and flown through.
//!
//! One file for each subcommand; `input.rs` and `output.rs` read and write for all of them, `told.rs`
//! says what is said of every mesh.

mod args;
mod boolean;
mod depth_args;
mod depth_input;
mod info;
mod input;
mod ladder;
mod output;
mod plan;
mod polyhedron;
mod reduce;
mod room;
mod tetrahedralize;
mod told;

pub(super) use args::MeshArgs;
use args::MeshCommand;

use super::failure::Failure;
use super::out::Out;

pub(super) fn mesh(args: &MeshArgs, out: &Out) -> Result<(), Failure> {
    match &args.command {
        MeshCommand::Boolean(args) => boolean::boolean(args, out),
        MeshCommand::Reduce(args) => reduce::reduce(args, out),
        MeshCommand::Info(args) => info::info(args, out),
        MeshCommand::Ladder(args) => ladder::ladder(args, out),
        MeshCommand::Plan(args) => plan::plan(args, out),
        MeshCommand::Polyhedron(args) => polyhedron::polyhedron(args, out),
        MeshCommand::Room(args) => room::room(args, out),
        MeshCommand::Tetrahedralize(args) => tetrahedralize::tetrahedralize(args, out),
    }
}
