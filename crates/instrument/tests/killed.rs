//! A run that is killed leaves a recording that opens up to what was sent last.

mod support;

use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use instrument::{Level, Recording, inspect};

const PATH: &str = "INSTRUMENT_TEST_KILLED_RECORDING";

/// The victim: records without end, until it is killed. Does nothing in an ordinary test run.
#[test]
fn endless() {
    let Some(path) = std::env::var_os(PATH) else { return };
    let world = worlds::paper::maze();
    let options = support::options(path.as_ref(), Level::Full, &["relative"], &world);
    let recording = Recording::create(options).expect("a new file");
    let world = std::sync::Arc::new(world);
    loop {
        let mut recorder = recording.recorder("relative");
        support::explore(&mut recorder, "relative", &world, 100);
    }
}

#[test]
fn a_killed_run_leaves_a_readable_recording() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.rrd");
    let mut victim = Command::new(std::env::current_exe().expect("this test"))
        .args(["--exact", "endless"])
        .env(PATH, &path)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("a child");
    let deadline = Instant::now() + Duration::from_secs(9);
    while path.metadata().map_or(0, |file| file.len()) < 2_000_000 && Instant::now() < deadline {
        std::thread::sleep(Duration::from_millis(20));
    }
    victim.kill().expect("SIGKILL");
    victim.wait().expect("a dead child");

    let found = inspect(&path).expect("readable");
    assert!(
        found.damage.as_deref().is_some_and(|d| d.contains("not closed")),
        "{:?}",
        found.damage
    );
    assert!(found.has_layout);
    assert_eq!(found.metrics, None);
    let steps = found.timelines.iter().find(|timeline| timeline.name == "step").expect("steps");
    assert!(steps.last > 10, "{steps:?}");
    let edges = found.entities.iter().find(|e| e.path == "/relative/belief/edges/frontier");
    assert!(edges.is_some_and(|edges| edges.rows > 10));
    assert!(found.events.iter().any(|event| event.variant == "PairCompared"));
}

#[test]
fn what_is_cut_off_is_told_and_the_rest_is_read() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.rrd");
    support::record(&path, Level::Summary, &["relative"], worlds::paper::open(), 80);
    let whole = inspect(&path).expect("readable");
    assert_eq!(whole.damage, None);
    let rows = |found: &instrument::Inspection| found.entities.iter().map(|e| e.rows).sum::<u64>();

    let bytes = std::fs::read(&path).expect("the file");
    let cut = folder.path().join("cut.rrd");
    let mut last = 0;
    for share in [0.2, 0.5, 0.8, 0.95] {
        let keep = (bytes.len() as f64 * share) as usize;
        std::fs::write(&cut, &bytes[..keep]).expect("a file");
        let found = inspect(&cut).expect("readable up to the cut");
        assert!(found.damage.is_some(), "cut at {share}");
        assert!((last..=rows(&whole)).contains(&rows(&found)), "cut at {share}");
        last = rows(&found);
    }
    assert!(last > 0);

    let mut spoilt = bytes.clone();
    let middle = spoilt.len() / 2;
    spoilt[middle..middle + 64].fill(0xA5);
    std::fs::write(&cut, &spoilt).expect("a file");
    let found = inspect(&cut).expect("readable up to the damage");
    assert!(found.damage.is_some());

    std::fs::write(&cut, b"this is no recording").expect("a file");
    assert!(matches!(inspect(&cut), Err(instrument::InstrumentError::NotARecording { .. })));
    std::fs::write(&cut, b"").expect("a file");
    assert!(matches!(inspect(&cut), Err(instrument::InstrumentError::NotARecording { .. })));
    let nowhere = folder.path().join("nowhere.rrd");
    assert!(matches!(inspect(&nowhere), Err(instrument::InstrumentError::Open { .. })));
}

#[test]
fn a_file_that_cannot_be_written_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("no such folder").join("run.rrd");
    let world = worlds::paper::open();
    let refused = Recording::create(support::options(&path, Level::Full, &["relative"], &world));
    assert!(matches!(refused, Err(instrument::InstrumentError::Write { .. })));
    let nothing = Recording::create(support::options(&path, Level::Off, &["relative"], &world));
    let recording = nothing.expect("level off writes nothing");
    let mut recorder = recording.recorder("relative");
    support::explore(&mut recorder, "relative", &std::sync::Arc::new(world), 5);
    recording.finish(&serde_json::json!({})).expect("nothing to write");
}
