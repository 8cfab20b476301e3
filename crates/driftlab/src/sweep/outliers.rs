//! Robust methods against wrong loop closures.

use std::path::{Path, PathBuf};
use std::time::Instant;

use formats::FormatError;
use formats::pose_graph::{AnyGraph, read};
use posegraph::initial::odometry;
use posegraph::synchronize::Rigid;
use posegraph::synthetic::{Lattice, Sphere, city, lattice, manhattan, sphere, with_outliers};
use posegraph::{FactorGraph, Options, Robust, default_start, optimize_robust};
use probe::Off;

use crate::config::{OutlierSweep, SyntheticGraph};

/// A map is right up to this share of its extent.
const RIGHT: f64 = 0.01;

/// Precision and recall of the rejected closures are right from here.
const NAMED: f64 = 0.95;

/// What one method made of one graph with wrong closures.
#[derive(Clone, Debug, PartialEq)]
pub struct OutlierRow {
    /// Name of the graph.
    pub graph: String,
    /// Dimension of the space, 2 or 3.
    pub dimension: u64,
    /// Share of wrong closures among all closures.
    pub share: f64,
    /// Seed of the wrong closures.
    pub seed: u64,
    /// Name of the method.
    pub method: &'static str,
    /// Whether the map is right and the wrong closures are named.
    pub success: bool,
    /// Root mean square distance of positions to the optimum without wrong closures, as a share of the
    /// longest side of its bounding box; both hold the first vertex.
    pub rmse: f64,
    /// Share of wrong closures among the rejected; 1 where none is rejected.
    pub precision: f64,
    /// Share of rejected closures among the wrong; 1 where none is wrong.
    pub recall: f64,
    /// Number of wrong closures.
    pub wrong: u64,
    /// Number of rejected closures.
    pub rejected: u64,
    /// Variance of the errors in units of what the information matrices say.
    pub noise_scale: f64,
    /// Iterations.
    pub iterations: u64,
    /// Time from start values to solution.
    pub secs: f64,
}

/// Why a sweep could not go on.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SweepError {
    /// A graph file that is not what it should be.
    #[error("{}: {reason}", path.display())]
    Graph {
        /// The file.
        path: PathBuf,
        /// What the reader said.
        reason: FormatError,
    },
    /// The file that holds the results could not be made.
    #[error("results.parquet: {0}")]
    Table(#[from] parquet::errors::ParquetError),
    /// The columns of the results do not fit together.
    #[error("results.parquet: {0}")]
    Columns(#[from] arrow::error::ArrowError),
}

/// Runs an outlier sweep; `data` is the folder of graph files.
///
/// `done` is told each row as it comes, `missing` each file that is not there.
///
/// # Errors
/// A file that is there and cannot be read as a graph.
pub fn outlier_rows(
    sweep: &OutlierSweep,
    data: Option<&Path>,
    mut missing: impl FnMut(&str),
    mut done: impl FnMut(&OutlierRow),
) -> Result<Vec<OutlierRow>, SweepError> {
    let mut rows = Vec::new();
    for &made in &sweep.synthetic {
        let name = format!("{} (made up)", made.name());
        match made {
            SyntheticGraph::Manhattan => {
                each(&name, &manhattan(3500, 1).graph, sweep, &mut rows, &mut done);
            }
            SyntheticGraph::City => each(&name, &city(3000, 1).graph, sweep, &mut rows, &mut done),
            SyntheticGraph::Sphere => {
                each(&name, &sphere(&Sphere::default()).graph, sweep, &mut rows, &mut done);
            }
            SyntheticGraph::Lattice => {
                let params = Lattice { side: 10, ..Lattice::default() };
                each(&name, &lattice(&params).graph, sweep, &mut rows, &mut done);
            }
        }
    }
    for file in &sweep.files {
        let path = data.map(|data| data.join(file));
        let Some((path, Ok(bytes))) = path.map(|path| (path.clone(), std::fs::read(&path))) else {
            missing(file);
            continue;
        };
        let graph = read(&bytes).map_err(|reason| SweepError::Graph { path, reason })?.graph;
        let name = Path::new(file).file_stem().unwrap_or_default().to_string_lossy().into_owned();
        match graph {
            AnyGraph::Plane(graph) => each(&name, &graph, sweep, &mut rows, &mut done),
            AnyGraph::Space(graph) => each(&name, &graph, sweep, &mut rows, &mut done),
        }
    }
    Ok(rows)
}

/// Every share, seed and method on one graph.
fn each<P: Rigid<D>, const D: usize>(
    name: &str,
    graph: &FactorGraph<P, D>,
    sweep: &OutlierSweep,
    rows: &mut Vec<OutlierRow>,
    done: &mut impl FnMut(&OutlierRow),
) {
    let options = Options::default();
    let clean = default_start(graph, &options).solution.poses;
    let methods: Vec<Robust> = (sweep.methods.iter())
        .filter_map(|name| Robust::ALL.into_iter().find(|robust| robust.name() == name))
        .collect();
    for &share in &sweep.shares {
        for seed in 1..=sweep.seeds {
            let made = with_outliers(graph, &clean, share, seed);
            for &method in &methods {
                let began = Instant::now();
                let start = odometry(&made.graph);
                let found = optimize_robust(&made.graph, &start, method, &options, &mut Off);
                let secs = began.elapsed().as_secs_f64();
                let hits = found.rejected.iter().filter(|k| made.wrong.binary_search(k).is_ok());
                let hits = hits.count() as f64;
                let of = |count: usize| if count == 0 { 1.0 } else { hits / count as f64 };
                let (precision, recall) = (of(found.rejected.len()), of(made.wrong.len()));
                let rmse = rmse(&found.solution.poses, &clean);
                let row = OutlierRow {
                    graph: name.to_owned(),
                    dimension: P::DIM as u64,
                    share,
                    seed,
                    method: method.name(),
                    success: rmse <= RIGHT && precision >= NAMED && recall >= NAMED,
                    rmse,
                    precision,
                    recall,
                    wrong: made.wrong.len() as u64,
                    rejected: found.rejected.len() as u64,
                    noise_scale: found.noise_scale,
                    iterations: found.iterations as u64,
                    secs,
                };
                done(&row);
                rows.push(row);
            }
        }
    }
}

/// Distance of positions as a share of the extent, first poses laid onto each other.
fn rmse<P: Rigid<D>, const D: usize>(found: &[P], clean: &[P]) -> f64 {
    let at = |pose: &P| pose.columns()[P::DIM];
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    let mut sum = 0.0;
    let Some(turn) = found.first().zip(clean.first()).map(|(a, b)| b.compose(&a.inverse())) else {
        return 0.0;
    };
    for (found, clean) in found.iter().zip(clean) {
        let (found, clean) = (at(&turn.compose(found)), at(clean));
        for k in 0..P::DIM {
            low[k] = low[k].min(clean[k]);
            high[k] = high[k].max(clean[k]);
            sum += (found[k] - clean[k]).powi(2);
        }
    }
    let extent = (0..P::DIM).map(|k| high[k] - low[k]).fold(0.0, f64::max);
    (sum / clean.len() as f64).sqrt() / extent
}
