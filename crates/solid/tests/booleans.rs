//! Booleans against a second engine, against each other, against sampling.

use boolmesh::prelude::{Manifold, OpType, compute_boolean};
use probe::Probe;
use proptest::prelude::*;
use solid::boolean::{BooleanEvent, Options, Provenance, obstacle_wins};
use solid::synthetic::{Kind, degenerate_pairs, views};
use solid::validity::check_topology;
use solid::{
    Label, Operation, Point3, Polyhedron, Side, Solid, boolean, boolean_with, check, jittered,
    unite, unite_with,
};

const ALL: [Operation; 4] = [
    Operation::Union,
    Operation::Intersection,
    Operation::Difference,
    Operation::SymmetricDifference,
];

/// The second engine's mesh: it merges across labels, so it is an oracle for volume only.
fn second(mesh: &Polyhedron) -> Manifold<f64> {
    let places: Vec<f64> = mesh.vertices().iter().flat_map(|v| [v.x, v.y, v.z]).collect();
    let corners: Vec<usize> = mesh.faces().iter().flatten().map(|&v| v as usize).collect();
    Manifold::new(&places, &corners).expect("a closed 2-manifold")
}

fn volume_of(mesh: &Manifold<f64>, about: &Point3) -> f64 {
    let corner = |h: usize| {
        let p = mesh.ps[mesh.hs[h].tail];
        Point3::new(p.x, p.y, p.z) - about
    };
    let six = |f: usize| corner(3 * f).dot(&corner(3 * f + 1).cross(&corner(3 * f + 2)));
    (0..mesh.hs.len() / 3).map(six).sum::<f64>() / 6.0
}

/// Volume by the second engine.
fn oracle(a: &Polyhedron, b: &Polyhedron, operation: Operation) -> f64 {
    let about = a.vertices()[0];
    let (first, other) = (second(a), second(b));
    let of = |p: &Manifold<f64>, q: &Manifold<f64>, op| {
        // It has no empty meshes and says so in words.
        compute_boolean(p, q, op).map_or(0.0, |mesh| volume_of(&mesh, &about))
    };
    match operation {
        Operation::Union => of(&first, &other, OpType::Add),
        Operation::Intersection => of(&first, &other, OpType::Intersect),
        Operation::Difference => of(&first, &other, OpType::Subtract),
        Operation::SymmetricDifference => {
            of(&first, &other, OpType::Subtract) + of(&other, &first, OpType::Subtract)
        }
    }
}

#[track_caller]
fn assert_manifold(mesh: &Polyhedron, what: &str) {
    let validity = check_topology(mesh);
    assert!(validity.is_valid(), "{what}: {:?}", validity.defects.first());
}

#[test]
fn the_degenerate_pairs_are_closed_and_of_the_right_volume() {
    let pairs = degenerate_pairs();
    assert_eq!(pairs.len(), 20);
    for pair in pairs {
        for operand in [&pair.a, &pair.b] {
            assert_manifold(operand, pair.name);
            assert!(operand.volume_m3() > 0.0, "{}", pair.name);
        }
        let scale = pair.a.volume_m3() + pair.b.volume_m3();
        let mut volumes = Vec::new();
        for operation in ALL {
            let what = format!("{}, {operation}", pair.name);
            let options = Options::default();
            let mesh = boolean(&pair.a, &pair.b, operation, &options).expect("sound operands");
            assert_manifold(&mesh, &what);
            let (volume, expected) = (mesh.volume_m3(), oracle(&pair.a, &pair.b, operation));
            assert!(
                (volume - expected).abs() <= 1e-9 * scale,
                "{what}: {volume} against {expected}"
            );
            volumes.push(volume);
        }
        let [union, intersection, difference, symmetric] = volumes[..] else { panic!("four") };
        if let Some(known) = pair.union_m3 {
            assert!((union - known).abs() <= 1e-9 * known, "{}: {union}", pair.name);
        }
        let (a, b) = (pair.a.volume_m3(), pair.b.volume_m3());
        for (name, sum) in [
            ("union + intersection", union + intersection - a - b),
            ("difference", difference + intersection - a),
            ("symmetric difference", symmetric + intersection - union),
        ] {
            assert!(sum.abs() <= 1e-9 * scale, "{}: {name} off by {sum:e}", pair.name);
        }
    }
}

