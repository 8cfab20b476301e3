//! Which label each part of a result has: against cells of boxes, and against distances from operands.

use pose::Se3;
use pose::nalgebra::{UnitQuaternion, Vector3};
use proptest::prelude::*;
use solid::boolean::{COINCIDENT_M, JITTER_M, Options, Provenance};
use solid::query::distance_to_triangle;
use solid::synthetic::{Kind, views};
use solid::validity::check_topology;
use solid::{Label, Operation, Point3, Polyhedron, boolean, check, jittered, unite};

const ALL: [Operation; 4] = [
    Operation::Union,
    Operation::Intersection,
    Operation::Difference,
    Operation::SymmetricDifference,
];

/// An axis-parallel box with a label on each of its sides: low and high, axis by axis.
#[derive(Clone, Copy, Debug)]
struct Box3 {
    low: [f64; 3],
    high: [f64; 3],
    labels: [[Label; 2]; 3],
}

impl Box3 {
    fn new(low: [f64; 3], high: [f64; 3], label: Label) -> Self {
        Self { low, high, labels: [[label; 2]; 3] }
    }

    fn mesh(&self) -> Polyhedron {
        let mesh = Polyhedron::cuboid(&self.low.into(), &self.high.into(), Label::Obstacle);
        let label = |face: usize| {
            let normal = mesh.scaled_normal(face);
            let axis = normal.iamax();
            self.labels[axis][usize::from(normal[axis] > 0.0)]
        };
        let labels = (0..mesh.faces().len()).map(label).collect();
        mesh.with_labels(labels).expect("one for each face")
    }

    fn holds(&self, p: &[f64; 3]) -> bool {
        (0..3).all(|k| self.low[k] < p[k] && p[k] < self.high[k])
    }

    /// Whether a side across `axis` at coordinate `p[axis]` is obstacle round `p`.
    fn is_obstacle(&self, axis: usize, p: &[f64; 3]) -> bool {
        let beside =
            (0..3).filter(|&k| k != axis).all(|k| self.low[k] < p[k] && p[k] < self.high[k]);
        let at =
            |end: usize, side: f64| p[axis] == side && self.labels[axis][end] == Label::Obstacle;
        beside && (at(0, self.low[axis]) || at(1, self.high[axis]))
    }
}

/// Obstacle and frontier area of what an operation makes of two boxes, square metres: sides of the
/// cells that all their planes make, where one of the two cells belongs to the result.
fn expected(a: &Box3, b: &Box3, operation: Operation) -> [f64; 2] {
    let planes: [Vec<f64>; 3] = [0, 1, 2].map(|k| {
        let mut planes = vec![a.low[k], a.high[k], b.low[k], b.high[k]];
        planes.sort_by(f64::total_cmp);
        planes.dedup();
        planes
    });
    let belongs = |p: &[f64; 3]| {
        let (in_a, in_b) = (a.holds(p), b.holds(p));
        match operation {
            Operation::Union => in_a || in_b,
            Operation::Intersection => in_a && in_b,
            Operation::Difference => in_a && !in_b,
            Operation::SymmetricDifference => in_a != in_b,
        }
    };
    let mut area = [0.0; 2];
    for k in 0..3 {
        let (u, v) = ((k + 1) % 3, (k + 2) % 3);
        for (i, &at) in planes[k].iter().enumerate() {
            let next = |i: Option<usize>| i.and_then(|i| planes[k].get(i)).copied();
            let below = next(i.checked_sub(1)).map_or(at - 1.0, |low| 0.5 * (low + at));
            let above = next(Some(i + 1)).map_or(at + 1.0, |high| 0.5 * (at + high));
            for s in planes[u].windows(2) {
                for t in planes[v].windows(2) {
                    let mut p = [0.0; 3];
                    (p[u], p[v]) = (0.5 * (s[0] + s[1]), 0.5 * (t[0] + t[1]));
                    let [low, high, here] = [below, above, at].map(|at| {
                        let mut p = p;
                        p[k] = at;
                        p
                    });
                    if belongs(&low) != belongs(&high) {
                        let obstacle = a.is_obstacle(k, &here) || b.is_obstacle(k, &here);
                        area[usize::from(!obstacle)] += (s[1] - s[0]) * (t[1] - t[0]);
                    }
                }
            }
        }
    }
    area
}

