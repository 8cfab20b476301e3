//! `driftlab mesh` as a user types it.

use std::fs;
use std::path::Path;

use assert_cmd::Command;
use serde_json::Value;

fn driftlab() -> Command {
    Command::cargo_bin("driftlab").expect("the binary is built with the tests")
}

fn json_of(arguments: &[&str], folder: &Path) -> Value {
    let output =
        driftlab().args(arguments).arg("--json").current_dir(folder).output().expect("it runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("one JSON object and nothing else")
}

/// A cube with corners at 0 and 1, moved along x.
fn cube(x: f64) -> String {
    let mut text = String::from("OFF\n8 6 12\n");
    for corner in 0..8 {
        let at = [corner >> 2 & 1, corner >> 1 & 1, corner & 1].map(f64::from);
        text += &format!("{} {} {}\n", at[0] + x, at[1], at[2]);
    }
    text + "4 0 1 3 2\n4 4 6 7 5\n4 0 4 5 1\n4 2 3 7 6\n4 0 2 6 4\n4 1 5 7 3\n"
}

#[test]
fn info_tells_what_a_mesh_is() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("cube.off"), cube(0.0)).expect("it is written");
    let told = json_of(&["mesh", "info", "cube.off"], folder.path());
    assert_eq!(told["faces"], 12);
    assert_eq!(told["polygons"], 6);
    assert_eq!(told["volume_m3"], 1.0);
    assert_eq!(told["area_by_label_m2"]["obstacle"], 6.0);
    for (level, is) in
        [("closed", true), ("oriented", true), ("manifold", true), ("self_intersecting", false)]
    {
        assert_eq!(told[level], is, "{level}");
    }
}

#[test]
fn info_names_what_is_wrong_and_where() {
    let folder = tempfile::tempdir().expect("a folder");
    let open = cube(0.0).replace("8 6 12", "8 5 12").replace("4 1 5 7 3\n", "");
    fs::write(folder.path().join("open.off"), open).expect("it is written");
    let told = json_of(&["mesh", "info", "open.off"], folder.path());
    assert_eq!(told["closed"], false);
    assert_eq!(told["defects"][0], "edge 1-3 is open: face 1");

    fs::write(folder.path().join("bad.off"), "OFF\n1 1 0\n0 0 0\n3 0 1 2\n")
        .expect("it is written");
    let output = driftlab()
        .args(["mesh", "info", "bad.off"])
        .current_dir(folder.path())
        .output()
        .expect("it runs");
    assert_eq!(output.status.code(), Some(2));
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(message.contains("bad.off: line 4, column 5: found vertex 1, expected"), "{message}");
}

#[test]
fn booleans_combine_two_files() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("a.off"), cube(0.0)).expect("it is written");
    fs::write(folder.path().join("b.off"), cube(0.5)).expect("it is written");
    for (operation, volume) in
        [("union", 1.5), ("intersection", 0.5), ("difference", 0.5), ("symmetric-difference", 1.0)]
    {
        let out = format!("{operation}.ply");
        let told =
            json_of(&["mesh", "boolean", operation, "a.off", "b.off", "-o", &out], folder.path());
        let found = told["volume_m3"].as_f64().expect("a number");
        assert!((found - volume).abs() < 1e-12, "{operation}: {found}");
        assert_eq!((&told["closed"], &told["manifold"]), (&true.into(), &true.into()));
        assert!(told["faces"].as_u64() >= Some(12) && told["secs"].is_number());
        let again = json_of(&["mesh", "info", &out], folder.path());
        assert_eq!(again["volume_m3"], told["volume_m3"]);
        assert_eq!(again["area_by_label_m2"], told["area_by_label_m2"]);
    }
    let occupied = driftlab()
        .args(["mesh", "boolean", "union", "a.off", "b.off", "-o", "union.ply"])
        .current_dir(folder.path())
        .output()
        .expect("it runs");
    assert_eq!(occupied.status.code(), Some(2), "nothing is overwritten without --force");
}

#[test]
fn a_recording_of_a_boolean_holds_every_event() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("a.off"), cube(0.0)).expect("it is written");
    fs::write(folder.path().join("b.off"), cube(0.5)).expect("it is written");
    let arguments =
        ["mesh", "boolean", "union", "a.off", "b.off", "--clean", "0.001", "--record", "it.rrd"];
    json_of(&arguments, folder.path());
    let told = json_of(&["inspect", "it.rrd"], folder.path());
    let all = told.to_string();
    for variant in ["Started", "Combined", "Settled", "Cleaned", "Finished"] {
        assert!(all.contains(variant), "{variant} in {all}");
    }
}

