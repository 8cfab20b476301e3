//! The united map: membership, tallies, corrections and refusals.

use std::collections::BTreeSet;
use std::f64::consts::FRAC_PI_2;

use maps3d::{
    ConsolidationEvent, DepthEvent, FlightRoute, Hovering, Known, Look, Map3d, Maps3dError,
    PlanEvent, UnionCorrection, UnionEvent, UnionMap, UnionParams,
};
use nalgebra::{Point3, UnitQuaternion, Vector3};
use pose::Se3;
use posegraph::{EdgeKind, PoseGraph};
use probe::{Off, Probe, VertexId};
use sensing::{Camera, DepthImage};
use solid::{Label, Side, Solid};

const COLUMNS: usize = 48;
const ROWS: usize = 36;

/// A box of a room with a box of a pillar in it, and cameras anywhere inside.
struct Room {
    size: Vector3<f64>,
    pillar: Option<[Point3<f64>; 2]>,
}

/// Where a ray enters and leaves a box.
fn slabs(low: &Point3<f64>, high: &Point3<f64>, from: &Point3<f64>, by: &Vector3<f64>) -> [f64; 2] {
    let (mut enter, mut leave) = (f64::NEG_INFINITY, f64::INFINITY);
    for axis in 0..3 {
        let (a, b) = ((low[axis] - from[axis]) / by[axis], (high[axis] - from[axis]) / by[axis]);
        (enter, leave) = (enter.max(a.min(b)), leave.min(a.max(b)));
    }
    [enter, leave]
}

impl Room {
    fn look(&self, world_from_camera: &Se3, wide: f64) -> DepthImage {
        let camera = Camera::new(
            COLUMNS as f64 / wide,
            COLUMNS as f64 / wide,
            (COLUMNS - 1) as f64 / 2.0,
            (ROWS - 1) as f64 / 2.0,
        );
        let from = Point3::from(world_from_camera.translation);
        let depth = |i: usize| {
            let at = camera.point_in_camera((i % COLUMNS) as f64, (i / COLUMNS) as f64, 1.0);
            let by = world_from_camera.rotation * at.coords;
            let [_, mut depth] = slabs(&Point3::origin(), &self.size.into(), &from, &by);
            if let Some([low, high]) = &self.pillar {
                let [enter, leave] = slabs(low, high, &from, &by);
                if enter < leave && enter > 0.0 {
                    depth = depth.min(enter);
                }
            }
            depth as f32
        };
        DepthImage::new(COLUMNS, camera, (0..COLUMNS * ROWS).map(depth).collect())
    }
}

/// A camera that looks along x at yaw 0, turned about the vertical, then tilted up.
fn body_from_camera(yaw: f64, tilt: f64) -> Se3 {
    let ahead = UnitQuaternion::from_euler_angles(-FRAC_PI_2, 0.0, -FRAC_PI_2);
    let turned = UnitQuaternion::from_euler_angles(0.0, 0.0, yaw)
        * UnitQuaternion::from_euler_angles(0.0, -tilt, 0.0);
    Se3::new(Vector3::zeros(), turned * ahead)
}

fn at(x: f64, y: f64, z: f64) -> Se3 {
    Se3::new(Vector3::new(x, y, z), UnitQuaternion::identity())
}

fn hovering(vertex: u32) -> Hovering {
    Hovering { vertex: VertexId(vertex), vertex_from_body: Se3::identity() }
}

/// Vertices along a line in a room, each with some looks; poses as the map believes them.
struct Walk {
    room: Room,
    world_from_vertex: Vec<Se3>,
    looks: Vec<(u32, Se3)>,
    wide: f64,
}

