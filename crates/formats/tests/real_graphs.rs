//! Pose graphs that others wrote, where a folder of test data is at hand.

mod data;

use std::fs;

use formats::pose_graph::{AnyGraph, GraphFormat, WarningKind, read, write};
use formats::{Kind, sniff};

/// File, dimensions, vertices, vertex lines, edges, unknown tags: as counted by `grep`.
const KNOWN: [(&str, usize, usize, usize, usize, usize); 18] = [
    ("intel.g2o", 2, 1728, 1728, 2512, 0),
    ("input_INTEL_g2o.g2o", 2, 1228, 1228, 1483, 0),
    ("input_M3500_g2o.g2o", 2, 3500, 3500, 5453, 0),
    ("manhattan.g2o", 2, 3500, 0, 5453, 0),
    ("manhattanOlson3500.g2o", 2, 3500, 3500, 5598, 0),
    ("FR079_P_toro.graph", 2, 989, 989, 1217, 0),
    ("kitti_05.g2o", 2, 2761, 0, 2826, 0),
    ("tinyGrid3D.g2o", 3, 9, 9, 11, 0),
    ("smallGrid3D.g2o", 3, 125, 125, 297, 0),
    ("sphere2500.g2o", 3, 2500, 2500, 4949, 0),
    ("sphere2500_groundtruth.txt", 3, 2500, 0, 4949, 0),
    ("parking-garage.g2o", 3, 1661, 1661, 6275, 0),
    ("sphere.g2o", 3, 2500, 2500, 9799, 0),
    ("sphere_gt.g2o", 3, 2500, 2500, 9799, 0),
    ("gtsam_small/w100.graph", 2, 100, 100, 300, 1),
    ("gtsam_small/noisyToyGraph.txt", 2, 4, 4, 5, 0),
    ("gtsam_small/pose3example.txt", 3, 5, 5, 6, 0),
    ("gtsam_small/Klaus3.g2o", 3, 3, 3, 3, 0),
];

#[test]
fn counts_are_those_of_the_files_and_g2o_reads_back_equal() {
    let Some(folder) = data::folder("posegraphs") else { return };
    for (name, dimensions, vertices, vertex_lines, edges, unknown) in KNOWN {
        let bytes = fs::read(folder.join(name)).expect(name);
        let file = read(&bytes).expect(name);
        let (graph, report) = (&file.graph, &file.report);
        assert_eq!(
            (graph.dimensions(), graph.vertices(), graph.edges()),
            (dimensions, vertices, edges),
            "{name}"
        );
        assert_eq!((report.vertex_lines, report.edge_lines), (vertex_lines, edges), "{name}");
        assert_eq!(report.unknown_tags.len(), unknown, "{name}");
        let kind = match report.format {
            GraphFormat::G2o => Kind::G2o,
            GraphFormat::Toro => Kind::Toro,
        };
        assert_eq!(sniff(&bytes, None), kind, "{name}");

        let text = write(graph, GraphFormat::G2o);
        let back = read(&text).expect(name);
        assert_eq!(&back.graph, graph, "{name}");
        if edges < 3000 {
            let through_toro = read(&write(graph, GraphFormat::Toro)).expect(name);
            assert_eq!(through_toro.graph.edges(), edges, "{name}");
        }
    }
}

#[test]
fn the_vehicle_of_the_garage_and_its_quaternions() {
    let Some(folder) = data::folder("posegraphs") else { return };
    let name = "parking-garage.g2o";
    let file = read(&fs::read(folder.join(name)).expect(name)).expect(name);
    let norms = |kind: &WarningKind| matches!(kind, WarningKind::NonUnitQuaternion { .. });
    assert!(!file.report.warnings.iter().any(|w| norms(&w.kind)), "{:?}", file.report);
    let AnyGraph::Space(graph) = file.graph else { panic!("{name} is of space") };
    let norm = |factor: &posegraph::Factor<_, 6>| -> f64 { pose_norm(&factor.from_from_to) };
    assert!(graph.factors.iter().all(|factor| (norm(factor) - 1.0).abs() < 1e-14));
}

fn pose_norm(pose: &pose::Se3) -> f64 {
    pose.rotation.coords.norm()
}
