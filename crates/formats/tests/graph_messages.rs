//! What the readers of pose graphs say about files that are not as they should be.

use formats::pose_graph::{self, AnyGraph, GraphFormat, WarningKind};
use formats::tum;
use posegraph::{FactorGraph2, FactorGraph3};

fn plane(text: &str) -> (FactorGraph2, pose_graph::GraphFileReport) {
    let file = pose_graph::read(text.as_bytes()).expect(text);
    match file.graph {
        AnyGraph::Plane(graph) => (graph, file.report),
        AnyGraph::Space(_) => panic!("{text}: not of the plane"),
    }
}

fn space(text: &str) -> (FactorGraph3, pose_graph::GraphFileReport) {
    let file = pose_graph::read(text.as_bytes()).expect(text);
    match file.graph {
        AnyGraph::Space(graph) => (graph, file.report),
        AnyGraph::Plane(_) => panic!("{text}: not of space"),
    }
}

const UNIT3: &str = "1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1";

#[test]
fn returns_alone_end_lines_and_packed_files_are_named() {
    let text = "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\nEDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n";
    let (graph, report) = plane(&text.replace('\n', "\r"));
    assert_eq!((graph, report), plane(text));
    let path = "0 1 2 3 0 0 0 1\n1 1 2 3 0 0 0 1\n";
    assert_eq!(tum::read(path.replace('\n', "\r").as_bytes()), tum::read(path.as_bytes()));
    for bytes in [&b"\x1f\x8b\x08\x08VERTEX"[..], b"\x1f\x8b"] {
        let found =
            "byte 0: found a gzip-compressed file (decompress it first: gunzip), expected a pose";
        let graph = pose_graph::read(bytes).expect_err("packed").to_string();
        assert!(graph.starts_with(found), "{graph}");
        let path = tum::read(bytes).expect_err("packed").to_string();
        assert!(path.starts_with(found), "{path}");
    }
}

#[test]
fn errors_say_where_what_and_what_instead() {
    let graph = "a pose graph: a line that starts with VERTEX_SE2, VERTEX_SE3:QUAT, EDGE_SE2, \
                 EDGE_SE3:QUAT, VERTEX2, VERTEX3, EDGE2 or EDGE3";
    let cases = [
        ("", format!("line 1, column 1: found the end of the file, expected {graph}")),
        (
            "\n# nothing\n",
            format!("line 2, column 10: found the end of the file, expected {graph}"),
        ),
        ("HELLO 1 2\n", format!("line 1, column 1: found `HELLO`, expected {graph}")),
        (
            "VERTEX_SE2 0 0 0",
            "line 1, column 17: found the end of the file, expected 3 numbers (a pose x y theta), \
             of which 2 are there"
                .into(),
        ),
        (
            "VERTEX_SE2 0 0 0 0\nEDGE_SE2 0 1 1 0 0 1 0\nVERTEX_SE2 1 1 0 0\n",
            "line 2, column 23: found the end of the line, expected 6 numbers (an information \
             matrix I11 I12 I13 I22 I23 I33), of which 2 are there"
                .into(),
        ),
        (
            "VERTEX_SE2 0 0 nan 0\n",
            "line 1, column 16: found `nan`, expected a pose x y theta, a finite number".into(),
        ),
        (
            "EDGE_SE2 0 -1 0 0 0 1 0 0 1 0 1\n",
            "line 1, column 12: found `-1`, expected the id of the vertex that the edge leads to, \
             an integer from 0 to 18446744073709551615"
                .into(),
        ),
        (
            "VERTEX_SE2 0 0 0 0\nVERTEX_SE3:QUAT 1 0 0 0 0 0 0 1\n",
            "line 2, column 1: found `VERTEX_SE3:QUAT` in a file that starts in 2D, expected \
             vertices and edges in 2D only"
                .into(),
        ),
        (
            "VERTEX_SE3:QUAT 1 0 0 0  0 0 0 0\n",
            "line 1, column 26: found a quaternion 0 0 0 0, expected one of norm 1".into(),
        ),
        (
            "VERTEX_SE2 0 0 0 0\nFIX\n",
            "line 2, column 4: found the end of the line, expected the id of a vertex to hold, an \
             integer from 0 to 18446744073709551615"
                .into(),
        ),
    ];
    for (text, message) in cases {
        assert_eq!(pose_graph::read(text.as_bytes()).expect_err(text).to_string(), message);
    }
}

