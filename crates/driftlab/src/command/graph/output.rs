//! Writing a file whole or not at all.

use std::path::{Path, PathBuf};

use anyhow::anyhow;
use formats::pose_graph::{self, AnyGraph, GraphFormat};
use formats::tum;

use super::super::failure::Failure;
use super::super::files::write_whole;
pub(super) use super::super::files::{apart, free};
use super::args::FileFormat;
use super::input::trajectory_of;

/// A file that will be written: checked before the work starts.
#[derive(Debug)]
pub(super) struct Target {
    path: PathBuf,
    pub format: FileFormat,
}

impl Target {
    /// Checks that the format is known and that nothing is in the way.
    pub fn new(path: &Path, to: Option<FileFormat>, force: bool) -> Result<Self, Failure> {
        let extension = path.extension().and_then(|extension| extension.to_str());
        let told = match extension.map(str::to_ascii_lowercase).as_deref() {
            Some("g2o") => Some(FileFormat::G2o),
            Some("graph" | "toro") => Some(FileFormat::Toro),
            Some("tum") => Some(FileFormat::Tum),
            _ => None,
        };
        let format = to.or(told).ok_or_else(|| {
            Failure::Input(anyhow!(
                "{}: found no known extension, expected .g2o, .graph, .toro or .tum, or --to",
                path.display()
            ))
        })?;
        free(path, force)?;
        Ok(Self { path: path.to_owned(), format })
    }

    /// Writes a graph; poses alone into a trajectory.
    pub fn write(&self, graph: &AnyGraph) -> Result<(), Failure> {
        let bytes = match self.format {
            FileFormat::G2o => pose_graph::write(graph, GraphFormat::G2o),
            FileFormat::Toro => pose_graph::write(graph, GraphFormat::Toro),
            FileFormat::Tum => tum::write(&trajectory_of(graph)),
        };
        self.write_bytes(&bytes)
    }

    /// Writes under a temporary name beside the file, then renames.
    pub fn write_bytes(&self, bytes: &[u8]) -> Result<(), Failure> {
        write_whole(&self.path, bytes)
    }
}
