//! What is recorded depends on the run alone, and the run does not depend on what is recorded.

mod support;

use std::sync::Arc;

use instrument::{Level, Recording, diff, fingerprint};

#[test]
fn two_runs_give_recordings_without_a_difference() {
    let folder = tempfile::tempdir().expect("a folder");
    let [a, b, c] = ["a", "b", "c"].map(|name| folder.path().join(format!("{name}.rrd")));
    support::record(&a, Level::Full, &["relative", "grid"], worlds::paper::open(), 60);
    support::record(&b, Level::Full, &["relative", "grid"], worlds::paper::open(), 60);
    support::record(&c, Level::Full, &["relative", "grid"], worlds::paper::open(), 61);
    assert_eq!(diff(&a, &b).expect("readable"), []);
    let print = |path| fingerprint(path).expect("readable");
    assert_eq!(print(&a), print(&b));
    let differences = diff(&a, &c).expect("readable");
    assert!(
        differences.iter().any(|d| d.entity == "/relative/metrics/coverage"),
        "{differences:?}"
    );
    assert_ne!(print(&a), print(&c));
}

/// Maps may run in threads of their own: the recording says the same.
#[test]
fn maps_in_threads_give_the_same_recording() {
    let folder = tempfile::tempdir().expect("a folder");
    let [one, two] = ["one", "two"].map(|name| folder.path().join(format!("{name}.rrd")));
    let maps = ["relative", "grid"];
    let world = Arc::new(worlds::paper::maze());
    for (path, threads) in [(&one, false), (&two, true)] {
        let options = support::options(path, Level::Full, &maps, &world);
        let recording = Recording::create(options).expect("a new file");
        let run = |kind: &str| {
            let mut recorder = recording.recorder(kind);
            support::explore(&mut recorder, kind, &world, 40);
        };
        if threads {
            std::thread::scope(|scope| {
                let run = &run;
                for kind in maps {
                    scope.spawn(move || run(kind));
                }
            });
        } else {
            maps.iter().for_each(|kind| run(kind));
        }
        recording.finish(&serde_json::json!({})).expect("a disk");
    }
    assert_eq!(diff(&one, &two).expect("readable"), []);
}

#[test]
fn recording_changes_nothing_about_the_run() {
    let folder = tempfile::tempdir().expect("a folder");
    let world = Arc::new(worlds::paper::forest_house());
    let outcome = |level: Level| {
        let path = folder.path().join(format!("{level:?}.rrd"));
        let options = support::options(&path, level, &["relative"], &world);
        let recording = Recording::create(options).expect("a new file");
        let mut recorder = recording.recorder("relative");
        let (report, witness, _) = support::explore(&mut recorder, "relative", &world, 90);
        let seen: Vec<u64> = (0..witness.coverage().size().0 * witness.coverage().size().1)
            .filter_map(|index| witness.coverage().first_seen_m(index))
            .map(f64::to_bits)
            .collect();
        let wrote = path.exists();
        (wrote, (report, witness.tally().clone(), seen))
    };
    let (off, summary, full) = (outcome(Level::Off), outcome(Level::Summary), outcome(Level::Full));
    assert_eq!((off.0, summary.0, full.0), (false, true, true));
    assert_eq!(off.1, summary.1);
    assert_eq!(off.1, full.1);
}
