//! Vertices leave the skeleton and come back; the ways between the others stay what they are.

use pose::Se2;
use posegraph::{EdgeKind, PoseGraph, Scope, ScopeScratch, Skeleton};
use probe::{EdgeId, VertexId};
use proptest::prelude::*;
use proptest::sample::Index;

use super::config;
use super::graphs::{Drawn, all_ways, graphs, near, same_pose, skeleton_of, walk};

const SEEDS: &str = "proptest-regressions/contraction.txt";

#[derive(Clone, Debug)]
enum Op {
    Retire(Index),
    Restore(Index),
    Add(Index, Index),
}

fn ops() -> impl Strategy<Value = Vec<Op>> {
    let op = prop_oneof![
        4 => any::<Index>().prop_map(Op::Retire),
        1 => any::<Index>().prop_map(Op::Restore),
        2 => (any::<Index>(), any::<Index>()).prop_map(|(a, b)| Op::Add(a, b)),
    ];
    prop::collection::vec(op, 1..16)
}

/// Applies an op to the record and to the skeleton. Returns whether ways stay exact: a vertex that
/// was retired when something new came to it may be left with ways that are longer.
fn apply(
    op: &Op,
    drawn: &Drawn,
    graph: &mut PoseGraph,
    skeleton: &mut Skeleton,
    scratch: &mut ScopeScratch,
) -> Result<bool, TestCaseError> {
    let pick = |index: &Index| VertexId(index.index(drawn.places.len()) as u32);
    match op {
        Op::Retire(vertex) => {
            let vertex = pick(vertex);
            let can = !skeleton.is_retired(vertex) && !skeleton.links(vertex).is_empty();
            let count = skeleton.retired_count();
            prop_assert_eq!(skeleton.retire(vertex, scratch), can);
            prop_assert_eq!(skeleton.retired_count(), count + usize::from(can));
        }
        Op::Restore(vertex) => {
            let vertex = pick(vertex);
            let can = skeleton.is_retired(vertex);
            prop_assert_eq!(skeleton.restore(vertex, scratch), can);
            prop_assert!(!skeleton.is_retired(vertex));
            return Ok(!can);
        }
        Op::Add(a, b) => {
            let hidden = [a, b].map(|v| skeleton.is_retired(pick(v)));
            if let Some(edge) = drawn.add_picked(graph, a, b) {
                skeleton.add_edge(edge, graph.edge(edge), scratch);
            }
            prop_assert_eq!([a, b].map(|v| skeleton.is_retired(pick(v))), hidden);
            return Ok(hidden == [false; 2]);
        }
    }
    Ok(true)
}

/// Links come in pairs, lead to vertices that are there, and are ways over measured edges.
fn check_links(graph: &PoseGraph, skeleton: &Skeleton) -> Result<(), TestCaseError> {
    for here in (0..skeleton.len() as u32).map(VertexId) {
        prop_assert!(!skeleton.is_retired(here) || skeleton.links(here).is_empty());
        for link in skeleton.links(here) {
            prop_assert!(!skeleton.is_retired(link.to));
            let walked = walk(graph, here, link.via.edges());
            prop_assert!(walked.is_some(), "{:?} is no way from {}", link, here);
            let (end, way) = walked.unwrap();
            prop_assert_eq!(end, link.to);
            prop_assert!(near(way.length_m, link.length_m));
            prop_assert!(near(way.odometry_m, link.odometry_m));
            prop_assert!(same_pose(&way.from_to, &link.here_from_there));
            let mut reversed = link.via.edges().to_vec();
            reversed.reverse();
            let back = skeleton.links(link.to).iter();
            let back = back.filter(|back| back.to == here && back.via.edges() == reversed);
            prop_assert!(back.count() > 0, "no link back");
        }
    }
    Ok(())
}

