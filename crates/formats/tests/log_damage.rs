//! Damaged logs: no panic, no hang, no more memory than was promised.
#![expect(
    clippy::print_stderr,
    clippy::print_stdout,
    reason = "what was skipped and what was found is told"
)]

use std::path::{Path, PathBuf};

use formats::log::{LogReader, ReadOptions};

/// Samples of every kind, with their names.
fn samples() -> Vec<(String, Vec<u8>)> {
    let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/samples/logs");
    let others = std::env::var_os("DRIFTLAB_DATA").map(PathBuf::from);
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let others = others.unwrap_or_else(|| root.join("../shared/data")).join("mcap");
    if !others.is_dir() {
        eprintln!("SKIPPED: the recordings of {}", others.display());
    }
    let mut samples = Vec::new();
    for folder in [own, others] {
        let Ok(entries) = std::fs::read_dir(&folder) else { continue };
        let mut paths: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
        paths.sort();
        for path in paths {
            if path.extension().is_some_and(|extension| extension == "mcap" || extension == "bag") {
                let name = path.file_name().expect("a file").to_string_lossy().into_owned();
                samples.push((name, std::fs::read(&path).expect("readable")));
            }
        }
    }
    assert!(samples.len() >= 8, "the samples of the repository are always there");
    samples
}

/// What comes of a file: messages, and the place of its damage.
fn outcome(bytes: &[u8]) -> Option<(usize, Option<u64>)> {
    let mut reader = LogReader::new(bytes, &ReadOptions::default()).ok()?;
    let messages = reader.by_ref().count();
    let damage = reader.damage().map(|damage| damage.at);
    assert!(damage.is_none_or(|at| at <= bytes.len() as u64));
    Some((messages, damage))
}

/// A number that looks like chance and is the same every time.
fn hash(seed: u64) -> u64 {
    let mixed = (seed ^ seed >> 31).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    (mixed ^ mixed >> 29).wrapping_mul(0xbf58_476d_1ce4_e5b9) >> 7
}

fn truncate(times: u64) {
    for (name, bytes) in samples() {
        let whole = outcome(&bytes).map_or(0, |(messages, _)| messages);
        for time in 0..times {
            let length = (time as usize * bytes.len()) / times as usize;
            let Some((messages, damage)) = outcome(&bytes[..length]) else { continue };
            assert!(messages <= whole, "{name}: more messages in less of the file");
            // A bag may end behind any record.
            assert!(
                damage.is_some() || name.ends_with(".bag"),
                "{name}: {length} of {}",
                bytes.len()
            );
        }
    }
}

fn flip(times: u64) {
    for (name, mut bytes) in samples() {
        let mut damaged = 0;
        for time in 0..times {
            let draw = hash(time.wrapping_mul(7919) + bytes.len() as u64);
            let at = draw as usize % bytes.len();
            let mask = (draw >> 40) as u8 | 1;
            bytes[at] ^= mask;
            damaged += u64::from(outcome(&bytes).is_none_or(|(_, damage)| damage.is_some()));
            bytes[at] ^= mask;
        }
        println!("{name}: {damaged} of {times} flipped bytes end the reading");
    }
}

#[test]
fn truncated_files_are_read_up_to_the_damage() {
    truncate(60);
}

#[test]
fn flipped_bytes_are_survived() {
    flip(200);
}

#[test]
#[ignore = "the whole counts: 1,000 truncations and 10,000 flipped bytes of each sample"]
fn all_damage_is_survived() {
    truncate(1000);
    flip(10_000);
    // Linux tells the most memory that was ever used at once; other systems do not, here.
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kib = peak.and_then(|peak| peak.trim().trim_end_matches(" kB").parse::<u64>().ok());
    println!("most memory: {} MiB", kib.unwrap_or(0) / 1024);
    // All samples are in memory; what they declare is less than a MiB each, and lies are not filled.
    assert!(kib.unwrap_or(0) < 64 * 1024);
}

/// A place in the file, and the lie that is put there: sizes that no file here holds.
#[test]
fn declared_sizes_are_checked_before_memory_is_asked_for() {
    for (name, bytes) in samples() {
        for at in (0..bytes.len().min(4000).saturating_sub(8)).step_by(11) {
            let mut lie = bytes.clone();
            lie[at..at + 8].copy_from_slice(&(0x2000_0000_u64 - 1).to_le_bytes());
            let _ = outcome(&lie).map(|(messages, _)| assert!(messages < 1000, "{name}"));
        }
    }
}
