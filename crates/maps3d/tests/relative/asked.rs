//! The policy's questions in a room of which everything is known.

use maps3d::relative::{FanOptions, RelativeParams};
use maps3d::{FlightRoute, FrontierPatch, Hovering, Known, Map3d, Sights};
use nalgebra::{Point3, Vector3};
use pose::Se3;
use posegraph::EdgeKind;
use probe::{EdgeId, Off, VertexId};

use super::scene::{Fed, reduced_to, room_image, vertex_from_camera};

fn params() -> RelativeParams {
    RelativeParams { view: reduced_to(300), ..RelativeParams::default() }
}

fn at(x: f64, y: f64, z: f64) -> Se3 {
    Se3::new(Vector3::new(x, y, z), Se3::identity().rotation)
}

/// Four looks around from one place.
fn looked_around(fed: &mut Fed, vertex: VertexId, world_from_vertex: &Se3) {
    for quarter in 0..4 {
        let camera = vertex_from_camera(f64::from(quarter) * std::f64::consts::FRAC_PI_2);
        fed.look(vertex, camera, &room_image(&(*world_from_vertex * camera)));
    }
}

fn hovering(vertex: VertexId) -> Hovering {
    Hovering { vertex, vertex_from_body: Se3::identity() }
}

#[test]
fn looking_around_closes_the_sides_of_the_looks() {
    let mut fed = Fed::new(params());
    let vertex = fed.vertex();
    let camera = vertex_from_camera(0.0);
    let place = at(-2.0, -1.0, 0.0);
    fed.look(vertex, camera, &room_image(&(place * camera)));
    let one_m2 = fed.map.tally().open_m2;
    let mut fed = Fed::new(params());
    let vertex = fed.vertex();
    looked_around(&mut fed, vertex, &place);
    let tally = fed.map.tally();
    assert!(tally.volumes == 4 && tally.faces > 1000);
    // Left are the cones above and below, and what the pillar hides.
    let mut patches: Vec<FrontierPatch> = Vec::new();
    fed.map.frontiers(&hovering(vertex), &mut patches);
    let told_m2: f64 = patches.iter().map(|patch| patch.area_m2).sum();
    assert!((told_m2 - tally.open_m2).abs() < 1e-6 * told_m2);
    assert!((fed.map.frontier_at(vertex) - tally.open_m2).abs() < 1e-9);
    assert!(one_m2 > 0.3 * tally.open_m2);
    let mut between_m2 = 0.0;
    for patch in &patches {
        assert!(!patch.points.is_empty() && patch.owner == vertex);
        for point in &patch.points {
            assert!((point.normal_in_body.norm() - 1.0).abs() < 1e-9);
            // Across the frontier nobody looked; before it, somebody did.
            let beyond = point.in_body + point.normal_in_body * 0.02;
            let before = point.in_body - point.normal_in_body * 0.02;
            let known = fed.map.knows(&hovering(vertex), &before);
            let unknown = fed.map.knows(&hovering(vertex), &beyond);
            if known == Known::Free && unknown != Known::Free {
                between_m2 += point.area_m2;
            }
        }
    }
    assert!(between_m2 > 0.95 * told_m2, "{between_m2} of {told_m2}");
}

#[test]
fn what_is_seen_from_elsewhere_is_closed_and_the_rest_is_led_to() {
    let mut fed = Fed::new(params());
    let first = fed.vertex();
    looked_around(&mut fed, first, &at(-2.0, -1.0, 0.0));
    let before_m2 = fed.map.frontier_at(first);
    let second = fed.vertex();
    let first_from_second = at(5.0, 3.0, 0.0);
    fed.edge(first, second, first_from_second, EdgeKind::Odometry);
    looked_around(&mut fed, second, &at(3.0, 2.0, 0.0));
    assert!(fed.map.frontier_at(first) < before_m2);
    let length_m = first_from_second.distance();
    let to = fed.map.route(&hovering(first), 0.2, &|vertex| vertex == second);
    let expected =
        (fed.map.frontier_at(second) > 0.0).then(|| FlightRoute::Repeat(vec![(second, length_m)]));
    assert_eq!(to, expected);
    assert_eq!(fed.map.route(&hovering(first), 0.2, &|_| false), None);
}

