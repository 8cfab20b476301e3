//! The files of an export, which get their names together.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use formats::FormatError;
use formats::log::{EdgeLabel, Stamp};
use maps2d::correction::CorrectionParams;
use maps2d::relative::ConsolidationEvent;
use maps2d::volume::VolumeEvent;
use pose::Se2;
use probe::VertexId;

use super::volumes::{edges_of_view, edges_of_volume};
use super::{Fed, RunLog, Tracks};
use crate::files::PartialFile;

/// Endings of the files of one robot.
const ENDINGS: [&str; 4] = ["mcap", "odom.tum", "truth.tum", "g2o"];

/// The log begins here: ROS takes a stamp of 0 for "any time".
const START_NANOS: i64 = 1_000_000_000;

/// What a scan takes, on top of the way driven at 1 m/s: stamps of scans differ.
const SCAN_NANOS: i64 = 100_000_000;

/// Why an export failed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ExportError {
    /// An export is there already.
    #[error("{}: the file exists already; --force replaces it", path.display())]
    Occupied {
        /// The file.
        path: PathBuf,
    },
    /// The system refused.
    #[error("{}: {reason}", path.display())]
    Io {
        /// The file or folder.
        path: PathBuf,
        /// What the system said.
        reason: io::Error,
    },
    /// The log cannot be written.
    #[error("{}: {error}", path.display())]
    Log {
        /// The file.
        path: PathBuf,
        /// What the writer said.
        error: FormatError,
    },
}

/// A folder that takes the exports of all robots of a run or a replay.
///
/// Files wait under temporary names until [`finish`](Self::finish); dropped before, they go.
#[derive(Debug)]
pub struct ExportFolder {
    folder: PathBuf,
    /// Whether it was not there before.
    made: bool,
    waiting: Vec<PartialFile>,
}

impl ExportFolder {
    /// Whether a folder could take the exports of robots of these names, without touching it.
    ///
    /// # Errors
    /// [`ExportError::Occupied`] where a file is there and `force` is not given; [`ExportError::Io`] where the
    /// folder is a file.
    pub fn check(folder: &Path, robots: &[&str], force: bool) -> Result<(), ExportError> {
        if folder.exists() && !folder.is_dir() {
            let reason = io::Error::other("found a file, expected a folder for the export");
            return Err(ExportError::Io { path: folder.to_owned(), reason });
        }
        for robot in robots {
            for ending in ENDINGS {
                let path = folder.join(format!("{robot}.{ending}"));
                if path.exists() && !force {
                    return Err(ExportError::Occupied { path });
                }
            }
        }
        Ok(())
    }

    /// Makes the folder.
    ///
    /// # Errors
    /// [`ExportError::Io`]
    pub fn create(folder: &Path) -> Result<Self, ExportError> {
        let made = !folder.exists();
        std::fs::create_dir_all(folder)
            .map_err(|reason| ExportError::Io { path: folder.to_owned(), reason })?;
        Ok(Self { folder: folder.to_owned(), made, waiting: Vec::new() })
    }

    /// Begins the export of a robot.
    ///
    /// # Errors
    /// [`ExportError`]
    pub fn robot(&self, name: &str, noise: CorrectionParams) -> Result<Exports, ExportError> {
        let path = self.folder.join(format!("{name}.mcap"));
        let refused = |reason| ExportError::Io { path: path.clone(), reason };
        let waiting = PartialFile::create(&path).map_err(refused)?;
        let sink = BufWriter::new(waiting.handle().map_err(refused)?);
        let log =
            RunLog::new(sink).map_err(|error| ExportError::Log { path: path.clone(), error })?;
        Ok(Exports {
            folder: self.folder.clone(),
            name: name.to_owned(),
            path,
            waiting,
            log,
            tracks: Tracks::new(noise),
            scans: 0,
            now: Stamp::from_nanos(START_NANOS),
            changed: BTreeMap::new(),
            failed: None,
        })
    }

    /// Takes what a robot's export has become.
    ///
    /// # Errors
    /// [`ExportError`], also where something could not be written before.
    pub fn take(&mut self, exports: Exports) -> Result<(), ExportError> {
        let written = exports.finish()?;
        self.waiting.extend(written);
        Ok(())
    }

    /// Gives all files their names.
    ///
    /// # Errors
    /// [`ExportError::Io`]
    pub fn finish(mut self) -> Result<(), ExportError> {
        for file in std::mem::take(&mut self.waiting) {
            let path = file.path().to_owned();
            file.finish().map_err(|reason| ExportError::Io { path, reason })?;
        }
        Ok(())
    }
}

impl Drop for ExportFolder {
    fn drop(&mut self) {
        self.waiting.clear();
        if self.made {
            // Refused for a folder with files in it, which is meant.
            let _ = std::fs::remove_dir(&self.folder);
        }
    }
}

/// Edges of changed volumes, by map and vertex.
type Changed = BTreeMap<(String, VertexId), Option<Vec<([[f64; 2]; 2], EdgeLabel)>>>;

