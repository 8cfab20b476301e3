//! A place edge that is taken back opens exactly what relied on it.

use maps2d::relative::{Fate, FrontierPiece, RelativeMap, RelativeParams};
use probe::{EdgeId, VertexId};
use proptest::prelude::*;

use super::config;
use super::consolidation::{check_against_all_pairs, check_partition, check_reasons};
use super::drive::{Done, Drive, Mix, params, stories};
use super::oracle::SAMPLES;

const SEEDS: &str = "proptest-regressions/withdrawal.txt";
const WITHDRAWING: Mix = Mix { turns: 1, links: 3, withdrawals: 2 };

/// The volume, cause, step and path at sample points of every frontier edge.
type Reasons = Vec<Vec<Option<(VertexId, u32, Vec<EdgeId>)>>>;

fn reasons(map: &RelativeMap, count: usize) -> Vec<Reasons> {
    let at = |vertex: usize| {
        let Some(state) = map.volume(VertexId(vertex as u32)) else { return Vec::new() };
        let of_edge = state.ledgers.iter().map(|ledger| {
            let reason = |t: f64| {
                let closing = ledger.reason_at(t)?;
                Some((closing.by, closing.step, map.book().edges(closing.path).to_vec()))
            };
            SAMPLES.map(reason).to_vec()
        });
        of_edge.collect()
    };
    (0..count).map(at).collect()
}

fn mentions(map: &RelativeMap, edge: EdgeId) -> bool {
    let pieces = map.volumes().flat_map(|(vertex, _)| map.explain(vertex));
    pieces.into_iter().any(|piece: FrontierPiece| match piece.fate {
        Fate::Gone { path, .. } => path.contains(&edge),
        Fate::Left(_) => false,
    })
}

proptest! {
    #![proptest_config(config(48, SEEDS))]

    /// What did not rely on the edge keeps its reason; what did is open, or closed along another
    /// way; and nothing mentions the edge any more.
    #[test]
    fn exactly_what_relied_on_the_edge_opens(
        story in stories(WITHDRAWING, 4..24),
        params in params(),
    ) {
        let mut drive = Drive::new(&story.room, &story.sensor);
        let mut map = RelativeMap::new(params);
        for op in &story.ops {
            let before = reasons(&map, drive.world_from_vertex.len());
            let Done::Withdrew(edge) = drive.act(op, &mut [&mut map]) else { continue };
            let after = reasons(&map, drive.world_from_vertex.len());
            for (was, is) in before.iter().flatten().flatten().zip(after.iter().flatten().flatten()) {
                match was {
                    Some((_, _, path)) if path.contains(&edge) => {}
                    // What was open may be closed now: the way to a volume may lead elsewhere.
                    None => {}
                    Some(_) => prop_assert_eq!(is, was),
                }
            }
            prop_assert!(!mentions(&map, edge));
            check_partition(&map)?;
            check_reasons(&drive, &map)?;
        }
    }

    /// After a withdrawal the map is what it would be had the edge never been there.
    #[test]
    fn what_other_ways_account_for_is_closed_again(
        story in stories(WITHDRAWING, 4..20),
        params in params().prop_map(|params| RelativeParams { retire: false, ..params }),
    ) {
        let mut drive = Drive::new(&story.room, &story.sensor);
        let mut map = RelativeMap::new(params);
        for op in &story.ops {
            if let Done::Withdrew(_) = drive.act(op, &mut [&mut map]) {
                check_against_all_pairs(&drive, &map)?;
            }
        }
        check_against_all_pairs(&drive, &map)?;
    }
}
