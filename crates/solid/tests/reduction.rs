//! What a reduction keeps, and how far it goes.

use probe::Probe;
use proptest::prelude::*;
use solid::boolean::Options;
use solid::reduce::Goal;
use solid::synthetic::{Kind, views};
use solid::{
    Label, Point3, Polyhedron, ReduceEvent, Solid, check, clean, jittered, reduce, reduce_with,
    unite,
};

fn euler(mesh: &Polyhedron) -> i64 {
    let used: std::collections::BTreeSet<u32> = mesh.faces().iter().flatten().copied().collect();
    used.len() as i64 - mesh.faces().len() as i64 / 2
}

fn map(kind: Kind, count: usize) -> Polyhedron {
    let views: Vec<Polyhedron> = views(kind, count)
        .iter()
        .enumerate()
        .map(|(i, view)| jittered(view, i as u64, 1e-8))
        .collect();
    unite(&views, &Options::default()).expect("sound views")
}

/// The greatest distance of a vertex of `from` from the surface of `to`, found without the reduction's
/// own book-keeping.
fn farthest(from: &Polyhedron, to: &Polyhedron) -> f64 {
    let solid = Solid::new(to);
    let used = from.faces().iter().flatten().map(|&vertex| &from.vertices()[vertex as usize]);
    used.map(|point| solid.distance_m(point)).fold(0.0, f64::max)
}

#[test]
fn a_map_stays_valid_and_within_the_bound() {
    for (kind, error_m) in [(Kind::Noisy, 0.02), (Kind::Path, 0.02), (Kind::Coplanar, 0.01)] {
        let map = map(kind, 3);
        assert!(check(&map).is_valid());
        let reduced = reduce(&map, &Goal { error_m, faces: 0 });
        let validity = check(&reduced.mesh);
        assert!(validity.is_valid(), "{kind:?}: {:?}", validity.defects.first());
        assert_eq!(euler(&reduced.mesh), euler(&map), "{kind:?}");
        assert!(reduced.mesh.faces().len() < map.faces().len() / 2, "{:?}", reduced.refusals);
        assert_eq!(reduced.removed * 2, map.faces().len() - reduced.mesh.faces().len());
        let measured = farthest(&map, &reduced.mesh);
        assert!(measured <= reduced.error_m + 1e-12 && reduced.error_m <= error_m);
        let (was, is) = (map.area_by_label(), reduced.mesh.area_by_label());
        for label in Label::ALL {
            let change = (is.of(label) - was.of(label)).abs() / was.of(label);
            assert!(change < 0.1, "{kind:?}: {label}: {} -> {}", was.of(label), is.of(label));
        }
    }
}

#[test]
fn it_stops_at_a_number_of_faces() {
    let map = map(Kind::Noisy, 2);
    let reduced = reduce(&map, &Goal { error_m: 1.0, faces: 300 });
    assert!((299..=300).contains(&reduced.mesh.faces().len()), "{:?}", reduced.refusals);
    assert!(check(&reduced.mesh).is_valid());
}

#[test]
fn a_box_of_many_squares_becomes_a_box() {
    let n = 6;
    let mesh = squared_box(n);
    assert!(check(&mesh).is_valid());
    let reduced = reduce(&mesh, &Goal { error_m: 1e-9, faces: 0 });
    assert_eq!(reduced.mesh.faces().len(), 12);
    assert!(reduced.error_m < 1e-12);
    assert!((reduced.mesh.volume_m3() - 1.0).abs() < 1e-12);
    // With a frontier square on top its corners and edges stay, and the cube's.
    let labels = (0..mesh.faces().len()).map(|face| {
        let [a, b, c] = mesh.corners(face);
        let middle = (a.coords + b.coords + c.coords) / 3.0;
        let inside =
            middle.z > 0.999 && (0.3..0.7).contains(&middle.x) && (0.3..0.7).contains(&middle.y);
        if inside { Label::Frontier } else { Label::Obstacle }
    });
    let labels = labels.collect();
    let patched = mesh.with_labels(labels).expect("one for each face");
    let reduced = reduce(&patched, &Goal { error_m: 1e-9, faces: 0 });
    assert!(
        (reduced.mesh.area_by_label().frontier_m2 - patched.area_by_label().frontier_m2).abs()
            < 1e-12
    );
    assert_eq!(reduced.mesh.vertices().len(), 8 + 4);
}

