//! Bad graphs and bad questions get a typed error, and leave the scratch usable.

use probe::VertexId;
use search::{
    Scratch, SearchError, astar, astar_nearest, breadth_first, depth_first, dijkstra,
    dijkstra_nearest, dijkstra_within,
};

use crate::graphs::Edges;

const START: VertexId = VertexId(0);

fn graph(edges: Vec<(u32, u32, f64)>) -> Edges {
    Edges { nodes: 3, edges }
}

#[test]
fn negative_and_nan_costs_are_refused_with_their_edge() {
    for bad in [-0.5, f64::NAN, f64::NEG_INFINITY] {
        let graph = graph(vec![(0, 1, 1.0), (1, 2, bad), (1, 0, 1.0)]);
        let mut scratch = Scratch::new();
        let errors = [
            dijkstra(&graph, START, &mut scratch).unwrap_err(),
            dijkstra_nearest(&graph, START, 9.0, |_| false, &mut scratch).unwrap_err(),
            astar(&graph, START, VertexId(2), |_| 0.0, &mut scratch).unwrap_err(),
        ];
        for error in errors {
            let SearchError::Cost { from: 1, to: 2, cost } = error else { panic!("{error}") };
            assert_eq!(cost.to_bits(), bad.to_bits());
        }
        // Out of reach, the edge is not looked at.
        assert_eq!(dijkstra_within(&graph, START, 0.5, &mut scratch).unwrap().len(), 1);
        assert_eq!(breadth_first(&graph, START, 9, &mut scratch).unwrap().len(), 3);
    }
}

#[test]
fn edges_out_of_the_graph_are_refused() {
    let graph = graph(vec![(0, 7, 1.0)]);
    let mut scratch = Scratch::new();
    let expected = SearchError::EdgeOutOfRange { from: 0, to: 7, bound: 3 };
    assert_eq!(dijkstra(&graph, START, &mut scratch).unwrap_err(), expected);
    assert_eq!(breadth_first(&graph, START, 9, &mut scratch).unwrap_err(), expected);
    assert_eq!(depth_first(&graph, START, &mut scratch).unwrap_err(), expected);
    assert_eq!(astar(&graph, START, START, |_| 0.0, &mut scratch).unwrap().unwrap().cost, 0.0);
    let refused = astar(&graph, START, VertexId(1), |_| 0.0, &mut scratch).unwrap_err();
    assert_eq!(refused, expected);
}

#[test]
fn starts_and_goals_out_of_the_graph_are_refused() {
    let graph = graph(vec![]);
    let out = VertexId(3);
    let mut scratch = Scratch::new();
    let expected = SearchError::NodeOutOfRange { node: 3, bound: 3 };
    assert_eq!(dijkstra(&graph, out, &mut scratch).unwrap_err(), expected);
    assert_eq!(breadth_first(&graph, out, 9, &mut scratch).unwrap_err(), expected);
    assert_eq!(depth_first(&graph, out, &mut scratch).unwrap_err(), expected);
    assert_eq!(astar(&graph, START, out, |_| 0.0, &mut scratch).unwrap_err(), expected);
    assert_eq!(astar(&graph, out, START, |_| 0.0, &mut scratch).unwrap_err(), expected);
    let refused = astar_nearest(&graph, START, &[START, out], |_, _| 0.0, &mut scratch);
    assert_eq!(refused.unwrap_err(), expected);
    assert_eq!(expected.to_string(), "node 3 is not in the graph, whose nodes are below 3");

    let empty = Edges { nodes: 0, edges: vec![] };
    let expected = SearchError::NodeOutOfRange { node: 0, bound: 0 };
    assert_eq!(dijkstra(&empty, START, &mut Scratch::new()).unwrap_err(), expected);
}

#[test]
fn bad_limits_are_refused() {
    let graph = graph(vec![(0, 1, 1.0)]);
    let mut scratch = Scratch::new();
    for bad in [-1.0, f64::NAN] {
        let refused = dijkstra_within(&graph, START, bad, &mut scratch).unwrap_err();
        let SearchError::Limit { limit } = refused else { panic!("{refused}") };
        assert_eq!(limit.to_bits(), bad.to_bits());
    }
    assert_eq!(dijkstra(&graph, START, &mut scratch).unwrap().len(), 2, "it goes on after errors");
}
