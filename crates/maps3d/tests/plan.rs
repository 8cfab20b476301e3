//! Laws of paths: the same cost by every search, inside of the space, clear of obstacles.

use std::cell::{Cell, RefCell};
use std::collections::BTreeSet;

use maps3d::plan::{Passage, Space, passage};
use maps3d::{Algorithm, Heuristic, Maps3dError, Plan, PlanEvent, PlanOptions, Planner, Target};
use probe::Probe;
use proptest::prelude::*;
use solid::boolean::Options;
use solid::mesh::weld;
use solid::query::distance_to_triangle;
use solid::synthetic::{Kind, views};
use solid::tetrahedra::fan;
use solid::{Label, Point3, Polyhedron, Tetrahedra, tetrahedralize, unite};

fn of_boxes(boxes: &[([f64; 3], [f64; 3])]) -> Tetrahedra {
    let boxes: Vec<Polyhedron> = boxes
        .iter()
        .map(|(low, high)| {
            Polyhedron::cuboid(&Point3::from(*low), &Point3::from(*high), Label::Obstacle)
        })
        .collect();
    let united = unite(&boxes, &Options::default()).expect("sound boxes");
    tetrahedralize(&weld(&united).mesh).expect("a sound union")
}

fn of_views(count: usize) -> Tetrahedra {
    let map = unite(&views(Kind::Path, count), &Options::default()).expect("sound views");
    tetrahedralize(&weld(&map).mesh).expect("a sound map")
}

fn inside(map: &Tetrahedra, shares: [f64; 4]) -> Point3 {
    let t = ((shares[0] * map.tetrahedra.len() as f64) as usize).min(map.tetrahedra.len() - 1);
    let sum: f64 = shares.iter().map(|s| s + 0.1).sum();
    let corners = map.tetrahedra[t].map(|v| map.vertices[v as usize].coords);
    let weighted = corners.iter().zip(shares).map(|(corner, share)| corner * ((share + 0.1) / sum));
    Point3::from(weighted.sum::<solid::Vector3>())
}

/// By another way than the walk: each of many points of the path lies in a tetrahedron, or a hair from one.
fn assert_inside(space: &Space, points: &[Point3]) {
    for pair in points.windows(2) {
        for i in 0..=12 {
            let at = pair[0] + (pair[1] - pair[0]) * (f64::from(i) / 12.0);
            let hair = 1e-9;
            let around = [
                [0.0; 3],
                [hair, 0.0, 0.0],
                [-hair, 0.0, 0.0],
                [0.0, hair, 0.0],
                [0.0, -hair, 0.0],
            ];
            let more = [[0.0, 0.0, hair], [0.0, 0.0, -hair]];
            let held = around
                .iter()
                .chain(&more)
                .any(|by| space.locate(&(at + solid::Vector3::from(*by))).is_some());
            assert!(held, "{at} is outside");
        }
    }
}

/// Distance of many points of a path from all obstacle faces, one by one.
fn clearance_m(space: &Space, points: &[Point3]) -> f64 {
    let mut least = f64::INFINITY;
    for pair in points.windows(2) {
        for i in 0..=12 {
            let at = pair[0] + (pair[1] - pair[0]) * (f64::from(i) / 12.0);
            for [a, b, c] in space.obstacles().triangles() {
                least = least.min(distance_to_triangle(&at, [a, b, c]));
            }
        }
    }
    least
}

fn check(planner: &Planner, plan: &Plan) {
    let space = planner.space();
    for pair in plan.corridor.tetrahedra.windows(2) {
        assert!(space.exit(pair[0], pair[1]).is_some());
    }
    assert_eq!(plan.corridor.leaves(space, &plan.way), None, "the way leaves its corridor");
    assert_eq!(plan.corridor.leaves(space, &plan.path), None, "the path leaves its corridor");
    assert_inside(space, &plan.points());
}

