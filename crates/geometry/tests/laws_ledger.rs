//! A ledger partitions its edge, only ever closes what was open, and opens exactly what it is told.

mod common;

use common::config;
use geometry::planar::{EdgeLedger, Interval};
use proptest::prelude::*;

const SEEDS: &str = "proptest-regressions/laws_ledger.txt";
const CELLS: i32 = 48;

#[derive(Clone, Debug)]
enum Act {
    Close { from: f64, to: f64, reason: u8 },
    Reopen { reasons: u8 },
}

/// Spans whose ends the given strategy draws, also inverted, empty and beyond the edge.
fn acts(ends: impl Strategy<Value = f64> + Clone) -> impl Strategy<Value = Vec<Act>> {
    let close = (ends.clone(), ends, 0..8_u8).prop_map(|(from, to, reason)| Act::Close {
        from,
        to,
        reason,
    });
    let reopen = any::<u8>().prop_map(|reasons| Act::Reopen { reasons });
    prop::collection::vec(prop_oneof![5 => close, 1 => reopen], 1..30)
}

fn any_end() -> impl Strategy<Value = f64> + Clone {
    prop_oneof![
        8 => -0.2..1.2_f64,
        1 => prop::sample::select(vec![0.0, 1.0, 0.5, 1e-300, 1.0 - f64::EPSILON, f64::NAN]),
        1 => prop::sample::select(vec![0.1, 0.2, 0.30000000000000004, 0.7, f64::INFINITY]),
    ]
}

fn apply(ledger: &mut EdgeLedger<u8>, act: &Act) -> Vec<Interval> {
    let mut changed = Vec::new();
    match act {
        Act::Close { from, to, reason } => {
            ledger.close(Interval::new(*from, *to), reason, &mut changed);
        }
        Act::Reopen { reasons } => ledger.reopen(|r| reasons >> r & 1 == 1, &mut changed),
    }
    changed
}

fn share(stretches: &[Interval]) -> f64 {
    stretches.iter().map(Interval::share).sum()
}

proptest! {
    #![proptest_config(config(2_000, SEEDS))]

    /// Against a plain array of cells, for ends on their borders.
    #[test]
    fn a_ledger_is_an_array_of_cells(acts in acts((-4..=CELLS + 4).prop_map(|k| f64::from(k) / f64::from(CELLS)))) {
        let mut ledger = EdgeLedger::new();
        let mut cells: Vec<Option<u8>> = vec![None; CELLS as usize];
        let centre = |k: usize| (k as f64 + 0.5) / f64::from(CELLS);
        for act in acts {
            let before = cells.clone();
            for (k, cell) in cells.iter_mut().enumerate() {
                match act {
                    Act::Close { from, to, reason } if from < centre(k) && centre(k) < to => {
                        *cell = cell.or(Some(reason));
                    }
                    Act::Reopen { reasons } => *cell = cell.filter(|r| reasons >> r & 1 == 0),
                    Act::Close { .. } => {}
                }
            }
            let changed = apply(&mut ledger, &act);
            for k in 0..cells.len() {
                prop_assert_eq!(ledger.reason_at(centre(k)).copied(), cells[k]);
                let reported = changed.iter().any(|s| s.from < centre(k) && centre(k) < s.to);
                prop_assert_eq!(reported, before[k].is_some() != cells[k].is_some());
                let open = ledger.open().any(|s| s.from < centre(k) && centre(k) < s.to);
                prop_assert_eq!(open, cells[k].is_none());
            }
            prop_assert_eq!(ledger.is_closed(), cells.iter().all(Option::is_some));
            prop_assert_eq!(ledger.is_open(), cells.iter().all(Option::is_none));
        }
    }

    /// Open and closed stretches tile the edge, and their lengths add up to 1 exactly.
    #[test]
    fn labels_partition_the_edge(acts in acts(any_end())) {
        let mut ledger = EdgeLedger::new();
        for act in acts {
            let before = ledger.clone();
            let changed = apply(&mut ledger, &act);
            let mut all: Vec<Interval> = ledger.open().collect();
            all.extend(ledger.closed().iter().map(|c| c.span));
            all.sort_by(|a, b| a.from.total_cmp(&b.from));
            prop_assert_eq!(all[0].from, 0.0);
            prop_assert_eq!(all[all.len() - 1].to, 1.0);
            prop_assert!(all.windows(2).all(|w| w[0].to == w[1].from));
            prop_assert!(all.iter().all(|s| s.from < s.to));
            prop_assert_eq!(ledger.open_share() + ledger.closed_share(), 1.0);
            prop_assert_eq!(share(&all), 1.0);
            match act {
                Act::Close { .. } => {
                    prop_assert_eq!(before.closed_share() + share(&changed), ledger.closed_share());
                    for kept in before.closed() {
                        prop_assert!(ledger.closed().contains(kept), "a first reason was lost");
                    }
                }
                Act::Reopen { reasons } => {
                    prop_assert_eq!(before.open_share() + share(&changed), ledger.open_share());
                    for kept in ledger.closed() {
                        prop_assert!(before.closed().contains(kept));
                        prop_assert!(reasons >> kept.reason & 1 == 0);
                    }
                    for gone in before.closed().iter().filter(|c| reasons >> c.reason & 1 == 1) {
                        prop_assert!(changed.contains(&gone.span));
                    }
                }
            }
        }
    }
}