#[test]
fn clearance_is_the_distance_from_walls_and_from_what_was_not_seen() {
    let mut fed = Fed::new(params());
    let vertex = fed.vertex();
    looked_around(&mut fed, vertex, &at(-2.0, -1.0, 0.0));
    let here = hovering(vertex);
    // Along the room, 2 m from the nearer wall at y = -3, 1.5 m from floor and ceiling.
    let ahead = fed.map.clearance(&here, &Point3::new(2.0, 0.0, 0.0), 0.5);
    assert!((ahead.solid_m - 1.5).abs() < 0.1, "{ahead:?}");
    assert!(ahead.unseen_m > 0.2 && ahead.unseen_m < 0.6, "{ahead:?}");
    let into_wall = fed.map.clearance(&here, &Point3::new(0.0, -2.5, 0.0), 0.5);
    assert_eq!(into_wall.solid_m, 0.0);
    let near_wall = fed.map.clearance(&here, &Point3::new(0.0, -1.6, 0.0), 0.5);
    assert!((near_wall.solid_at_end_m - 0.4).abs() < 0.05, "{near_wall:?}");
    // Straight up nobody looked.
    let up = fed.map.clearance(&here, &Point3::new(0.0, 0.0, 1.0), 0.3);
    assert_eq!((up.unseen_m, up.unseen_at_end_m), (0.0, 0.0));
    let nowhere = fed.map.clearance(&hovering(VertexId(9)), &Point3::new(1.0, 0.0, 0.0), 0.3);
    assert_eq!(nowhere, maps3d::FlightClearance::NONE);
}

#[test]
fn what_is_given_up_does_not_count_any_more() {
    let mut fed = Fed::new(params());
    let vertex = fed.vertex();
    looked_around(&mut fed, vertex, &at(-2.0, -1.0, 0.0));
    let mut patches = Vec::new();
    let mut rounds = 0;
    loop {
        fed.map.frontiers(&hovering(vertex), &mut patches);
        let Some(place) = patches.first().map(|patch| patch.points[0].in_body) else { break };
        let before_m2 = fed.map.tally().open_m2;
        fed.map.give_up(&hovering(vertex), &[place], 0.5, rounds % 2 == 0, &mut Off);
        assert!(fed.map.tally().open_m2 < before_m2);
        rounds += 1;
        assert!(rounds < 500);
    }
    let tally = fed.map.tally();
    assert!(tally.patches == 0 && tally.open_m2 == 0.0 && tally.given_up_m2 > 1.0, "{tally:?}");
    assert!(fed.map.route(&hovering(vertex), 0.2, &|_| true).is_none());
}

#[test]
fn bad_looks_are_refused_and_change_nothing() {
    let mut fed = Fed::new(params());
    let vertex = fed.vertex();
    let image = room_image(&vertex_from_camera(0.0));
    let mut bad = image.clone();
    bad.depths_m.pop();
    let nan = Se3::new(Vector3::new(f64::NAN, 0.0, 0.0), Se3::identity().rotation);
    for (vertex_from_camera, image) in [(Se3::identity(), &bad), (nan, &image)] {
        let look = maps3d::Look { vertex, vertex_from_camera, image };
        assert!(fed.map.looked(&look, &mut Off).is_err());
        assert_eq!(fed.map.tally(), maps3d::MapTally::default());
    }
    // An image without a reading is all frontier.
    let mut empty = image.clone();
    empty.depths_m.fill(f32::NAN);
    fed.look(vertex, Se3::identity(), &empty);
    let tally = fed.map.tally();
    assert!(tally.volumes == 1 && tally.patches == 1 && tally.open_m2 > 50.0, "{tally:?}");
}

#[test]
fn the_same_looks_give_the_same_map() {
    let told = || {
        let mut fed = Fed::new(params());
        let vertex = fed.vertex();
        looked_around(&mut fed, vertex, &at(-2.0, -1.0, 0.0));
        let mut patches = Vec::new();
        fed.map.frontiers(&hovering(vertex), &mut patches);
        (fed.map.tally(), fed.map.bytes(), patches)
    };
    assert_eq!(told(), told());
}

