//! The folder of a run: what is in it, and how nothing half-written gets there.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Names of the files in a run's folder.
pub mod names {
    /// The recording; grows under this name and opens up to its last flush.
    pub const RECORDING: &str = "run.rrd";
    /// The resolved config.
    pub const CONFIG: &str = "run.toml";
    /// What was measured; the same for the same config, seed and program.
    pub const METRICS: &str = "metrics.json";
    /// One row per step and map; the same for the same config, seed and program.
    pub const STEPS: &str = "steps.parquet";
    /// Everything that depends on the clock or on memory.
    pub const TIMING: &str = "timing.json";
    /// Version, commit, seed, inputs, how it ended.
    pub const PROVENANCE: &str = "provenance.toml";
    /// Of a replay: the trajectory by the log's odometry, in TUM's form.
    pub const BY_ODOMETRY: &str = "odometry.tum";
    /// Of a replay: the trajectory by steps that scans corrected.
    pub const TRACKED: &str = "tracked.tum";
    /// Of a replay: the trajectory as everything agrees best.
    pub const OPTIMISED: &str = "optimised.tum";
    /// Of a replay: the pose graph, in g2o's form.
    pub const GRAPH: &str = "graph.g2o";
    /// Of a replay: the accepted closures.
    pub const CLOSURES: &str = "closures.txt";
    /// Of a replay of depth images: where the camera was, in TUM's form.
    pub const CAMERA: &str = "camera.tum";
    /// Of a replay of depth images: the united map, labelled.
    pub const UNION_MESH: &str = "global_union.ply";
    /// Of a replay of depth images: the faces of all views of the relative map, labelled.
    pub const RELATIVE_MESH: &str = "relative.ply";
    /// All of them.
    pub const ALL: [&str; 14] = [
        RECORDING,
        CONFIG,
        METRICS,
        STEPS,
        TIMING,
        PROVENANCE,
        BY_ODOMETRY,
        TRACKED,
        OPTIMISED,
        GRAPH,
        CLOSURES,
        CAMERA,
        UNION_MESH,
        RELATIVE_MESH,
    ];
}

/// Why a folder cannot take a run.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FolderError {
    /// A run is there already.
    #[error("{}: holds a run ({file}); choose another folder with --out, or --force to replace it", folder.display())]
    Occupied {
        /// The folder.
        folder: PathBuf,
        /// The file that was found.
        file: &'static str,
    },
    /// The folder cannot be made, or nothing can be written there.
    #[error("{}: cannot be written ({reason}); expected a folder for the run", folder.display())]
    Unwritable {
        /// The folder.
        folder: PathBuf,
        /// What the system said.
        reason: io::Error,
    },
    /// The system refused.
    #[error("{}: {reason}", path.display())]
    Io {
        /// The file or folder.
        path: PathBuf,
        /// What the system said.
        reason: io::Error,
    },
}

fn io_at(path: &Path) -> impl FnOnce(io::Error) -> FolderError {
    let path = path.to_owned();
    |reason| FolderError::Io { path, reason }
}

/// A run's folder while the run goes on.
///
/// Files wait under temporary names until [`finish`](Self::finish) renames them all. A folder that
/// is dropped before leaves its recording and nothing else; where there is no recording, it leaves
/// no folder that was not there.
#[derive(Debug)]
pub struct RunFolder {
    folder: PathBuf,
    made: Vec<PathBuf>,
    waiting: Vec<&'static str>,
}

impl RunFolder {
    /// Whether a folder could take a run, without touching it.
    ///
    /// # Errors
    /// [`FolderError::Occupied`] where a run is there and `force` is not given.
    pub fn check(folder: &Path, force: bool) -> Result<(), FolderError> {
        if folder.exists() && !folder.is_dir() {
            let reason = io::Error::other("it is a file");
            return Err(FolderError::Unwritable { folder: folder.to_owned(), reason });
        }
        match names::ALL.into_iter().find(|name| folder.join(name).exists()) {
            Some(file) if !force => Err(FolderError::Occupied { folder: folder.to_owned(), file }),
            _ => Ok(()),
        }
    }

