//! A ledger tiles its edge, whatever is closed and opened.
#![no_main]

use geometry::planar::{EdgeLedger, Interval};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|acts: Vec<(f64, f64, u8, bool)>| {
    let mut ledger = EdgeLedger::new();
    let mut changed = Vec::new();
    for (from, to, reason, close) in acts {
        changed.clear();
        let closed_before = ledger.closed_share();
        if close {
            ledger.close(Interval::new(from, to), &reason, &mut changed);
        } else {
            ledger.reopen(|r| *r == reason, &mut changed);
        }
        let moved: f64 = changed.iter().map(Interval::share).sum();
        let sign = if close { 1.0 } else { -1.0 };
        assert_eq!(closed_before + sign * moved, ledger.closed_share());
        assert_eq!(ledger.open_share() + ledger.closed_share(), 1.0);
        let mut all: Vec<Interval> = ledger.open().collect();
        all.extend(ledger.closed().iter().map(|c| c.span));
        all.sort_by(|a, b| a.from.total_cmp(&b.from));
        assert!(all[0].from == 0.0 && all[all.len() - 1].to == 1.0);
        assert!(all.windows(2).all(|w| w[0].to == w[1].from));
    }
});