#[test]
fn trajectories_are_checked_line_by_line() {
    let cases = [
        (
            "",
            "line 1, column 1: found the end of the file, expected a pose `timestamp tx ty tz qx qy qz qw`",
        ),
        (
            "0 1 2 3 0 0 0 1\n1 2 3\n",
            "line 2, column 6: found the end of the line, expected 4 numbers (timestamp tx ty tz of a pose), of which 3 are there",
        ),
        (
            "0 1 2 3 0 0 0 1 9\n",
            "line 1, column 17: found `9`, expected the end of the line after eight numbers",
        ),
        (
            "0 1 2 3 0 0 0 x\n",
            "line 1, column 15: found `x`, expected a quaternion qx qy qz qw, a finite number",
        ),
    ];
    for (text, message) in cases {
        assert_eq!(tum::read(text.as_bytes()).expect_err(text).to_string(), message);
    }
    let read = tum::read(b"# stamp x\n1.25 1 2 3 0 0 0 2\n").expect("a pose");
    assert_eq!((read.stamps_secs[0], read.poses[0].translation.z), (1.25, 3.0));
    assert_eq!(read.poses[0].rotation.w, 1.0);
}

#[test]
fn files_without_vertices_sparse_ids_and_other_tags() {
    let text = "PARAMS_SE2OFFSET 0 0 0 0\r\nEDGE_SE2 70000000000 5 1 2 0.5 4 0 0 4 0 9\n\
                EDGE_SE2 5 12 1 2 0.5 4 0 0 4 0 9\nLANDMARK 3\nEDGE_SE2 5 12 1 0 0 1 0 0 1 0 1\n\
                LANDMARK 4 # x\nFIX 12 5\n";
    let (graph, report) = plane(text);
    assert_eq!(graph.ids, [5, 12, 70_000_000_000]);
    assert_eq!(graph.initial, [None; 3]);
    assert_eq!(graph.fixed, [0, 1]);
    let ends: Vec<(usize, usize)> = graph.factors.iter().map(|f| (f.from, f.to)).collect();
    assert_eq!(ends, [(2, 0), (0, 1), (0, 1)]);
    assert_eq!(report.warnings, []);
    assert_eq!((report.lines, report.vertex_lines, report.edge_lines), (7, 0, 3));
    let unknown: Vec<_> =
        report.unknown_tags.iter().map(|u| (u.tag.as_str(), u.count, u.first_line)).collect();
    assert_eq!(unknown, [("`PARAMS_SE2OFFSET`", 1, 1), ("`LANDMARK`", 2, 4)]);
}

/// Found by the fuzzer: counting the ids of a dense range ran beyond the largest there is.
#[test]
fn the_largest_id_is_an_id_like_others() {
    let (graph, report) = plane("VERTEX_SE2 018446744073709551615 0 -0 0\nVERT\nE2 .137643\n");
    assert_eq!((graph.ids.as_slice(), report.unknown_tags.len()), (&[u64::MAX][..], 2));
    let (graph, _) = plane(
        "VERTEX_SE2 18446744073709551614 0 0 0\nVERTEX_SE2 18446744073709551615 1 0 0\n\
         EDGE_SE2 18446744073709551614 18446744073709551615 1 0 0 1 0 0 1 0 1\n",
    );
    assert_eq!(graph.ids, [u64::MAX - 1, u64::MAX]);
    assert_eq!((graph.factors[0].from, graph.factors[0].to), (0, 1));
}