impl Walk {
    /// Three places in a row, four looks to the sides from each.
    fn sides() -> Self {
        let pillar = [Point3::new(2.5, 0.0, 0.0), Point3::new(3.0, 1.2, 3.0)];
        let places = [1.0, 2.2, 4.0];
        let turns = |vertex: u32| {
            (0..4).map(move |i| (vertex, body_from_camera(f64::from(i) * FRAC_PI_2, 0.0)))
        };
        Self {
            room: Room { size: Vector3::new(6.0, 3.5, 2.6), pillar: Some(pillar) },
            world_from_vertex: places.iter().map(|&x| at(x, 1.9, 1.3)).collect(),
            looks: (0..places.len() as u32).flat_map(turns).collect(),
            wide: 2.1,
        }
    }

    fn graph(&self) -> PoseGraph<Se3> {
        let mut graph = PoseGraph::new();
        for _ in &self.world_from_vertex {
            graph.add_vertex();
        }
        for (i, pair) in self.world_from_vertex.windows(2).enumerate() {
            let (a, b) = (VertexId(i as u32), VertexId(i as u32 + 1));
            let step = pair[0].inverse_mul(&pair[1]);
            graph.add_edge(a, b, step, EdgeKind::Odometry).expect("vertices that exist");
        }
        graph
    }

    fn feed(&self, map: &mut UnionMap, probe: &mut dyn maps3d::Map3dProbe) {
        let graph = self.graph();
        let edges: Vec<_> = graph.edges().map(|(edge, _)| edge).collect();
        map.edges_added(&graph, &edges, probe);
        for (vertex, vertex_from_camera) in &self.looks {
            let world_from_camera = self.world_from_vertex[*vertex as usize] * *vertex_from_camera;
            let image = self.room.look(&world_from_camera, self.wide);
            let vertex_from_camera = *vertex_from_camera;
            let look = Look { vertex: VertexId(*vertex), vertex_from_camera, image: &image };
            map.looked(&look, probe).expect("a sound image");
        }
    }

    fn map(&self, params: UnionParams) -> UnionMap {
        let mut map = UnionMap::new(params).expect("sound options");
        self.feed(&mut map, &mut Off);
        map
    }
}

fn small() -> UnionParams {
    UnionParams { view: maps3d::ViewOptions::default(), ..with_vertices(60) }
}

fn with_vertices(count: usize) -> UnionParams {
    let mut params = UnionParams::default();
    if let Some(reduce) = &mut params.view.reduce {
        reduce.stop = maps3d::reduce::Stop::Vertices(count);
    }
    params
}

/// Points all over a box that is larger than the room, the same every time.
fn points(count: u32) -> impl Iterator<Item = Point3<f64>> {
    let share = |i: u32, by: f64| (f64::from(i) * by + 0.37).fract();
    (0..count).map(move |i| {
        let [x, y, z] = [0.754_877, 0.569_840, 0.430_159].map(|by| share(i, by));
        Point3::new(7.0 * x - 0.5, 4.5 * y - 0.5, 3.6 * z - 0.5)
    })
}

#[test]
fn a_point_is_free_where_a_view_holds_it() {
    let walk = Walk::sides();
    let mut placed = Placed(Vec::new());
    let params = UnionParams { body_m: 0.0, ..with_vertices(60) };
    let mut map = UnionMap::new(params).expect("sound options");
    walk.feed(&mut map, &mut placed);
    let solids: Vec<Solid<'_>> = placed.0.iter().map(Solid::new).collect();
    let map_from_world = walk.world_from_vertex[0].inverse();
    let (mut free, mut other) = (0, 0);
    for in_world in points(3000) {
        let point = map_from_world.transform(&in_world);
        let held = solids.iter().any(|solid| solid.side(&point) == Side::Inside);
        let known = map.knows(&hovering(0), &point);
        assert_eq!(known == Known::Free, held, "{in_world}");
        free += usize::from(held);
        other += usize::from(!held);
    }
    assert!(free > 500 && other > 500, "{free} free, {other} not");
    assert!(solid::check(map.polyhedron()).is_valid());
    let counts = map.counts();
    assert_eq!((counts.unions, counts.refused, counts.rebuilds), (12, 0, 0));
}

