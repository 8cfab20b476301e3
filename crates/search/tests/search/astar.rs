//! A* against Floyd and Warshall, with estimates from useless over inconsistent to perfect.

use probe::VertexId;
use proptest::prelude::*;
use search::{
    AstarEvent, Graph, Scratch, SearchError, astar, astar_nearest, astar_where, astar_with,
    dijkstra_nearest,
};

use crate::graphs::{Edges, any_graph, positive_graph};

const START: VertexId = VertexId(0);

/// The true cost left, cut down to a share of 0 to 4 quarters that differs wildly from node to
/// node: admissible, far from consistent.
fn cut_down(left: f64, shares: &[u32], node: VertexId) -> f64 {
    match shares[node.0 as usize % shares.len()] {
        0 => 0.0,
        share => left * f64::from(share) / 4.0,
    }
}

fn shares() -> impl Strategy<Value = Vec<u32>> {
    proptest::collection::vec(0u32..=4, 1..24)
}

proptest! {
    #[test]
    fn the_route_to_one_goal_is_cheapest(
        graph in any_graph(), shares in shares(), goal in 0usize..24,
    ) {
        let goal = goal % graph.nodes;
        let oracle = graph.all_pairs();
        let mut scratch = Scratch::new();
        let estimate = |node: VertexId| cut_down(oracle[node.0 as usize][goal], &shares, node);
        let route = astar(&graph, START, VertexId(goal as u32), estimate, &mut scratch).unwrap();
        match route {
            None => prop_assert_eq!(oracle[0][goal], f64::INFINITY),
            Some(route) => {
                prop_assert_eq!(route.cost, oracle[0][goal]);
                prop_assert_eq!(graph.path_cost(route.nodes), route.cost);
                prop_assert_eq!(route.nodes[0], START);
                prop_assert_eq!(route.nodes.last(), Some(&VertexId(goal as u32)));
            }
        }
    }

    #[test]
    fn the_nearest_of_many_goals_costs_what_dijkstra_says(
        graph in any_graph(), shares in shares(),
        goals in proptest::collection::vec(0usize..24, 0..5),
    ) {
        let goals: Vec<_> = goals.iter().map(|g| VertexId((g % graph.nodes) as u32)).collect();
        let oracle = graph.all_pairs();
        let is_goal = |node| goals.contains(&node);
        let mut scratch = Scratch::new();
        let nearest = dijkstra_nearest(&graph, START, f64::INFINITY, is_goal, &mut scratch);
        let expected = nearest.unwrap().goal.map(|goal| goal.cost);

        let estimate = |node: VertexId, goal: VertexId| {
            cut_down(oracle[node.0 as usize][goal.0 as usize], &shares, node)
        };
        let route = astar_nearest(&graph, START, &goals, estimate, &mut scratch).unwrap();
        prop_assert_eq!(route.map(|route| route.cost), expected);
        if let Some(route) = route {
            prop_assert!(is_goal(*route.nodes.last().unwrap()));
            prop_assert_eq!(graph.path_cost(route.nodes), route.cost);
        }

        let least = |node: VertexId| {
            goals.iter().map(|goal| estimate(node, *goal)).fold(f64::INFINITY, f64::min)
        };
        let route = astar_where(&graph, START, is_goal, least, &mut scratch).unwrap();
        prop_assert_eq!(route.map(|route| route.cost), expected);
    }

    #[test]
    fn without_an_estimate_it_is_dijkstra(graph in positive_graph(), goal in 0usize..24) {
        let goal = VertexId((goal % graph.nodes) as u32);
        let mut scratch = Scratch::new();
        let is_goal = |node| node == goal;
        let nearest = dijkstra_nearest(&graph, START, f64::INFINITY, is_goal, &mut scratch);
        let settled = nearest.unwrap().tree.settled().to_vec();
        let route = astar(&graph, START, goal, |_| 0.0, &mut scratch).unwrap();
        let expanded = route.map_or(settled.len(), |route| route.expanded + 1);
        prop_assert_eq!(expanded, settled.len());
        prop_assert_eq!(scratch.tree().settled(), settled);
    }

    #[test]
    fn a_perfect_estimate_expands_only_nodes_of_cheapest_routes(
        graph in positive_graph(), goal in 0usize..24,
    ) {
        let goal = goal % graph.nodes;
        let oracle = graph.all_pairs();
        let mut scratch = Scratch::new();
        let perfect = |node: VertexId| oracle[node.0 as usize][goal];
        let route = astar(&graph, START, VertexId(goal as u32), perfect, &mut scratch).unwrap();
        prop_assert_eq!(route.is_none(), oracle[0][goal].is_infinite());
        for settled in scratch.tree().settled() {
            let node = settled.node.0 as usize;
            prop_assert_eq!(settled.cost + oracle[node][goal], oracle[0][goal]);
        }
    }

    #[test]
    fn a_probe_changes_nothing_and_the_order_of_edges_neither(
        graph in any_graph(), shares in shares(), goal in 0usize..24,
    ) {
        let goal = goal % graph.nodes;
        let oracle = graph.all_pairs();
        let estimate = |node: VertexId| cut_down(oracle[node.0 as usize][goal], &shares, node);
        let goal = VertexId(goal as u32);
        let mut scratch = Scratch::new();
        let plain = astar(&graph, START, goal, estimate, &mut scratch).unwrap();
        let plain = plain.map(|route| (route.nodes.to_vec(), route.cost, route.expanded));
        for graph in [&graph, &graph.reordered()] {
            let mut events: Vec<AstarEvent<VertexId>> = Vec::new();
            let watched =
                astar_with(graph, START, goal, estimate, &mut scratch, &mut events).unwrap();
            let watched = watched.map(|route| (route.nodes.to_vec(), route.cost, route.expanded));
            prop_assert_eq!(&watched, &plain);
            let count = |wanted: fn(&AstarEvent<VertexId>) -> bool| {
                events.iter().filter(|event| wanted(event)).count()
            };
            let expanded = count(|event| matches!(event, AstarEvent::Expanded { .. }));
            let closed = scratch.tree().len() - usize::from(plain.is_some());
            prop_assert_eq!(expanded, closed);
            let end = match plain {
                Some((_, cost, _)) => AstarEvent::Found { goal, cost },
                None => AstarEvent::Exhausted { expanded },
            };
            prop_assert_eq!(events.last(), Some(&end));
        }
    }
}