#[test]
fn every_search_finds_the_same_cost_and_stays_inside() {
    let map = of_views(2);
    let options = PlanOptions { shorten: false, ..PlanOptions::default() };
    let planner = RefCell::new(Planner::new(&[&map], &options).expect("sound tetrahedra"));
    proptest!(ProptestConfig::with_cases(24), |(a in prop::array::uniform4(0.0..1.0), b in prop::array::uniform4(0.0..1.0))| {
        let mut planner = planner.borrow_mut();
        let (from, to) = (inside(&map, a), inside(&map, b));
        for target in [Target::Point(to), Target::Frontier] {
            planner.set_search(Algorithm::Dijkstra, Heuristic::Zero);
            let plain = planner.plan(&from, &target).expect("points inside").expect("one part");
            check(&planner, &plain);
            for heuristic in [Heuristic::Zero, Heuristic::Manhattan, Heuristic::Euclidean, Heuristic::Landmarks] {
                planner.set_search(Algorithm::Astar, heuristic);
                let drawn = planner.plan(&from, &target).expect("points inside").expect("one part");
                prop_assert_eq!(drawn.cost_m, plain.cost_m);
                prop_assert!(drawn.expansions <= plain.expansions + 2);
            }
            for algorithm in [Algorithm::Breadth, Algorithm::Depth] {
                planner.set_search(algorithm, Heuristic::Zero);
                let other = planner.plan(&from, &target).expect("points inside").expect("one part");
                prop_assert_eq!(other.corridor.leaves(planner.space(), &other.path), None);
                prop_assert!(other.cost_m >= plain.cost_m);
            }
        }
    });
}

#[test]
fn paths_are_shorter_than_ways_stay_inside_and_keep_the_radius() {
    let map = of_views(3);
    for radius_m in [0.0, 0.1, 0.25] {
        let options = PlanOptions { radius_m, ..PlanOptions::default() };
        let planner = RefCell::new(Planner::new(&[&map], &options).expect("sound tetrahedra"));
        let clear = Cell::new(0);
        proptest!(ProptestConfig::with_cases(25), |(a in prop::array::uniform4(0.0..1.0), b in prop::array::uniform4(0.0..1.0))| {
            let mut planner = planner.borrow_mut();
            let (from, to) = (inside(&map, a), inside(&map, b));
            match planner.plan(&from, &Target::Point(to)) {
                Ok(Some(plan)) => {
                    check(&planner, &plan);
                    if plan.clear {
                        clear.set(clear.get() + 1);
                        let least = clearance_m(planner.space(), &plan.points());
                        prop_assert!(least >= radius_m * (1.0 - 1e-9), "{} < {}", least, radius_m);
                    } else {
                        prop_assert!(plan.clearance_m < radius_m);
                    }
                    if radius_m == 0.0 {
                        prop_assert!(plan.path_m <= plan.cost_m);
                    }
                }
                Ok(None) => prop_assert!(radius_m > 0.0, "the map is one part"),
                Err(Maps3dError::TooNear { distance_m, .. }) => prop_assert!(distance_m < radius_m),
                Err(other) => prop_assert!(false, "{}", other),
            }
        });
        assert!(clear.get() >= 3, "{} clear paths at {radius_m} m", clear.get());
    }
}

/// An L of two passages, 1 m wide and high.
fn corner() -> Tetrahedra {
    of_boxes(&[([0.0; 3], [4.0, 1.0, 1.0]), ([3.0, 0.0, 0.0], [4.0, 4.0, 1.0])])
}

#[test]
fn round_a_corner_the_path_is_the_shortest() {
    let (from, to) = (Point3::new(0.5, 0.5, 0.5), Point3::new(3.5, 3.5, 0.5));
    let inner = Point3::new(3.0, 1.0, 0.5);
    let mut planner = Planner::new(&[&corner()], &PlanOptions::default()).expect("sound");
    let plan = planner.plan(&from, &Target::Point(to)).expect("inside").expect("a way");
    check(&planner, &plan);
    let shortest = (inner - from).norm() + (to - inner).norm();
    assert!((plan.path_m - shortest).abs() < 1e-4, "{} is not {shortest}", plan.path_m);

    // With a radius: two tangents and an arc round the corner.
    for radius_m in [0.1, 0.3] {
        let options = PlanOptions { radius_m, ..PlanOptions::default() };
        let mut planner = Planner::new(&[&corner()], &options).expect("sound");
        let plan = planner.plan(&from, &Target::Point(to)).expect("inside").expect("a way");
        check(&planner, &plan);
        assert!(plan.clear);
        assert!(clearance_m(planner.space(), &plan.points()) >= radius_m * (1.0 - 1e-9));
        let apart = (inner - from).norm();
        let tangent = (apart * apart - radius_m * radius_m).sqrt();
        // The angle round the corner on the side of the passage, less what the tangents take.
        let round = std::f64::consts::TAU - (from - inner).angle(&(to - inner));
        let taut = 2.0 * tangent + radius_m * (round - 2.0 * (radius_m / apart).acos());
        assert!(plan.path_m >= taut * (1.0 - 1e-3), "{} is less than {taut}", plan.path_m);
        assert!(plan.path_m <= taut * 1.05, "{} is much more than {taut}", plan.path_m);
    }
}

