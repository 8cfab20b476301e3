//! Damaged text logs and folders: no panic, no hang, and errors that name a place.
#![expect(clippy::print_stderr, reason = "what was skipped is told")]

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use flate2::Compression;
use flate2::write::GzEncoder;
use formats::depth_folder::{self, Listing};
use formats::laser::{self, relations};
use formats::{FormatError, gzip, tum};

/// How much of a file that others wrote is taken: damage is tried ten thousand times.
const TAKEN: usize = 1 << 15;

fn packed(text: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(text).expect("memory");
    encoder.finish().expect("memory")
}

fn carmen() -> String {
    let mut text = String::from("PARAM robot_frontlaser_offset 0.3\n");
    for at in 0..12 {
        let x = f64::from(at) * 0.31;
        writeln!(text, "ODOM {x} 0.5 {x} 0 0 0 {x} host {x}").expect("memory");
        let ranges: String = (0..24).map(|ray| format!("{} ", f64::from(ray) * 0.37)).collect();
        writeln!(text, "FLASER 24 {ranges}{x} 1 2 {x} 0.5 {x} {x} host {x}").expect("memory");
        writeln!(
            text,
            "ROBOTLASER1 0 -1.5 3 0.125 50 0.1 0 24 {ranges}1 7 {x} 5 6 4 5 6 0 0 0 0 0 {x} h 1"
        )
        .expect("memory");
    }
    text
}

fn json_map() -> String {
    let scans: Vec<String> = (0..12)
        .map(|at| {
            let ranges: Vec<String> = (0..20).map(|ray| format!("{}.25", ray + at)).collect();
            let ranges = ranges.join(", ");
            format!(
                "\"{at}.5\": {{\"range\": [{ranges}], \"x\": {at}, \"y\": -1e-1, \"theta\": 0.1}}"
            )
        })
        .collect();
    format!("{{\"about\": [null, true], \"map\": {{{}}}}}", scans.join(",\n"))
}

fn lines(count: usize, line: impl Fn(usize) -> String) -> String {
    (0..count).map(|at| line(at) + "\n").collect()
}

/// Reads as every reader of text does; the names of those that took it.
fn outcome(bytes: &[u8]) -> Vec<&'static str> {
    let mut taken = Vec::new();
    let mut note = |name, error: Option<FormatError>| match error {
        None => taken.push(name),
        Some(error) => assert!(!error.to_string().is_empty()),
    };
    note("laser", laser::read(bytes).err());
    note("relations", relations::read(bytes).err());
    note("tum", gzip::unpack(bytes).and_then(|bytes| tum::read(&bytes)).err());
    taken
}

fn samples() -> Vec<(String, Vec<u8>)> {
    let relations = lines(60, |at| format!("{at}.5 {} 1.25 -2 0 0 0 0.{at}", at + 1));
    let poses = lines(60, |at| format!("{at}.5 1 2 {at} 0 0 0.6 0.8"));
    let mut samples = vec![
        ("carmen".to_owned(), carmen().into_bytes()),
        ("packed carmen".to_owned(), packed(carmen().as_bytes())),
        ("json map".to_owned(), json_map().into_bytes()),
        ("relations".to_owned(), relations.into_bytes()),
        ("trajectory".to_owned(), poses.into_bytes()),
    ];
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let others = std::env::var_os("DRIFTLAB_DATA").map(PathBuf::from);
    let others = others.unwrap_or_else(|| root.join("../shared/data")).join("laser");
    let Ok(entries) = std::fs::read_dir(&others) else {
        eprintln!("SKIPPED: the logs of {}", others.display());
        return samples;
    };
    let mut paths: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    paths.sort();
    for path in paths {
        let bytes = std::fs::read(&path).expect("readable");
        let mut text = gzip::unpack(&bytes).expect("whole").into_owned();
        text.truncate(TAKEN);
        let name = path.file_name().expect("a file").to_string_lossy().into_owned();
        samples.push((format!("packed {name}"), packed(&text)));
        samples.push((name, text));
    }
    samples
}

/// A number that looks like chance and is the same every time.
fn hash(seed: u64) -> u64 {
    let mixed = (seed ^ seed >> 31).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    (mixed ^ mixed >> 29).wrapping_mul(0xbf58_476d_1ce4_e5b9) >> 7
}

