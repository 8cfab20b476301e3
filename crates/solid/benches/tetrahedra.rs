//! Tetrahedra of united views, or of OFF files: how many, how many points added, and how long it takes.
//!
//! `cargo bench -p solid --bench tetrahedra -- [--points] [--write DIR] [FILE.off ...]`; without files, unions
//! of 1, 2, 5, 10, 20 and 50 views of each kind, which `--write` also keeps as OFF files for other programs,
//! and Delaunay tetrahedra of random points, which are all that `--points` is for. Seconds are those of the
//! processor, of the median run.

mod clock;
mod files;

use std::fmt::Write as _;
use std::io::Write;

use clock::secs;
use files::read;
use solid::boolean::Options;
use solid::mesh::weld;
use solid::synthetic::{Kind, views};
use solid::tetrahedra::delaunay;
use solid::{Point3, Polyhedron, check, tetrahedralize, unite};

/// How often each mesh is filled; told is the median.
const RUNS: usize = 3;

fn say(line: &str) {
    writeln!(std::io::stdout(), "{line}").expect("stdout takes text");
}

fn write(path: &str, mesh: &Polyhedron) {
    let mut text = format!("OFF\n{} {} 0\n", mesh.vertices().len(), mesh.faces().len());
    for p in mesh.vertices() {
        writeln!(text, "{:?} {:?} {:?}", p.x, p.y, p.z).expect("memory takes text");
    }
    for [a, b, c] in mesh.faces() {
        writeln!(text, "3 {a} {b} {c}").expect("memory takes text");
    }
    std::fs::write(path, text).expect("a folder to write to");
}

fn measure(name: &str, mesh: &Polyhedron) {
    let (validity, checked) = secs(|| check(mesh));
    let mut runs: Vec<_> = (0..RUNS).map(|_| secs(|| tetrahedralize(mesh))).collect();
    runs.sort_by(|a, b| a.1.total_cmp(&b.1));
    let (found, took) = runs.swap_remove(RUNS / 2);
    let vertices = mesh.vertices().len();
    let head =
        format!("{name:16} {vertices:7} {:7} {:>5}", mesh.faces().len(), validity.is_valid());
    match found {
        Ok(found) => say(&format!(
            "{head} {:8} {:8.2} {:7} {:8.1} {checked:8.3} {took:8.3} {:8.4}",
            found.tetrahedra.len(),
            found.tetrahedra.len() as f64 / vertices as f64,
            found.steiner_points,
            vertices as f64 / found.steiner_points as f64,
            took * 1e3 / vertices as f64,
        )),
        Err(error) => {
            let told: String = error.to_string().chars().take(200).collect();
            say(&format!("{head} {took:8.3} s: {told}"));
        }
    }
}

fn points(count: usize) {
    let mut state = 0x9e37_79b9_7f4a_7c15u64;
    let mut unit = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    let points: Vec<Point3> = (0..count).map(|_| Point3::new(unit(), unit(), unit())).collect();
    let (found, took) = secs(|| delaunay(&points));
    let cells = found.map_or(0, |found| found.tetrahedra.len());
    say(&format!(
        "{count:8} random points: {cells} tetrahedra, {:.0} points per s",
        count as f64 / took
    ));
}

fn random_points() {
    for count in [100_000, 1_000_000] {
        points(count);
    }
}

fn main() {
    let mut words: Vec<String> =
        std::env::args().skip(1).filter(|word| word != "--bench").collect();
    let mut folder = None;
    if words.iter().any(|word| word == "--points") {
        return random_points();
    }
    if let Some(at) = words.iter().position(|word| word == "--write") {
        folder = words.drain(at..at + 2).nth(1);
    }
    say(&format!(
        "{:16} {:>7} {:>7} {:>5} {:>8} {:>8} {:>7} {:>8} {:>8} {:>8} {:>8}",
        "mesh",
        "vertices",
        "faces",
        "valid",
        "tets",
        "per v.",
        "added",
        "v. per",
        "check s",
        "s",
        "ms/v."
    ));
    for path in &words {
        let name = path.rsplit('/').next().unwrap_or(path);
        measure(name.trim_end_matches(".off"), &read(path));
    }
    if !words.is_empty() {
        return;
    }
    for kind in Kind::ALL {
        for count in [1, 2, 5, 10, 20, 50] {
            let map = unite(&views(kind, count), &Options::default()).expect("sound views");
            let map = weld(&map).mesh;
            let name = format!("{kind:?}{count}");
            if let Some(folder) = &folder {
                write(&format!("{folder}/{name}.off"), &map);
            }
            measure(&name, &map);
        }
    }
    random_points();
}
