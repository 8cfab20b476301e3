//! `driftlab mesh plan` as a user types it.

mod desk;

use desk::{Desk, code, json, stderr, stdout};
use serde_json::Value;

/// A corridor round a corner, 1 m wide and high: along x to 3 m, then along y; frontier at the end, at y = 3.
fn corner() -> String {
    let outline =
        [(0, 0), (2, 0), (3, 0), (3, 1), (3, 3), (2, 3), (2, 1), (0, 1)].map(|(x, y)| [x, y]);
    let mut text = String::new();
    for z in [0, 1] {
        for [x, y] in outline {
            text += &format!("v {x} {y} {z}\n");
        }
    }
    text += "usemtl obstacle\n";
    for quad in [[1, 2, 7, 8], [2, 3, 4, 7], [7, 4, 5, 6]] {
        let [a, b, c, d] = quad;
        text += &format!("f {d} {c} {b} {a}\nf {} {} {} {}\n", a + 8, b + 8, c + 8, d + 8);
    }
    for side in 1..=8 {
        let next = side % 8 + 1;
        let label = if side == 5 { "frontier" } else { "obstacle" };
        text += &format!("usemtl {label}\nf {side} {next} {} {}\n", next + 8, side + 8);
    }
    text
}

fn desk() -> Desk {
    let desk = Desk::new("");
    desk.put("corner.obj", &corner());
    desk
}

fn plan(desk: &Desk, args: &[&str]) -> Value {
    json(&desk.driftlab(&[&["mesh", "plan", "corner.obj", "--json"][..], args].concat()))
}

fn number(told: &Value, key: &str) -> f64 {
    told[key].as_f64().unwrap_or_else(|| panic!("no number {key} in {told}"))
}

#[test]
fn a_path_goes_round_the_corner() {
    let desk = desk();
    let told = plan(&desk, &["--from", "0.5,0.5,0.5", "--to", "2.5,2.5,0.5"]);
    assert_eq!((&told["found"], &told["clear"]), (&true.into(), &true.into()));
    assert_eq!(told["inside_corridor"], true);
    // The shortest way touches the inner edge, at x = 2 and y = 1.
    let shortest = 2.0 * 2.5_f64.sqrt();
    let path_m = number(&told, "path_m");
    assert!(path_m > shortest - 1e-6 && path_m < 1.1 * shortest, "{told}");
    assert!(number(&told, "way_m") > number(&told, "path_m"));
    assert!(number(&told, "shortened_share") > 0.0);
    assert_eq!(told["frontier"], Value::Null);
    for key in ["secs_read", "secs_tetrahedralize", "secs_graph", "secs_prepare", "secs_plan"] {
        assert!(told[key].is_number(), "{key}");
    }
    // A ball keeps away from that edge.
    let wide = plan(&desk, &["--from", "0.5,0.5,0.5", "--to", "2.5,2.5,0.5", "--radius", "0.3"]);
    assert!(number(&wide, "path_m") > shortest + 0.01, "{wide}");
    assert_eq!(wide["clear"], true);
    // All searches by cost find the same cost.
    let ends = ["--from", "0.5,0.5,0.5", "--to", "2.5,2.5,0.5", "--no-shorten"];
    for heuristic in ["zero", "euclidean", "manhattan", "landmarks"] {
        let other = plan(&desk, &[&ends[..], &["--heuristic", heuristic]].concat());
        assert_eq!(other["way_m"], told["way_m"], "{heuristic}");
        assert_eq!(other["programmes"], 0);
    }
    for algorithm in ["breadth-first", "depth-first", "dijkstra"] {
        let other = plan(&desk, &[&ends[..], &["--algorithm", algorithm]].concat());
        assert!(number(&other, "way_m") >= number(&told, "way_m"), "{algorithm}");
        assert_eq!(other["inside_corridor"], true);
    }
}

#[test]
fn without_a_goal_it_goes_to_the_nearest_frontier() {
    let desk = desk();
    let told = plan(&desk, &["--from", "0.5,0.5,0.5", "--spacing", "0.4"]);
    assert!(told["frontier_points"].as_u64() >= Some(8), "{told}");
    assert_eq!(told["frontier"]["area_m2"], 0.5);
    let end = told["path"].as_array().and_then(|path| path.last()).expect("a path");
    assert!((end[1].as_f64().expect("a number") - 3.0).abs() < 1e-9, "{told}");
    assert_eq!(end, &told["frontier"]["at"]);
}