/// The operands as they were united.
struct Placed(Vec<solid::Polyhedron>);

impl Probe<UnionEvent<'_>> for Placed {
    fn emit(&mut self, event: UnionEvent<'_>) {
        if let UnionEvent::Placed { operand, .. } = event {
            self.0.push(operand.clone());
        }
    }
}

impl Probe<DepthEvent<'_>> for Placed {
    fn emit(&mut self, _: DepthEvent<'_>) {}
}

impl Probe<PlanEvent<'_>> for Placed {
    fn emit(&mut self, _: PlanEvent<'_>) {}
}

impl Probe<ConsolidationEvent<'_>> for Placed {
    fn emit(&mut self, _: ConsolidationEvent<'_>) {}
}

#[test]
fn what_is_seen_all_around_has_no_frontier_left() {
    let mut looks: Vec<(u32, Se3)> =
        (0..4).map(|i| (0, body_from_camera(f64::from(i) * FRAC_PI_2, 0.0))).collect();
    looks.extend([FRAC_PI_2, -FRAC_PI_2].map(|tilt| (0, body_from_camera(0.0, tilt))));
    let room = Room { size: Vector3::new(4.0, 3.0, 2.5), pillar: None };
    let walk = Walk { room, world_from_vertex: vec![at(1.7, 1.4, 1.2)], looks, wide: 3.2 };
    // A room without gaps in depth: what looks like one between coarse pixels is a wall seen along.
    let mut params = with_vertices(40);
    params.view.occlusion = None;
    let mut map = walk.map(params);
    let tally = map.tally();
    assert_eq!(tally.open_m2, 0.0, "{tally:?}");
    assert!(tally.sliver_m2 < 0.05, "{tally:?}");
    assert!((map.polyhedron().volume_m3() - 30.0).abs() < 0.3);
    let mut out = vec![];
    map.frontiers(&hovering(0), &mut out);
    assert!(out.is_empty());
    assert_eq!(map.route(&hovering(0), 0.2, &|_| true), None);
    // Half a metre from the walls, and far from anything unseen.
    let clearance = map.clearance(&hovering(0), &Point3::new(1.8, 0.0, 0.0), 0.5);
    assert!((clearance.solid_m - 0.5).abs() < 0.02, "{clearance:?}");
    assert!((clearance.solid_at_start_m - 1.2).abs() < 0.02, "{clearance:?}");
    assert_eq!(map.clearance(&hovering(0), &Point3::new(2.6, 0.0, 0.0), 0.5).solid_m, 0.0);
}

/// A wall at 3 m with a hole, and a box before it, in small images of a camera that looks past their corner.
fn wall(step: usize) -> DepthImage {
    let depth_m = |i: usize| match (i % 40 + step, i / 40) {
        (28..38, 0..6) => 0.0,
        (14..22, 12..22) => 1.5,
        _ => 3.0,
    };
    let camera = Camera::new(400.0, 400.0, 319.5, 239.5);
    DepthImage::new(40, camera, (0..40 * 30).map(depth_m).collect())
}

#[test]
fn three_parallel_views_of_a_wall_unite_to_a_map_that_does_not_cross_itself() {
    // Reduced over the inverse depth, walls that are the same differ by some millionths of a metre.
    for step_in_m in [0.0, UnionParams::default().step_in_m] {
        let mut params = UnionParams { step_in_m, ..with_vertices(60) };
        params.view.prepare.far_m = 4.0;
        let mut map = UnionMap::new(params).expect("sound options");
        for step in 0..3_u8 {
            let vertex_from_camera = at(0.1 * f64::from(step), 0.0, 0.0);
            let image = wall(step.into());
            let look = Look { vertex: VertexId(0), vertex_from_camera, image: &image };
            map.looked(&look, &mut Off).expect("a sound image");
        }
        assert!(solid::check(map.polyhedron()).is_valid());
        assert!(map.fill(&mut Off) > 0);
        let counts = map.counts();
        let told = (counts.unions, counts.refused, counts.fillings, counts.refused_fillings);
        assert_eq!(told, (3, 0, 1, 0), "{counts:?}");
        assert_eq!(map.beside(), 0);
    }
}

