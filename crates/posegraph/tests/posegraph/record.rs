//! The record of vertices and edges: what it refuses, and what withdrawal leaves.

use pose::Se2;
use posegraph::{EdgeKind, PoseGraph, PoseGraphError};
use probe::{EdgeId, VertexId};
use proptest::prelude::*;

use super::config;
use super::graphs::{graphs, same_pose};

const SEEDS: &str = "proptest-regressions/record.txt";

fn two() -> (PoseGraph, VertexId, VertexId) {
    let mut graph = PoseGraph::new();
    let (a, b) = (graph.add_vertex(), graph.add_vertex());
    (graph, a, b)
}

#[test]
fn requests_that_make_no_sense_are_refused() {
    let (mut graph, a, b) = two();
    let pose = Se2::new(1.0, 2.0, 0.5);
    let nobody = VertexId(7);
    let unknown = PoseGraphError::UnknownVertex { vertex: nobody, len: 2 };
    assert_eq!(graph.add_edge(a, nobody, pose, EdgeKind::Place), Err(unknown.clone()));
    assert_eq!(graph.add_edge(nobody, b, pose, EdgeKind::Odometry), Err(unknown));
    let to_itself = graph.add_edge(b, b, pose, EdgeKind::Place);
    assert_eq!(to_itself, Err(PoseGraphError::SelfEdge { vertex: b }));
    for (x, y, theta) in [
        (f64::NAN, 0.0, 0.0),
        (0.0, f64::INFINITY, 0.0),
        (0.0, f64::NEG_INFINITY, 0.0),
        (0.0, 0.0, f64::NAN),
        (0.0, 0.0, f64::INFINITY),
    ] {
        let refused = graph.add_edge(a, b, Se2::new(x, y, theta), EdgeKind::Place);
        assert_eq!(refused, Err(PoseGraphError::NotFinite { a, b }), "{x} {y} {theta}");
    }
    assert_eq!(graph.edge_count(), 0, "what is refused leaves no trace");
    assert_eq!(graph.edges_of(a).count(), 0);
}

#[test]
fn only_place_edges_can_be_withdrawn_and_only_once() {
    let (mut graph, a, b) = two();
    let pose = Se2::new(1.0, 0.0, 0.0);
    let driven = graph.add_edge(a, b, pose, EdgeKind::Odometry).unwrap();
    let recognised = graph.add_edge(a, b, pose, EdgeKind::Place).unwrap();
    let nothing = EdgeId(9);
    assert_eq!(graph.withdraw(nothing), Err(PoseGraphError::UnknownEdge { edge: nothing, len: 2 }));
    assert_eq!(graph.withdraw(driven), Err(PoseGraphError::NotAPlaceEdge { edge: driven }));
    assert_eq!(graph.withdraw(recognised), Ok(()));
    assert_eq!(
        graph.withdraw(recognised),
        Err(PoseGraphError::AlreadyWithdrawn { edge: recognised })
    );
    assert!(graph.edge(recognised).withdrawn && !graph.edge(driven).withdrawn);
    assert_eq!(graph.edge_count(), 2, "it stays in the record");
    for vertex in [a, b] {
        assert_eq!(graph.edges_of(vertex).map(|(id, _)| id).collect::<Vec<_>>(), [driven]);
    }
}

#[test]
fn errors_name_what_was_wrong() {
    let message = PoseGraphError::UnknownVertex { vertex: VertexId(7), len: 2 }.to_string();
    assert_eq!(message, "vertex v7 is not in the graph, which holds 2 vertices");
}

proptest! {
    #![proptest_config(config(100, SEEDS))]

    /// Every edge is told at both its ends, each seen from there, until it is withdrawn.
    #[test]
    fn edges_are_told_at_both_ends(
        drawn in graphs(2..10),
        gone in prop::collection::vec(any::<prop::sample::Index>(), 0..6),
    ) {
        let mut graph = drawn.graph();
        for pick in gone {
            if graph.edge_count() > 0 {
                let edge = EdgeId(pick.index(graph.edge_count()) as u32);
                let (kind, before) = (graph.edge(edge).kind, graph.edge(edge).withdrawn);
                let done = graph.withdraw(edge).is_ok();
                prop_assert_eq!(done, kind == EdgeKind::Place && !before);
            }
        }
        prop_assert_eq!(graph.vertex_count(), drawn.places.len());
        prop_assert_eq!(graph.edges().len(), graph.edge_count());
        for (id, edge) in graph.edges() {
            prop_assert!((edge.length_m - edge.a_from_b.distance()).abs() == 0.0);
            for (here, there) in [(edge.a, edge.b), (edge.b, edge.a)] {
                let told = graph.edges_of(here).filter(|(known, _)| *known == id).count();
                prop_assert_eq!(told, usize::from(!edge.withdrawn));
                let (end, here_from_there) = edge.from_end(here);
                prop_assert_eq!(end, there);
                let there_from_here = edge.from_end(there).1;
                prop_assert!(same_pose(&(here_from_there * there_from_here), &Se2::identity()));
            }
        }
    }
}