    /// Makes the folder ready; with `force`, the files of the run that was there go.
    ///
    /// # Errors
    /// As [`check`](Self::check), and what the system refuses.
    pub fn create(folder: &Path, force: bool) -> Result<Self, FolderError> {
        Self::check(folder, force)?;
        let ancestors = folder.ancestors().take_while(|path| !path.as_os_str().is_empty());
        let made: Vec<PathBuf> =
            ancestors.take_while(|path| !path.exists()).map(Path::to_owned).collect();
        let refused = |reason| FolderError::Unwritable { folder: folder.to_owned(), reason };
        fs::create_dir_all(folder).map_err(refused)?;
        // Told now, not after the run.
        let trial = folder.join(format!(".driftlab.{}.partial", std::process::id()));
        fs::write(&trial, b"").and_then(|()| fs::remove_file(&trial)).map_err(refused)?;
        for name in names::ALL {
            let path = folder.join(name);
            if path.exists() {
                fs::remove_file(&path).map_err(io_at(&path))?;
            }
        }
        Ok(Self { folder: folder.to_owned(), made, waiting: Vec::new() })
    }

    /// The folder.
    pub fn path(&self) -> &Path {
        &self.folder
    }

    /// Where the recording goes; it may be written at once.
    pub fn recording(&self) -> PathBuf {
        self.folder.join(names::RECORDING)
    }

    fn waiting_path(&self, name: &str) -> PathBuf {
        self.folder.join(format!(".{name}.{}.partial", std::process::id()))
    }

    /// Writes a file under a temporary name.
    ///
    /// # Errors
    /// What the system refuses.
    pub fn write(&mut self, name: &'static str, bytes: &[u8]) -> Result<(), FolderError> {
        let path = self.waiting_path(name);
        self.waiting.push(name);
        fs::write(&path, bytes).map_err(io_at(&path))
    }

    /// Gives every file its name.
    ///
    /// # Errors
    /// What the system refuses.
    pub fn finish(mut self) -> Result<(), FolderError> {
        for name in &self.waiting {
            let path = self.folder.join(name);
            fs::rename(self.waiting_path(name), &path).map_err(io_at(&path))?;
        }
        self.waiting.clear();
        self.made.clear();
        Ok(())
    }
}

impl Drop for RunFolder {
    fn drop(&mut self) {
        for name in &self.waiting {
            // It may be missing: the write itself can have failed.
            let _ = fs::remove_file(self.waiting_path(name));
        }
        for folder in &self.made {
            // Refused for a folder with a recording in it, which is meant.
            let _ = fs::remove_dir(folder);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn listing(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap();
        let mut all: Vec<String> =
            entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        all.sort();
        all
    }

    #[test]
    fn nothing_is_left_of_a_run_that_did_not_finish() {
        let root = tempfile::tempdir().unwrap();
        let mut folder = RunFolder::create(&root.path().join("a/b"), false).unwrap();
        folder.write(names::METRICS, b"{}").unwrap();
        drop(folder);
        assert_eq!(listing(root.path()), Vec::<String>::new());
    }

    #[test]
    fn the_recording_of_a_run_that_did_not_finish_stays() {
        let root = tempfile::tempdir().unwrap();
        let mut folder = RunFolder::create(&root.path().join("a"), false).unwrap();
        fs::write(folder.recording(), b"rrd").unwrap();
        folder.write(names::METRICS, b"{}").unwrap();
        drop(folder);
        assert_eq!(listing(&root.path().join("a")), [names::RECORDING]);
    }

    #[test]
    fn a_run_is_replaced_only_by_force_and_then_as_a_whole() {
        let root = tempfile::tempdir().unwrap();
        let mut first = RunFolder::create(root.path(), false).unwrap();
        first.write(names::METRICS, b"1").unwrap();
        first.write(names::TIMING, b"1").unwrap();
        first.finish().unwrap();
        fs::write(root.path().join("notes.txt"), b"mine").unwrap();
        let error = RunFolder::create(root.path(), false).unwrap_err();
        assert!(matches!(error, FolderError::Occupied { file: names::METRICS, .. }), "{error}");
        let mut second = RunFolder::create(root.path(), true).unwrap();
        second.write(names::METRICS, b"2").unwrap();
        second.finish().unwrap();
        assert_eq!(listing(root.path()), [names::METRICS, "notes.txt"]);
        assert_eq!(fs::read(root.path().join(names::METRICS)).unwrap(), b"2");
    }

    #[test]
    fn a_file_in_the_way_is_told() {
        let root = tempfile::tempdir().unwrap();
        let path = root.path().join("a");
        fs::write(&path, b"").unwrap();
        assert!(
            RunFolder::create(&path, true).unwrap_err().to_string().contains("expected a folder")
        );
    }
}
