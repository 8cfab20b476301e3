//! Any bytes as a pose graph and as a trajectory: no panic, and what is accepted reads back equal.
#![no_main]

use formats::pose_graph::{AnyGraph, GraphFormat, read, write};
use formats::{sniff, tum};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let _ = sniff(bytes, None);
    if let Ok(file) = read(bytes) {
        let _ = file.report.messages();
        let _ = write(&file.graph, GraphFormat::Toro);
        let text = write(&file.graph, GraphFormat::G2o);
        // A file of self-loops alone leaves nothing to write.
        if !text.is_empty() {
            let back = read(&text).expect("it was written").graph;
            let poses = |graph: &AnyGraph| match graph {
                AnyGraph::Plane(graph) => format!("{:?} {:?}", graph.initial, graph.factors),
                AnyGraph::Space(graph) => format!("{:?} {:?}", graph.initial, graph.factors),
            };
            assert_eq!(poses(&back), poses(&file.graph));
        }
    }
    if let Ok(trajectory) = tum::read(bytes) {
        assert_eq!(tum::read(&tum::write(&trajectory)).expect("it was written"), trajectory);
    }
});