#[test]
fn an_open_operand_is_bad_input() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("a.off"), cube(0.0)).expect("it is written");
    let open = cube(0.0).replace("8 6 12", "8 5 12").replace("4 1 5 7 3\n", "");
    fs::write(folder.path().join("open.off"), open).expect("it is written");
    let output = driftlab()
        .args(["mesh", "boolean", "union", "a.off", "open.off", "-o", "out.ply"])
        .current_dir(folder.path())
        .output()
        .expect("it runs");
    assert_eq!(output.status.code(), Some(2));
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(
        message.contains("open.off: found no closed 2-manifold: edge 1-3 is open"),
        "{message}"
    );
    assert!(!folder.path().join("out.ply").exists());
}

#[test]
fn a_mesh_is_reduced_within_the_error_and_recorded() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("a.off"), cube(0.0)).expect("it is written");
    fs::write(folder.path().join("b.off"), cube(1.0)).expect("it is written");
    json_of(
        &["mesh", "boolean", "union", "a.off", "b.off", "--origins", "-o", "both.ply"],
        folder.path(),
    );
    let before = json_of(&["mesh", "info", "both.ply"], folder.path());
    let arguments =
        ["mesh", "reduce", "both.ply", "--error", "0.001", "-o", "small.off", "--record", "it.rrd"];
    let told = json_of(&arguments, folder.path());
    assert_eq!(told["faces"], 12, "two cubes are one box: {before}");
    assert_eq!(told["volume_m3"], 2.0);
    assert!(told["max_m"].as_f64() <= Some(0.001) && told["closed"] == true);
    let all = json_of(&["inspect", "it.rrd"], folder.path()).to_string();
    for variant in ["Started", "Collapsed", "Finished"] {
        assert!(all.contains(variant), "{variant} in {all}");
    }
}

#[test]
fn tetrahedralize_fills_a_mesh_and_refuses_by_name() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("cube.off"), cube(0.0)).expect("it is written");
    let told = json_of(
        &["mesh", "tetrahedralize", "cube.off", "-o", "cube.vtk", "--record", "cube.rrd"],
        folder.path(),
    );
    assert_eq!((&told["input_faces"], &told["preserved_faces"]), (&12.into(), &12.into()));
    assert_eq!(told["vertices"], 8);
    assert!(told["tetrahedra"].as_u64() >= Some(5) && told["steiner_points"].is_number());
    let volume = told["volume_m3"].as_f64().expect("a number");
    assert!((volume - 1.0).abs() < 1e-12 && told["secs"].is_number());
    let written = fs::read_to_string(folder.path().join("cube.vtk")).expect("it was written");
    assert!(written.contains("UNSTRUCTURED_GRID"));
    let seen = json_of(&["inspect", "cube.rrd"], folder.path()).to_string();
    for name in ["Inserted", "Triangulated", "Classified", "Finished"] {
        assert!(seen.contains(name), "no {name} in {seen}");
    }

    let open = cube(0.0).replace("8 6 12", "8 5 12").replace("4 1 5 7 3\n", "");
    fs::write(folder.path().join("open.off"), open).expect("it is written");
    let output = driftlab()
        .args(["mesh", "tetrahedralize", "open.off"])
        .current_dir(folder.path())
        .output()
        .expect("it runs");
    assert_eq!(output.status.code(), Some(2));
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(message.contains("is open: face"), "{message}");
}

#[test]
fn points_without_faces_get_delaunay_tetrahedra() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut nodes = String::from("9 3 0 0\n");
    for corner in 0..8 {
        let [x, y, z] = [corner >> 2 & 1, corner >> 1 & 1, corner & 1];
        nodes += &format!("{corner} {x} {y} {z}\n");
    }
    fs::write(folder.path().join("cube.node"), nodes + "8 0.5 0.4 0.3\n").expect("it is written");
    let told = json_of(&["mesh", "tetrahedralize", "cube.node", "-o", "cube.mesh"], folder.path());
    assert_eq!((&told["vertices"], &told["input_faces"]), (&9.into(), &0.into()));
    assert_eq!(told["steiner_points"], 0);
    assert_eq!(told["tetrahedra"], 12);
    let volume = told["volume_m3"].as_f64().expect("a number");
    assert!((volume - 1.0).abs() < 1e-12, "{volume}");

    fs::write(folder.path().join("flat.node"), "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 1 1 0\n")
        .expect("it is written");
    let output = driftlab()
        .args(["mesh", "tetrahedralize", "flat.node"])
        .current_dir(folder.path())
        .output()
        .expect("it runs");
    assert_eq!(output.status.code(), Some(2), "{}", String::from_utf8_lossy(&output.stderr));
}