#[test]
fn odd_lines_are_kept_or_left_out_with_a_warning() {
    let text = "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\nVERTEX_SE2 1 2 0 0 7\nFIX 8\n\
                EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\nEDGE_SE2 1 1 1 0 0 1 0 0 1 0 1\n\
                EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\nEDGE_SE2 1 9 1 0 0 1 2 0 1 0 1\n";
    let (graph, report) = plane(text);
    assert_eq!(graph.ids, [0, 1, 9]);
    assert_eq!(graph.initial[1].map(|pose| pose.translation.x), Some(1.0));
    assert_eq!(graph.initial[2], None);
    assert_eq!((graph.factors.len(), graph.fixed.len()), (3, 0));
    let warnings: Vec<_> =
        report.warnings.iter().map(|w| (w.kind, w.count, w.first_line)).collect();
    assert_eq!(
        warnings,
        [
            (WarningKind::TrailingWords, 1, 3),
            (WarningKind::SelfLoop { first_id: 1 }, 1, 6),
            (WarningKind::IndefiniteInformation, 1, 8),
            (WarningKind::MissingVertex { first_id: 9, vertices: 1 }, 1, 8),
            (WarningKind::RepeatedVertex { first_id: 1, conflicting: true }, 1, 3),
            (WarningKind::FixedStranger { first_id: 8 }, 1, 4),
            (WarningKind::RepeatedEdge, 1, 7),
        ]
    );
    assert_eq!(report.messages().len(), 7);
}

#[test]
fn quaternions_are_normalised() {
    let text = format!(
        "VERTEX_SE3:QUAT 0 0 0 0 0 0 0 -2\nVERTEX_SE3:QUAT 1 0 0 0 1e200 0 0 1e200\n\
         VERTEX_SE3:QUAT 2 0 0 0 0 1e-200 0 0\nEDGE_SE3:QUAT 0 1 1 0 0 0 0 0.70710 0.70710 {UNIT3}\n"
    );
    let (graph, report) = space(&text);
    let rotation = |index: usize| graph.initial[index].expect("a pose").rotation;
    assert_eq!(rotation(0).w, -1.0);
    assert!((rotation(1).i - 0.5_f64.sqrt()).abs() < 1e-15);
    assert_eq!(rotation(2).j, 1.0);
    assert!((graph.factors[0].from_from_to.rotation.norm() - 1.0).abs() < 1e-15);
    assert_eq!(report.warnings.len(), 1, "{:?}", report.warnings);
    assert_eq!((report.warnings[0].count, report.warnings[0].first_line), (3, 1));
}

#[test]
fn toro_tells_of_another_frame_another_order_and_other_angles() {
    // A quarter turn: the first axis of the first pose is minus the second axis after the motion.
    let half = std::f64::consts::FRAC_PI_2;
    let (graph, report) = plane(&format!("EDGE2 3 4 1 0 {half} 10 1 20 30 2 3\n"));
    assert_eq!(report.format, GraphFormat::Toro);
    let found = graph.factors[0].information;
    let expected = nalgebra::Matrix3::new(20.0, -1.0, 3.0, -1.0, 10.0, -2.0, 3.0, -2.0, 30.0);
    assert!((found - expected).amax() < 1e-14, "{found}");

    let text = "EDGE3 0 1 1 2 3 0.1 0.2 0.3 1 0 0 5 0 0 1 0 0 0 0 1 0 0 0 40 0 0 40 0 40\n";
    let (graph, _) = space(text);
    let factor = &graph.factors[0];
    let (roll, pitch, yaw) = factor.from_from_to.rotation.euler_angles();
    assert!((roll - 0.1).abs() + (pitch - 0.2).abs() + (yaw - 0.3).abs() < 1e-14);
    assert!((factor.information[(3, 3)] - 160.0).abs() < 1e-12);
    // The block between translation and rotation: twice, and turned from the left.
    let turned = factor.from_from_to.rotation_matrix().transpose().column(0) * 10.0;
    assert!((factor.information.fixed_view::<3, 1>(0, 3) - turned).amax() < 1e-13);
}