#[test]
fn chains_of_views_stay_valid_and_agree_with_the_second_engine() {
    for kind in Kind::ALL {
        let mut views = views(kind, 8);
        if kind == Kind::Coplanar {
            let jitter = |(i, view): (usize, &Polyhedron)| jittered(view, i as u64, 1e-8);
            views = views.iter().enumerate().map(jitter).collect();
        }
        let map = unite(&views, &Options::default()).expect("sound views");
        let validity = check(&map);
        assert!(validity.is_valid(), "{kind:?}: {:?}", validity.defects.first());
        let mut other = second(&views[0]);
        for view in &views[1..] {
            other = compute_boolean(&other, &second(view), OpType::Add).expect("a union");
        }
        let expected = volume_of(&other, &views[0].vertices()[0]);
        let volume = map.volume_m3();
        assert!((volume - expected).abs() < 1e-9 * expected, "{kind:?}: {volume} {expected}");
    }
}

/// A number from 0 to 1 (additive recurrence, Roberts 2018).
fn spread(index: usize, axis: usize) -> f64 {
    let step = [0.754_877_666_246_693, 0.569_840_290_998_053][axis];
    (0.5 + step * (index + 1) as f64).fract()
}

#[test]
fn area_per_label_is_that_of_what_no_other_view_covers() {
    let views = views(Kind::Noisy, 6);
    let map = unite(&views, &Options::default()).expect("sound views");
    let solids: Vec<Solid<'_>> = views.iter().map(Solid::new).collect();
    let mut expected = [0.0; 2];
    let mut variance = [0.0; 2];
    for (index, view) in views.iter().enumerate() {
        for face in 0..view.faces().len() {
            let samples = 24;
            let [a, b, c] = view.corners(face);
            let free = (0..samples).filter(|&sample| {
                let (mut s, mut t) =
                    (spread(face * samples + sample, 0), spread(face * samples + sample, 1));
                if s + t > 1.0 {
                    (s, t) = (1.0 - s, 1.0 - t);
                }
                let point = a + (b - a) * s + (c - a) * t;
                let others = solids.iter().enumerate().filter(|&(other, _)| other != index);
                !others.into_iter().any(|(_, solid)| solid.side(&point) == Side::Inside)
            });
            let share = free.count() as f64 / samples as f64;
            let (area, label) = (view.face_area_m2(face), view.labels()[face].code() as usize);
            expected[label] += area * share;
            variance[label] += area * area * (share * (1.0 - share) + 0.02) / samples as f64;
        }
    }
    let area = map.area_by_label();
    for label in Label::ALL {
        let (is, should) = (area.of(label), expected[label.code() as usize]);
        let sigma = variance[label.code() as usize].sqrt();
        assert!((is - should).abs() < 4.0 * sigma, "{label}: {is} against {should} +- {sigma}");
        assert!(sigma < 0.01 * should, "the test is sharp: {sigma} of {should}");
    }
}

#[test]
fn origins_name_the_face_on_which_a_face_lies() {
    let views = views(Kind::Noisy, 4);
    let options = Options { provenance: Provenance::Origins, ..Options::default() };
    let map = unite(&views, &options).expect("sound views");
    let origins = map.origins().expect("they were asked for");
    for (face, origin) in origins.iter().enumerate() {
        let source = &views[origin.view as usize];
        assert_eq!(map.labels()[face], source.labels()[origin.face as usize]);
        let corners = source.corners(origin.face as usize);
        for corner in map.corners(face) {
            let off = solid::query::distance_to_triangle(corner, corners);
            assert!(off < 1e-9, "face {face} lies {off} m from {origin:?}");
        }
    }
    let merged = unite(&views, &Options::default()).expect("sound views");
    assert!(merged.origins().is_none() && merged.faces().len() < map.faces().len());
    assert!((merged.volume_m3() - map.volume_m3()).abs() < 1e-9 * map.volume_m3());
}

