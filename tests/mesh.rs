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
    assert_eq!(told["defects"][0], "edge 1-3 is open: face 0");

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
