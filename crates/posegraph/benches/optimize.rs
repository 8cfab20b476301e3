//! Initial values and optimisation on the public graphs of `$DRIFTLAB_DATA/posegraphs`, and on
//! synthetic ones: one thread, best of several runs.
//!
//! `cargo bench -p posegraph --bench optimize [-- NAME]` prints a table; the last column is the cost
//! relative to the best one known, where one is. `OPTIMIZE_SIZES=1` adds graphs of growing size.
#![expect(clippy::print_stdout, reason = "a bench prints its table")]

use std::path::PathBuf;
use std::time::Instant;

use formats::pose_graph::{AnyGraph, read};
use posegraph::initial::{given, odometry, spanning_tree};
use posegraph::synthetic::{Lattice, lattice, manhattan};
use posegraph::{FactorGraph, Manifold, Options, optimize};

/// File and best known χ².
const GRAPHS: [(&str, f64); 10] = [
    ("intel.g2o", 45.004696),
    ("input_INTEL_g2o.g2o", 215.83023),
    ("input_M3500_g2o.g2o", 137.91295),
    ("manhattan.g2o", 3549.0368),
    ("manhattanOlson3500.g2o", 146.07675),
    ("kitti_05.g2o", 157.10437),
    ("parking-garage.g2o", 1.2386906),
    ("smallGrid3D.g2o", 458.15378),
    ("sphere2500.g2o", 727.14967),
    ("sphere.g2o", f64::NAN),
];

const RUNS: usize = 7;

fn row<P: Manifold<D>, const D: usize>(
    name: &str,
    init: &str,
    graph: &FactorGraph<P, D>,
    best: f64,
    start: impl Fn(&FactorGraph<P, D>) -> Vec<P>,
) {
    let (mut total, mut iterations, mut chi2, mut ended) = (f64::INFINITY, 0, 0.0, "");
    let mut fill = 0;
    for _ in 0..RUNS {
        let clock = Instant::now();
        let solution = optimize(graph, &start(graph), &Options::default());
        total = total.min(clock.elapsed().as_secs_f64());
        iterations = solution.report.iterations.len();
        chi2 = solution.report.chi2;
        ended = solution.report.termination.name();
        fill = solution.report.fill.factor;
    }
    println!(
        "{name:26} {init:9} {:7} {:7} {iterations:3} {:9.2} ms {fill:9} {chi2:16.9} {:+.1e} {ended}",
        graph.ids.len(),
        graph.factors.len(),
        total * 1e3,
        (chi2 - best) / best,
    );
}

fn rows<P: Manifold<D>, const D: usize>(name: &str, graph: &FactorGraph<P, D>, best: f64) {
    row(name, "odometry", graph, best, odometry);
    if graph.initial.iter().all(Option::is_some) {
        row(name, "file", graph, best, given);
    }
}

fn main() {
    let wanted = std::env::args().skip(1).find(|argument| !argument.starts_with('-'));
    let wanted = |name: &str| wanted.as_ref().is_none_or(|wanted| name.contains(wanted.as_str()));
    let folder = match std::env::var_os("DRIFTLAB_DATA") {
        Some(folder) => PathBuf::from(folder),
        None => PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data"),
    };
    println!("graph, start, poses, factors, iterations, time, fill, chi2, off the best known, end");
    for (name, best) in GRAPHS.into_iter().filter(|(name, _)| wanted(name)) {
        let path = folder.join("posegraphs").join(name);
        let graph = std::fs::read(&path).ok().and_then(|bytes| read(&bytes).ok());
        match graph.map(|file| file.graph) {
            Some(AnyGraph::Plane(graph)) => rows(name, &graph, best),
            Some(AnyGraph::Space(graph)) => rows(name, &graph, best),
            None => println!("{name:26} SKIPPED: not at {}", path.display()),
        }
    }
    if std::env::var_os("OPTIMIZE_SIZES").is_some() {
        for poses in [1_000, 10_000, 100_000] {
            let graph = manhattan(poses, 1).graph;
            row("manhattan, synthetic", "tree", &graph, f64::NAN, spanning_tree);
        }
        for side in [10, 22, 31] {
            let graph = lattice(&Lattice { side, ..Lattice::default() }).graph;
            row("lattice, synthetic", "tree", &graph, f64::NAN, spanning_tree);
        }
    }
}