#[test]
fn walls_seen_again_add_hardly_a_face() {
    let looks = (0..8).map(|i| (0, body_from_camera(f64::from(i % 4) * FRAC_PI_2, 0.0)));
    let walk = Walk { looks: looks.collect(), ..Walk::sides() };
    let faces = |step_in_m: f64| {
        let map = walk.map(UnionParams { step_in_m, ..with_vertices(60) });
        map.polyhedron().faces().len()
    };
    let (drawn_in, as_seen) = (faces(0.02), faces(0.0));
    assert!(2 * drawn_in < as_seen, "{drawn_in} faces against {as_seen}");
}

#[test]
fn areas_of_frontier_add_up_also_when_some_is_given_up() {
    let walk = Walk::sides();
    let mut map = walk.map(with_vertices(60));
    let all_m2 = map.polyhedron().area_by_label().of(Label::Frontier);
    let sum = |map: &UnionMap| {
        let tally = map.tally();
        tally.open_m2 + tally.sliver_m2 + tally.given_up_m2
    };
    assert!((sum(&map) - all_m2).abs() < 1e-9 * all_m2);
    let mut patches = vec![];
    map.frontiers(&hovering(1), &mut patches);
    let point = patches.first().expect("some frontier in sight").points[0];
    let before = map.tally();
    map.give_up(&hovering(1), &[point.in_body], 0.5, false, &mut Off);
    let after = map.tally();
    assert!((sum(&map) - all_m2).abs() < 1e-9 * all_m2);
    assert!(after.given_up_m2 > 0.0 && after.open_m2 < before.open_m2);
    map.frontiers(&hovering(1), &mut patches);
    let left = patches.iter().flat_map(|patch| &patch.points);
    assert!(left.clone().all(|p| (p.in_body - point.in_body).norm() > 0.5));
    // What is in sight lies on the frontier, and its normal leads out of the map.
    for point in left {
        let beyond = point.in_body + point.normal_in_body * 1e-4;
        assert_ne!(map.knows(&hovering(1), &beyond), Known::Free);
    }
}

#[test]
fn a_way_leads_through_free_space_towards_frontier() {
    let walk = Walk::sides();
    let mut map = walk.map(with_vertices(60));
    let route = map.route(&hovering(0), 0.2, &|_| true);
    let Some(FlightRoute::Fly(points)) = route else { panic!("{route:?}") };
    let mut from = Point3::origin();
    for to in &points {
        let start = Hovering {
            vertex: VertexId(0),
            vertex_from_body: Se3::new(from.coords, UnitQuaternion::identity()),
        };
        let there = Point3::from(to - from);
        let clearance = map.clearance(&start, &there, 10.0);
        assert!(clearance.solid_m > 0.11, "{clearance:?}");
        from = *to;
    }
    assert!(from.coords.norm() > 0.1);
    let counts = map.counts();
    assert_eq!((counts.fillings, counts.refused_fillings, counts.ways), (1, 0, 1));
    // The tetrahedra stay until the map changes.
    map.route(&hovering(0), 0.2, &|_| true);
    assert_eq!(map.counts().fillings, 1);
}

#[test]
fn frontier_that_no_way_leads_to_is_given_up_and_told() {
    let walk = Walk::sides();
    let mut map = walk.map(with_vertices(60));
    let open_m2 = map.tally().open_m2;
    let mut names = Names::default();
    // A ball that fits nowhere.
    let mut rounds = 0;
    while map.route_with(&hovering(0), 50.0, &|_| true, &mut names).is_some() {
        rounds += 1;
        assert!(rounds < 1, "a ball of 50 m has a way");
    }
    let tally = map.tally();
    assert_eq!((tally.open_m2, tally.patches), (0.0, 0), "{tally:?}");
    assert!(tally.given_up_m2 > 0.9 * open_m2);
    assert!(names.0.contains("GivenUp"));
}