#[track_caller]
fn assert_areas(a: &Box3, b: &Box3, operation: Operation, options: &Options) {
    let mesh = boolean(&a.mesh(), &b.mesh(), operation, options).expect("boxes");
    let validity = check_topology(&mesh);
    assert!(validity.is_valid(), "{operation} of {a:?} and {b:?}: {:?}", validity.defects.first());
    let (area, [obstacle_m2, frontier_m2]) = (mesh.area_by_label(), expected(a, b, operation));
    assert!(
        (area.obstacle_m2 - obstacle_m2).abs() < 1e-9
            && (area.frontier_m2 - frontier_m2).abs() < 1e-9,
        "{operation} of {a:?} and {b:?}: {area:?}, {obstacle_m2} and {frontier_m2} expected"
    );
}

#[test]
fn obstacles_win_what_they_cover_of_a_face_and_no_more() {
    let (frontier, obstacle) = (Label::Frontier, Label::Obstacle);
    let cube = Box3::new([0.0; 3], [1.0; 3], frontier);
    for step in 1..24 {
        // Shares that floats hold, and others.
        for off in [f64::from(step) / 16.0, f64::from(step) / 13.7, 0.6_f64.powi(step)] {
            for shifted in [
                Box3::new([off, 0.0, 0.0], [off + 1.0, 1.0, 1.0], obstacle),
                Box3::new([off, 0.25, 0.0], [off + 0.5, 0.75, 1.0], obstacle),
                Box3::new([off, off, 0.0], [off + 0.5, off + 0.5, 1.0], obstacle),
                Box3::new([1.0, off, 0.3], [2.0, off + 0.5, 2.0], obstacle),
            ] {
                for operation in ALL {
                    assert_areas(&cube, &shifted, operation, &Options::default());
                    assert_areas(&shifted, &cube, operation, &Options::default());
                }
            }
        }
    }
    for step in 1..16 {
        // Next to nothing, but not along the way that faces look, where it would be nothing at all.
        let off = 0.1_f64.powi(step);
        let shifted = Box3::new([1.0, off, 0.3], [2.0, off + 0.5, 2.0], obstacle);
        assert_areas(&cube, &shifted, Operation::Difference, &Options::default());
        assert_areas(&cube, &shifted, Operation::Union, &Options::default());
    }
    let origins = Options { provenance: Provenance::Origins, ..Options::default() };
    let shifted = Box3::new([0.3, 0.1, 0.0], [1.3, 0.9, 1.0], obstacle);
    ALL.iter().for_each(|&operation| assert_areas(&cube, &shifted, operation, &origins));
}

/// A coordinate that several boxes are likely to share, or one of its own.
fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => (0..12_i32).prop_map(|tenths| 0.1 * f64::from(tenths)),
        1 => 0.0..1.2_f64,
    ]
}

fn label() -> impl Strategy<Value = Label> {
    any::<bool>().prop_map(|obstacle| if obstacle { Label::Obstacle } else { Label::Frontier })
}

fn any_box() -> impl Strategy<Value = Box3> {
    let side = (coordinate(), coordinate())
        .prop_filter("sides have a length", |(a, b)| (a - b).abs() > 1e-3)
        .prop_map(|(a, b)| [a.min(b), a.max(b)]);
    let sides = prop::array::uniform3(side);
    (sides, prop::array::uniform3(prop::array::uniform2(label()))).prop_map(|(sides, labels)| {
        Box3 { low: sides.map(|side| side[0]), high: sides.map(|side| side[1]), labels }
    })
}

/// Points of a face, well inside of it.
fn inner_points(mesh: &Polyhedron, face: usize) -> impl Iterator<Item = Point3> {
    let [a, b, c] = mesh.corners(face).map(|corner| corner.coords);
    let shares =
        [[1.0, 1.0, 1.0], [4.0, 1.0, 1.0], [1.0, 4.0, 1.0], [1.0, 1.0, 4.0], [3.0, 2.0, 1.0]];
    shares.into_iter().map(move |[s, t, u]| Point3::from((a * s + b * t + c * u) / (s + t + u)))
}

