//! Results that rounding spoils are made again, or mended; those that operands spoil are not.

use pose::Se3;
use pose::nalgebra::{UnitQuaternion, Vector3};
use probe::Off;
use solid::boolean::Provenance;
use solid::boolean::{BooleanResult, JITTER_M, ManifoldKernel, Options, boolean_told};
use solid::{Label, Operation, Point3, Polyhedron, check, unite};

const ALL: [Operation; 4] = [
    Operation::Union,
    Operation::Intersection,
    Operation::Difference,
    Operation::SymmetricDifference,
];

fn cuboid(low: [f64; 3], high: [f64; 3]) -> Polyhedron {
    Polyhedron::cuboid(&Point3::from(low), &Point3::from(high), Label::Obstacle)
}

fn turned(mesh: &Polyhedron) -> Polyhedron {
    let turn = UnitQuaternion::from_scaled_axis(Vector3::new(0.7, 0.1, 0.5));
    mesh.transformed(&Se3::new(Vector3::new(0.3, -0.2, 0.1), turn))
}

fn side_by_side(a: &Polyhedron, b: &Polyhedron) -> Polyhedron {
    let first = a.vertices().len() as u32;
    let vertices = a.vertices().iter().chain(b.vertices()).copied().collect();
    let moved = b.faces().iter().map(|face| face.map(|vertex| vertex + first));
    let faces: Vec<_> = a.faces().iter().copied().chain(moved).collect();
    let labels = vec![Label::Obstacle; faces.len()];
    Polyhedron::try_new(vertices, faces, labels).expect("two boxes")
}

fn told(a: &Polyhedron, b: &Polyhedron, operation: Operation, jitter_m: f64) -> BooleanResult {
    let options = Options { jitter_m, ..Options::default() };
    boolean_told(&ManifoldKernel, a, b, operation, &options, &mut Off).expect("boxes")
}

/// No other move parts what passes through itself already: the first result is the one.
#[test]
fn operands_that_meet_themselves_are_not_made_again() {
    let twice = side_by_side(&cuboid([0.0; 3], [2.0; 3]), &cuboid([1.0; 3], [3.0; 3]));
    // Through the place where they meet, and coplanar with one of them.
    let through = cuboid([0.5, 0.5, 0.0], [2.5, 1.5, 2.0]);
    let (a, b) = (turned(&twice), turned(&through));
    for operation in ALL {
        for jitter_m in [0.0, JITTER_M] {
            for (p, q) in [(&a, &b), (&b, &a)] {
                let result = told(p, q, operation, jitter_m);
                let validity = check(&result.mesh);
                let what = format!("{operation}, {jitter_m}");
                assert!(validity.closed && validity.oriented && validity.manifold, "{what}");
                if validity.self_intersecting {
                    assert_eq!(result.again, 0, "{what}");
                }
            }
        }
        assert!(check(&told(&a, &b, operation, 0.0).mesh).self_intersecting, "{operation}");
    }
}

/// Where the operand meets itself outside of what is left of it, a result is valid and held against others as
/// any is.
#[test]
fn what_is_cut_off_spoils_nothing() {
    let twice = side_by_side(&cuboid([0.0; 3], [2.0; 3]), &cuboid([1.0; 3], [3.0; 3]));
    let corner = cuboid([0.0; 3], [0.5; 3]);
    for (a, b) in [(twice.clone(), corner.clone()), (turned(&twice), turned(&corner))] {
        let result = told(&a, &b, Operation::Intersection, 0.0);
        assert!(check(&result.mesh).is_valid());
        assert!((result.mesh.volume_m3() - 0.125).abs() < 1e-12);
    }
}

/// Boxes with faces in one plane but for the rounding of a turn: what the engine makes of some meets itself.
#[test]
fn unions_of_many_are_as_sound_as_those_of_two() {
    let boxes = [
        ([0.0, 0.0, 0.0], [4.0, 4.0, 4.0]),
        ([2.0, 0.0, 1.0], [6.0, 4.0, 3.0]),
        ([1.0, 0.0, 0.0], [3.0, 2.0, 4.0]),
        ([4.0, 1.0, 1.0], [5.0, 4.0, 4.0]),
        ([0.0, 2.0, 1.0], [6.0, 3.0, 4.0]),
        ([0.0, 4.0, 0.0], [3.0, 5.0, 4.0]),
    ];
    for shift in 0..boxes.len() {
        for count in 2..=boxes.len() {
            let order = (0..count).map(|i| boxes[(i + shift) % boxes.len()]);
            let (exact, views): (Vec<_>, Vec<_>) = order
                .map(|(low, high)| cuboid(low, high))
                .map(|mesh| (mesh.clone(), turned(&mesh)))
                .unzip();
            let exact = unite(&exact, &Options::default()).expect("boxes");
            for provenance in [Provenance::Labels, Provenance::Origins] {
                let options = Options { provenance, ..Options::default() };
                let map = unite(&views, &options).expect("boxes");
                let what = format!("{count} from {shift}, {provenance:?}");
                assert!(check(&map).is_valid(), "{what}: {:?}", check(&map).defects.first());
                assert!((map.volume_m3() - exact.volume_m3()).abs() < 1e-9, "{what}");
                if let Some(origins) = map.origins() {
                    assert!(origins.iter().all(|origin| (origin.view as usize) < count), "{what}");
                    assert!(origins.iter().any(|origin| origin.view as usize == count - 1));
                }
                assert_eq!(map.origins().is_some(), provenance == Provenance::Origins, "{what}");
            }
        }
    }
}
