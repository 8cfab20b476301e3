//! Writing a mesh whole or not at all.

use std::path::{Path, PathBuf};

use anyhow::anyhow;
use formats::mesh::{write_obj, write_off, write_ply, write_stl};
use solid::Polyhedron;

use super::super::failure::Failure;
use super::super::files::{free, write_whole};

/// A file that will be written: checked before the work starts.
#[derive(Debug)]
pub(super) struct Target {
    path: PathBuf,
    write: fn(&Polyhedron) -> Vec<u8>,
}

impl Target {
    /// Checks that the format is known and that nothing is in the way.
    pub fn new(path: &Path, force: bool) -> Result<Self, Failure> {
        let extension = path.extension().and_then(|extension| extension.to_str());
        let write = match extension.map(str::to_ascii_lowercase).as_deref() {
            Some("ply") => write_ply,
            Some("obj") => write_obj,
            Some("stl") => write_stl,
            Some("off") => write_off,
            _ => {
                return Err(Failure::Input(anyhow!(
                    "{}: found no known extension, expected .ply, .obj, .stl or .off",
                    path.display()
                )));
            }
        };
        free(path, force)?;
        Ok(Self { path: path.to_owned(), write })
    }

    /// Writes the mesh.
    pub fn write(&self, mesh: &Polyhedron) -> Result<(), Failure> {
        write_whole(&self.path, &(self.write)(mesh))
    }
}
