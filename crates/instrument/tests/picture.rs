//! Pictures that are sent in parts are whole at every step.

mod support;

use std::collections::BTreeMap;
use std::path::Path;

use instrument::Level;
use rerun::external::arrow::array::{Array as _, AsArray as _};
use rerun::external::arrow::datatypes::{Float64Type, UInt8Type};
use rerun::external::re_log_encoding::Decoder;
use rerun::log::{Chunk, LogMsg};

fn chunks(path: &Path) -> Vec<Chunk> {
    let file = std::io::BufReader::new(std::fs::File::open(path).expect("the file"));
    Decoder::<LogMsg>::decode_lazy(file)
        .filter_map(|message| match message.expect("whole") {
            LogMsg::ArrowMsg(store, message) if store.is_recording() => {
                Some(Chunk::from_arrow_msg(&message).expect("a chunk"))
            }
            _ => None,
        })
        .collect()
}

/// What the latest row of a component says at each step, by entity.
fn rows<T>(
    chunks: &[Chunk],
    prefix: &str,
    component: &str,
    say: impl Fn(&dyn rerun::external::arrow::array::Array) -> T,
) -> BTreeMap<String, BTreeMap<i64, T>> {
    let mut found: BTreeMap<String, BTreeMap<i64, T>> = BTreeMap::new();
    for chunk in chunks {
        let path = chunk.entity_path().to_string();
        let timelines = chunk.timelines();
        let steps = timelines.values().find(|times| times.name() == "step");
        let column = chunk.components().values().find(|c| c.descriptor.component == component);
        let (true, Some(steps), Some(column)) = (path.starts_with(prefix), steps, column) else {
            continue;
        };
        for (i, step) in steps.times_raw().iter().enumerate() {
            let row = column.list_array.value(i);
            found.entry(path.clone()).or_default().insert(*step, say(&row));
        }
    }
    found
}

fn at<T>(rows: &BTreeMap<i64, T>, step: i64) -> Option<&T> {
    rows.range(..=step).next_back().map(|row| row.1)
}

#[test]
fn coverage_and_paths_are_whole_at_every_step() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.rrd");
    support::record(&path, Level::Summary, &["relative"], worlds::paper::maze(), 300);
    let chunks = chunks(&path);

    // Classes 2 and 3: seen, and seen at this step.
    let tiles = rows(&chunks, "/relative/truth/cells/", "SegmentationImage:buffer", |row| {
        let bytes = row.as_list::<i32>().value(0);
        let classes = bytes.as_primitive::<UInt8Type>().values().to_vec();
        (
            classes.iter().filter(|&&class| class == 2 || class == 3).count(),
            classes.iter().filter(|&&class| class != 0).count(),
        )
    });
    let coverage = rows(&chunks, "/relative/metrics/coverage", "Scalars:scalars", |row| {
        row.as_primitive::<Float64Type>().value(0)
    });
    let coverage = &coverage["/relative/metrics/coverage"];
    let strips = |entity: &str| {
        rows(&chunks, entity, "LineStrips2D:strips", |row| {
            let strips = row.as_list::<i32>();
            (0..strips.len()).map(|i| strips.value(i).len() - 1).sum::<usize>()
        })
    };
    let (path, odometry) = (strips("/relative/truth/path/"), strips("/relative/graph/odometry/"));
    assert!(path.len() > 2 && odometry.len() > 2, "several parts");

    let last = *coverage.keys().next_back().expect("steps");
    assert!(last > 200);
    let (mut before, mut grew) = (0, 0);
    for step in 0..=last {
        let now = tiles.values().filter_map(|tile| at(tile, step));
        let (seen, counts) = now.fold((0, 0), |sum, tile| (sum.0 + tile.0, sum.1 + tile.1));
        assert_eq!(counts, 716, "free cells of the maze at step {step}");
        // A number that stays the same is written where that ends, so steps between hold it too.
        let fraction = at(coverage, step).expect("a number");
        assert_eq!(seen, (fraction * 716.0).round() as usize, "cells seen at step {step}");
        let moved = path.values().filter_map(|part| at(part, step)).sum::<usize>();
        assert!(moved == before || moved == before + 1, "step {step}: {before}, then {moved}");
        grew += moved - before;
        before = moved;
    }
    assert!(grew > 60, "the robot moved {grew} times");
}

/// The summary holds one belief per step: the one at its end.
#[test]
fn the_summary_holds_one_belief_per_step() {
    let folder = tempfile::tempdir().expect("a folder");
    for (level, one_per_step) in [(Level::Summary, true), (Level::Full, false)] {
        let path = folder.path().join(format!("{level:?}.rrd"));
        support::record(&path, level, &["relative"], worlds::paper::open(), 120);
        let mut steps: Vec<i64> = Vec::new();
        for chunk in chunks(&path) {
            if chunk.entity_path().to_string() == "/relative/belief/edges/frontier" {
                let timelines = chunk.timelines();
                let of_chunk = timelines.values().find(|times| times.name() == "step");
                steps.extend(of_chunk.map_or(&[][..], |times| times.times_raw()));
            }
        }
        let rows = steps.len();
        steps.dedup();
        assert!(rows > 60, "{rows} rows at {level:?}");
        assert!(!one_per_step || steps.len() == rows, "{rows} rows, {} steps", steps.len());
    }
}