/// Two rooms, joined by a short slot of 0.2 m and a long passage of 1 m.
fn slot(with_passage: bool) -> Tetrahedra {
    let mut boxes = vec![
        ([0.0; 3], [2.0, 2.0, 2.0]),
        ([3.0, 0.0, 0.0], [5.0, 2.0, 2.0]),
        ([1.5, 0.9, 0.9], [3.5, 1.1, 1.1]),
    ];
    if with_passage {
        boxes.push(([0.5, 1.5, 0.5], [1.5, 6.0, 1.5]));
        boxes.push(([0.5, 5.0, 0.5], [4.5, 6.0, 1.5]));
        boxes.push(([3.5, 1.5, 0.5], [4.5, 6.0, 1.5]));
    }
    of_boxes(&boxes)
}

#[test]
fn a_ball_takes_the_passage_that_it_fits_through() {
    let (from, to) = (Point3::new(1.0, 1.0, 1.0), Point3::new(4.0, 1.0, 1.0));
    for (radius_m, with_passage, length_m) in [
        (0.05, true, Some(3.0)),
        (0.15, true, Some(10.5)),
        (0.05, false, Some(3.0)),
        (0.15, false, None),
    ] {
        let options = PlanOptions { radius_m, ..PlanOptions::default() };
        let mut planner = Planner::new(&[&slot(with_passage)], &options).expect("sound");
        let plan = planner.plan(&from, &Target::Point(to)).expect("inside");
        match (plan, length_m) {
            (None, None) => {}
            (Some(plan), Some(length_m)) => {
                check(&planner, &plan);
                assert!(plan.clear && (plan.path_m - length_m).abs() < 0.2, "{}", plan.path_m);
            }
            (plan, _) => panic!("{radius_m} m: {plan:?}"),
        }
    }
}

#[test]
fn a_face_that_is_shut_has_no_point_where_the_ball_fits() {
    let map = of_views(3);
    let space = Space::new(&[&map]).expect("sound");
    let (mut shut, mut open) = (0, 0);
    for (t, tet) in map.tetrahedra.iter().enumerate().step_by(11) {
        let Some(i) = (0..4).find(|&i| map.neighbours[t][i].is_some()) else { continue };
        let mut corners = tet.to_vec();
        corners.remove(i);
        let face = [0, 1, 2].map(|j| map.vertices[corners[j] as usize]);
        let radius_m = 0.05 + 0.05 * (t % 7) as f64;
        let all = |at: &Point3| {
            let triangles = space.obstacles().triangles().iter();
            triangles
                .map(|[a, b, c]| distance_to_triangle(at, [a, b, c]))
                .fold(f64::INFINITY, f64::min)
        };
        match passage(&face, radius_m, space.obstacles()) {
            Passage::Open(at) => {
                open += 1;
                assert!(all(&at) >= radius_m);
            }
            Passage::Shut => {
                shut += 1;
                for (u, v) in
                    (0..=6).flat_map(|u| (0..=6 - u).map(move |v| (f64::from(u), f64::from(v))))
                {
                    let at =
                        face[0] + (face[1] - face[0]) * (u / 6.0) + (face[2] - face[0]) * (v / 6.0);
                    assert!(all(&at) < radius_m, "{at} fits");
                }
            }
            Passage::Unknown => {}
        }
    }
    assert!(shut > 5 && open > 5, "{shut} shut, {open} open");
}

