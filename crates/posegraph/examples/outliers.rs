//! Which wrong loop closures a method finds, and what map it is left with.
//!
//! ```text
//! cargo run --release -p posegraph --example outliers -- [--graphs A,B] [--methods gnc-tls,pcm]
//!     [--shares 0.1,0.3,0.5] [--seeds 11..20] [--wrong anywhere|alike] [--keep 0.1] [--why]
//! ```
//!
//! A graph is a file of `$DRIFTLAB_DATA/posegraphs`, or `town:POSES`, `city:POSES`, `sphere`, `grid:SIDE`
//! with the seed of the wrong closures. Prints a line for each run and a table of all; seconds are
//! those of the processor. `--keep` takes this share of the genuine closures only, spread evenly; `--why` lists the closures that were taken for what they are not.
#![expect(clippy::print_stdout, reason = "a program prints its table")]

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::time::Instant;

use formats::pose_graph::{AnyGraph, read};
use posegraph::initial::odometry;
use posegraph::robust::closures;
use posegraph::synthetic::{
    Judgement, Lattice, Sphere, Wrong, city, lattice, manhattan, sphere, with_wrong_closures,
};
use posegraph::{FactorGraph, Options, Rigid, Robust, default_start, optimize_robust};
use probe::Off;

const GRAPHS: &str = "intel.g2o,input_INTEL_g2o.g2o,input_M3500_g2o.g2o,manhattan.g2o,\
    sphere2500.g2o,sphere.g2o,parking-garage.g2o,kitti_05.g2o,FR079_P_toro.graph,smallGrid3D.g2o";

/// What is asked for on the command line.
struct Asked {
    methods: Vec<Robust>,
    shares: Vec<f64>,
    seeds: std::ops::RangeInclusive<u64>,
    wrong: Wrong,
    keep: f64,
    why: bool,
}

/// One run.
struct Run {
    judgement: Judgement,
    secs: f64,
    noise_scale: f64,
}

type Table = BTreeMap<(String, &'static str, String), Vec<Run>>;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let value = |name: &str, otherwise: &str| -> String {
        let at = arguments.iter().position(|argument| argument == name);
        at.and_then(|at| arguments.get(at + 1)).map_or(otherwise, String::as_str).to_owned()
    };
    let methods = value("--methods", "gnc-tls");
    let seeds = value("--seeds", "11..20");
    let (first, last) = seeds.split_once("..").unwrap_or((&seeds, &seeds));
    let asked = Asked {
        methods: Robust::ALL
            .into_iter()
            .filter(|robust| methods == "all" || methods.split(',').any(|m| m == robust.name()))
            .collect(),
        shares: value("--shares", "0.1,0.3,0.5")
            .split(',')
            .filter_map(|s| s.parse().ok())
            .collect(),
        seeds: first.parse().unwrap_or(1)..=last.parse().unwrap_or(1),
        wrong: if value("--wrong", "anywhere") == "alike" { Wrong::Alike } else { Wrong::Anywhere },
        keep: value("--keep", "1").parse().unwrap_or(1.0),
        why: arguments.iter().any(|argument| argument == "--why"),
    };
    let folder = match std::env::var_os("DRIFTLAB_DATA") {
        Some(folder) => PathBuf::from(folder),
        None => PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data"),
    };
    let mut table = Table::new();
    for name in value("--graphs", GRAPHS).split(',') {
        let (kind, size) = name.split_once(':').unwrap_or((name, ""));
        let size = |otherwise: usize| size.parse().unwrap_or(otherwise);
        match kind {
            "town" => rows(name, |seed| manhattan(size(3500), seed).graph, &asked, &mut table),
            "city" => rows(name, |seed| city(size(3000), seed).graph, &asked, &mut table),
            "sphere" => {
                let of = |seed| sphere(&Sphere { seed, ..Sphere::default() }).graph;
                rows(name, of, &asked, &mut table);
            }
            "grid" => {
                let of =
                    |seed| lattice(&Lattice { side: size(6), seed, ..Lattice::default() }).graph;
                rows(name, of, &asked, &mut table);
            }
            _ => {
                let path = folder.join("posegraphs").join(name);
                match std::fs::read(&path).ok().and_then(|bytes| read(&bytes).ok()) {
                    Some(file) => match file.graph {
                        AnyGraph::Plane(graph) => rows(name, |_| graph.clone(), &asked, &mut table),
                        AnyGraph::Space(graph) => rows(name, |_| graph.clone(), &asked, &mut table),
                    },
                    None => println!("{name}: SKIPPED, no graph at {}", path.display()),
                }
            }
        }
    }
    println!(
        "\n| graph | method | wrong | right | worst RMSE, % | precision | recall | scale | secs |"
    );
    println!("|---|---|---|---|---|---|---|---|---|");
    for ((graph, method, share), runs) in &table {
        let worst = |of: fn(&Run) -> f64| runs.iter().map(of).fold(0.0, f64::max);
        println!(
            "| {graph} | {method} | {share} | {}/{} | {:.3} | {:.3} | {:.3} | {:.3} | {:.2} |",
            runs.iter().filter(|run| run.judgement.success()).count(),
            runs.len(),
            100.0 * worst(|run| run.judgement.rmse),
            1.0 - worst(|run| 1.0 - run.judgement.precision),
            1.0 - worst(|run| 1.0 - run.judgement.recall),
            worst(|run| run.noise_scale),
            worst(|run| run.secs),
        );
    }
}

