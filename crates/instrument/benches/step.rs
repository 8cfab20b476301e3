//! What recording adds to a step: the median step of the paper's maze at each level.
//!
//! The bar is 1 ms for `full` and 0.1 ms for `summary`, each against `off`.

#![allow(missing_docs, reason = "a benchmark has no users")]

#[path = "../tests/support/mod.rs"]
mod support;

use std::sync::Arc;
use std::time::Duration;

use criterion::Criterion;
use instrument::{Level, Recording};

fn median_step(level: Level, kind: &str) -> Duration {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.rrd");
    let world = Arc::new(worlds::paper::maze());
    let options = support::options(&path, level, &[kind], &world);
    let recording = Recording::create(options).expect("a new file");
    let mut recorder = recording.recorder(kind);
    let (_, _, mut times) = support::explore(&mut recorder, kind, &world, 20_000);
    recorder.send().expect("rows fit together");
    recording.finish(&serde_json::json!({})).expect("a disk");
    times.sort_unstable();
    times[times.len() / 2]
}

fn main() {
    let mut criterion = Criterion::default().sample_size(10).configure_from_args();
    for kind in ["relative", "grid"] {
        let mut group = criterion.benchmark_group(format!("median step of the maze, {kind}"));
        for level in [Level::Off, Level::Summary, Level::Full] {
            group.bench_function(format!("{level:?}"), |bencher| {
                bencher.iter_custom(|rounds| {
                    (0..rounds.min(3)).map(|_| median_step(level, kind)).sum::<Duration>()
                        * (rounds as u32)
                        / (rounds.min(3) as u32)
                });
            });
        }
        group.finish();
    }
    criterion.final_summary();
}
