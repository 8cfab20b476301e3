//! Meshes that others made: read, counted, and as valid as they are known to be.

mod data;

use std::fs;

use formats::mesh::{MeshFile, read};
use solid::mesh::weld;
use solid::{Polyhedron, check};

fn open(folder: &std::path::Path, name: &str) -> (MeshFile, Polyhedron) {
    let path = folder.join(name);
    let bytes = fs::read(&path).unwrap_or_else(|error| panic!("{name}: {error}"));
    let extension = path.extension().and_then(|extension| extension.to_str());
    let file = read(&bytes, extension, None).unwrap_or_else(|error| panic!("{name}: {error}"));
    let mesh = if file.is_soup() { weld(&file.mesh).mesh } else { file.mesh.clone() };
    (file, mesh)
}

/// A file with its vertices, faces, whether it is closed, manifold, intersects itself, its volume.
type Known = (&'static str, usize, usize, bool, bool, bool, Option<f64>);

#[test]
fn every_mesh_is_read_and_the_sound_ones_are_found_sound() {
    let Some(folder) = data::folder("meshes") else { return };
    // Name, vertices, polygons, closed, 2-manifold, self-intersecting, volume.
    let known: [Known; 18] = [
        ("clean/cube.off", 8, 6, true, true, false, Some(4.0)),
        // Its faces 593 and 732 cross; rational arithmetic says so, too.
        ("clean/cow.off", 2762, 5520, true, true, true, Some(0.05348)),
        ("clean/fertility.off", 4494, 9000, true, true, false, Some(4.322e5)),
        ("clean/decimated-knight.off", 502, 1000, true, true, false, Some(0.02449)),
        ("cgal/star.off", 14, 24, true, true, false, Some(0.0625)),
        ("cgal/cubes.off", 14, 24, true, false, false, Some(2.0)),
        ("cgal/hole.off", 20, 28, true, true, false, Some(6095.0)),
        ("cgal/double-torus-example.off", 231, 220, true, true, false, Some(65.0)),
        ("thingi10k/65004.stl", 731, 1466, true, true, false, Some(1.289e4)),
        ("thingi10k/72214.stl", 830, 1660, true, true, false, Some(3.03e4)),
        ("thingi10k/472042.stl", 1814, 3632, true, true, false, Some(1.562e5)),
        ("boolean_pairs/bunny25k.obj", 12500, 24996, true, true, false, Some(0.04836)),
        ("boolean_pairs/cow25k.obj", 12500, 24996, true, true, false, Some(0.04131)),
        ("boolean_pairs/Havocglass8_right.obj", 8, 12, true, true, false, Some(3.49e5)),
        ("plc/bracket.off", 1464, 2936, true, true, false, Some(0.04173)),
        ("plc/boeing_part.off", 3406, 6848, true, true, false, Some(1.563e4)),
        ("nasty/self_intersectA.obj", 8582, 17160, true, true, true, Some(0.148)),
        ("nasty/truck.obj", 2956, 4770, false, false, true, None),
    ];
    let mut wrong = Vec::new();
    for (name, vertices, polygons, closed, manifold, crossing, volume) in known {
        let (file, mesh) = open(&folder, name);
        assert_eq!(file.polygons, polygons, "{name}");
        assert_eq!(mesh.vertices().len(), vertices, "{name}");
        let validity = check(&mesh);
        let told = (validity.closed, validity.manifold, validity.self_intersecting);
        if told != (closed, manifold, crossing) {
            wrong.push(format!("{name}: {told:?} {:?}", validity.defects.first()));
        }
        if let Some(volume) = volume {
            let off = (mesh.volume_m3().abs() / volume - 1.0).abs();
            assert!(off < 2e-3, "{name}: {}", mesh.volume_m3());
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn complexes_are_read_with_their_facets() {
    let Some(folder) = data::folder("meshes") else { return };
    for (name, points, facets) in [
        ("plc/example.poly", 28, 23),
        ("plc/slit-1.smesh", 14, 13),
        ("plc/slit-10.smesh", 14, 13),
        ("plc/spike-1-7.smesh", 8, 8),
        ("plc/spike-10-10.smesh", 11, 11),
        ("plc/wedge-5.smesh", 6, 5),
    ] {
        let (file, mesh) = open(&folder, name);
        assert_eq!((mesh.vertices().len(), file.polygons), (points, facets), "{name}");
        assert!(!check(&mesh).self_intersecting, "{name}: {:?}", check(&mesh).defects);
    }
}