#[test]
fn on_coincident_faces_the_obstacle_wins() {
    let p = |c: [f64; 3]| Point3::from(c);
    let frontier = Polyhedron::cuboid(&p([0.0; 3]), &p([1.0; 3]), Label::Frontier);
    let obstacle = Polyhedron::cuboid(&p([0.0, 0.0, 0.0]), &p([1.0, 1.0, 2.0]), Label::Obstacle);
    for (a, b) in [(&frontier, &obstacle), (&obstacle, &frontier)] {
        let area = |operation| {
            let mesh = boolean(a, b, operation, &Options::default()).expect("cubes");
            mesh.area_by_label()
        };
        assert_eq!(area(Operation::Union).frontier_m2, 0.0);
        let both = area(Operation::Intersection);
        // The lid at half the height is the frontier cube's alone.
        assert!((both.frontier_m2 - 1.0).abs() < 1e-12, "{both:?}");
    }
    let other_way = Polyhedron::cuboid(&p([1.0, 0.0, 0.0]), &p([2.0, 1.0, 1.0]), Label::Obstacle);
    let settled = obstacle_wins(&frontier, &[other_way], 1e-7);
    assert_eq!(settled.area_by_label().obstacle_m2, 0.0, "faces that look at each other");
}

/// Counts events.
#[derive(Default)]
struct Counter(Vec<&'static str>, usize);

impl Probe<BooleanEvent<'_>> for Counter {
    fn emit(&mut self, event: BooleanEvent<'_>) {
        self.0.push(event.variant());
        if let BooleanEvent::Combined { mesh, operand_of, curve } = event {
            assert_eq!(operand_of.len(), mesh.faces().len());
            self.1 += curve.len();
        }
    }
}

#[test]
fn a_probe_changes_nothing_and_sees_the_curve() {
    let views = views(Kind::Noisy, 3);
    let options = Options::default();
    for operation in ALL {
        let mut counter = Counter::default();
        let plain = boolean(&views[0], &views[1], operation, &options).expect("sound");
        let watched =
            boolean_with(&views[0], &views[1], operation, &options, &mut counter).expect("sound");
        assert_eq!(plain, watched);
        assert_eq!(plain, boolean(&views[0], &views[1], operation, &options).expect("sound"));
        assert_eq!(counter.0, ["Started", "Combined", "Settled", "Finished"]);
    }
    let mut counter = Counter::default();
    let watched = unite_with(&views, &options, &mut counter).expect("sound");
    assert_eq!(watched, unite(&views, &options).expect("sound"));

    let cleans = Options { clean_m: 1e-3, ..options };
    let mut counter = Counter::default();
    let watched = boolean_with(&views[0], &views[1], Operation::Union, &cleans, &mut counter);
    let plain = boolean(&views[0], &views[1], Operation::Union, &cleans);
    assert_eq!(watched.expect("sound"), plain.expect("sound"));
    assert_eq!(counter.0, ["Started", "Combined", "Settled", "Cleaned", "Finished"]);

    let p = |c: [f64; 3]| Point3::from(c);
    let a = Polyhedron::cuboid(&p([0.0; 3]), &p([1.0; 3]), Label::Obstacle);
    let b = Polyhedron::cuboid(&p([0.5, 0.25, 0.25]), &p([2.0, 0.75, 0.75]), Label::Obstacle);
    let mut counter = Counter::default();
    boolean_with(&a, &b, Operation::Union, &options, &mut counter).expect("cubes");
    assert!(counter.1 >= 4, "a beam goes into a wall along at least four edges: {}", counter.1);
}

#[test]
fn broken_operands_are_refused_by_name() {
    let cube = Polyhedron::cuboid(&Point3::origin(), &Point3::new(1.0, 1.0, 1.0), Label::Obstacle);
    let (vertices, mut faces, mut labels, _) = cube.clone().into_parts();
    faces.pop();
    labels.pop();
    let open = Polyhedron::try_new(vertices, faces, labels).expect("indices are in range");
    let refused = boolean(&cube, &open, Operation::Union, &Options::default());
    let message = refused.expect_err("it is open").to_string();
    assert_eq!(message, "the second operand is no closed 2-manifold: edge 1-3 is open: face 0");
    let points = Polyhedron::try_new(cube.vertices().to_vec(), vec![], vec![]).expect("points");
    let refused = boolean(&points, &cube, Operation::Union, &Options::default());
    let message = refused.expect_err("points are no solid").to_string();
    assert_eq!(message, "the first operand is no closed 2-manifold: it has no faces");
    let (vertices, mut faces, labels, _) = cube.clone().into_parts();
    faces.iter_mut().for_each(|face| face.swap(0, 1));
    let inside_out = Polyhedron::try_new(vertices, faces, labels).expect("indices are in range");
    let refused = boolean(&cube, &inside_out, Operation::Intersection, &Options::default());
    let message = refused.expect_err("it is inside out").to_string();
    let expected = "the second operand is no closed 2-manifold: its faces look inwards, the volume is -1.000e0 m3";
    assert_eq!(message, expected);
    let empty = Polyhedron::try_new(vec![], vec![], vec![]).expect("nothing is wrong with nothing");
    let same =
        boolean(&cube, &empty, Operation::Union, &Options::default()).expect("nothing added");
    assert!((same.volume_m3() - 1.0).abs() < 1e-12);
    assert!(
        boolean(&cube, &empty, Operation::Intersection, &Options::default())
            .expect("empty")
            .is_empty()
    );
}