/// All runs on one graph; it may change with the seed.
fn rows<P: Rigid<D>, const D: usize>(
    name: &str,
    graph_of: impl Fn(u64) -> FactorGraph<P, D>,
    asked: &Asked,
    table: &mut Table,
) {
    let options = Options::default();
    let mut known: Option<(FactorGraph<P, D>, Vec<P>)> = None;
    for seed in asked.seeds.clone() {
        let graph = thinned(graph_of(seed), asked.keep);
        let map = match known.take() {
            Some((before, map)) if before == graph => map,
            _ => default_start(&graph, &options).solution.poses,
        };
        for &share in &asked.shares {
            let made = with_wrong_closures(&graph, &map, share, seed, asked.wrong);
            for &method in &asked.methods {
                let began = processor_secs();
                let start = odometry(&made.graph);
                let found = optimize_robust(&made.graph, &start, method, &options, &mut Off);
                let secs = processor_secs() - began;
                let judgement = made.judge(&found, &map);
                println!(
                    "{name:20} {:10} {share} {seed:3} {} rmse {:8.4} % precision {:.3} recall {:.3} \
                     wrong {} rejected {} scale {:.4} loops {:.4} rounds {} iterations {} {secs:.2} s",
                    method.name(),
                    if judgement.success() { "ok  " } else { "FAIL" },
                    100.0 * judgement.rmse,
                    judgement.precision,
                    judgement.recall,
                    made.wrong.len(),
                    found.rejected.len(),
                    found.noise_scale,
                    found.loop_scale.unwrap_or(f64::NAN),
                    found.rounds,
                    found.iterations,
                );
                if asked.why {
                    why(&made.graph, &made.wrong, &found, &map);
                }
                let run = Run { judgement, secs, noise_scale: found.noise_scale };
                let key = (name.to_owned(), method.name(), share.to_string());
                table.entry(key).or_default().push(run);
            }
        }
        known = Some((graph, map));
    }
}

/// The graph with this share of its closures, spread evenly over their order.
fn thinned<P: Rigid<D>, const D: usize>(
    mut graph: FactorGraph<P, D>,
    keep: f64,
) -> FactorGraph<P, D> {
    let closes = closures(&graph);
    let mut seen = 0.0;
    let mut index = 0;
    graph.factors.retain(|_| {
        index += 1;
        if !closes[index - 1] {
            return true;
        }
        let before: f64 = seen;
        seen += keep;
        seen.floor() > before.floor() || keep >= 1.0
    });
    graph
}

/// Lists closures that were taken for what they are not, with `χ²` at the solution and at the map
/// without wrong closures.
fn why<P: Rigid<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    wrong: &[usize],
    found: &posegraph::RobustSolution<P>,
    map: &[P],
) {
    let chi2 = |index: usize, poses: &[P]| {
        let factor = &graph.factors[index];
        let (from, to) = (&poses[factor.from], &poses[factor.to]);
        let error = P::error(posegraph::ErrorKind::G2o, &factor.from_from_to, from, to);
        error.dot(&(factor.information * error))
    };
    for index in 0..graph.factors.len() {
        let (bad, out) =
            (wrong.binary_search(&index).is_ok(), found.rejected.binary_search(&index).is_ok());
        if bad != out {
            println!(
                "    {} {index} {} -> {}: chi2 {:.3} here, {:.3} in the clean map, gate {:.3}",
                if bad { "kept wrong" } else { "left out genuine" },
                graph.factors[index].from,
                graph.factors[index].to,
                chi2(index, &found.solution.poses),
                chi2(index, map),
                found.gate,
            );
        }
    }
}

/// Seconds of the processor so far where the system tells, else of the clock.
fn processor_secs() -> f64 {
    static BEGAN: std::sync::OnceLock<Instant> = std::sync::OnceLock::new();
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanos = told.and_then(|text| text.split(' ').next()?.parse::<f64>().ok());
    nanos.map_or_else(|| BEGAN.get_or_init(Instant::now).elapsed().as_secs_f64(), |n| n * 1e-9)
}
