//! Placement along shortest paths ([ISRR19] 4.2) and the scope (4.3).

use pose::Se3;
use pose::nalgebra::{UnitQuaternion, Vector3};
use posegraph::{EdgeKind, PoseGraph, PoseGraphError, Scope, ScopeScratch, Skeleton};
use probe::VertexId;
use proptest::prelude::*;

use super::config;
use super::graphs::{
    all_ways, all_ways_weighing, filled, graphs, near, same_pose, skeleton_of, walk,
};

const SEEDS: &str = "proptest-regressions/placement.txt";

proptest! {
    #![proptest_config(config(400, SEEDS))]

    /// Who is in a scope, how far, and where: what brute force finds along the shortest path.
    #[test]
    fn a_scope_is_what_brute_force_finds(
        drawn in graphs(1..16),
        root in any::<prop::sample::Index>(),
        radius_m in prop_oneof![3 => 0.0..60.0_f64, 1 => Just(f64::INFINITY), 1 => Just(0.0)],
    ) {
        let graph = drawn.graph();
        let skeleton = skeleton_of(&graph, 20.0);
        let root = root.index(drawn.places.len());
        let (mut scope, mut scratch) = (Scope::default(), ScopeScratch::default());
        // The second time in the same memory gives the same.
        scratch.place(&skeleton, VertexId(0), 1e9, &mut scope);
        scratch.place(&skeleton, VertexId(root as u32), radius_m, &mut scope);
        prop_assert_eq!(scope.root(), Some(VertexId(root as u32)));
        prop_assert!(scope.placed().is_sorted_by(|a, b| a.distance_m <= b.distance_m));
        let ways = all_ways(&graph);
        for (vertex, way) in ways[root].iter().enumerate() {
            let mut rows = scope.placed().iter().filter(|row| row.vertex.0 as usize == vertex);
            let row = rows.next();
            prop_assert!(rows.next().is_none(), "v{} twice", vertex);
            let Some(way) = way.filter(|way| way.length_m < radius_m + 1e-9) else {
                prop_assert!(row.is_none(), "v{} is out of reach", vertex);
                continue;
            };
            if way.length_m > radius_m - 1e-9 && radius_m > 0.0 {
                continue;
            }
            prop_assert!(row.is_some(), "v{} is {} m away", vertex, way.length_m);
            let row = row.unwrap();
            prop_assert!(near(row.distance_m, way.length_m));
            prop_assert!(near(row.odometry_m, way.odometry_m));
            prop_assert!(same_pose(&row.root_from_vertex, &way.from_to), "{:?} {:?}", row, way);
        }
    }

    /// Where place edges count less, placement goes along what is then shortest; driving does not.
    #[test]
    fn weighed_places_change_placement_and_not_driving(
        drawn in graphs(2..14),
        place_weight in 0.01..1.0_f64,
    ) {
        let graph = drawn.graph();
        let skeleton = filled(Skeleton::new(20.0).weigh_places(place_weight), &graph);
        let (mut scope, mut scratch) = (Scope::default(), ScopeScratch::default());
        scratch.place(&skeleton, VertexId(0), f64::INFINITY, &mut scope);
        let (weighed, driven) = (all_ways_weighing(&graph, place_weight), all_ways(&graph));
        let reached = weighed[0].iter().filter(|way| way.is_some()).count();
        prop_assert_eq!(scope.placed().len(), reached);
        for row in scope.placed() {
            let vertex = row.vertex.0 as usize;
            let way = weighed[0][vertex].unwrap();
            prop_assert!(near(row.distance_m, way.length_m));
            prop_assert!(near(row.odometry_m, way.odometry_m));
            prop_assert!(same_pose(&row.root_from_vertex, &way.from_to), "{:?} {:?}", row, way);
            let goal = |at: VertexId| at == row.vertex;
            let legs = scratch.way_to_nearest(&skeleton, VertexId(0), f64::INFINITY, goal).unwrap();
            let legs_m: f64 = legs.iter().map(|leg| leg.1).sum();
            prop_assert!(near(legs_m, driven[0][vertex].unwrap().length_m));
        }
    }

    /// What is weighed anew is placed as if it had been weighed so from the start.
    #[test]
    fn weighing_anew_is_weighing_from_the_start(
        drawn in graphs(1..14),
        place_weight in 0.01..1.0_f64,
    ) {
        let graph = drawn.graph();
        let anew = skeleton_of(&graph, 20.0).reweighed(place_weight);
        let skeleton = filled(Skeleton::new(20.0).weigh_places(place_weight), &graph);
        let (mut one, mut other) = (Scope::default(), Scope::default());
        let mut scratch = ScopeScratch::default();
        scratch.place(&anew, VertexId(0), f64::INFINITY, &mut one);
        scratch.place(&skeleton, VertexId(0), f64::INFINITY, &mut other);
        prop_assert_eq!(one.placed().len(), other.placed().len());
        for (a, b) in one.placed().iter().zip(other.placed()) {
            prop_assert!(near(a.distance_m, b.distance_m));
        }
    }

    /// The nearest few are the head of all.
    #[test]
    fn the_nearest_few_are_the_head_of_all(
        drawn in graphs(1..16),
        radius_m in 0.0..60.0_f64,
        most in 0_usize..20,
    ) {
        let skeleton = skeleton_of(&drawn.graph(), 20.0);
        let (mut all, mut few) = (Scope::default(), Scope::default());
        let mut scratch = ScopeScratch::default();
        scratch.place(&skeleton, VertexId(0), radius_m, &mut all);
        scratch.place_nearest(&skeleton, VertexId(0), radius_m, most, &mut few);
        let count = most.clamp(1, all.placed().len());
        prop_assert_eq!(few.placed(), &all.placed()[..count]);
    }

    /// The path between two rows leads from one to the other, walks no edge twice, and adds up to
    /// how they are placed.
    #[test]
    fn a_path_between_rows_is_a_way(drawn in graphs(2..12), radius_m in 5.0..80.0_f64) {
        let graph = drawn.graph();
        let skeleton = skeleton_of(&graph, 20.0);
        let (mut scope, mut scratch) = (Scope::default(), ScopeScratch::default());
        scratch.place(&skeleton, VertexId(0), radius_m, &mut scope);
        let rows = scope.placed();
        for (a, row_a) in rows.iter().enumerate() {
            for (b, row_b) in rows.iter().enumerate() {
                let path = scope.path_between(&skeleton, a, b);
                let walked = walk(&graph, row_a.vertex, &path);
                prop_assert!(walked.is_some(), "{:?} is no way from {}", path, row_a.vertex);
                let (end, way) = walked.unwrap();
                prop_assert_eq!(end, row_b.vertex);
                let a_from_b = row_a.root_from_vertex.inverse_mul(&row_b.root_from_vertex);
                prop_assert!(same_pose(&way.from_to, &a_from_b));
                let mut once = path.clone();
                once.sort_unstable();
                once.dedup();
                prop_assert_eq!(once.len(), path.len(), "an edge is walked twice");
                prop_assert!(a != b || path.is_empty());
            }
        }
    }

    #[test]
    fn the_nearest_goal_is_the_nearest(
        drawn in graphs(2..14),
        goals in prop::collection::vec(any::<bool>(), 14),
        limit_m in prop_oneof![0.0..50.0_f64, Just(f64::INFINITY)],
    ) {
        let graph = drawn.graph();
        let skeleton = skeleton_of(&graph, 20.0);
        let ways = all_ways(&graph);
        let mut scratch = ScopeScratch::default();
        let goal = |vertex: VertexId| goals[vertex.0 as usize];
        let found = scratch.way_to_nearest(&skeleton, VertexId(0), limit_m, goal);
        let lengths = ways[0].iter().enumerate().filter(|(v, _)| goals[*v]);
        let nearest_m = lengths.filter_map(|(_, way)| Some(way.as_ref()?.length_m)).reduce(f64::min);
        match nearest_m {
            Some(nearest_m) if nearest_m < limit_m - 1e-9 => {
                prop_assert!(found.is_some());
                let legs = found.unwrap();
                prop_assert!(near(legs.iter().map(|leg| leg.1).sum(), nearest_m));
                let end = legs.last().map_or(VertexId(0), |leg| leg.0);
                prop_assert!(goals[end.0 as usize]);
            }
            Some(nearest_m) if nearest_m < limit_m + 1e-9 => {}
            _ => prop_assert_eq!(found, None),
        }
        for (vertex, way) in ways[0].iter().enumerate() {
            let there = VertexId(vertex as u32);
            let told = scratch.distance_within(&skeleton, VertexId(0), there, limit_m);
            match way {
                Some(way) if way.length_m < limit_m - 1e-9 => {
                    prop_assert!(told.is_some_and(|told| near(told, way.length_m)));
                }
                Some(way) if way.length_m < limit_m + 1e-9 => {}
                _ => prop_assert_eq!(told, None),
            }
        }
    }
}