#[test]
fn jitter_depends_on_view_and_vertex_alone() {
    let view = &views(Kind::Coplanar, 1)[0];
    let moved = jittered(view, 3, 1e-8);
    assert_eq!(moved, jittered(view, 3, 1e-8));
    assert_ne!(moved, jittered(view, 4, 1e-8));
    let farthest = view.vertices().iter().zip(moved.vertices()).map(|(p, q)| (p - q).amax());
    let farthest = farthest.fold(0.0, f64::max);
    assert!((0.5e-8..=1.01e-8).contains(&farthest), "{farthest}");
}

/// A box with corners on a coarse grid, so that most pairs share planes, edges or corners.
#[test]
fn what_operands_share_of_their_surface_is_not_left_twice() {
    let a = as_mesh([[0, 2], [0, 2], [0, 2]], Label::Obstacle);
    // Side by side; on top, in part; overlapping with two surfaces in one plane.
    for (sides, volume) in [
        ([[2, 4], [0, 2], [0, 2]], 16.0),
        ([[1, 3], [0, 2], [2, 4]], 16.0),
        ([[1, 3], [0, 2], [0, 2]], 8.0),
    ] {
        let b = as_mesh(sides, Label::Obstacle);
        let options = Options::default();
        let mesh = boolean(&a, &b, Operation::SymmetricDifference, &options).expect("two boxes");
        assert_manifold(&mesh, "symmetric difference");
        assert!(solid::crossings(&mesh, 1).is_empty(), "{sides:?}");
        assert!(
            (mesh.volume_m3() - 1e-3 * volume).abs() < 1e-12,
            "{sides:?}: {}",
            mesh.volume_m3()
        );
    }
}

fn grid_box() -> impl Strategy<Value = [[i32; 2]; 3]> {
    prop::array::uniform3((0..4_i32, 1..3_i32).prop_map(|(low, size)| [low, low + size]))
}

fn as_mesh(sides: [[i32; 2]; 3], label: Label) -> Polyhedron {
    let corner = |end: usize| Point3::from(sides.map(|side| 0.1 * f64::from(side[end])));
    Polyhedron::cuboid(&corner(0), &corner(1), label)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn boxes_that_share_planes_have_the_volume_that_coordinates_tell(a in grid_box(), b in grid_box()) {
        let cells = |sides: [[i32; 2]; 3]| sides.iter().map(|[low, high]| high - low).product::<i32>();
        let common = [0, 1, 2].map(|i| {
            let low = a[i][0].max(b[i][0]);
            [low, low.max(a[i][1].min(b[i][1]))]
        });
        let (first, second, both) = (cells(a), cells(b), cells(common));
        let (of_a, of_b) = (as_mesh(a, Label::Obstacle), as_mesh(b, Label::Frontier));
        for (operation, cells) in [
            (Operation::Union, first + second - both),
            (Operation::Intersection, both),
            (Operation::Difference, first - both),
            (Operation::SymmetricDifference, first + second - 2 * both),
        ] {
            let mesh = boolean(&of_a, &of_b, operation, &Options::default()).expect("boxes");
            prop_assert!(check_topology(&mesh).is_valid(), "{operation}");
            let expected = f64::from(cells) * 1e-3;
            prop_assert!((mesh.volume_m3() - expected).abs() < 1e-12, "{operation}: {}", mesh.volume_m3());
        }
    }
}