#[test]
fn frontier_faces_are_goals_and_large_ones_have_several_points() {
    let (low, high) = (Point3::new(0.0, 0.0, 0.0), Point3::new(4.0, 2.0, 1.0));
    let room = Polyhedron::cuboid(&low, &high, Label::Obstacle);
    let labels: Vec<Label> = (0..12)
        .map(|face| {
            let far = room.corners(face).iter().all(|corner| corner.x == 4.0);
            if far { Label::Frontier } else { Label::Obstacle }
        })
        .collect();
    let map = tetrahedralize(&room.with_labels(labels).expect("a label each")).expect("sound");
    for (spacing_m, least) in [(10.0, 2), (0.5, 20)] {
        let options = PlanOptions { spacing_m, ..PlanOptions::default() };
        let mut planner = Planner::new(&[&map], &options).expect("sound");
        let nodes = planner.graph().frontier().to_vec();
        assert!(nodes.len() >= least && nodes.iter().all(|node| (node.at.x - 4.0).abs() < 1e-9));
        let from = Point3::new(1.0, 0.3, 0.4);
        let plan = planner.plan(&from, &Target::Frontier).expect("inside").expect("a way");
        check(&planner, &plan);
        let goal = nodes[plan.frontier.expect("a frontier point") as usize];
        assert_eq!(plan.path.last().map(|knot| knot.at), Some(goal.at));
        assert!(plan.path_m < 4.0);
    }
    // Smaller faces than asked for are no goals.
    let options = PlanOptions { least_area_m2: 1.5, ..PlanOptions::default() };
    let mut planner = Planner::new(&[&map], &options).expect("sound");
    assert_eq!(planner.plan(&Point3::new(1.0, 0.3, 0.4), &Target::Frontier), Ok(None));
}

#[test]
fn fans_that_overlap_are_one_space() {
    let boxes = [([0.0; 3], [2.0, 1.0, 1.0]), ([1.0, 0.2, 0.2], [4.0, 0.8, 0.8])];
    let fans: Vec<Tetrahedra> = boxes
        .iter()
        .map(|(low, high)| {
            let (low, high) = (Point3::from(*low), Point3::from(*high));
            let one = Polyhedron::cuboid(&low, &high, Label::Frontier);
            fan(&one, &nalgebra::center(&low, &high)).expect("a box is a star")
        })
        .collect();
    let both: Vec<&Tetrahedra> = fans.iter().collect();
    let mut planner = Planner::new(&both, &PlanOptions::default()).expect("sound");
    let (from, to) = (Point3::new(0.2, 0.5, 0.5), Point3::new(3.8, 0.5, 0.5));
    let plan = planner.plan(&from, &Target::Point(to)).expect("inside").expect("a way");
    check(&planner, &plan);
    assert!(plan.path_m < 4.2, "{}", plan.path_m);
    // Frontier of one volume inside the other is none.
    let left = planner.space().frontier().iter().filter(|face| {
        let [a, b, c] = planner.space().points(face.corners);
        let middle = Point3::from((a.coords + b.coords + c.coords) / 3.0);
        (1.0..=2.0).contains(&middle.x) && (middle.y - 0.5).abs() < 0.4
    });
    assert_eq!(left.filter(|face| face.volume == 1).count(), 0);
}

#[test]
fn what_cannot_be_is_told() {
    let map = corner();
    let mut planner = Planner::new(&[&map], &PlanOptions::default()).expect("sound");
    let inside = Point3::new(0.5, 0.5, 0.5);
    for at in [
        Point3::new(9.0, 0.0, 0.0),
        Point3::new(f64::NAN, 0.0, 0.0),
        Point3::new(f64::INFINITY, 0.0, 0.0),
    ] {
        let told = planner.plan(&at, &Target::Frontier);
        assert!(matches!(told, Err(Maps3dError::Outside { what: "start", .. })), "{told:?}");
        let told = planner.plan(&inside, &Target::Point(at));
        assert!(matches!(told, Err(Maps3dError::Outside { what: "goal", .. })), "{told:?}");
    }
    assert_eq!(planner.plan(&inside, &Target::Frontier), Ok(None), "no frontier at all");
    let here = planner.plan(&inside, &Target::Point(inside)).expect("inside").expect("a way");
    assert_eq!((here.path_m, here.cost_m), (0.0, 0.0));

    let options = PlanOptions { radius_m: 0.3, ..PlanOptions::default() };
    let mut wide = Planner::new(&[&map], &options).expect("sound");
    let told = wide.plan(&Point3::new(0.1, 0.5, 0.5), &Target::Point(inside));
    assert!(matches!(told, Err(Maps3dError::TooNear { what: "start", .. })), "{told:?}");

    for options in [
        PlanOptions { radius_m: -1.0, ..PlanOptions::default() },
        PlanOptions { radius_m: f64::NAN, ..PlanOptions::default() },
        PlanOptions { spacing_m: 0.0, ..PlanOptions::default() },
        PlanOptions { least_area_m2: f64::NAN, ..PlanOptions::default() },
        PlanOptions { tries: 0, ..PlanOptions::default() },
    ] {
        assert!(matches!(Planner::new(&[&map], &options), Err(Maps3dError::Option { .. })));
    }
    // Two rooms apart: no way.
    let apart = of_boxes(&[([0.0; 3], [1.0; 3]), ([2.0, 0.0, 0.0], [3.0, 1.0, 1.0])]);
    let mut planner = Planner::new(&[&apart], &PlanOptions::default()).expect("sound");
    let told = planner.plan(&inside, &Target::Point(Point3::new(2.5, 0.5, 0.5)));
    assert_eq!(told, Ok(None));
    let mut nothing = Planner::new(&[], &PlanOptions::default()).expect("no volume is no error");
    assert!(nothing.plan(&inside, &Target::Frontier).is_err());
}

