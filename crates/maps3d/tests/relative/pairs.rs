//! Random pairs of volumes: areas add up exactly, and what is closed is what lies inside.

use geometry::planar::overlay::{StepOverlay, StepRings};
use maps3d::Map3d;
use maps3d::relative::{OpenPart, RelativeParams, TWICE_AREA, ViewState};
use pose::Se3;
use posegraph::EdgeKind;

use super::oracle::{depth_in_fan, is_open, place};
use super::scene::{Fed, Numbers, bare, random_image};

/// So many pairs, or as many as `MAPS3D_PAIRS` says.
fn pairs(usual: u64) -> u64 {
    let asked = std::env::var("MAPS3D_PAIRS").ok().and_then(|pairs| pairs.parse().ok());
    asked.unwrap_or(usual)
}

/// Two views of random things, one a little way from the other.
fn random_pair(seed: u64, params: RelativeParams) -> (Fed, Se3) {
    let mut numbers = Numbers::new(seed);
    let mut fed = Fed::new(params);
    let (a, b) = (fed.vertex(), fed.vertex());
    let a_from_b = numbers.pose(1.0, 0.8);
    fed.edge(a, b, a_from_b, EdgeKind::Odometry);
    let camera = numbers.pose(0.2, 0.4);
    let image = random_image(&mut numbers);
    fed.look(a, camera, &image);
    let other = numbers.pose(0.2, 0.4);
    let image = random_image(&mut numbers);
    fed.look(b, other, &image);
    let from = camera.inverse() * a_from_b * other;
    (fed, from)
}

/// Open and free area add up to that of the face, in whole numbers: the free part is cut out of the face
/// anew, by another operation.
fn assert_adds_up(open: &OpenPart, overlay: &mut StepOverlay) {
    let (rings, whole) = (open.rings(), OpenPart::default().rings());
    let mut free = StepRings::new();
    overlay.difference(&whole, &rings, &mut free);
    assert_eq!(free.twice_area() + open.twice_area(), TWICE_AREA);
    let mut back = StepRings::new();
    overlay.intersection(&whole, &rings, &mut back);
    assert_eq!(back.twice_area(), open.twice_area());
}

/// Points of all frontier faces of a view: open exactly where the other volume does not hold them. Returns
/// how many were near neither boundary.
fn assert_agrees(
    of: &ViewState,
    other: &ViewState,
    other_from_of: &Se3,
    numbers: &mut Numbers,
) -> u64 {
    let polyhedron = other.volume.polyhedron().expect("a polyhedron");
    let surface = other.volume.surface_count();
    let mut judged = 0;
    for (index, open) in of.open.iter().enumerate() {
        let grid = of.grid(index);
        for _ in 0..3 {
            let at = place(numbers);
            let point = other_from_of.transform(&grid.point(at));
            let depth_m = depth_in_fan(&polyhedron, surface, &point);
            let Some(is_open) = is_open(open, at, 30.0) else { continue };
            if depth_m.abs() < 1e-4 {
                continue;
            }
            judged += 1;
            assert_eq!(is_open, depth_m < 0.0, "face {index} at {at:?}, {depth_m} m deep");
        }
    }
    judged
}

#[test]
fn what_is_closed_is_what_lies_inside() {
    let mut overlay = StepOverlay::default();
    let (mut judged, mut partly, mut closed) = (0, 0, 0);
    for seed in 0..pairs(250) {
        let (fed, first_from_second) = random_pair(seed, bare(40));
        let [first, second] = fed.map.views() else { panic!("two views") };
        for open in first.open.iter().chain(&second.open) {
            assert_adds_up(open, &mut overlay);
            closed += u64::from(open.is_closed());
            partly += u64::from(!open.is_closed() && !open.is_whole());
        }
        let mut numbers = Numbers::new(seed ^ 0xABCD);
        judged += assert_agrees(first, second, &first_from_second.inverse(), &mut numbers);
        judged += assert_agrees(second, first, &first_from_second, &mut numbers);
    }
    assert!(judged > 60 * pairs(250), "{judged} points");
    assert!(partly > 5 * pairs(250) && closed > pairs(250) / 2, "{partly} partly, {closed} closed");
}

#[test]
fn nothing_opens_while_no_edge_is_withdrawn() {
    let mut numbers = Numbers::new(77);
    let mut fed = Fed::new(bare(40));
    let mut before: Vec<Vec<i64>> = Vec::new();
    let mut last = fed.vertex();
    for round in 0..14 {
        if round % 3 == 2 {
            let next = fed.vertex();
            fed.edge(last, next, numbers.pose(0.5, 0.3), EdgeKind::Odometry);
            last = next;
        }
        let image = random_image(&mut numbers);
        fed.look(last, numbers.pose(0.3, 0.6), &image);
        let areas: Vec<Vec<i64>> = fed
            .map
            .views()
            .iter()
            .map(|state| state.open.iter().map(OpenPart::twice_area).collect())
            .collect();
        for (now, before) in areas.iter().flatten().zip(before.iter().flatten()) {
            assert!(now <= before);
        }
        before = areas;
    }
    let closed: usize = fed.map.views().iter().map(|state| state.closings.len()).sum();
    assert!(closed > 50, "{closed}");
}

#[test]
fn two_looks_from_one_place_do_not_close_each_other() {
    let params = RelativeParams { wall_closing_m: 0.0, ..RelativeParams::default() };
    let mut numbers = Numbers::new(5);
    let image = random_image(&mut numbers);
    let mut fed = Fed::new(params);
    let vertex = fed.vertex();
    for _ in 0..2 {
        fed.look(vertex, Se3::identity(), &image);
    }
    for state in fed.map.views() {
        assert!(state.open.iter().all(|open| open.is_whole() || open.is_closed()));
        assert!(state.closings.is_empty());
        let area_m2: f64 = (0..state.open.len()).map(|index| state.grid(index).area_m2()).sum();
        assert!((state.open_m2 + state.sliver_m2 - area_m2).abs() < 1e-9 * area_m2);
    }
    assert!(fed.map.tally().open_m2 > 1.0);
}
