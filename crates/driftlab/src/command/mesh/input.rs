//! Reading a mesh, whatever it is written in.

use std::path::Path;
use std::time::Instant;

use anyhow::anyhow;
use formats::mesh::{self, MeshFile};
use solid::Polyhedron;
use solid::mesh::weld;

use super::super::failure::Failure;
use super::super::out::Out;
use crate::config::never_ends;

/// A mesh that was read.
pub(super) struct Read {
    /// The mesh, welded where it had to be.
    pub mesh: Polyhedron,
    /// What the file said; its own mesh and facets are those before welding.
    pub file: MeshFile,
    /// How long it took.
    pub secs: f64,
}

/// Reads a mesh; what was odd about it goes to standard error.
pub(super) fn mesh(path: &Path, welds: bool, out: &Out) -> Result<Read, Failure> {
    let start = Instant::now();
    if never_ends(path) {
        let path = path.display();
        return Err(Failure::Input(anyhow!("{path}: is no ordinary file; expected a mesh")));
    }
    let bytes = std::fs::read(path)
        .map_err(|error| Failure::Input(anyhow!("{}: {error}; expected a mesh", path.display())))?;
    let extension = path.extension().and_then(|extension| extension.to_str());
    // The points of a .poly may stand in a file of their own beside it.
    let beside = path.with_extension("node");
    let nodes = if never_ends(&beside) { None } else { std::fs::read(&beside).ok() };
    let file = mesh::read(&bytes, extension, nodes.as_deref())
        .map_err(|error| Failure::Input(anyhow!("{}: {error}", path.display())))?;
    if file.left_out > 0 {
        out.note(&format!(
            "warning: {}: {} faces with fewer than three different corners left out",
            path.display(),
            file.left_out
        ));
    }
    let mesh = if welds || file.is_soup() {
        let welded = weld(&file.mesh);
        if !welded.collapsed.is_empty() {
            out.note(&format!(
                "warning: {}: {} triangles lost a corner by welding and are left out",
                path.display(),
                welded.collapsed.len()
            ));
        }
        welded.mesh
    } else {
        file.mesh.clone()
    };
    Ok(Read { mesh, file, secs: start.elapsed().as_secs_f64() })
}