/// A unit box whose sides are grids of n by n squares.
fn squared_box(n: usize) -> Polyhedron {
    let at = |i: usize| i as f64 / n as f64;
    let mut vertices = Vec::new();
    let mut faces = Vec::new();
    for axis in 0..3 {
        for high in [false, true] {
            let first = vertices.len() as u32;
            for i in 0..=n {
                for j in 0..=n {
                    let mut place = [0.0; 3];
                    place[axis] = if high { 1.0 } else { 0.0 };
                    place[(axis + 1) % 3] = at(i);
                    place[(axis + 2) % 3] = at(j);
                    vertices.push(Point3::from(place));
                }
            }
            let row = n as u32 + 1;
            for i in 0..n as u32 {
                for j in 0..n as u32 {
                    let [a, b] = [first + i * row + j, first + (i + 1) * row + j];
                    for [p, q, r] in [[a, b, b + 1], [a, b + 1, a + 1]] {
                        faces.push(if high { [p, q, r] } else { [p, r, q] });
                    }
                }
            }
        }
    }
    let labels = vec![Label::Obstacle; faces.len()];
    let soup = Polyhedron::try_new(vertices, faces, labels).expect("indices are in range");
    solid::mesh::weld(&soup).mesh
}

#[test]
fn cleaning_takes_short_edges_and_nothing_else() {
    let map = map(Kind::Coplanar, 5);
    let length_m = 1e-3;
    let cleaned = clean(&map, length_m);
    let validity = check(&cleaned.mesh);
    assert!(validity.is_valid(), "{:?}", validity.defects.first());
    assert_eq!(euler(&cleaned.mesh), euler(&map));
    assert!(!cleaned.removed.is_empty());
    assert_eq!(2 * cleaned.removed.len(), map.faces().len() - cleaned.mesh.faces().len());
    assert!(farthest(&map, &cleaned.mesh) <= length_m);
    assert!((cleaned.mesh.volume_m3() - map.volume_m3()).abs() < 1e-4 * map.volume_m3());
    let again = clean(&cleaned.mesh, length_m);
    assert!(again.removed.is_empty() || again.removed.len() < cleaned.removed.len());
}

#[test]
fn borders_of_open_meshes_stay() {
    let mesh = squared_box(5);
    let (vertices, faces, _, _) = mesh.into_parts();
    let lid = |face: &[u32; 3]| face.iter().all(|&vertex| vertices[vertex as usize].z == 1.0);
    let faces: Vec<[u32; 3]> = faces.into_iter().filter(|face| !lid(face)).collect();
    let labels = vec![Label::Obstacle; faces.len()];
    let open = Polyhedron::try_new(vertices, faces, labels).expect("indices are in range");
    let reduced = reduce(&open, &Goal { error_m: 0.2, faces: 0 });
    let rim = |mesh: &Polyhedron| {
        let defects = check(mesh).defects;
        let open = defects.iter().filter(|d| matches!(d, solid::Defect::OpenEdge { .. }));
        assert_eq!(open.clone().count(), defects.len(), "nothing but the rim is wrong");
        open.count()
    };
    assert_eq!(rim(&reduced.mesh), rim(&open));
    assert_eq!(rim(&open), 20);
    assert!(reduced.mesh.faces().len() < open.faces().len() / 2);
}

#[derive(Default)]
struct Heard(Vec<&'static str>);

impl Probe<ReduceEvent<'_>> for Heard {
    fn emit(&mut self, event: ReduceEvent<'_>) {
        self.0.push(event.variant());
    }
}

#[test]
fn a_probe_changes_nothing() {
    let map = map(Kind::Noisy, 2);
    let goal = Goal { error_m: 0.05, faces: 0 };
    let mut heard = Heard::default();
    let watched = reduce_with(&map, &goal, &mut heard);
    assert_eq!(watched, reduce(&map, &goal));
    let collapses = heard.0.iter().filter(|name| **name == "Collapsed").count();
    assert_eq!(collapses, watched.removed);
    assert!(heard.0.contains(&"Halved") && heard.0.last() == Some(&"Finished"));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn rough_boxes_stay_valid(seed in any::<u64>(), error_m in 1e-4..0.3_f64, rough in 0.0..0.04_f64) {
        let mesh = jittered(&squared_box(5), seed, rough);
        prop_assume!(check(&mesh).is_valid());
        let reduced = reduce(&mesh, &Goal { error_m, faces: 0 });
        prop_assert!(check(&reduced.mesh).is_valid());
        prop_assert_eq!(euler(&reduced.mesh), 2);
        prop_assert!(farthest(&mesh, &reduced.mesh) <= error_m);
    }
}