#[test]
fn lines_are_free_where_views_hold_all_their_points() {
    let mut fed = Fed::new(params());
    let (here, there) = (fed.vertex(), fed.vertex());
    fed.edge(here, there, at(2.0, 0.5, 0.0), EdgeKind::Odometry);
    for (vertex, place) in [(here, at(-2.0, -1.0, 0.0)), (there, at(0.0, -0.5, 0.0))] {
        let camera = vertex_from_camera(0.0);
        fed.look(vertex, camera, &room_image(&(place * camera)));
    }
    let (from, hovering) = (Point3::origin(), hovering(here));
    // Ahead; through the far wall; to the side, where nobody looked; towards the pillar, and short of it.
    let ends = [
        Point3::new(3.0, 0.0, 0.0),
        Point3::new(7.0, 0.0, 0.0),
        Point3::new(0.0, 2.0, 0.0),
        Point3::new(3.4, 1.7, 0.0),
    ];
    let lines = ends.map(|end| [from, end]);
    assert_eq!(fed.map.free_lines(&hovering, &lines, 0.0), [true, false, false, false]);
    assert_eq!(fed.map.free_lines(&hovering, &lines, 1.5), [true, true, false, true]);
    // In the body's frame, whichever way it is turned.
    let turned = Hovering { vertex_from_body: vertex_yaw(0.7), ..hovering };
    let in_body = lines.map(|line| line.map(|p| turned.vertex_from_body.inverse_transform(&p)));
    assert_eq!(fed.map.free_lines(&turned, &in_body, 0.0), [true, false, false, false]);
    assert!(fed.map.meets_solid(&hovering, &[ends[0], Point3::new(6.1, 0.0, 0.0)]));
    assert!(!fed.map.meets_solid(&hovering, &[ends[0], ends[2]]));
    // Of a point beyond the wall the other view says that something stands before it.
    let beyond = Sights { solid: 1, ..Sights::default() };
    assert_eq!(fed.map.sights_of(&hovering, &ends[1]), beyond);
    assert_eq!(fed.map.sights_of(&hovering, &ends[0]).free, 1);
}

fn vertex_yaw(yaw_rad: f64) -> Se3 {
    let turn = nalgebra::UnitQuaternion::from_axis_angle(&Vector3::z_axis(), yaw_rad);
    Se3::new(Vector3::zeros(), turn)
}

/// Frontier of a look that is left after a second one from a place nearby, which is believed to be turned by
/// more than it is.
fn left_m2(off_rad: f64, contradiction_share: f64) -> f64 {
    let mut fed = Fed::new(RelativeParams { contradiction_share, ..params() });
    let (here, there) = (fed.vertex(), fed.vertex());
    let camera = vertex_from_camera(0.0);
    let (first, step) = (at(-3.0, -1.0, 0.0), at(1.0, 0.0, 0.0));
    fed.look(here, camera, &room_image(&(first * camera)));
    fed.edge(here, there, step * vertex_yaw(off_rad), EdgeKind::Odometry);
    looked_around(&mut fed, there, &(first * step));
    fed.map.frontier_at(here)
}

#[test]
fn a_view_that_is_contradicted_closes_nothing() {
    let (lenient, strict) = (1.0, 0.5);
    // Where it is placed well little speaks against it: reduced surfaces are not exact.
    let placed_m2 = left_m2(0.0, strict);
    assert!(placed_m2 <= 1.1 * left_m2(0.0, lenient), "{placed_m2}");
    // Where it is off by 20 degrees, walls that one view saw stand in the midst of what the other saw free.
    let off_rad = 20f64.to_radians();
    let believed_m2 = left_m2(off_rad, lenient);
    let doubted_m2 = left_m2(off_rad, strict);
    assert!(doubted_m2 > believed_m2 + 0.5, "{placed_m2} {believed_m2} {doubted_m2}");
}

