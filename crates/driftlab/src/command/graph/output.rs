//! Writing a file whole or not at all.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::anyhow;
use formats::pose_graph::{self, AnyGraph, GraphFormat};
use formats::tum;

use super::super::failure::Failure;
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
        let name = self.path.file_name().unwrap_or_default().to_string_lossy();
        let waiting = self.path.with_file_name(format!(".{name}.{}.partial", std::process::id()));
        let refused = |path: &Path| {
            let path = path.display().to_string();
            move |error: std::io::Error| Failure::Work(anyhow!("{path}: {error}"))
        };
        let written = fs::write(&waiting, bytes).map_err(refused(&self.path));
        let renamed =
            written.and_then(|()| fs::rename(&waiting, &self.path).map_err(refused(&self.path)));
        if renamed.is_err() {
            // It may not even be there: the write itself can have failed.
            let _ = fs::remove_file(&waiting);
        }
        renamed
    }
}

/// Refuses to replace a file unless forced to.
pub(super) fn free(path: &Path, force: bool) -> Result<(), Failure> {
    if path.is_dir() {
        return Err(Failure::Input(anyhow!("{}: found a folder, expected a file", path.display())));
    }
    if path.exists() && !force {
        return Err(Failure::Input(anyhow!(
            "{}: the file exists already; --force replaces it",
            path.display()
        )));
    }
    Ok(())
}
