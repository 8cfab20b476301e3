//! Every closed mesh of the test data against a shifted and a turned copy of itself.

mod data;

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

/// All files that hold a closed 2-manifold with its inside inside.
fn meshes(folder: &Path, parts: &[&str]) -> Vec<(String, Polyhedron)> {
    let mut files = Vec::new();
    for part in parts {
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

/// The second engine's mesh; `None` where it refuses: it joins vertices at one place, and then has
/// edges with more than two faces.
fn second(mesh: &Polyhedron) -> Option<Manifold<f64>> {
    let places: Vec<f64> = mesh.vertices().iter().flat_map(|v| [v.x, v.y, v.z]).collect();
    let corners: Vec<usize> = mesh.faces().iter().flatten().map(|&v| v as usize).collect();
    Manifold::new(&places, &corners).ok()
}

fn volume_of(mesh: &Manifold<f64>, about: &Point3) -> f64 {
    let corner = |h: usize| {
        let p = mesh.ps[mesh.hs[h].tail];
        Point3::new(p.x, p.y, p.z) - about
    };
    let six = |f: usize| corner(3 * f).dot(&corner(3 * f + 1).cross(&corner(3 * f + 2)));
    (0..mesh.hs.len() / 3).map(six).sum::<f64>() / 6.0
}

/// Unites, intersects and subtracts every mesh of some folders with its copies.
///
/// `bar` is how far the volumes may be off, as a share of the mesh's: from those of the second engine,
/// and by what union and intersection together differ from both operands.
fn combine(parts: &[&str], at_least: usize, bar: [f64; 2]) {
    let Some(folder) = data::folder("meshes") else { return };
    let meshes = meshes(&folder, parts);
    assert!(meshes.len() >= at_least, "{} closed meshes", meshes.len());
    let wrong: Vec<String> =
        meshes.iter().flat_map(|(name, mesh)| with_copies(name, mesh, bar)).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// What is wrong with the booleans of a mesh and its copies.
fn with_copies(name: &str, mesh: &Polyhedron, bar: [f64; 2]) -> Vec<String> {
    let mut wrong = Vec::new();
    let (low, high) = mesh.bounds().expect("it has faces");
    let (size, middle) = (high - low, nalgebra::center(&low, &high));
    let step = size.component_mul(&Vector3::new(0.31, 0.17, 0.23));
    let turn = UnitQuaternion::from_scaled_axis(Vector3::new(0.4, -0.7, 0.5));
    let shifted = Se3::new(step, UnitQuaternion::identity());
    let turned = Se3::new(middle.coords - turn * middle.coords, turn);
    for (how, moved_from_mesh) in [("shifted", shifted), ("turned", turned)] {
        let copy = mesh.transformed(&moved_from_mesh);
        let scale = mesh.volume_m3();
        let others = second(mesh).zip(second(&copy));
        if others.is_none() {
            let text = format!("SKIPPED: {name}, {how}: the second engine refuses it");
            writeln!(std::io::stderr(), "{text}").expect("stderr takes text");
        }
        let mut sum = -mesh.volume_m3() - copy.volume_m3();
        for (operation, theirs) in [
            (Operation::Union, OpType::Add),
            (Operation::Intersection, OpType::Intersect),
            (Operation::Difference, OpType::Subtract),
        ] {
            let what = format!("{name}, {how}, {operation}");
            let ours = match boolean(mesh, &copy, operation, &Options::default()) {
                Ok(mesh) => mesh,
                Err(error) => {
                    wrong.push(format!("{what}: {error}"));
                    continue;
                }
            };
            if !check_topology(&ours).is_valid() {
                wrong.push(format!("{what}: no 2-manifold"));
            }
            if operation != Operation::Difference {
                sum += ours.volume_m3();
            }
            let Some((p, q)) = &others else { continue };
            let expected = match compute_boolean(p, q, theirs) {
                Ok(mesh) => volume_of(&mesh, &middle),
                // It has no empty meshes.
                Err(why) if why.contains("empty") => 0.0,
                Err(why) => panic!("{what}: the second engine fails: {why}"),
            };
            let off = (ours.volume_m3() - expected).abs() / scale;
            if off.is_nan() || off > bar[0] {
                wrong.push(format!("{what}: off by {off:e}"));
            }
        }
        if sum.abs() > bar[1] * scale {
            wrong.push(format!(
                "{name}, {how}: union and intersection sum to {:e} more",
                sum / scale
            ));
        }
    }
    wrong
}

/// The bar for meshes that do not intersect themselves.
const SOUND: [f64; 2] = [1e-9, 1e-9];

#[test]
fn copies_of_regression_operands() {
    combine(&["boolean_pairs"], 7, SOUND);
}

#[test]
fn copies_of_small_meshes() {
    combine(&["cgal", "clean", "thingi10k"], 12, SOUND);
}

#[test]
fn copies_of_meshes_with_coplanar_faces() {
    combine(&["plc"], 2, SOUND);
}

#[test]
fn copies_of_nasty_meshes() {
    // They intersect themselves: what is inside is a matter of taste there, and the engines differ.
    combine(&["nasty"], 2, [1e-8, 1e-2]);
}