/// Holds each face's label against the distance of its points from the obstacle faces that look its way;
/// operands with 1, or -1 where their faces are turned.
#[track_caller]
fn assert_labels(mesh: &Polyhedron, operands: &[(&Polyhedron, f64)], within_m: f64, what: &str) {
    let mut obstacles = Vec::new();
    for &(operand, sense) in operands {
        for face in 0..operand.faces().len() {
            if operand.labels()[face] == Label::Obstacle {
                let looks = operand.scaled_normal(face).normalize() * sense;
                obstacles.push((operand.corners(face), looks));
            }
        }
    }
    for face in 0..mesh.faces().len() {
        let normal = mesh.scaled_normal(face);
        let corners = mesh.corners(face);
        let sides = (0..3).map(|i| (corners[i] - corners[(i + 1) % 3]).norm());
        // The direction of a sliver is rounding.
        if normal.norm() < 1e-5 * sides.fold(0.0, f64::max) {
            continue;
        }
        let looks = normal.normalize();
        let near = obstacles.iter().filter(|(_, theirs)| theirs.dot(&looks) > 1.0 - 1e-6);
        let near: Vec<_> = near.map(|(corners, _)| *corners).collect();
        for point in inner_points(mesh, face) {
            let off_m = near.iter().map(|&corners| distance_to_triangle(&point, corners));
            let off_m = off_m.fold(f64::INFINITY, f64::min);
            let label = mesh.labels()[face];
            if off_m < within_m {
                assert_eq!(label, Label::Obstacle, "{what}: {point} is {off_m} from an obstacle");
            } else if off_m > 1e-6 {
                assert_eq!(label, Label::Frontier, "{what}: {point} is {off_m} from an obstacle");
            }
        }
    }
}

fn looking<'a>(
    a: &'a Polyhedron,
    b: &'a Polyhedron,
    operation: Operation,
) -> Vec<(&'a Polyhedron, f64)> {
    match operation {
        Operation::Union | Operation::Intersection => vec![(a, 1.0), (b, 1.0)],
        Operation::Difference => vec![(a, 1.0), (b, -1.0)],
        Operation::SymmetricDifference => vec![(a, 1.0), (b, 1.0), (a, -1.0), (b, -1.0)],
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn areas_per_label_of_boxes_are_those_of_their_cells(a in any_box(), b in any_box()) {
        ALL.iter().for_each(|&operation| assert_areas(&a, &b, operation, &Options::default()));
    }

    #[test]
    fn labels_of_turned_boxes_are_those_of_the_operands_there(
        a in any_box(),
        b in any_box(),
        axis in prop::array::uniform3(-2.0..2.0_f64),
        far in prop::array::uniform3(-9.0..9.0_f64),
        seed in 0..1000_u64,
    ) {
        let turn = Se3::new(Vector3::from(far), UnitQuaternion::from_scaled_axis(Vector3::from(axis)));
        let (a, b) = (a.mesh().transformed(&turn), b.mesh().transformed(&turn));
        for operation in ALL {
            let looking = looking(&a, &b, operation);
            let mesh = boolean(&a, &b, operation, &Options::default()).expect("boxes");
            prop_assert!(check_topology(&mesh).is_valid());
            assert_labels(&mesh, &looking, 1e-9, operation.name());
            let jitter = Options { jitter_m: JITTER_M, seed, ..Options::default() };
            let mesh = boolean(&a, &b, operation, &jitter).expect("boxes");
            let validity = check(&mesh);
            prop_assert!(validity.is_valid(), "{operation}: {:?}", validity.defects.first());
            assert_labels(&mesh, &looking, 0.5 * COINCIDENT_M, "jittered");
        }
    }

    #[test]
    fn labels_of_chains_are_those_of_the_operands_there(boxes in prop::collection::vec(any_box(), 3..7)) {
        let meshes: Vec<_> = boxes.iter().map(Box3::mesh).collect();
        let looking: Vec<_> = meshes.iter().map(|mesh| (mesh, 1.0)).collect();
        let map = unite(&meshes, &Options::default()).expect("boxes");
        prop_assert!(check_topology(&map).is_valid());
        assert_labels(&map, &looking, 1e-9, "united at once");
        let mut map = meshes[0].clone();
        for mesh in &meshes[1..] {
            map = boolean(&map, mesh, Operation::Union, &Options::default()).expect("boxes");
        }
        prop_assert!(check_topology(&map).is_valid());
        assert_labels(&map, &looking, 1e-9, "united one by one");
    }
}

#[test]
fn labels_of_jittered_views_are_those_of_the_views_there() {
    let views = views(Kind::Coplanar, 4);
    let moved: Vec<_> =
        views.iter().enumerate().map(|(i, view)| jittered(view, i as u64, JITTER_M)).collect();
    let map = unite(&moved, &Options::default()).expect("sound views");
    assert!(check(&map).is_valid());
    let looking: Vec<_> = moved.iter().map(|view| (view, 1.0)).collect();
    assert_labels(&map, &looking, 0.5 * COINCIDENT_M, "views");
}
