//! Dijkstra against Floyd and Warshall.

use probe::VertexId;
use proptest::prelude::*;
use search::{
    DijkstraEvent, Scratch, Settled, dijkstra, dijkstra_nearest, dijkstra_nearest_with,
    dijkstra_within, dijkstra_within_with,
};

use crate::graphs::{Edges, any_graph, positive_graph};

const START: VertexId = VertexId(0);

fn settled_within(graph: &Edges, limit: f64) -> Vec<Settled<VertexId>> {
    let mut scratch = Scratch::new();
    let tree = dijkstra_within(graph, START, limit, &mut scratch);
    tree.expect("the graph and the limit are valid").settled().to_vec()
}

proptest! {
    #[test]
    fn costs_are_those_of_floyd_and_warshall(graph in any_graph()) {
        let oracle = graph.all_pairs();
        let mut scratch = Scratch::new();
        for (start, costs) in oracle.iter().enumerate() {
            let tree = dijkstra(&graph, VertexId(start as u32), &mut scratch).unwrap();
            for (node, &cost) in costs.iter().enumerate() {
                let found = tree.cost(VertexId(node as u32)).unwrap_or(f64::INFINITY);
                prop_assert_eq!(found, cost, "{} -> {}", start, node);
            }
        }
    }

    #[test]
    fn parents_make_paths_of_the_same_cost(graph in any_graph()) {
        let mut scratch = Scratch::new();
        let tree = dijkstra(&graph, START, &mut scratch).unwrap();
        for (position, settled) in tree.settled().iter().enumerate() {
            let path = tree.path_to(settled.node).unwrap();
            prop_assert_eq!((path[0], path[path.len() - 1]), (START, settled.node));
            prop_assert_eq!(graph.path_cost(&path), settled.cost);
            prop_assert_eq!(tree.position(settled.node), Some(position));
            if let Some(parent) = settled.parent {
                prop_assert!(tree.position(parent).unwrap() < position);
            }
        }
    }

    #[test]
    fn nodes_are_settled_by_cost_and_then_by_id(graph in positive_graph()) {
        let settled = settled_within(&graph, f64::INFINITY);
        let keys: Vec<_> = settled.iter().map(|s| (s.cost.to_bits(), s.node)).collect();
        prop_assert!(keys.is_sorted(), "{keys:?}");
    }

    #[test]
    fn free_edges_keep_the_order_of_costs(graph in any_graph()) {
        prop_assert!(settled_within(&graph, f64::INFINITY).is_sorted_by_key(|s| s.cost.to_bits()));
    }

    #[test]
    fn the_parent_is_the_first_settled_that_gives_the_cost(graph in any_graph()) {
        let settled = settled_within(&graph, f64::INFINITY);
        for (position, child) in settled.iter().enumerate().skip(1) {
            let first = settled[..position].iter().find(|parent| {
                graph.edge_cost(parent.node, child.node).map(|cost| parent.cost + cost)
                    == Some(child.cost)
            });
            prop_assert_eq!(first.map(|parent| parent.node), child.parent);
        }
    }

    #[test]
    fn the_order_of_edges_does_not_matter(graph in any_graph()) {
        let other = graph.reordered();
        prop_assert_eq!(settled_within(&graph, 3.0), settled_within(&other, 3.0));
    }

    #[test]
    fn a_bounded_search_is_the_head_of_a_full_one(graph in any_graph(), quarters in 0u32..20) {
        let limit = f64::from(quarters) / 4.0;
        let mut head = settled_within(&graph, f64::INFINITY);
        head.retain(|settled| settled.cost <= limit);
        prop_assert_eq!(settled_within(&graph, limit), head);
    }

    #[test]
    fn the_nearest_goal_is_the_first_of_a_full_search(
        graph in any_graph(),
        goals in proptest::collection::vec(0u32..24, 0..5),
        limit in prop_oneof![Just(f64::INFINITY), Just(2.0)],
    ) {
        let is_goal = |node: VertexId| goals.contains(&node.0);
        let expected = settled_within(&graph, limit).into_iter().find(|s| is_goal(s.node));
        let mut scratch = Scratch::new();
        let nearest = dijkstra_nearest(&graph, START, limit, is_goal, &mut scratch).unwrap();
        prop_assert_eq!(nearest.goal, expected);
        if let Some(goal) = nearest.goal {
            prop_assert_eq!(nearest.tree.settled().last(), Some(&goal), "it goes no further");
        }
    }

    #[test]
    fn a_used_scratch_is_as_good_as_a_new_one(
        first in any_graph(), second in any_graph(), limit in 0.0f64..4.0,
    ) {
        let mut scratch = Scratch::new();
        dijkstra(&first, START, &mut scratch).unwrap();
        let tree = dijkstra_within(&second, START, limit, &mut scratch).unwrap();
        prop_assert_eq!(tree.settled(), settled_within(&second, limit));
        let known = (0..30).filter(|&node| tree.get(VertexId(node)).is_some()).count();
        prop_assert_eq!(known, tree.len(), "nothing is left of the first search");
    }

    #[test]
    fn a_probe_changes_nothing_and_sees_everything(graph in any_graph(), limit in 0.0f64..6.0) {
        let plain = settled_within(&graph, limit);
        let mut events: Vec<DijkstraEvent<VertexId>> = Vec::new();
        let mut scratch = Scratch::new();
        let tree = dijkstra_within_with(&graph, START, limit, &mut scratch, &mut events).unwrap();
        prop_assert_eq!(tree.settled(), &plain);
        let settled = events.iter().filter_map(|event| match *event {
            DijkstraEvent::Settled { node, cost, parent } => Some(Settled { node, cost, parent }),
            _ => None,
        });
        prop_assert_eq!(settled.collect::<Vec<_>>(), plain.clone());
        let mut costs = vec![None; graph.nodes];
        for event in &events {
            if let DijkstraEvent::Relaxed { to, before, cost, .. } = *event {
                prop_assert_eq!(before, costs[to.0 as usize]);
                costs[to.0 as usize] = Some(cost);
            }
        }
        for reached in &plain[1..] {
            prop_assert_eq!(costs[reached.node.0 as usize], Some(reached.cost));
        }
        let last = events.last();
        prop_assert_eq!(last, Some(&DijkstraEvent::Exhausted { settled: plain.len() }));
    }
}

