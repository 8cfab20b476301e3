//! Ways through the views of two rooms with a door between.

use std::collections::BTreeSet;

use maps3d::relative::{FanOptions, FanSearch, RelativeParams};
use maps3d::{ConsolidationEvent, DepthEvent, Hovering, Map3d, PlanEvent, UnionEvent};
use nalgebra::{Point3, Vector3};
use pose::Se3;
use posegraph::EdgeKind;
use probe::{Off, Probe, VertexId};

use super::scene::{Block, Fed, image_of, reduced_to, vertex_from_camera};

/// A wall across the middle, with a door that is off the straight way.
const ROOMS: [Block; 3] = [
    ([-4.0, -3.0, -1.5], [4.0, 3.0, 1.5]),
    ([-0.1, -3.0, -1.5], [0.1, 0.4, 1.5]),
    ([-0.1, 1.6, -1.5], [0.1, 3.0, 1.5]),
];

/// In one room, in its far corner, in the door, and in the other room.
const PLACES: [[f64; 3]; 4] =
    [[-2.0, -1.5, 0.0], [-3.0, 2.0, 0.0], [0.0, 1.0, 0.0], [2.0, -1.5, 0.0]];

/// How far a point is from everything solid, metres.
fn from_solid_m(p: &Point3<f64>) -> f64 {
    let outside_m = |(low, high): &Block| {
        let by = Vector3::from_fn(|axis, _| (low[axis] - p[axis]).max(p[axis] - high[axis]));
        if by.max() > 0.0 { by.sup(&Vector3::zeros()).norm() } else { by.max() }
    };
    ROOMS[1..].iter().map(outside_m).fold(-outside_m(&ROOMS[0]), f64::min)
}

/// The two rooms, looked at all around from each place.
fn two_rooms() -> (Fed, Vec<VertexId>) {
    let params = RelativeParams { view: reduced_to(300), ..RelativeParams::default() };
    let mut fed = Fed::new(params);
    let mut vertices: Vec<VertexId> = Vec::new();
    for place in PLACES {
        let vertex = fed.vertex();
        if let (Some(&before), Some(from)) =
            (vertices.last(), PLACES.get(vertices.len().wrapping_sub(1)))
        {
            let by = Vector3::from(place) - Vector3::from(*from);
            fed.edge(before, vertex, Se3::new(by, Se3::identity().rotation), EdgeKind::Odometry);
        }
        for quarter in 0..4 {
            let camera = vertex_from_camera(f64::from(quarter) * std::f64::consts::FRAC_PI_2);
            let world_from_vertex = Se3::new(place.into(), Se3::identity().rotation);
            fed.look(vertex, camera, &image_of(&ROOMS, &(world_from_vertex * camera)));
        }
        vertices.push(vertex);
    }
    (fed, vertices)
}

/// Hovers at a vertex, turned.
fn turned(vertex: VertexId) -> Hovering {
    let turn = nalgebra::UnitQuaternion::from_axis_angle(&Vector3::z_axis(), 0.7);
    Hovering { vertex, vertex_from_body: Se3::new(Vector3::zeros(), turn) }
}

fn sought(fed: &mut Fed, from: VertexId, to: VertexId, place: &Point3<f64>) -> FanSearch {
    let options = FanOptions { radius_m: 0.25, ..FanOptions::default() };
    let here = turned(from);
    fed.map.way_through_fans_to(&here, to, place, &options, &mut Off).expect("a radius")
}

#[test]
fn a_way_to_a_place_in_another_room_leads_through_the_door() {
    let (mut fed, vertices) = two_rooms();
    let place = Point3::new(0.4, -0.3, 0.2);
    let (from, to) = (vertices[0], vertices[3]);
    let before = fed.map.tally();
    let search = sought(&mut fed, from, to, &place);
    let way = search.way.clone().expect("there is a door");
    assert_eq!((search.goals, search.plans), (1, 1));
    assert!((2..=16).contains(&search.volumes), "{search:?}");
    let here = turned(from).vertex_from_body;
    let world_from_body = Se3::new(Vector3::from(PLACES[0]), Se3::identity().rotation) * here;
    let in_world: Vec<Point3<f64>> =
        way.in_body.iter().map(|p| world_from_body.transform(p)).collect();
    let goal = Point3::from(Vector3::from(PLACES[3])) + place.coords;
    assert!((in_world[0] - Point3::from(PLACES[0])).norm() < 1e-6, "{in_world:?}");
    assert!((in_world[in_world.len() - 1] - goal).norm() < 1e-6, "{in_world:?}");
    for leg in in_world.windows(2) {
        for step in 0..=40 {
            let at = leg[0] + (leg[1] - leg[0]) * (f64::from(step) / 40.0);
            let clear_m = from_solid_m(&at);
            assert!(clear_m > way.keeps_m - 0.05, "{clear_m} at {at}: {way:?}");
        }
    }
    // Shortened in its corridor, then from volume to volume; no shorter than round the edge of the door.
    let (centroids_m, corridor_m) =
        (way.centroids_m.expect("planned"), way.corridor_m.expect("planned"));
    let edge = Point3::new(0.0, 0.4, 0.0);
    let least_m = (edge - in_world[0]).norm() + (goal - edge).norm();
    assert!(way.length_m <= corridor_m + 1e-6 && corridor_m <= centroids_m + 1e-6, "{way:?}");
    assert!(way.length_m >= least_m - 0.2 && way.length_m < 1.2 * least_m, "{least_m} {way:?}");
    // It is counted, and the map is what it was.
    let work = fed.map.work();
    assert_eq!((work.paths, work.tetrahedra), (1, search.tetrahedra));
    assert_eq!((work.paths_m, work.shortened_m), (centroids_m, way.length_m));
    assert_eq!(fed.map.tally(), before);
    let told = fed.map.way_to(&turned(from), to, &place, 0.25, &mut Off).expect("the same");
    assert_eq!(told[..], way.in_body[1..]);
    assert_eq!(sought(&mut two_rooms().0, from, to, &place), search);
}

