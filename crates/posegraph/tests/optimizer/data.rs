//! Public graphs, where a folder of test data is at hand: best known costs from odometry and from
//! the start of the file.

#[path = "../data_folder/mod.rs"]
mod data_folder;

use std::fs;

use formats::pose_graph::{AnyGraph, read};
use posegraph::initial::{given, odometry};
use posegraph::{FactorGraph, Manifold, Options, optimize};

/// File and best known χ², found by Ceres at a tolerance of 1e-13 from several starts.
const KNOWN: [(&str, f64); 8] = [
    ("intel.g2o", 45.004696),
    ("input_INTEL_g2o.g2o", 215.83023),
    ("input_M3500_g2o.g2o", 137.91295),
    ("manhattan.g2o", 3549.0368),
    ("manhattanOlson3500.g2o", 146.07675),
    ("parking-garage.g2o", 1.2386906),
    ("smallGrid3D.g2o", 458.15378),
    ("sphere2500.g2o", 727.14967),
];

fn hold<P: Manifold<D>, const D: usize>(name: &str, graph: &FactorGraph<P, D>, best: f64) {
    let mut starts = vec![("odometry", odometry(graph))];
    if graph.initial.iter().all(Option::is_some) {
        starts.push(("file", given(graph)));
    }
    for (init, start) in starts {
        let report = optimize(graph, &start, &Options::default()).report;
        let off = (report.chi2 - best).abs() / best;
        // The best known costs have eight digits.
        assert!(off < 1e-6, "{name} {init} {} {best} {:?}", report.chi2, report.termination);
        assert!(report.termination.is_converged(), "{name} {init} {:?}", report.termination);
    }
}

#[test]
fn best_known_costs_are_reached_from_odometry_and_from_the_file() {
    let Some(folder) = data_folder::graphs() else { return };
    for (name, best) in KNOWN {
        match read(&fs::read(folder.join(name)).unwrap()).unwrap().graph {
            AnyGraph::Plane(graph) => hold(name, &graph, best),
            AnyGraph::Space(graph) => hold(name, &graph, best),
        }
    }
}