fn damage(truncations: usize, flips: u64) {
    for (name, mut bytes) in samples() {
        let whole = gzip::unpack(&bytes).expect("whole").into_owned();
        for time in 0..truncations {
            outcome(&bytes[..time * bytes.len() / truncations]);
        }
        for time in 0..flips {
            let draw = hash(time.wrapping_mul(7919) + bytes.len() as u64);
            let at = draw as usize % bytes.len();
            let mask = (draw >> 40) as u8 | 1;
            bytes[at] ^= mask;
            let taken = outcome(&bytes);
            // A checksum holds it all together: bits that nobody reads may change, the text may not.
            let same = || gzip::unpack(&bytes).is_ok_and(|read| read == whole);
            assert!(!name.starts_with("packed") || taken.is_empty() || same(), "{name}: byte {at}");
            bytes[at] ^= mask;
        }
    }
}

#[test]
fn damaged_text_is_survived() {
    damage(40, 100);
}

#[test]
#[ignore = "the whole counts: 1,000 truncations and 10,000 flipped bytes of each sample"]
fn all_damage_of_text_is_survived() {
    damage(1000, 10_000);
}

/// Folders of each kind: names and contents.
fn folders() -> Vec<BTreeMap<String, Vec<u8>>> {
    let matrix = "1 0 0 0.5\n0 1 0 0\n0 0 1 2\n0 0 0 1\n";
    let camera = ("camera-intrinsics.txt", "585 0 320\n0 585 240\n0 0 1\n".to_owned());
    let named = |files: Vec<(String, String)>| {
        files.into_iter().map(|(name, text)| (name, text.into_bytes())).collect()
    };
    let mut seven = vec![(camera.0.to_owned(), camera.1.clone())];
    let mut tum = Vec::new();
    let mut numbered = vec![(camera.0.to_owned(), camera.1.clone())];
    for at in 0..5 {
        seven.push((format!("frame-00000{at}.depth.png"), String::new()));
        seven.push((format!("frame-00000{at}.pose.txt"), matrix.to_owned()));
        tum.push((format!("depth/{at}.5.png"), String::new()));
        numbered.push((format!("depth_{at}.pgm"), String::new()));
    }
    tum.push(("depth.txt".to_owned(), lines(5, |at| format!("{at}.5 depth/{at}.5.png"))));
    let poses = lines(50, |at| format!("{}.5 1 2 3 0 0 0 1", at / 10));
    tum.push(("groundtruth.txt".to_owned(), poses));
    numbered.push(("pose.txt".to_owned(), lines(5, |at| format!("{at} 1 2 3 0 0 0 1"))));
    vec![named(seven), named(tum), named(numbered)]
}

fn read_folder(files: &BTreeMap<String, Vec<u8>>) -> Option<usize> {
    let read = |name: &str| files.get(name).cloned().ok_or(std::io::ErrorKind::NotFound.into());
    match depth_folder::read(&Listing { names: files.keys().cloned().collect(), read: &read }) {
        Ok(folder) => Some(folder.frames.len()),
        Err(error) => {
            assert!(!error.to_string().is_empty());
            None
        }
    }
}

fn damage_folders(truncations: usize, flips: u64) {
    for (kind, mut files) in folders().into_iter().enumerate() {
        assert_eq!(read_folder(&files), Some(5), "folder {kind}");
        let names: Vec<String> = files.keys().cloned().collect();
        for name in names.iter().filter(|name| name.ends_with(".txt")) {
            let whole = files[name].clone();
            for time in 0..truncations {
                let cut = whole[..time * whole.len() / truncations].to_vec();
                files.insert(name.clone(), cut);
                read_folder(&files);
            }
            for time in 0..flips {
                let draw = hash(time.wrapping_mul(7919) + whole.len() as u64);
                let mut flipped = whole.clone();
                let at = draw as usize % flipped.len();
                flipped[at] ^= (draw >> 40) as u8 | 1;
                files.insert(name.clone(), flipped);
                read_folder(&files);
            }
            files.insert(name.clone(), whole);
        }
    }
}

#[test]
fn damaged_folders_are_survived() {
    damage_folders(40, 200);
}

#[test]
#[ignore = "the whole counts: 1,000 truncations and 10,000 flipped bytes of each file"]
fn all_damage_of_folders_is_survived() {
    damage_folders(1000, 10_000);
}
