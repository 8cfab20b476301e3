//! Poses one by one on the public graphs of `$DRIFTLAB_DATA/posegraphs`, marginals, and growth with
//! the size of the graph; one thread.
//!
//! `cargo bench -p posegraph --bench incremental [-- NAME]` prints three tables. The time of a step is
//! that of the thread on the processor, the best of several runs, which do the same work, so that other
//! work on the machine counts less; beside it stands what the wall says. `NAME` picks graphs; `growth` the
//! last table.
#![expect(clippy::print_stdout, reason = "a bench prints its table")]

use std::path::PathBuf;
use std::time::Instant;

use formats::pose_graph::{AnyGraph, read};
use posegraph::initial::{odometry, spanning_tree};
use posegraph::synthetic::{Lattice, lattice, manhattan};
use posegraph::{
    Factor, FactorGraph, Incremental, IncrementalOptions, Manifold, Marginals, Options, optimize,
};

const GRAPHS: [&str; 6] = [
    "input_M3500_g2o.g2o",
    "manhattanOlson3500.g2o",
    "input_INTEL_g2o.g2o",
    "intel.g2o",
    "parking-garage.g2o",
    "sphere2500.g2o",
];

/// Runs of each graph; fewer where one takes long.
const RUNS: usize = 3;
const LONG_SECS: f64 = 10.0;

fn millis(since: Instant) -> f64 {
    since.elapsed().as_secs_f64() * 1e3
}

/// Factors by the vertex with which they become known, those to the vertex before first.
fn by_step<P: Copy, const D: usize>(graph: &FactorGraph<P, D>) -> Vec<Vec<Factor<P, D>>> {
    let mut steps = vec![Vec::new(); graph.ids.len()];
    for factor in &graph.factors {
        steps[factor.from.max(factor.to)].push(*factor);
    }
    for (vertex, step) in steps.iter_mut().enumerate() {
        step.sort_by_key(|factor| factor.from.min(factor.to) + 1 != vertex);
    }
    steps
}

fn steps<P: Manifold<D>, const D: usize>(name: &str, graph: &FactorGraph<P, D>) {
    let given = by_step(graph);
    let count = given.len();
    let mut times = vec![f64::INFINITY; count];
    let mut walls = vec![f64::INFINITY; count];
    let (mut finish, mut cpu) = (f64::INFINITY, f64::INFINITY);
    let (mut before, mut after, mut relinearised, mut refactored) = (0.0, 0.0, 0, 0);
    for _ in 0..RUNS {
        let mut growing = Incremental::new(IncrementalOptions::default());
        let used = cpu_secs();
        (relinearised, refactored) = (0, 0);
        for (step, (time, wall)) in given.iter().zip(times.iter_mut().zip(&mut walls)) {
            let (used, clock) = (cpu_secs(), Instant::now());
            if let Ok(update) = growing.add(None, step) {
                relinearised += update.relinearised;
                refactored += update.refactored;
            }
            *wall = wall.min(millis(clock));
            *time = time.min((cpu_secs() - used) * 1e3);
        }
        before = growing.chi2();
        let clock = Instant::now();
        growing.finish(&Options::default());
        finish = finish.min(millis(clock));
        cpu = cpu.min(cpu_secs() - used);
        after = growing.chi2();
        if times.iter().sum::<f64>() > LONG_SECS * 1e3 {
            break;
        }
    }
    let exact = Options { relative_decrease: 1e-12, ..Options::default() };
    let best = optimize(graph, &odometry(graph), &exact).report.chi2;
    let wall: f64 = walls.iter().sum();
    times.sort_by(f64::total_cmp);
    walls.sort_by(f64::total_cmp);
    println!(
        "| {name} | {count} | {:.2} | {cpu:.2} | {:.2} | {:.2} | {:.2} | {:.2} | {:.1} | {finish:.1} | {:.0} | {:.0} | {:+.1e} | {:+.1e} |",
        (wall + finish) / 1e3,
        walls[count * 95 / 100],
        times[count / 2],
        times[count * 95 / 100],
        times[count * 99 / 100],
        times[count - 1],
        relinearised as f64 / count as f64,
        refactored as f64 / count as f64,
        (before - best) / best,
        (after - best) / best,
    );
}

