//! The files of a replay.

use formats::log::spatial;
use formats::pose_graph::{GraphFormat, write_plane};
use formats::tum::{self, Trajectory};
use pose::Se2;
use posegraph::FactorGraph2;

use super::steps::to_parquet;
use super::{PlanarLog, ReplayError, Replayed, between};
use crate::config::{Config, plain_toml};
use crate::run::{GIT_HASH, Input, Provenance, RunError, VERSION, names, to_file};

/// The files of a replay but for its recording: name and content.
///
/// # Errors
/// Where a report cannot be put into its form.
pub fn files(
    config: &Config,
    log: &PlanarLog,
    replayed: &Replayed,
    inputs: Vec<Input>,
) -> Result<Vec<(&'static str, Vec<u8>)>, ReplayError> {
    let course = &replayed.course;
    let provenance = Provenance {
        version: VERSION,
        git_hash: GIT_HASH,
        seed: config.seed,
        termination: replayed
            .metrics
            .maps
            .iter()
            .map(|(name, map)| (name.clone(), map.termination.to_owned()))
            .collect(),
        inputs,
    };
    let trajectory = |poses: &[Se2]| {
        let poses = between::of_scans(log, course, poses);
        tum::write(&Trajectory {
            stamps_secs: log.scans.iter().map(|scan| scan.stamp_secs).collect(),
            poses: poses.iter().map(spatial).collect(),
        })
    };
    let graph = FactorGraph2 {
        initial: course.optimised.iter().copied().map(Some).collect(),
        ..course.factors.clone()
    };
    let report = |result: Result<Vec<u8>, RunError>| result.map_err(ReplayError::from);
    let toml = |text: Result<String, toml::ser::Error>| {
        report(text.map(String::into_bytes).map_err(RunError::from))
    };
    Ok(vec![
        (names::CONFIG, toml(plain_toml(config))?),
        (names::STEPS, report(to_parquet(&course.rows).map_err(RunError::from))?),
        (names::BY_ODOMETRY, trajectory(&course.by_odometry())),
        (names::TRACKED, trajectory(&course.tracked)),
        (names::OPTIMISED, trajectory(&course.optimised)),
        (names::GRAPH, write_plane(&graph, GraphFormat::G2o)),
        (names::CLOSURES, closures(replayed)),
        (names::TIMING, report(to_file(&replayed.timing).map_err(RunError::from))?),
        (names::PROVENANCE, toml(provenance.to_toml())?),
        // Last, as the sign that all the others are there.
        (names::METRICS, report(to_file(&replayed.metrics).map_err(RunError::from))?),
    ])
}

/// The accepted closures, in the form that `--places` takes.
fn closures(replayed: &Replayed) -> Vec<u8> {
    let mut text = String::from("# t_known t_current x y theta sigma_m sigma_deg\n");
    let stamp = |keyframe: usize| {
        replayed.course.stops.get(keyframe).map_or(f64::NAN, |stop| stop.stamp_secs)
    };
    for (known, current, pose, sigma_m, sigma_rad) in &replayed.closures {
        let (x, y, theta) = (pose.translation.x, pose.translation.y, pose.angle());
        let (known, current) = (stamp(*known), stamp(*current));
        let sigma_deg = sigma_rad.to_degrees();
        text.push_str(&format!(
            "{known:.6} {current:.6} {x:.6} {y:.6} {theta:.6} {sigma_m:.6} {sigma_deg:.6}\n"
        ));
    }
    text.into_bytes()
}