#[test]
fn a_root_that_is_not_there_stands_alone() {
    let (mut scope, mut scratch) = (Scope::default(), ScopeScratch::default());
    assert_eq!(scope.root(), None);
    let skeleton: Skeleton = Skeleton::new(10.0);
    scratch.place(&skeleton, VertexId(3), 10.0, &mut scope);
    assert_eq!((scope.root(), scope.placed().len()), (Some(VertexId(3)), 1));
}

/// In space as in the plane: the plane lifted into space gives the same ways and places.
#[test]
fn space_is_placed_as_the_plane_is() {
    let turn = |angle| UnitQuaternion::from_axis_angle(&Vector3::z_axis(), angle);
    let mut graph: PoseGraph<Se3> = PoseGraph::new();
    let (mut skeleton, mut scratch) = (Skeleton::new(10.0), ScopeScratch::default());
    let vertices: Vec<VertexId> = (0..6).map(|_| graph.add_vertex()).collect();
    skeleton.cover(vertices[5]);
    // A hexagon of 1 m, climbing by 0.5 m with each step; the last side is a place edge.
    let step = Se3::new(Vector3::new(1.0, 0.0, 0.5), turn(std::f64::consts::FRAC_PI_3));
    let mut edges = Vec::new();
    for pair in vertices.windows(2) {
        let edge = graph.add_edge(pair[0], pair[1], step, EdgeKind::Odometry).unwrap();
        skeleton.add_edge(edge, graph.edge(edge), &mut scratch);
        edges.push(edge);
    }
    let all = (0..5).fold(Se3::identity(), |so_far, _| so_far * step);
    let place = graph.add_edge(vertices[0], vertices[5], all, EdgeKind::Place).unwrap();
    skeleton.add_edge(place, graph.edge(place), &mut scratch);
    let mut scope = Scope::default();
    assert!(skeleton.retire(vertices[1], &mut scratch));
    scratch.place(&skeleton, vertices[0], 10.0, &mut scope);
    for row in scope.placed() {
        let steps = row.vertex.0;
        let expected = (0..steps).fold(Se3::identity(), |so_far, _| so_far * step);
        let off = expected.inverse_mul(&row.root_from_vertex);
        assert!(off.distance() < 1e-12 && off.rotation.angle() < 1e-12, "{row:?}");
    }
    let row_of = |v| scope.placed().iter().position(|row| row.vertex == vertices[v]).unwrap();
    assert_eq!(scope.path_between(&skeleton, row_of(2), 0), [edges[1], edges[0]]);
    assert_eq!(scope.path_between(&skeleton, 0, row_of(5)), [place]);
    let broken = Se3::new(Vector3::new(1.0, f64::NAN, 0.0), turn(0.0));
    let refused = graph.add_edge(vertices[0], vertices[2], broken, EdgeKind::Place);
    assert!(matches!(refused, Err(PoseGraphError::NotFinite { .. })));
}
