//! Operands that touch, or have faces in one plane: what has no volume is no solid, and results are valid.

use pose::Se3;
use pose::nalgebra::{UnitQuaternion, Vector3};
use probe::Off;
use proptest::prelude::*;
use solid::boolean::{JITTER_M, ManifoldKernel, Options, boolean_told, obstacle_wins};
use solid::{Label, Operation, Point3, Polyhedron, boolean, check};

const ALL: [Operation; 4] = [
    Operation::Union,
    Operation::Intersection,
    Operation::Difference,
    Operation::SymmetricDifference,
];

fn cuboid(low: [f64; 3], high: [f64; 3], label: Label) -> Polyhedron {
    Polyhedron::cuboid(&Point3::from(low), &Point3::from(high), label)
}

/// Boxes that touch the unit cube: at a whole face, parts of faces, edges, parts of edges, a corner.
fn touching() -> Vec<Polyhedron> {
    [
        ([1.0, 0.0, 0.0], [2.0, 1.0, 1.0]),
        ([1.0, 0.25, 0.25], [2.0, 0.75, 0.75]),
        ([1.0, 0.25, 0.25], [2.0, 0.75, 1.5]),
        ([1.0, 0.5, 0.5], [2.0, 1.5, 1.5]),
        ([0.2, -0.5, 1.0], [0.7, 1.5, 2.0]),
        ([1.0, 1.0, 0.0], [2.0, 2.0, 1.0]),
        ([1.0, 1.0, 0.0], [2.0, 2.0, 0.5]),
        ([1.0, 1.0, 0.3], [2.0, 2.0, 0.7]),
        ([1.0, 1.0, 0.3], [2.0, 2.0, 1.7]),
        ([1.0, 1.0, 1.0], [2.0, 2.0, 2.0]),
    ]
    .map(|(low, high)| cuboid(low, high, Label::Frontier))
    .to_vec()
}

#[track_caller]
fn assert_valid(mesh: &Polyhedron, what: &str) {
    let validity = check(mesh);
    assert!(validity.is_valid(), "{what}: {:?}", validity.defects.first());
}

#[test]
fn boxes_that_touch_have_nothing_in_common() {
    let cube = cuboid([0.0; 3], [1.0; 3], Label::Obstacle);
    for (index, other) in touching().iter().enumerate() {
        for (a, b) in [(&cube, other), (other, &cube)] {
            for operation in ALL {
                let what = format!("{operation}, {index}");
                let mesh = boolean(a, b, operation, &Options::default()).expect("boxes");
                assert_valid(&mesh, &what);
                let expected = match operation {
                    Operation::Intersection => 0.0,
                    Operation::Difference => a.volume_m3(),
                    _ => a.volume_m3() + b.volume_m3(),
                };
                assert!((mesh.volume_m3() - expected).abs() < 1e-12, "{what}");
                assert_eq!(mesh.is_empty(), operation == Operation::Intersection, "{what}");
            }
        }
    }
}

#[test]
fn a_union_that_touches_along_half_an_edge_has_corners_there() {
    let cube = cuboid([0.0; 3], [1.0; 3], Label::Obstacle);
    let half = cuboid([1.0, 1.0, 0.0], [2.0, 2.0, 0.5], Label::Frontier);
    let mesh = boolean(&cube, &half, Operation::Union, &Options::default()).expect("boxes");
    assert_valid(&mesh, "half an edge");
    let middle = Point3::new(1.0, 1.0, 0.5);
    assert_eq!(mesh.vertices().iter().filter(|&&vertex| vertex == middle).count(), 2);
    assert_eq!(mesh.faces().len(), 12 + 12 + 2);
    assert_eq!(mesh.area_by_label().obstacle_m2, 6.0);
    assert_eq!(mesh.area_by_label().frontier_m2, 4.0);
}

#[test]
fn thin_solids_are_no_leaves() {
    for thick in [1e-3, 1e-6, 1e-9] {
        let plate = cuboid([0.0; 3], [1.0, 1.0, thick], Label::Obstacle);
        let beam = cuboid([0.2, -1.0, -1.0], [0.4, 2.0, 1.0], Label::Obstacle);
        let both = boolean(&plate, &beam, Operation::Intersection, &Options::default());
        let both = both.expect("boxes");
        let expected = 0.2 * thick;
        assert!((both.volume_m3() - expected).abs() < 1e-15, "{thick}: {}", both.volume_m3());
        assert_valid(&both, "a strip");
    }
}

fn turned(mesh: &Polyhedron, axis: [f64; 3]) -> Polyhedron {
    let turn = UnitQuaternion::from_scaled_axis(Vector3::from(axis));
    mesh.transformed(&Se3::new(Vector3::new(1.0, 2.0, 3.0), turn))
}

