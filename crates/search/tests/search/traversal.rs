//! Breadth first and depth first.

use probe::VertexId;
use proptest::prelude::*;
use search::{
    BreadthEvent, DepthEvent, Graph, Scratch, breadth_first, breadth_first_with, depth_first,
    depth_first_with, dijkstra_within,
};

use crate::graphs::{Edges, any_graph};

const START: VertexId = VertexId(0);

fn with_unit_costs(graph: &Edges) -> Edges {
    let edges = graph.edges.iter().map(|&(a, b, _)| (a, b, 1.0)).collect();
    Edges { nodes: graph.nodes, edges }
}

/// Preorder and postorder by plain recursion.
fn recurse(graph: &Edges, node: u32, pre: &mut Vec<VertexId>, post: &mut Vec<VertexId>) {
    pre.push(VertexId(node));
    let mut next: Vec<u32> = graph.edges.iter().filter(|e| e.0 == node).map(|e| e.1).collect();
    next.sort_unstable();
    for to in next {
        if !pre.contains(&VertexId(to)) {
            recurse(graph, to, pre, post);
        }
    }
    post.push(VertexId(node));
}

proptest! {
    #[test]
    fn breadth_first_is_dijkstra_at_unit_costs(graph in any_graph(), max_hops in 0usize..8) {
        let unit = with_unit_costs(&graph);
        let mut scratch = Scratch::new();
        let expected = dijkstra_within(&unit, START, max_hops as f64, &mut scratch).unwrap();
        let expected = expected.settled().to_vec();
        let tree = breadth_first(&graph, START, max_hops, &mut scratch).unwrap();
        prop_assert_eq!(tree.settled(), &expected);
        for (position, settled) in expected.iter().enumerate() {
            prop_assert_eq!(tree.position(settled.node), Some(position));
        }
    }

    #[test]
    fn depth_first_is_the_recursion(graph in any_graph()) {
        let (mut pre, mut post) = (Vec::new(), Vec::new());
        recurse(&graph, 0, &mut pre, &mut post);
        let mut scratch = Scratch::new();
        let found = depth_first(&graph, START, &mut scratch).unwrap();
        let entered: Vec<_> = found.tree.settled().iter().map(|settled| settled.node).collect();
        prop_assert_eq!(entered, pre);
        prop_assert_eq!(found.left, post);
        for settled in found.tree.settled() {
            let depth = found.tree.back_from(settled.node).count() - 1;
            prop_assert_eq!(settled.cost, depth as f64);
            if let Some(parent) = settled.parent {
                prop_assert!(graph.edge_cost(parent, settled.node).is_some());
            }
        }
    }

    #[test]
    fn the_order_of_edges_does_not_matter(graph in any_graph()) {
        let other = graph.reordered();
        let (mut one, mut two) = (Scratch::new(), Scratch::new());
        let a = breadth_first(&graph, START, usize::MAX, &mut one).unwrap();
        let b = breadth_first(&other, START, usize::MAX, &mut two).unwrap();
        prop_assert_eq!(a.settled(), b.settled());
        let a = depth_first(&graph, START, &mut one).unwrap();
        let b = depth_first(&other, START, &mut two).unwrap();
        prop_assert_eq!(a.tree.settled(), b.tree.settled());
        prop_assert_eq!(a.left, b.left);
    }

    #[test]
    fn probes_change_nothing_and_see_every_node(graph in any_graph()) {
        let mut scratch = Scratch::new();
        let plain = breadth_first(&graph, START, 3, &mut scratch).unwrap().settled().to_vec();
        let mut events: Vec<BreadthEvent<VertexId>> = Vec::new();
        let tree = breadth_first_with(&graph, START, 3, &mut scratch, &mut events).unwrap();
        prop_assert_eq!(tree.settled(), &plain);
        let mut reached: Vec<_> = events.iter().filter_map(|event| match *event {
            BreadthEvent::Reached { from, node, hops } => Some((hops, node, from)),
            _ => None,
        }).collect();
        reached.sort_unstable();
        let expected: Vec<_> =
            plain.iter().map(|s| (s.cost as usize, s.node, s.parent)).collect();
        prop_assert_eq!(reached, expected);
        let end = BreadthEvent::Exhausted { reached: plain.len() };
        prop_assert_eq!(events.last(), Some(&end));

        let plain = depth_first(&graph, START, &mut scratch).unwrap();
        let (entered, left) = (plain.tree.settled().to_vec(), plain.left.to_vec());
        let mut events: Vec<DepthEvent<VertexId>> = Vec::new();
        let found = depth_first_with(&graph, START, &mut scratch, &mut events).unwrap();
        prop_assert_eq!(found.tree.settled(), &entered);
        prop_assert_eq!(found.left, &left);
        let mut open = Vec::new();
        for event in &events {
            match *event {
                DepthEvent::Entered { node, parent, depth } => {
                    prop_assert_eq!((open.last().copied(), open.len()), (parent, depth));
                    open.push(node);
                }
                DepthEvent::Left { node } => prop_assert_eq!(open.pop(), Some(node)),
                DepthEvent::Exhausted { entered } => prop_assert_eq!(entered, found.tree.len()),
            }
        }
        prop_assert!(open.is_empty());
    }
}

#[test]
fn breadth_first_expands_no_node_at_the_limit() {
    let graph = Edges { nodes: 4, edges: vec![(0, 1, 1.0), (1, 2, 1.0), (2, 3, 1.0)] };
    let mut events: Vec<BreadthEvent<VertexId>> = Vec::new();
    breadth_first_with(&graph, START, 1, &mut Scratch::new(), &mut events).unwrap();
    let expected = [
        BreadthEvent::Reached { from: None, node: START, hops: 0 },
        BreadthEvent::Reached { from: Some(START), node: VertexId(1), hops: 1 },
        BreadthEvent::Expanded { node: START },
        BreadthEvent::Exhausted { reached: 2 },
    ];
    assert_eq!(events, expected);
}

#[test]
fn a_long_chain_does_not_overflow_the_stack() {
    struct Chain;
    impl Graph for Chain {
        type Node = VertexId;
        fn node_bound(&self) -> usize {
            300_000
        }
        fn for_each_edge(&self, from: VertexId, mut visit: impl FnMut(VertexId, f64)) {
            if from.0 + 1 < 300_000 {
                visit(VertexId(from.0 + 1), 1.0);
            }
        }
    }
    let mut scratch = Scratch::new();
    let found = depth_first(&Chain, START, &mut scratch).unwrap();
    assert_eq!(found.left.len(), 300_000);
    assert_eq!(found.left.last(), Some(&START));
}

#[test]
fn an_acyclic_graph_leaves_in_reverse_topological_order() {
    let edges = vec![(0, 3, 1.0), (0, 1, 1.0), (3, 1, 1.0), (1, 2, 1.0), (3, 2, 1.0)];
    let mut scratch = Scratch::new();
    let graph = Edges { nodes: 4, edges };
    let found = depth_first(&graph, START, &mut scratch).unwrap();
    let order: Vec<u32> = found.left.iter().rev().map(|node| node.0).collect();
    assert_eq!(order, [0, 3, 1, 2]);
}