#[test]
fn a_corrected_map_is_that_of_the_corrected_poses() {
    let walk = Walk::sides();
    let straight = walk.map(with_vertices(60));
    // Odometry that is wrong by 20 cm at the second vertex.
    let drifted = Walk {
        world_from_vertex: vec![at(1.0, 1.9, 1.3), at(2.4, 1.9, 1.3), at(4.2, 1.9, 1.3)],
        ..Walk::sides()
    };
    let graph = drifted.graph();
    let edges: Vec<_> = graph.edges().map(|(edge, _)| edge).collect();
    let mut map = UnionMap::new(with_vertices(60)).expect("sound options");
    map.edges_added(&graph, &edges, &mut Off);
    for (vertex, vertex_from_camera) in &walk.looks {
        let world_from_camera = walk.world_from_vertex[*vertex as usize] * *vertex_from_camera;
        let image = walk.room.look(&world_from_camera, walk.wide);
        let vertex_from_camera = *vertex_from_camera;
        let look = Look { vertex: VertexId(*vertex), vertex_from_camera, image: &image };
        map.looked(&look, &mut Off).expect("a sound image");
    }
    let apart = (map.polyhedron().volume_m3() - straight.polyhedron().volume_m3()).abs();
    assert!(apart > 0.05, "{apart}");
    let corrected: Vec<Se3> = walk
        .world_from_vertex
        .iter()
        .map(|pose| walk.world_from_vertex[0].inverse_mul(pose))
        .collect();
    let mut names = Names::default();
    map.poses_reestimated(&corrected, &mut names);
    assert!(names.0.contains("Rebuilt"));
    assert_eq!(map.counts().rebuilds, 1);
    let apart = (map.polyhedron().volume_m3() - straight.polyhedron().volume_m3()).abs();
    assert!(apart < 1e-6, "{apart}");
    // Poses that are the same do not cost a thing.
    map.poses_reestimated(&corrected, &mut names);
    assert_eq!(map.counts().rebuilds, 1);
}

#[test]
fn a_recognised_place_corrects_the_poses() {
    let mut map =
        UnionMap::new(UnionParams { correction: Some(UnionCorrection::default()), ..small() })
            .expect("sound options");
    assert_eq!(map.kind(), "global_union_corrected");
    let mut graph = PoseGraph::new();
    let (a, b) = (graph.add_vertex(), graph.add_vertex());
    let room = Room { size: Vector3::new(4.0, 3.0, 2.5), pillar: None };
    let drifted = at(1.3, 0.1, 0.0);
    let edge = graph.add_edge(a, b, drifted, EdgeKind::Odometry).expect("vertices that exist");
    map.edges_added(&graph, &[edge], &mut Off);
    for (vertex, x) in [(a, 1.0), (b, 2.0)] {
        let vertex_from_camera = body_from_camera(0.0, 0.0);
        let image = room.look(&(at(x, 1.5, 1.2) * vertex_from_camera), 2.0);
        map.looked(&Look { vertex, vertex_from_camera, image: &image }, &mut Off).expect("sound");
    }
    let place =
        graph.add_edge(a, b, at(1.0, 0.0, 0.0), EdgeKind::Place).expect("vertices that exist");
    let mut names = Names::default();
    map.edges_added(&graph, &[place], &mut names);
    assert!(names.0.contains("Corrected") && names.0.contains("Rebuilt"));
    let counts = map.counts();
    assert_eq!((counts.corrections, counts.rebuilds), (1, 1));
    let placed = map.map_from_vertex()[1].translation;
    assert!((placed - Vector3::new(1.0, 0.0, 0.0)).norm() < 0.02, "{placed}");
}

