//! The files of a replay of depth images.

use formats::mesh::write_ply;
use formats::tum::{self, Trajectory};

use super::super::ReplayError;
use super::DepthReplayed;
use crate::config::{Config, plain_toml};
use crate::run::{GIT_HASH, Input, Provenance, RunError, VERSION, names, to_file};

/// The files of a replay but for its recording: name and content.
///
/// # Errors
/// Where a report cannot be put into its form.
pub fn depth_files(
    config: &Config,
    replayed: &DepthReplayed,
    inputs: Vec<Input>,
) -> Result<Vec<(&'static str, Vec<u8>)>, ReplayError> {
    let metrics = &replayed.metrics;
    let ended = metrics.maps.iter();
    let provenance = Provenance {
        version: VERSION,
        git_hash: GIT_HASH,
        seed: config.seed,
        termination: ended.map(|(name, map)| (name.clone(), map.termination.to_owned())).collect(),
        inputs,
    };
    let toml = |text: Result<String, toml::ser::Error>| {
        text.map(String::into_bytes).map_err(|error| ReplayError::from(RunError::from(error)))
    };
    let mut files = vec![(names::CONFIG, toml(plain_toml(config))?)];
    for (map, mesh) in &replayed.meshes {
        let name = match *map {
            "relative" => names::RELATIVE_MESH,
            _ => names::UNION_MESH,
        };
        files.push((name, write_ply(mesh)));
    }
    let trajectory = Trajectory {
        stamps_secs: replayed.poses.iter().map(|(stamp_secs, _)| *stamp_secs).collect(),
        poses: replayed.poses.iter().map(|(_, pose)| *pose).collect(),
    };
    files.push((names::CAMERA, tum::write(&trajectory)));
    files.push((names::TIMING, to_file(&replayed.timing).map_err(RunError::from)?));
    files.push((names::PROVENANCE, toml(provenance.to_toml())?));
    // Last, as the sign that all the others are there.
    files.push((names::METRICS, to_file(&replayed.metrics).map_err(RunError::from)?));
    Ok(files)
}