/// Between vertices that are not retired: exact up to the horizon, farther ways no shorter than
/// they are, and nothing comes apart. `stretch` is what a way may have grown by.
fn check_ways(
    graph: &PoseGraph,
    skeleton: &Skeleton,
    horizon_m: f64,
    stretch: f64,
) -> Result<(), TestCaseError> {
    let (mut scope, mut scratch) = (Scope::default(), ScopeScratch::default());
    let ways = all_ways(graph);
    for root in (0..skeleton.len() as u32).map(VertexId).filter(|&v| !skeleton.is_retired(v)) {
        scratch.place(skeleton, root, f64::INFINITY, &mut scope);
        for to in (0..skeleton.len() as u32).map(VertexId).filter(|&v| !skeleton.is_retired(v)) {
            let row = scope.placed().iter().find(|row| row.vertex == to);
            let Some(way) = &ways[root.0 as usize][to.0 as usize] else {
                prop_assert!(row.is_none());
                continue;
            };
            prop_assert!(row.is_some(), "{} and {} came apart", root, to);
            let row = row.unwrap();
            prop_assert!(row.distance_m > way.length_m - 1e-9);
            if way.length_m <= horizon_m - 1e-9 {
                prop_assert!(row.distance_m < way.length_m * stretch + 1e-9, "{:?} {:?}", row, way);
                if stretch == 1.0 {
                    prop_assert!(same_pose(&row.root_from_vertex, &way.from_to));
                }
            }
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(config(300, SEEDS))]

    #[test]
    fn ways_up_to_the_horizon_stay_what_they_are(
        drawn in graphs(2..12),
        ops in ops(),
        horizon_m in prop_oneof![Just(0.0), 5.0..40.0_f64, Just(1e9)],
    ) {
        let mut graph = drawn.graph();
        let mut skeleton = skeleton_of(&graph, horizon_m);
        let mut scratch = ScopeScratch::default();
        let mut exact = true;
        for op in &ops {
            exact &= apply(op, &drawn, &mut graph, &mut skeleton, &mut scratch)?;
            check_links(&graph, &skeleton)?;
            check_ways(&graph, &skeleton, if exact { horizon_m } else { 0.0 }, 1.0)?;
        }
    }

    /// A vertex that stands for a retired one is not retired, and says where it is.
    #[test]
    fn retired_vertices_can_be_found(drawn in graphs(2..12), ops in ops()) {
        let drawn = Drawn { wrong_m: 0.0, ..drawn };
        let mut graph = drawn.graph();
        let mut skeleton = skeleton_of(&graph, 20.0);
        let mut scratch = ScopeScratch::default();
        for op in &ops {
            apply(op, &drawn, &mut graph, &mut skeleton, &mut scratch)?;
            for vertex in 0..drawn.places.len() {
                let (host, host_from_vertex) = skeleton.resolve(VertexId(vertex as u32));
                prop_assert!(!skeleton.is_retired(host));
                let exact = drawn.world_from(host.0 as usize).inverse_mul(&drawn.world_from(vertex));
                prop_assert!(same_pose(&host_from_vertex, &exact));
            }
        }
    }

    /// With a stretch, a way that loses one vertex grows by no more than that.
    #[test]
    fn a_stretch_bounds_what_one_vertex_costs(
        drawn in graphs(3..12),
        vertex in any::<Index>(),
        stretch in 1.0..1.5_f64,
    ) {
        let graph = drawn.graph();
        let mut scratch = ScopeScratch::default();
        let mut skeleton = Skeleton::with_stretch(1e9, stretch);
        skeleton.cover(VertexId(drawn.places.len() as u32 - 1));
        for (id, edge) in graph.edges() {
            skeleton.add_edge(id, edge, &mut scratch);
        }
        skeleton.retire(VertexId(vertex.index(drawn.places.len()) as u32), &mut scratch);
        check_links(&graph, &skeleton)?;
        check_ways(&graph, &skeleton, 1e9, stretch)?;
    }

    /// Everything but one vertex may go, and come back.
    #[test]
    fn all_come_back(drawn in graphs(2..10)) {
        let graph = drawn.graph();
        let mut skeleton = skeleton_of(&graph, 1e9);
        let mut scratch = ScopeScratch::default();
        for vertex in (1..drawn.places.len() as u32).map(VertexId) {
            skeleton.retire(vertex, &mut scratch);
        }
        for vertex in (1..drawn.places.len() as u32).map(VertexId) {
            skeleton.restore(vertex, &mut scratch);
        }
        prop_assert_eq!(skeleton.retired_count(), 0);
        check_links(&graph, &skeleton)?;
        check_ways(&graph, &skeleton, 0.0, 1.0)?;
    }
}

/// A chain of places 1 m apart.
fn chain(length: u32) -> (PoseGraph, Skeleton) {
    let mut graph = PoseGraph::new();
    for i in 0..length {
        let vertex = graph.add_vertex();
        if i > 0 {
            let step = Se2::new(1.0, 0.0, 0.0);
            graph.add_edge(VertexId(i - 1), vertex, step, EdgeKind::Odometry).unwrap();
        }
    }
    let skeleton = skeleton_of(&graph, 20.0);
    (graph, skeleton)
}

#[test]
fn a_chain_becomes_one_link() {
    let (_, mut skeleton) = chain(5);
    let mut scratch = ScopeScratch::default();
    for vertex in [2, 1, 3].map(VertexId) {
        assert!(skeleton.retire(vertex, &mut scratch));
    }
    assert!(!skeleton.is_whole());
    let [link] = skeleton.links(VertexId(0)) else { panic!("{:?}", skeleton.links(VertexId(0))) };
    assert_eq!((link.to, link.length_m, link.odometry_m), (VertexId(4), 4.0, 4.0));
    assert_eq!(link.via.edges(), [0, 1, 2, 3].map(EdgeId));
    assert!(skeleton.heap_bytes() > 0);
}

#[test]
fn an_edge_to_a_retired_vertex_serves_the_others() {
    let (mut graph, mut skeleton) = chain(5);
    let mut scratch = ScopeScratch::default();
    assert!(skeleton.retire(VertexId(2), &mut scratch));
    // A sixth place, 0.5 m beside the retired one.
    let beside = graph.add_vertex();
    skeleton.cover(beside);
    let pose = Se2::new(0.0, 0.5, 0.0);
    let edge = graph.add_edge(VertexId(2), beside, pose, EdgeKind::Place).unwrap();
    skeleton.add_edge(edge, graph.edge(edge), &mut scratch);
    assert!(skeleton.is_retired(VertexId(2)));
    for end in [1, 3].map(VertexId) {
        let length_m = scratch.distance_within(&skeleton, beside, end, 10.0);
        assert_eq!(length_m, Some(1.5), "not by way of the vertex that stands for it");
    }
}

#[test]
fn a_vertex_without_links_stays() {
    let mut skeleton = Skeleton::new(10.0);
    assert!(skeleton.is_empty());
    skeleton.cover(VertexId(0));
    assert!(!skeleton.retire(VertexId(0), &mut ScopeScratch::default()));
    assert!(!skeleton.restore(VertexId(0), &mut ScopeScratch::default()));
    assert_eq!(skeleton.resolve(VertexId(0)), (VertexId(0), Se2::identity()));
}