/// The export of one robot: a log, two trajectories, a pose graph.
#[derive(Debug)]
pub struct Exports {
    folder: PathBuf,
    name: String,
    path: PathBuf,
    waiting: PartialFile,
    log: RunLog<BufWriter<File>>,
    tracks: Tracks,
    scans: i64,
    now: Stamp,
    changed: Changed,
    failed: Option<FormatError>,
}

impl Exports {
    /// The time of a simulated scan after `distance_m` driven, when `scans` were taken before.
    pub fn simulated_time(&self, distance_m: f64) -> Stamp {
        let driven = Stamp::from_secs(distance_m).nanos();
        Stamp::from_nanos(START_NANOS + driven + self.scans * SCAN_NANOS)
    }

    /// Writes what the maps were fed at a time.
    pub fn fed(&mut self, at: Stamp, fed: &Fed) {
        self.now = at;
        let known = self.tracks.vertices();
        self.tracks.fed(at, fed);
        let Self { log, tracks, .. } = self;
        let place = |vertex: VertexId| tracks.odom_from_vertex(vertex.0 as usize);
        let done = match fed {
            Fed::Edges { edges, .. } => {
                let mut founded = (known..tracks.vertices()).map(|vertex| VertexId(vertex as u32));
                founded
                    .try_for_each(|vertex| log.vertex(at, vertex, &place(vertex)))
                    .and_then(|()| log.edges(at, edges, place))
            }
            Fed::Scan { standing, scan } => {
                self.scans += 1;
                log.scan(at, standing, &place(standing.vertex), scan)
            }
            Fed::Decided { map, decision } => log.decided(at, map, *decision),
        };
        self.note(done);
    }

    /// Notes where the robot truly is, or is best known to be: for the trajectory, never in the log.
    pub fn reference(&mut self, at: Stamp, map_from_body: &Se2) {
        self.tracks.reference(at, map_from_body);
    }

    /// A map tells of a view.
    pub fn volume(&mut self, kind: &str, event: &VolumeEvent<'_>) {
        if let VolumeEvent::Built { vertex, volume } | VolumeEvent::Merged { vertex, volume } =
            event
        {
            self.changed.insert((kind.to_owned(), *vertex), Some(edges_of_view(volume)));
        }
    }

    /// A relative map tells of its labels.
    pub fn consolidation(&mut self, kind: &str, event: &ConsolidationEvent<'_>) {
        match event {
            ConsolidationEvent::Closed { volume, .. }
            | ConsolidationEvent::Reopened { volume, .. } => {
                self.changed.insert((kind.to_owned(), *volume), None);
            }
            ConsolidationEvent::Settled { map, .. } => {
                for ((of, vertex), edges) in &mut self.changed {
                    if of == kind
                        && let Some(state) = map.volume(*vertex)
                    {
                        *edges = Some(edges_of_volume(state));
                    }
                }
            }
            _ => {}
        }
    }

    /// Draws the volumes that changed since this was asked last.
    pub fn draw(&mut self) {
        let mut by_kind: BTreeMap<String, Vec<_>> = BTreeMap::new();
        for ((kind, vertex), edges) in std::mem::take(&mut self.changed) {
            if let Some(edges) = edges {
                by_kind.entry(kind).or_default().push((vertex, edges));
            }
        }
        for (kind, volumes) in by_kind {
            let done = self.log.volumes(self.now, &kind, volumes);
            self.note(done);
        }
    }

    /// What could not be written is told at the end, or when asked for.
    fn note(&mut self, done: Result<(), FormatError>) {
        if let Err(error) = done {
            self.failed.get_or_insert(error);
        }
    }

    /// Whether something could not be written.
    ///
    /// # Errors
    /// [`ExportError::Log`]
    pub fn check(&self) -> Result<(), ExportError> {
        match &self.failed {
            Some(error) => Err(ExportError::Log { path: self.path.clone(), error: error.clone() }),
            None => Ok(()),
        }
    }

    fn finish(mut self) -> Result<Vec<PartialFile>, ExportError> {
        self.draw();
        self.check()?;
        let path = self.path;
        self.log.finish().map_err(|error| ExportError::Log { path, error })?;
        let mut written = vec![self.waiting];
        let texts = [
            (ENDINGS[1], Some(self.tracks.odometry_tum())),
            (ENDINGS[2], self.tracks.reference_tum()),
            (ENDINGS[3], Some(self.tracks.g2o())),
        ];
        for (ending, text) in texts {
            let Some(text) = text else { continue };
            let path = self.folder.join(format!("{}.{ending}", self.name));
            let refused = |reason| ExportError::Io { path: path.clone(), reason };
            let file = PartialFile::create(&path).map_err(refused)?;
            file.handle().and_then(|mut handle| handle.write_all(&text)).map_err(refused)?;
            written.push(file);
        }
        Ok(written)
    }
}