#[test]
fn every_kind_of_event_occurs() {
    let edges = vec![(0, 1, 5.0), (0, 2, 1.0), (2, 1, 1.0), (1, 3, 1.0), (1, 4, 9.0)];
    let graph = Edges { nodes: 5, edges };
    let (a, b, c, d) = (VertexId(0), VertexId(1), VertexId(2), VertexId(3));
    let mut events: Vec<DijkstraEvent<VertexId>> = Vec::new();
    let mut scratch = Scratch::new();
    let is_goal = |node| node == d;
    dijkstra_nearest_with(&graph, a, 6.0, is_goal, &mut scratch, &mut events).unwrap();
    let expected = [
        DijkstraEvent::Settled { node: a, cost: 0.0, parent: None },
        DijkstraEvent::Relaxed { from: a, to: b, before: None, cost: 5.0 },
        DijkstraEvent::Relaxed { from: a, to: c, before: None, cost: 1.0 },
        DijkstraEvent::Expanded { node: a },
        DijkstraEvent::Settled { node: c, cost: 1.0, parent: Some(a) },
        DijkstraEvent::Relaxed { from: c, to: b, before: Some(5.0), cost: 2.0 },
        DijkstraEvent::Expanded { node: c },
        DijkstraEvent::Settled { node: b, cost: 2.0, parent: Some(c) },
        DijkstraEvent::Relaxed { from: b, to: d, before: None, cost: 3.0 },
        DijkstraEvent::BeyondLimit { from: b, to: VertexId(4), cost: 11.0 },
        DijkstraEvent::Expanded { node: b },
        DijkstraEvent::Settled { node: d, cost: 3.0, parent: Some(b) },
        DijkstraEvent::Found { goal: d, cost: 3.0 },
    ];
    assert_eq!(events, expected);
}

#[test]
fn limit_zero_gives_the_start_and_what_is_free_from_it() {
    let graph = Edges { nodes: 3, edges: vec![(0, 1, 0.0), (1, 2, 0.25)] };
    let nodes: Vec<u32> = settled_within(&graph, 0.0).iter().map(|s| s.node.0).collect();
    assert_eq!(nodes, [0, 1]);
}

#[test]
fn a_path_whose_cost_overflows_is_closed() {
    let graph = Edges { nodes: 3, edges: vec![(0, 1, f64::MAX), (1, 2, f64::MAX)] };
    assert_eq!(settled_within(&graph, f64::INFINITY).len(), 2);
}

#[test]
fn minus_zero_costs_nothing() {
    let graph = Edges { nodes: 3, edges: vec![(0, 2, -0.0), (0, 1, 1.0)] };
    let costs: Vec<f64> = settled_within(&graph, f64::INFINITY).iter().map(|s| s.cost).collect();
    assert_eq!(costs, [0.0, 0.0, 1.0]);
    assert_eq!(settled_within(&graph, -0.0).len(), 2);
}
