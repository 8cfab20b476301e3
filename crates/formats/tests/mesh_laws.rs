//! Meshes read back as they were written, and broken bytes say where they break.

use formats::mesh::{
    MeshFormat, PlcKind, TetrahedraFile, read, write_medit, write_obj, write_off, write_ply,
    write_ply_ascii, write_stl, write_vtk,
};
use proptest::prelude::*;
use solid::mesh::weld;
use solid::{Label, Origin, Point3, Polyhedron, check};

fn mesh() -> impl Strategy<Value = Polyhedron> {
    let vertex = prop::array::uniform3(prop_oneof![-1e3..1e3_f64, Just(0.0), -1e-9..1e-9_f64]);
    (prop::collection::vec(vertex, 3..20), any::<bool>()).prop_flat_map(|(vertices, origins)| {
        let count = vertices.len() as u32;
        let face = (0..count, 1..count, 1..count - 1).prop_map(move |(a, step, other)| {
            let b = (a + step) % count;
            let c =
                (0..count).filter(|&c| c != a && c != b).nth(other as usize % (count as usize - 2));
            [a, b, c.unwrap_or_default()]
        });
        let faces = prop::collection::vec((face, any::<bool>()), 1..30);
        faces.prop_map(move |faces| {
            let label = |is: bool| if is { Label::Frontier } else { Label::Obstacle };
            let labels = faces.iter().map(|&(_, is)| label(is)).collect();
            let corners: Vec<_> = faces.iter().map(|&(face, _)| face).collect();
            let of =
                (0..corners.len() as u32).map(|face| Origin { view: 7 * face, face }).collect();
            let points = vertices.iter().copied().map(Point3::from).collect();
            let made = Polyhedron::try_new(points, corners, labels).expect("it is sound");
            if origins { made.with_origins(of).expect("one for each face") } else { made }
        })
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn what_is_written_reads_back_equal(mesh in mesh()) {
        for bytes in [write_ply(&mesh), write_ply_ascii(&mesh)] {
            let file = read(&bytes, None, None).expect("it was written");
            prop_assert!(file.labelled && file.format == MeshFormat::Ply);
            prop_assert_eq!(&file.mesh, &mesh);
        }
        let bare = mesh.without_origins();
        for (bytes, format) in [(write_obj(&bare), MeshFormat::Obj), (write_off(&bare), MeshFormat::Off)] {
            let file = read(&bytes, None, None).expect("it was written");
            prop_assert!(file.labelled && file.format == format);
            prop_assert_eq!(&file.mesh, &bare);
        }
        let soup = read(&write_stl(&bare), None, None).expect("it was written");
        prop_assert!(soup.is_soup() && soup.mesh.faces().len() == bare.faces().len());
    }

    #[test]
    fn broken_bytes_never_panic(
        mesh in mesh(),
        cut in 0.0..1.0_f64,
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..8),
        which in 0..5_usize,
    ) {
        let writers = [write_ply, write_ply_ascii, write_obj, write_off, write_stl];
        let mut bytes = writers[which](&mesh);
        for (index, byte) in changes {
            let at = index.index(bytes.len());
            bytes[at] = byte;
        }
        bytes.truncate((bytes.len() as f64 * cut) as usize + 1);
        for extension in [None, Some("off"), Some("poly"), Some("smesh"), Some("node"), Some("ply")] {
            if let Err(error) = read(&bytes, extension, None) {
                prop_assert!(error.to_string().contains("expected"), "{error}");
            }
        }
    }
}

#[test]
fn a_cube_of_squares_and_a_soup_are_valid() {
    let cube = Polyhedron::cuboid(&Point3::origin(), &Point3::new(1.0, 2.0, 4.0), Label::Obstacle);
    let soup = read(&write_stl(&cube), Some("stl"), None).expect("it was written");
    assert_eq!(soup.mesh.vertices().len(), 36);
    let welded = weld(&soup.mesh).mesh;
    assert!(check(&welded).is_valid());
    assert_eq!(welded.volume_m3(), 8.0);

    let text = "solid x\nfacet normal nan nan nan\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n\
                endloop\nendfacet\nendsolid x\n";
    let file = read(text.as_bytes(), None, None).expect("text");
    assert_eq!((file.mesh.faces().len(), file.format), (1, MeshFormat::Stl));
}

#[test]
fn facets_with_holes_and_points_elsewhere() {
    let nodes = "# corners\n8 3 0 0\n1 0 0 0\n2 4 0 0\n3 4 4 0\n4 0 4 0\n5 1 1 0\n6 2 1 0\n7 2 2 0\n8 1 2 0\n";
    let poly =
        "0 3 0 0\n1 0\n2 1 # with a hole\n4 1 2 3 4\n4 5 6 7 8\n1 1.5 1.5 0\n1\n1 9 9 9\n0\n";
    let file = read(poly.as_bytes(), Some("poly"), Some(nodes.as_bytes())).expect("a facet");
    assert_eq!((file.polygons, file.mesh.faces().len()), (1, 8));
    assert_eq!(file.mesh.area_by_label().obstacle_m2, 15.0);
    assert_eq!(file.hole_points, [Point3::new(9.0, 9.0, 9.0)]);
    assert!(file.facet_of.iter().all(|&facet| facet == 0));
    let alone = read(poly.as_bytes(), Some("poly"), None).expect_err("its points are missing");
    assert!(alone.to_string().contains(".node"), "{alone}");
    let points = read(nodes.as_bytes(), Some("node"), None).expect("points");
    assert_eq!((points.format, points.mesh.vertices().len()), (MeshFormat::Plc(PlcKind::Node), 8));
}

#[test]
fn relative_indices_and_late_vertices() {
    let text = "f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf -1/2/3 -2//1 -3\nusemtl frontier\nf 1 4 2\n";
    let file = read(text.as_bytes(), Some("obj"), None).expect("sound");
    assert_eq!(file.mesh.faces(), [[0, 1, 2], [3, 2, 1], [0, 3, 1]]);
    assert_eq!(file.mesh.labels()[2], Label::Frontier);
}

#[test]
fn errors_name_the_place() {
    let cases: [(&str, &str, &str); 6] = [
        (
            "OFF\n2 1 0\n0 0 0\n1 x 0\n",
            "off",
            "line 4, column 3: found `x`, expected x, y, z, a finite number",
        ),
        (
            "OFF\n1 1 0\n0 0 0\n3 0 0 1\n",
            "off",
            "line 4, column 7: found vertex 1, expected one of the 1 vertices from 0",
        ),
        (
            "v 0 0 0\nf 1 2 0\n",
            "obj",
            "line 2, column 7: found `0`, expected the number of a vertex, not 0",
        ),
        (
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n",
            "ply",
            "line 1, column 1: found a header without properties x, y and z, expected properties x, y and z",
        ),
        ("3 3 0 0\n0 0 0 0\n2 1 1 1\n", "node", "line 3, column 1: found point 2, expected 1"),
        (
            "what",
            "txt",
            "byte 0: found an unknown format, expected PLY, OBJ, STL, OFF, .node, .poly or .smesh",
        ),
    ];
    for (text, extension, message) in cases {
        let error = read(text.as_bytes(), Some(extension), None).expect_err(text);
        assert_eq!(error.to_string(), message);
    }
}

#[test]
fn tetrahedra_are_written_with_their_labels() {
    let vertices =
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(Point3::from);
    let file = TetrahedraFile {
        vertices: &vertices,
        tetrahedra: &[[0, 1, 2, 3]],
        faces: &[[0, 2, 1], [0, 1, 3]],
        labels: &[Label::Obstacle, Label::Frontier],
    };
    let vtk = String::from_utf8(write_vtk(&file)).expect("text");
    assert!(
        vtk.contains("CELLS 3 13\n4 0 1 2 3\n3 0 2 1\n3 0 1 3\nCELL_TYPES 3\n10\n5\n5\n"),
        "{vtk}"
    );
    assert!(vtk.ends_with("LOOKUP_TABLE default\n-1\n0\n1\n"), "{vtk}");
    let medit = String::from_utf8(write_medit(&file)).expect("text");
    assert!(
        medit.contains("Triangles\n2\n1 3 2 1\n1 2 4 2\nTetrahedra\n1\n1 2 3 4 0\nEnd\n"),
        "{medit}"
    );
}

/// A mesh without faces is one that the file says it is: by counts of 0, or by its end.
#[test]
fn a_file_that_says_nothing_is_no_empty_mesh() {
    for (bytes, extension) in [
        (&b""[..], "obj"),
        (b"hello world\nthis is no mesh\n", "obj"),
        (b"# a comment\n", "obj"),
        (b"", "off"),
        (b"OFF\n", "off"),
        (b"", "stl"),
        (b"solid\n", "stl"),
        (b"", "ply"),
        (b"ply\nformat ascii 1.0\n", "ply"),
    ] {
        let told = read(bytes, Some(extension), None);
        assert!(told.is_err(), "{extension}: {}", String::from_utf8_lossy(bytes));
    }
    let empty = Polyhedron::empty();
    for (bytes, extension) in [
        (write_obj(&empty), "obj"),
        (write_off(&empty), "off"),
        (write_stl(&empty), "stl"),
        (write_ply(&empty), "ply"),
        (b"solid nothing\nendsolid nothing\n".to_vec(), "stl"),
    ] {
        let file = read(&bytes, Some(extension), None).expect(extension);
        assert!(file.mesh.is_empty(), "{extension}");
    }
}
