//! The real logs, where they are at hand: counts, damage.

use std::path::PathBuf;

use formats::laser::{self, relations};

#[expect(clippy::print_stderr, reason = "a skipped test says so")]
fn data() -> Option<PathBuf> {
    let named = std::env::var_os("DRIFTLAB_DATA").map(PathBuf::from);
    let beside = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
    let dir = named.unwrap_or(beside).join("laser");
    if !dir.is_dir() {
        eprintln!("SKIPPED: no laser logs at {}; set DRIFTLAB_DATA", dir.display());
        return None;
    }
    Some(dir)
}

#[test]
fn every_log_is_read_whole() {
    let Some(dir) = data() else { return };
    for (name, scans, odometry, rays) in [
        ("intel_gfs.json.gz", 910, 0, 180),
        ("intel_corrected.json.gz", 910, 0, 180),
        ("intel-corrected.log.gz", 910, 14541, 180),
        ("freiburg-079-corrected.log.gz", 4791, 9725, 360),
        ("aces-corrected.log.gz", 440, 7814, 180),
        ("orebro-corrected.log.gz", 237, 255, 181),
        ("flirt_intel-lab.log.gz", 2672, 0, 180),
    ] {
        let bytes = std::fs::read(dir.join(name)).expect(name);
        let log = laser::read(&bytes).expect(name);
        assert_eq!((log.scans.len(), log.odometry.len()), (scans, odometry), "{name}");
        assert!(log.scans.iter().all(|scan| scan.scan.len() == rays), "{name}");
        assert!(log.warnings.is_empty(), "{name}: {:?}", log.warnings);
    }
    for (name, count) in [("intel.relations", 2984), ("fr079.relations", 1685)] {
        let bytes = std::fs::read(dir.join(name)).expect(name);
        assert_eq!(relations::read(&bytes).expect(name).len(), count);
    }
}

#[test]
fn cut_and_flipped_logs_are_refused_or_read_but_never_panic() {
    let mut samples = vec![
        b"PARAM robot_frontlaser_offset 0.5 host 0\nODOM 1 2 0.5 0 0 0 7 host 7\n\
          FLASER 4 1 2 81.83 4 9 9 9 1 2 0 8.25 host 8\n\
          ROBOTLASER1 0 -1.5 3 0.5 50 0.1 0 3 1 2 3 1 0.5 4 5 6 4 5 6 0 0 0 0 0 9 x 1\n"
            .to_vec(),
        br#"{"map": {"20.5": {"theta": 0.5, "x": 1, "y": -2e0, "range": [1, 81.83]}}}"#.to_vec(),
        b"10.5 11 1 -2 0 0 0 0.5\n11 12 1 -2 0 0 0 0.5\n".to_vec(),
    ];
    if let Some(dir) = data() {
        // Packed text: the flips meet the unpacking.
        let bytes = std::fs::read(dir.join("orebro-corrected.log.gz")).expect("orebro");
        samples.push(bytes[..2000].to_vec());
    }
    let mut seed = 9_u64;
    let mut draw = move |below: usize| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) as usize % below
    };
    for sample in samples {
        for cut in 0..1000 {
            let length = if cut < sample.len() { cut } else { draw(sample.len()) };
            let _ = (laser::read(&sample[..length]), relations::read(&sample[..length]));
        }
        for _ in 0..10_000 {
            let mut bytes = sample.clone();
            let at = draw(bytes.len());
            bytes[at] ^= 1 << draw(8);
            let _ = (laser::read(&bytes), relations::read(&bytes));
        }
    }
}
