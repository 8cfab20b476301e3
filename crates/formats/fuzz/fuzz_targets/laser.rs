//! Any bytes as a log of a planar laser, relations, or a trajectory, packed or not: no panic.
#![no_main]

use formats::laser::{self, relations};
use formats::log::plain;
use formats::{gzip, tum};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    match laser::read(bytes) {
        Ok(log) => {
            assert!(!log.scans.is_empty() && log.span_secs() >= 0.0);
            let messages = plain::of_laser(&log, "").messages.len();
            assert_eq!(messages, 2 * log.scans.len() + log.odometry.len());
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
    if let Ok(relations) = relations::read(bytes) {
        assert!(plain::of_relations(&relations).messages.len() > relations.len());
    }
    let Ok(bytes) = gzip::unpack(bytes) else { return };
    if let Ok(trajectory) = tum::read(&bytes) {
        assert_eq!(tum::read(&tum::write(&trajectory)), Ok(trajectory));
    }
});
