//! Every closed mesh of the test data against a shifted and a turned copy of itself.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use boolmesh::prelude::{Manifold, OpType, compute_boolean};
use formats::mesh::read;
use pose::Se3;
use pose::nalgebra::{UnitQuaternion, Vector3};
use solid::boolean::Options;
use solid::mesh::weld;
use solid::validity::check_topology;
use solid::{Operation, Point3, Polyhedron, boolean};

/// The folder `meshes` of `$DRIFTLAB_DATA`, else of the test data beside the project.
fn folder() -> Option<PathBuf> {
    let given = std::env::var_os("DRIFTLAB_DATA").map(PathBuf::from);
    let beside = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
    let folder = given.unwrap_or(beside).join("meshes");
    if folder.is_dir() {
        return Some(folder);
    }
    // Said past the test harness, which would swallow it.
    let text = "SKIPPED: no real meshes in this folder; DRIFTLAB_DATA names the test data's folder";
    writeln!(std::io::stderr(), "{text}: {}", folder.display()).expect("stderr takes text");
    None
}

/// All files that hold a closed 2-manifold with its inside inside.
fn meshes(folder: &Path) -> Vec<(String, Polyhedron)> {
    let mut files = Vec::new();
    for part in ["boolean_pairs", "cgal", "clean", "nasty", "plc", "thingi10k"] {
        let entries = fs::read_dir(folder.join(part)).expect("the folder is there");
        files.extend(entries.map(|entry| entry.expect("it can be listed").path()));
    }
    files.sort();
    let open = |path: PathBuf| {
        let bytes = fs::read(&path).expect("it can be read");
        let extension = path.extension().and_then(|extension| extension.to_str());
        let file = read(&bytes, extension, None).expect("it is a mesh");
        let mesh = if file.is_soup() { weld(&file.mesh).mesh } else { file.mesh };
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        (check_topology(&mesh).is_valid() && mesh.volume_m3() > 0.0).then_some((name, mesh))
    };
    files.into_iter().filter_map(open).collect()
}

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

#[test]
fn copies_of_real_meshes_combine_as_the_second_engine_says() {
    let Some(folder) = folder() else { return };
    let meshes = meshes(&folder);
    assert!(meshes.len() >= 18, "{} closed meshes", meshes.len());
    let mut wrong = Vec::new();
    for (name, mesh) in meshes {
        let (low, high) = mesh.bounds().expect("it has faces");
        let (size, middle) = (high - low, nalgebra::center(&low, &high));
        let shifted = Se3::new(
            size.component_mul(&Vector3::new(0.31, 0.17, 0.23)),
            UnitQuaternion::identity(),
        );
        let turn = UnitQuaternion::from_scaled_axis(Vector3::new(0.4, -0.7, 0.5));
        let turned = Se3::new(middle.coords - turn * middle.coords, turn);
        for (how, moved_from_mesh) in [("shifted", shifted), ("turned", turned)] {
            let copy = mesh.transformed(&moved_from_mesh);
            let scale = mesh.volume_m3();
            let (p, q) = (second(&mesh), second(&copy));
            for (operation, theirs) in [
                (Operation::Union, OpType::Add),
                (Operation::Intersection, OpType::Intersect),
                (Operation::Difference, OpType::Subtract),
            ] {
                let what = format!("{name}, {how}, {operation}");
                let ours = boolean(&mesh, &copy, operation, &Options::default());
                let ours = ours.unwrap_or_else(|error| panic!("{what}: {error}"));
                if !check_topology(&ours).is_valid() {
                    wrong.push(format!("{what}: no 2-manifold"));
                }
                let expected =
                    compute_boolean(&p, &q, theirs).map_or(f64::NAN, |m| volume_of(&m, &middle));
                let off = (ours.volume_m3() - expected).abs() / scale;
                // Where the second engine fails there is nothing to compare with.
                if off > 1e-9 {
                    wrong.push(format!("{what}: off by {off:e}"));
                }
                if expected.is_nan() {
                    let text = format!("SKIPPED: {what}: the second engine gives no mesh");
                    writeln!(std::io::stderr(), "{text}").expect("stderr takes text");
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}