#[test]
fn what_leads_nowhere_is_an_answer() {
    let desk = desk();
    desk.put("apart.off", &format!("OFF\n16 12 0\n{}", two_boxes()));
    let told = json(&desk.driftlab(&[
        "mesh",
        "plan",
        "apart.off",
        "--from",
        "0.5,0.5,0.5",
        "--to",
        "2.5,0.5,0.5",
        "--json",
    ]));
    assert_eq!(told["found"], false);
    // Too narrow: a path is told all the same, and that it is not clear.
    let told = json(&desk.driftlab(&[
        "mesh",
        "plan",
        "corner.obj",
        "--from",
        "0.5,0.5,0.5",
        "--to",
        "2.5,2.5,0.5",
        "--radius",
        "0.49",
        "--json",
    ]));
    assert_eq!(told["found"], true, "{told}");
}

/// The corners and faces of two boxes with a metre between them.
fn two_boxes() -> String {
    let mut text = String::new();
    for x in [0, 2] {
        for corner in 0..8 {
            text += &format!("{} {} {}\n", x + (corner >> 2 & 1), corner >> 1 & 1, corner & 1);
        }
    }
    for first in [0, 8] {
        for face in
            [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
        {
            let [a, b, c, d] = face.map(|corner| corner + first);
            text += &format!("4 {a} {b} {c} {d}\n");
        }
    }
    text
}

#[test]
fn a_recording_holds_every_step() {
    let desk = desk();
    let args = ["--from", "0.5,0.5,0.5", "--to", "2.5,2.5,0.5", "--radius", "0.3"];
    plan(&desk, &[&args[..], &["--record", "plan.rrd"]].concat());
    let told = json(&desk.driftlab(&["inspect", "plan.rrd", "--json"])).to_string();
    for name in [
        "Joined",
        "Located",
        "Opened",
        "Expanded",
        "Routed",
        "Solved",
        "Separated",
        "Verified",
        "Finished",
    ] {
        assert!(told.contains(name), "no {name} in {told}");
    }
    for entity in ["path/corridor", "search/closed", "path/half_spaces", "graph/legs", "plots/plan"]
    {
        assert!(told.contains(entity), "no {entity} in {told}");
    }
}

#[test]
fn the_text_says_what_was_found() {
    let desk = desk();
    let output =
        desk.driftlab(&["mesh", "plan", "corner.obj", "--from", "0.5,0.5,0.5", "--spacing", "2"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    // Seconds are never the same.
    let text = stdout(&output);
    let page: Vec<&str> = text.lines().filter(|line| !line.starts_with("seconds")).collect();
    insta::with_settings!({ omit_expression => true }, { insta::assert_snapshot!(page.join("\n")) });
}

#[test]
fn bad_input_gets_one_message_and_leaves_nothing() {
    let desk = desk();
    desk.put("cube.off", &format!("OFF\n16 12 0\n{}", two_boxes()));
    let open: Vec<String> = corner().lines().map(str::to_owned).collect();
    desk.put("open.obj", &open[..open.len() - 1].join("\n"));
    let before = desk.listing();
    let cases: [&[&str]; 10] = [
        &["missing.ply", "--from", "0,0,0"],
        &["open.obj", "--from", "0.5,0.5,0.5"],
        &["corner.obj", "--from", "9,0,0", "--record", "out.rrd"],
        &["corner.obj", "--from", "0.5,0.5,0.5", "--to", "nan,0,0", "--record", "out.rrd"],
        &["corner.obj", "--from", "0.5,0.5,0.5", "--to", "2.5,2.5,0.1", "--radius", "0.2"],
        &["corner.obj", "--from", "0.5,0.5,0.5", "--radius", "-1"],
        &["corner.obj", "--from", "0.5,0.5,0.5", "--spacing", "0"],
        &["corner.obj", "--from", "0.5,0.5,0.5", "--least-area", "5"],
        &["cube.off", "--from", "0.5,0.5,0.5"],
        &["corner.obj", "--from", "0.5,0.5,0.5", "--record", "corner.obj"],
    ];
    let mut page = String::new();
    for args in cases {
        let output = desk.driftlab(&[&["mesh", "plan"][..], args].concat());
        assert_eq!(code(&output), 2, "{args:?}: {}", stderr(&output));
        assert_eq!(stdout(&output), "", "{args:?}");
        page.push_str(&format!("$ driftlab mesh plan {}\n{}\n", args.join(" "), stderr(&output)));
    }
    assert_eq!(desk.listing(), before);
    insta::with_settings!({ omit_expression => true }, { insta::assert_snapshot!(page) });
}