#[test]
fn what_was_put_off_is_placed_along_the_way_with_the_least_odometry() {
    let mut fed = Fed::new(params());
    let [here, over, there] = [0; 3].map(|_| fed.vertex());
    let camera = vertex_from_camera(0.0);
    let (first, step, aside) = (at(-3.0, -1.0, 0.0), at(1.0, 0.0, 0.0), at(0.5, 0.8, 0.0));
    fed.look(here, camera, &room_image(&(first * camera)));
    // The straight way is off by 20 degrees; the longer one was recognised at both ends.
    let off = vertex_yaw(20f64.to_radians());
    fed.edge(here, over, aside, EdgeKind::Place);
    fed.edge(over, there, aside.inverse_mul(&step), EdgeKind::Place);
    fed.edge(here, there, step * off, EdgeKind::Odometry);
    looked_around(&mut fed, there, &(first * step));
    let doubted_m2 = fed.map.frontier_at(here);
    fed.map.compare_farther(here, false, &mut Off);
    let left_m2 = fed.map.frontier_at(here);
    assert!(left_m2 < doubted_m2 - 0.5, "{doubted_m2} {left_m2}");
    assert!(left_m2 <= 1.1 * self::left_m2(0.0, 0.5), "{left_m2}");
    // What closed it walks the place edges, and is taken back with one of them.
    fed.map.compare_farther(here, true, &mut Off);
    assert!(fed.map.frontier_at(here) <= left_m2);
    let edge = EdgeId(0);
    fed.graph.withdraw(edge).expect("an edge");
    fed.map.edge_withdrawn(&fed.graph, edge, &mut Off);
    assert!(fed.map.frontier_at(here) > left_m2 + 0.5);
}

/// How far a point is from the walls and the pillar of the room, metres.
fn from_solid_m(p: &Point3<f64>) -> f64 {
    let walls_m = [4.0 - p.x.abs(), 3.0 - p.y.abs(), 1.5 - p.z.abs()];
    let pillar_m = (p.x - 1.3).abs().max((p.y - 0.8).abs()) - 0.3;
    walls_m.into_iter().fold(pillar_m, f64::min)
}

/// The middle and the 26 directions around it.
fn around() -> impl Iterator<Item = Vector3<f64>> {
    (0..27).map(|i| Vector3::from([i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1].map(f64::from)))
}

#[test]
fn a_way_through_the_fans_stays_inside_of_them_and_clear_of_walls() {
    let mut fed = Fed::new(params());
    let first = fed.vertex();
    // One look ahead: everything else is behind its sides.
    let (camera, place) = (vertex_from_camera(0.0), at(-2.0, -1.0, 0.0));
    fed.look(first, camera, &room_image(&(place * camera)));
    let second = fed.vertex();
    fed.edge(first, second, at(5.0, 3.0, 0.0), EdgeKind::Odometry);
    looked_around(&mut fed, second, &at(3.0, 2.0, 0.0));
    for (vertex, world_from_vertex) in [(first, place), (second, at(3.0, 2.0, 0.0))] {
        let here = hovering(vertex);
        for radius_m in [0.1, 0.25] {
            let options = FanOptions { radius_m, ..FanOptions::default() };
            let search = fed.map.way_through_fans(&here, &options).expect("a radius");
            assert!(search.volumes == 5 && search.goals > 0, "{search:?}");
            let way = search.way.expect("frontier is left");
            assert!(way.length_m > radius_m && way.keeps_m <= radius_m, "{way:?}");
            let told = fed.map.way_through_views(&here, radius_m).expect("the same");
            assert_eq!(told[..], way.in_body[1..]);
            for leg in way.in_body.windows(2) {
                for step in 0..=20 {
                    let share = f64::from(step) / 20.0;
                    let at = leg[0] + (leg[1] - leg[0]) * share;
                    let clear_m = from_solid_m(&world_from_vertex.transform(&at));
                    assert!(clear_m > way.keeps_m - 0.05, "{clear_m} at {at}: {way:?}");
                    // A way may run along the side of a look: next to it somebody looked.
                    let mut next = around().map(|by| at + by * 1e-3);
                    let is_free = next.any(|p| fed.map.knows(&here, &p) == Known::Free);
                    assert!(is_free, "{at}: {way:?}");
                }
            }
            // Beyond the end somebody has still to look: near it there is what nobody knows.
            let end = way.in_body.last().expect("the end");
            let mut next = around().map(|by| end + by * 0.1);
            assert!(next.any(|p| fed.map.knows(&here, &p) != Known::Free), "{end}");
        }
    }
    let bad = FanOptions { radius_m: f64::NAN, ..FanOptions::default() };
    assert!(fed.map.way_through_fans(&hovering(first), &bad).is_err());
}