#[test]
fn tetrahedra_that_point_at_nothing_are_refused() {
    let sound = corner();
    let broken: [fn(&mut Tetrahedra); 6] = [
        |map| map.tetrahedra[0][0] = 1_000_000,
        |map| map.tetrahedra[0].swap(0, 1),
        |map| map.vertices[0].x = f64::NAN,
        |map| map.neighbours[0][0] = Some(1_000_000),
        |map| map.boundary[0].corners[0] = 1_000_000,
        |map| {
            map.neighbours.pop();
        },
    ];
    for breaks in broken {
        let mut map = sound.clone();
        breaks(&mut map);
        let told = Space::new(&[&map]);
        assert!(matches!(told, Err(Maps3dError::Tetrahedra { .. })));
    }
    // Neighbours that do not share a face are not believed.
    let mut map = sound;
    let count = map.tetrahedra.len() as u32;
    for (t, neighbours) in map.neighbours.iter_mut().enumerate() {
        *neighbours = [Some((t as u32 + 1) % count); 4];
    }
    assert!(Space::new(&[&map]).is_ok());
}

struct Names(BTreeSet<&'static str>);

impl Probe<PlanEvent<'_>> for Names {
    fn emit(&mut self, event: PlanEvent<'_>) {
        self.0.insert(event.variant());
    }
}

#[test]
fn a_probe_sees_everything_and_changes_nothing() {
    let mut names = Names(BTreeSet::new());
    let (from, to) = (Point3::new(1.0, 1.0, 1.0), Point3::new(4.0, 1.0, 1.0));
    for algorithm in [Algorithm::Astar, Algorithm::Dijkstra, Algorithm::Breadth, Algorithm::Depth] {
        for radius_m in [0.0, 0.08, 0.15, 0.19] {
            let options = PlanOptions { radius_m, algorithm, ..PlanOptions::default() };
            let map = slot(true);
            let mut planner = Planner::new(&[&map], &options).expect("sound");
            planner.tell(&mut names);
            let target = Target::Point(to);
            let plain = planner.plan(&from, &target);
            assert_eq!(planner.plan_with(&from, &target, &mut names), plain);
            assert_eq!(planner.plan_with(&from, &Target::Frontier, &mut names), Ok(None));
        }
    }
    let map = of_views(4);
    let options = PlanOptions { radius_m: 0.25, ..PlanOptions::default() };
    let mut planner = Planner::new(&[&map], &options).expect("sound");
    for i in 0..40 {
        let share = |k: u32| f64::from((i * 37 + k * 11) % 100) / 100.0;
        let (a, b) = ([1, 2, 3, 4].map(share), [5, 6, 7, 8].map(share));
        let target = Target::Point(inside(&map, b));
        let plain = planner.plan(&inside(&map, a), &target);
        assert_eq!(planner.plan_with(&inside(&map, a), &target, &mut names), plain);
    }
    let all: BTreeSet<&str> = PlanEvent::VARIANTS.iter().copied().collect();
    assert_eq!(names.0, all);
}