#[test]
fn what_is_refused_changes_nothing_that_was_there() {
    let walk = Walk::sides();
    let mut map = walk.map(with_vertices(60));
    let before = map.polyhedron().clone();
    let image = walk.room.look(&walk.world_from_vertex[0], walk.wide);
    for bad in [f64::NAN, f64::INFINITY, 1e16, 1e80] {
        let vertex_from_camera = at(bad, 0.0, 0.0);
        let look = Look { vertex: VertexId(1), vertex_from_camera, image: &image };
        let told = map.looked(&look, &mut Off);
        assert!(matches!(told, Err(Maps3dError::Pose { .. })), "{told:?}");
    }
    assert!(map.polyhedron() == &before);
    assert_eq!((map.counts().refused, map.beside(), map.looks()), (0, 0, 12));
    assert_eq!(map.knows(&hovering(0), &Point3::new(0.5, 0.0, 0.0)), Known::Free);
    assert!(map.tally().open_m2 > 0.0);
    assert!(map.route(&hovering(0), 0.2, &|_| true).is_some());
    let empty = DepthImage::new(1, image.camera, vec![]);
    let look = Look { vertex: VertexId(1), vertex_from_camera: Se3::identity(), image: &empty };
    assert!(map.looked(&look, &mut Off).is_err());
    assert!(map.polyhedron() == &before);
}

#[test]
fn options_out_of_their_range_are_refused() {
    let params = UnionParams::default;
    for wrong in [
        UnionParams { piece_m: 0.0, ..params() },
        UnionParams { jitter_m: f64::NAN, ..params() },
        UnionParams { clean_growth: 0.5, ..params() },
        UnionParams { body_m: -1.0, ..params() },
        UnionParams {
            correction: Some(UnionCorrection { place_sigma_m: -1.0, ..Default::default() }),
            ..params()
        },
        UnionParams { view: maps3d::ViewOptions { open: true, ..params().view }, ..params() },
    ] {
        assert!(matches!(UnionMap::new(wrong), Err(Maps3dError::Option { .. })));
    }
}

/// Names of the events that came.
#[derive(Default)]
struct Names(BTreeSet<&'static str>);

impl Probe<UnionEvent<'_>> for Names {
    fn emit(&mut self, event: UnionEvent<'_>) {
        self.0.insert(event.variant());
    }
}

impl Probe<DepthEvent<'_>> for Names {
    fn emit(&mut self, _: DepthEvent<'_>) {}
}

impl Probe<PlanEvent<'_>> for Names {
    fn emit(&mut self, _: PlanEvent<'_>) {}
}

impl Probe<ConsolidationEvent<'_>> for Names {
    fn emit(&mut self, _: ConsolidationEvent<'_>) {}
}

#[test]
fn the_same_looks_give_the_same_bytes_also_when_watched() {
    let walk = Walk::sides();
    let params = UnionParams { clean_m: 0.001, ..with_vertices(60) };
    let mut plain = walk.map(params.clone());
    let mut watched = UnionMap::new(params).expect("sound options");
    let mut names = Names::default();
    walk.feed(&mut watched, &mut names);
    assert!(plain.polyhedron() == watched.polyhedron());
    assert_eq!(plain.tally(), watched.tally());
    let route = |map: &mut UnionMap, probe: &mut dyn maps3d::Map3dProbe| {
        map.route_with(&hovering(2), 0.15, &|_| true, probe)
    };
    let way = route(&mut plain, &mut Off);
    assert!(way.is_some());
    assert_eq!(way, route(&mut watched, &mut names));
    assert!(plain.bytes() > 10_000);
    let seen: Vec<&str> = names.0.into_iter().collect();
    assert_eq!(seen, ["Cleaned", "Filled", "Placed", "Planned", "Sorted", "United"]);
}