#[test]
fn there_is_no_way_to_what_nobody_saw_or_what_is_far_along_the_graph() {
    let (mut fed, vertices) = two_rooms();
    let (from, to) = (vertices[0], vertices[3]);
    let behind_the_wall = Point3::new(4.0, 0.0, 0.0);
    assert_eq!(sought(&mut fed, from, to, &behind_the_wall).way, None);
    let beside_the_wall = Point3::new(1.95, 0.0, 0.0);
    assert_eq!(
        sought(&mut fed, from, to, &beside_the_wall).way,
        None,
        "the body does not fit there"
    );
    let nowhere = Point3::new(f64::NAN, 0.0, 0.0);
    assert_eq!(sought(&mut fed, from, to, &nowhere).way, None);
    let alone = fed.vertex();
    assert_eq!(sought(&mut fed, from, alone, &Point3::origin()), FanSearch::default());
    assert_eq!(fed.map.work().paths, 0);
    let options = FanOptions { radius_m: f64::NAN, ..FanOptions::default() };
    let bad = fed.map.way_through_fans_to(&turned(from), to, &Point3::origin(), &options, &mut Off);
    assert!(bad.is_err());
}

#[test]
fn where_no_place_is_tried_the_nearest_frontier_along_the_graph_is_gone_to() {
    let (mut fed, vertices) = two_rooms();
    // Only the last place has frontier left, and nothing of it is straight on from the first.
    for &vertex in &vertices[..3] {
        let here = Hovering { vertex, vertex_from_body: Se3::identity() };
        fed.map.give_up(&here, &[Point3::origin()], 20.0, false, &mut Off);
    }
    let options = FanOptions { radius_m: 0.2, ..FanOptions::default() };
    let tried = fed.map.way_through_fans(&turned(vertices[0]), &options).expect("a radius");
    let untried = FanOptions { most_plans: 0, ..options };
    let untried = fed.map.way_through_fans(&turned(vertices[0]), &untried).expect("a radius");
    assert!(tried.plans > 1 && untried.plans == 1, "{tried:?} {untried:?}");
    let (tried, untried) = (tried.way.expect("a way"), untried.way.expect("a way"));
    assert!(untried.centroids_m.is_some() && untried.in_body.len() > 2, "{untried:?}");
    assert!(tried.length_m <= untried.length_m + 1e-9, "{tried:?} {untried:?}");
}

/// The names of what is told.
#[derive(Default)]
struct Names(BTreeSet<&'static str>);

impl Probe<DepthEvent<'_>> for Names {
    fn emit(&mut self, _: DepthEvent<'_>) {}
}

impl Probe<UnionEvent<'_>> for Names {
    fn emit(&mut self, _: UnionEvent<'_>) {}
}

impl Probe<ConsolidationEvent<'_>> for Names {
    fn emit(&mut self, event: ConsolidationEvent<'_>) {
        self.0.insert(event.variant());
    }
}

impl Probe<PlanEvent<'_>> for Names {
    fn emit(&mut self, event: PlanEvent<'_>) {
        self.0.insert(event.variant());
    }
}

#[test]
fn what_the_planner_does_is_told_and_changes_nothing() {
    let (mut fed, vertices) = two_rooms();
    let options = FanOptions { radius_m: 0.25, ..FanOptions::default() };
    let (here, place) = (turned(vertices[0]), Point3::origin());
    let mut names = Names::default();
    let to = vertices[3];
    // The scope is told to who listens, although it was taken before without anybody listening.
    assert!(fed.map.free_lines(&here, &[], 0.0).is_empty());
    let told =
        fed.map.way_through_fans_to(&here, to, &place, &options, &mut names).expect("a radius");
    assert_eq!(told, sought(&mut fed, vertices[0], to, &place));
    for name in [
        "ScopeTaken",
        "Fanned",
        "Joined",
        "Located",
        "Opened",
        "Expanded",
        "Routed",
        "Finished",
        "Planned",
    ] {
        assert!(names.0.contains(name), "{name}: {:?}", names.0);
    }
}