/// Boxes of which some faces are coplanar, turned so that they are so up to rounding: the engine's own results
/// meet themselves in some, have sheets without volume in others.
#[test]
fn what_rounding_spoils_is_made_again_with_or_without_jitter() {
    let cube = cuboid([0.0; 3], [1.0; 3], Label::Obstacle);
    let mut others = touching();
    for (low, high) in [
        ([0.5, 0.0, 0.0], [1.5, 1.0, 1.0]),
        ([0.5, 0.0, 0.0], [1.5, 1.0, 0.5]),
        ([0.0, 0.0, 0.0], [1.0, 1.0, 2.0]),
        ([0.25, 0.25, 0.0], [0.75, 0.75, 1.0]),
        ([0.0, 0.0, 0.0], [1.0, 1.0, 1.0]),
        ([0.3, 0.3, 0.3], [1.0, 1.0, 1.0]),
    ] {
        others.push(cuboid(low, high, Label::Frontier));
    }
    let mut again = 0;
    for (index, other) in others.iter().enumerate() {
        for axis in [[0.0; 3], [0.7, 0.0, 0.5], [0.1, -1.1, 2.3]] {
            let (a, b) = (turned(&cube, axis), turned(other, axis));
            for operation in ALL {
                let what = format!("{operation}, {index}, {axis:?}");
                let options = Options::default();
                let told = boolean_told(&ManifoldKernel, &a, &b, operation, &options, &mut Off);
                let told = told.expect("boxes");
                again += told.again;
                let plain = told.mesh;
                assert_valid(&plain, &what);
                // Whole numbers, but for the turn: by the boxes before it.
                let exact = boolean(&cube, other, operation, &Options::default()).expect("boxes");
                let off = (plain.volume_m3() - exact.volume_m3()).abs();
                assert!(off < 1e-10, "{what}: {off}");
                let off =
                    (plain.area_by_label().total_m2() - exact.area_by_label().total_m2()).abs();
                assert!(off < 1e-9, "{what}: {off}");
                assert!(told.jitter_m < 1e-10, "{what}: {}", told.jitter_m);
                for seed in [1, 2] {
                    let options = Options { jitter_m: JITTER_M, seed, ..Options::default() };
                    let mesh = boolean(&a, &b, operation, &options).expect("boxes");
                    assert_valid(&mesh, &what);
                    let off = (mesh.volume_m3() - plain.volume_m3()).abs();
                    assert!(off < 1e-6, "{what}: {off}");
                    let again = boolean(&a, &b, operation, &options).expect("boxes");
                    assert_eq!(mesh, again);
                }
            }
        }
    }
    assert!(again > 10, "without another try some do: {again}");
}

/// Each move leaves layers as thin as itself, between which and a face moved as far the next one could leave
/// sheets, or faces that meet.
#[test]
fn chains_of_moved_booleans_keep_volume_and_area() {
    let boxes = [
        ([0.0, 0.0, 0.0], [4.0, 4.0, 4.0]),
        ([2.0, 0.0, 1.0], [6.0, 4.0, 3.0]),
        ([1.0, 0.0, 0.0], [3.0, 2.0, 4.0]),
        ([4.0, 1.0, 1.0], [5.0, 4.0, 4.0]),
        ([0.0, 2.0, 1.0], [6.0, 3.0, 4.0]),
    ];
    let steps = [Operation::Union, Operation::Difference, Operation::Union, Operation::Difference];
    let mut layered = 0;
    for axis in [[0.0; 3], [0.7, 0.0, 0.5], [0.1, -1.1, 2.3], [-0.4, 0.2, 1.3]] {
        for shift in 0..boxes.len() {
            let order: Vec<Polyhedron> = (0..boxes.len())
                .map(|i| boxes[(i + shift) % boxes.len()])
                .map(|(low, high)| cuboid(low, high, Label::Obstacle))
                .collect();
            let mut exact = order[0].clone();
            let mut moved = turned(&exact, axis);
            for (step, (operation, next)) in steps.iter().zip(&order[1..]).enumerate() {
                exact = boolean(&exact, next, *operation, &Options::default()).expect("boxes");
                let seed = step as u64;
                let options = Options { jitter_m: JITTER_M, seed, ..Options::default() };
                let (kernel, next) = (ManifoldKernel, turned(next, axis));
                let told = boolean_told(&kernel, &moved, &next, *operation, &options, &mut Off);
                let told = told.expect("boxes");
                layered += usize::from(told.jitter_m > JITTER_M);
                moved = told.mesh;
                let what = format!("{axis:?}, {shift}, {step}");
                assert_valid(&moved, &what);
                let off = (moved.volume_m3() - exact.volume_m3()).abs();
                assert!(off < 2e-5, "{what}: volume off by {off}");
                let area = |mesh: &Polyhedron| mesh.area_by_label().total_m2();
                let off = (area(&moved) - area(&exact)).abs();
                assert!(off < 2e-5, "{what}: area off by {off}");
            }
        }
    }
    assert!(layered > 0, "none was moved past layers");
}

#[test]
fn what_looks_the_other_way_is_no_obstacle() {
    let frontier = cuboid([0.0; 3], [1.0; 3], Label::Frontier);
    let beside = cuboid([1.0, 0.25, 0.25], [2.0, 0.75, 0.75], Label::Obstacle);
    assert_eq!(obstacle_wins(&frontier, std::slice::from_ref(&beside), 1e-7), frontier);
    let inside = cuboid([0.5, 0.25, 0.25], [1.0, 0.75, 0.75], Label::Obstacle);
    let won = obstacle_wins(&frontier, &[inside], 1e-7);
    assert_valid(&won, "a window");
    assert!((won.area_by_label().obstacle_m2 - 0.25).abs() < 1e-15);
    assert!((won.area_by_label().total_m2() - 6.0).abs() < 1e-14);
}

fn grid_box() -> impl Strategy<Value = Polyhedron> {
    let side = (0..4_i32, 1..3_i32).prop_map(|(low, size)| [low, low + size]);
    prop::array::uniform3(side).prop_map(|sides| {
        let corner = |end: usize| sides.map(|side| 0.25 * f64::from(side[end]));
        cuboid(corner(0), corner(1), Label::Obstacle)
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn boxes_on_a_grid_have_valid_results(a in grid_box(), b in grid_box()) {
        for operation in ALL {
            let mesh = boolean(&a, &b, operation, &Options::default()).expect("boxes");
            let validity = check(&mesh);
            prop_assert!(validity.is_valid(), "{operation}: {:?}", validity.defects.first());
        }
    }
}