/// An open square grid, four neighbours.
struct Grid {
    side: u32,
}

impl Graph for Grid {
    type Node = VertexId;

    fn node_bound(&self) -> usize {
        (self.side * self.side) as usize
    }

    fn for_each_edge(&self, from: VertexId, mut visit: impl FnMut(VertexId, f64)) {
        let (x, y) = (from.0 % self.side, from.0 / self.side);
        let mut step = |x: u32, y: u32| {
            if x < self.side && y < self.side {
                visit(VertexId(y * self.side + x), 1.0);
            }
        };
        step(x + 1, y);
        step(x.wrapping_sub(1), y);
        step(x, y + 1);
        step(x, y.wrapping_sub(1));
    }
}

#[test]
fn ties_are_taken_towards_the_goal() {
    let grid = Grid { side: 50 };
    let goal = VertexId(50 * 50 - 1);
    let estimate = |node: VertexId| f64::from((49 - node.0 % 50) + (49 - node.0 / 50));
    let mut scratch = Scratch::new();
    let route = astar(&grid, START, goal, estimate, &mut scratch).unwrap().unwrap();
    assert_eq!((route.cost, route.expanded), (98.0, 98), "no node off the route is expanded");
}

#[test]
fn an_inconsistent_estimate_reopens_and_still_finds_the_cheapest() {
    // The estimate at 1 holds back the cheap way to 2 until 2 has been expanded.
    let edges = vec![(0, 1, 1.0), (1, 2, 1.0), (0, 2, 3.0), (2, 3, 4.0)];
    let graph = Edges { nodes: 4, edges };
    let estimate = |node: VertexId| [0.0, 5.0, 0.0, 0.0][node.0 as usize];
    let mut events: Vec<AstarEvent<VertexId>> = Vec::new();
    let mut scratch = Scratch::new();
    let route =
        astar_with(&graph, START, VertexId(3), estimate, &mut scratch, &mut events).unwrap();
    let route = route.unwrap();
    assert_eq!(route.cost, 6.0);
    assert_eq!(route.nodes, [0, 1, 2, 3].map(VertexId));
    assert!(events.contains(&AstarEvent::Reopened { node: VertexId(2) }));
    let cheaper = AstarEvent::Relaxed {
        from: VertexId(1),
        to: VertexId(2),
        before: Some(3.0),
        cost: 2.0,
        estimate: 0.0,
    };
    assert!(events.contains(&cheaper));
}

#[test]
fn the_start_can_be_the_goal_and_goals_can_be_none() {
    let graph = Edges { nodes: 2, edges: vec![(0, 1, 1.0)] };
    let mut scratch = Scratch::new();
    let route = astar(&graph, START, START, |_| 0.0, &mut scratch).unwrap().unwrap();
    assert_eq!((route.nodes, route.cost, route.expanded), (&[START][..], 0.0, 0));
    let none = astar_nearest(&graph, START, &[], |_, _| 0.0, &mut scratch).unwrap();
    assert_eq!(none, None);
    let hopeless = astar(&graph, START, VertexId(1), |_| f64::INFINITY, &mut scratch).unwrap();
    assert_eq!(hopeless, None, "an infinite estimate rules a node out");
}

#[test]
fn bad_estimates_are_refused() {
    let graph = Edges { nodes: 3, edges: vec![(0, 1, 1.0), (1, 2, 1.0)] };
    let mut scratch = Scratch::new();
    for bad in [-1.0, f64::NAN] {
        let estimate = |node: VertexId| if node.0 == 1 { bad } else { 0.0 };
        let refused = astar(&graph, START, VertexId(2), estimate, &mut scratch).unwrap_err();
        let SearchError::Estimate { node: 1, estimate } = refused else {
            panic!("{refused}");
        };
        assert_eq!(estimate.to_bits(), bad.to_bits());
    }
    // One of many goals is enough, wherever it stands in the list.
    for goals in [[1, 2], [2, 1]] {
        let estimate = |_, goal: VertexId| if goal.0 == 1 { f64::NAN } else { 0.0 };
        let goals = goals.map(VertexId);
        let refused = astar_nearest(&graph, START, &goals, estimate, &mut scratch).unwrap_err();
        assert!(matches!(refused, SearchError::Estimate { node: 0, .. }), "{refused}");
    }
}