fn marginals<P: Manifold<D>, const D: usize>(name: &str, graph: &FactorGraph<P, D>) {
    let options = Options::default();
    let poses = optimize(graph, &odometry(graph), &options).poses;
    let clock = Instant::now();
    let Ok(marginals) = Marginals::new(graph, &poses, options.error) else {
        println!("| {name} | not determined |");
        return;
    };
    let factorise = millis(clock);
    let clock = Instant::now();
    let all = marginals.all();
    let of_all = millis(clock);
    let (mut one, mut two, mut worst) = (0.0, 0.0, 0.0f64);
    let count = all.len();
    let samples: Vec<usize> = (0..200).map(|k| k * 7919 % count).collect();
    for &a in &samples {
        let clock = Instant::now();
        let covariance = marginals.covariance(a);
        one += millis(clock);
        let clock = Instant::now();
        let relative = marginals.relative(a, count - 1 - a);
        two += millis(clock);
        if let (Some(covariance), Some(_)) = (covariance, relative) {
            let scale = all[a].amax().max(f64::MIN_POSITIVE);
            worst = worst.max((covariance - all[a]).amax() / scale);
        }
    }
    let share = 1e3 / samples.len() as f64;
    println!(
        "| {name} | {count} | {factorise:.1} | {of_all:.1} | {:.0} | {:.0} | {worst:.0e} |",
        one * share,
        two * share
    );
}

/// Time per iteration of a batch solution, and the numbers stored.
fn growth<P: Manifold<D>, const D: usize>(name: &str, graph: &FactorGraph<P, D>) {
    let start = spanning_tree(graph);
    let clock = Instant::now();
    let one = Options { max_iterations: 1, ..Options::default() };
    let report = optimize(graph, &start, &one).report;
    let first = millis(clock);
    let clock = Instant::now();
    let six = Options { max_iterations: 6, relative_decrease: 0.0, step: 0.0, ..one };
    let more = optimize(graph, &start, &six).report.iterations.len();
    let each = (millis(clock) - first) / (more.max(2) - 1) as f64;
    println!(
        "| {name} | {} | {} | {:.1} | {each:.1} | {:.1} | {:.1} |",
        graph.ids.len(),
        graph.factors.len(),
        first - each,
        report.fill.factor as f64 * 8e-6,
        peak_megabytes(),
    );
}

/// CPU seconds of this thread; 0 where the system does not tell.
fn cpu_secs() -> f64 {
    // The count is brought up to date where the scheduler is entered.
    std::thread::yield_now();
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let nanos = text.split(' ').next().and_then(|word| word.parse::<f64>().ok());
    nanos.unwrap_or(0.0) * 1e-9
}

/// The most memory that this process has held, megabytes; 0 where the system does not tell.
fn peak_megabytes() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kilobytes = line.and_then(|rest| rest.trim().trim_end_matches(" kB").parse::<f64>().ok());
    kilobytes.unwrap_or(0.0) / 1024.0
}

fn main() {
    let wanted = std::env::args().skip(1).find(|argument| !argument.starts_with('-'));
    let wanted = |name: &str| wanted.as_ref().is_none_or(|wanted| name.contains(wanted.as_str()));
    let folder = match std::env::var_os("DRIFTLAB_DATA") {
        Some(folder) => PathBuf::from(folder),
        None => PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data"),
    };
    if wanted("growth") {
        println!("| graph | poses | factors | analysis ms | iteration ms | factor MB | peak MB |");
        println!("|---|---|---|---|---|---|---|");
        for poses in [1_000, 10_000, 100_000] {
            growth("town", &manhattan(poses, 1).graph);
        }
        for side in [10, 22, 31] {
            growth("lattice", &lattice(&Lattice { side, ..Lattice::default() }).graph);
        }
    }
    let graphs: Vec<(&str, AnyGraph)> = GRAPHS
        .into_iter()
        .filter(|name| wanted(name))
        .filter_map(|name| {
            let bytes = std::fs::read(folder.join("posegraphs").join(name)).ok()?;
            Some((name, read(&bytes).ok()?.graph))
        })
        .collect();
    println!(
        "\n| graph | poses | total s | CPU s | p95 ms | CPU: median ms | p95 | p99 | max | finish ms | relinearised per step | refactored | gap before | gap at the end |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|");
    for (name, graph) in &graphs {
        match graph {
            AnyGraph::Plane(graph) => steps(name, graph),
            AnyGraph::Space(graph) => steps(name, graph),
        }
    }
    println!(
        "\n| graph | poses | factorise ms | all ms | one vertex us | relative pose us | way against recursion |"
    );
    println!("|---|---|---|---|---|---|---|");
    for (name, graph) in &graphs {
        match graph {
            AnyGraph::Plane(graph) => marginals(name, graph),
            AnyGraph::Space(graph) => marginals(name, graph),
        }
    }
}
