//! Polyhedra that bound some of the Delaunay tetrahedra of points: each can be filled, for the chosen
//! tetrahedra do. Bytes say where the points are and which tetrahedra are chosen.

#![no_main]

use libfuzzer_sys::fuzz_target;
use solid::predicates::orient3;
use solid::tetrahedra::delaunay;
use solid::{Label, Point3, Polyhedron, tetrahedralize};

/// The smallest and the largest number of points.
const COUNTS: (usize, usize) = (5, 24);

/// Points on a lattice of 16, each coordinate moved by less than a cell or by about rounding; then what
/// bounds the chosen tetrahedra.
fn polyhedron(bytes: &[u8]) -> Option<Polyhedron> {
    let (&first, rest) = bytes.split_first()?;
    let count = COUNTS.0 + usize::from(first) % (COUNTS.1 - COUNTS.0);
    let (places, chosen) = rest.split_at_checked(3 * count)?;
    let coordinate = |byte: u8| {
        let fine = match byte >> 4 {
            0..8 => 0.0,
            8..12 => f64::from(byte >> 4) / 16.0,
            tiny => f64::from(tiny) * 1e-13,
        };
        f64::from(byte & 15) + fine
    };
    let points: Vec<Point3> = places
        .chunks_exact(3)
        .map(|p| Point3::new(coordinate(p[0]), coordinate(p[1]), coordinate(p[2])))
        .collect();
    let cells = delaunay(&points).ok()?;
    let is_in = |t: usize| chosen.get(t / 8).is_some_and(|byte| byte >> (t % 8) & 1 == 1);
    let mut faces = Vec::new();
    for (t, &[a, b, c, d]) in cells.tetrahedra.iter().enumerate().filter(|&(t, _)| is_in(t)) {
        let sides = [[b, c, d], [a, d, c], [a, b, d], [a, c, b]];
        for (side, other) in sides.into_iter().zip(cells.neighbours[t]) {
            if !other.is_some_and(|other| is_in(other as usize)) {
                faces.push(side);
            }
        }
    }
    let labels = vec![Label::Obstacle; faces.len()];
    Polyhedron::try_new(points, faces, labels).ok().filter(|mesh| !mesh.faces().is_empty())
}

fuzz_target!(|bytes: &[u8]| {
    let Some(mesh) = polyhedron(bytes) else { return };
    let found = tetrahedralize(&mesh).expect("the chosen tetrahedra fill it");
    assert_eq!(found.boundary.len(), mesh.faces().len());
    let at = |v: u32| &found.vertices[v as usize];
    for (t, &[a, b, c, d]) in found.tetrahedra.iter().enumerate() {
        assert!(orient3(at(a), at(b), at(c), at(d)) > 0.0);
        for other in found.neighbours[t].into_iter().flatten() {
            assert!(found.neighbours[other as usize].contains(&Some(t as u32)));
        }
    }
    let (ours, theirs) = (found.volume_m3(), mesh.volume_m3().abs());
    assert!((ours - theirs).abs() <= 1e-9 * theirs + 1e-12, "{ours} {theirs}");
});
