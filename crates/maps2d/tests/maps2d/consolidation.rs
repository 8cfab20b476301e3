//! Laws of frontier consolidation without withdrawals ([ISRR19] 4.3).

use geometry::Point2;
use geometry::planar::Interval;
use maps2d::ExplorationMap;
use maps2d::relative::{Cause, RelativeMap, RelativeParams};
use probe::VertexId;
use proptest::prelude::*;

use super::config;
use super::drive::{Done, Drive, Mix, params, stories, tell};
use super::oracle::{
    SAMPLES, SLACK_M, cause_at, distances_m, expected_at, inside, to_solid_m, walk,
};

const SEEDS: &str = "proptest-regressions/consolidation.txt";
const PLAIN: Mix = Mix { turns: 0, links: 1, withdrawals: 0 };
const TURNING: Mix = Mix { turns: 2, links: 1, withdrawals: 0 };
const ALL: Mix = Mix { turns: 2, links: 1, withdrawals: 1 };

/// Open and closed parts tile every frontier edge, and the sums that the map tells are theirs.
pub fn check_partition(map: &RelativeMap) -> Result<(), TestCaseError> {
    let (mut open_m, mut ignored_m, mut places) = (0.0, 0.0, 0);
    for (_, state) in map.volumes() {
        prop_assert_eq!(state.ledgers.len(), state.volume.frontier.len());
        let mut chained_m = 0.0;
        for (edge, ledger) in state.volume.frontier.iter().zip(&state.ledgers) {
            prop_assert_eq!(ledger.open_share() + ledger.closed_share(), 1.0);
            let mut parts: Vec<Interval> = ledger.open().collect();
            parts.extend(ledger.closed().iter().map(|closed| closed.span));
            parts.sort_by(|a, b| a.from.total_cmp(&b.from));
            prop_assert_eq!(parts[0].from, 0.0);
            prop_assert_eq!(parts[parts.len() - 1].to, 1.0);
            for pair in parts.windows(2) {
                prop_assert_eq!(pair[0].to, pair[1].from);
            }
            chained_m += ledger.open_share() * edge.length_m();
            for closed in ledger.closed() {
                if closed.reason.cause == Cause::Unreachable {
                    ignored_m += closed.span.share() * edge.length_m();
                }
            }
        }
        let counting: f64 = state.counting_chains().map(|chain| chain.length_m).sum();
        prop_assert!((counting - state.open_m).abs() < 1e-9);
        prop_assert!((state.open_m + state.sliver_m - chained_m).abs() < 1e-9);
        open_m += counting;
        ignored_m += chained_m - counting;
        places += usize::from(counting > 0.0);
    }
    let told = map.frontier();
    prop_assert_eq!(told.places, places);
    prop_assert!((told.open_m - open_m).abs() < 1e-7, "{:?} {}", told, open_m);
    prop_assert!((told.ignored_m - ignored_m).abs() < 1e-7, "{:?} {}", told, ignored_m);
    Ok(())
}

/// Every closing names a way through the graph that ends at the volume that closed it; and seen
/// along that way the part lies inside that volume, or along its walls.
pub fn check_reasons(drive: &Drive, map: &RelativeMap) -> Result<(), TestCaseError> {
    for (vertex, state) in map.volumes() {
        for (edge, ledger) in state.volume.frontier.iter().zip(&state.ledgers) {
            for closed in ledger.closed() {
                let reason = closed.reason;
                let way = walk(&drive.graph, vertex, map.book().edges(reason.path));
                prop_assert!(way.is_some(), "{:?} of {} is no way", reason, vertex);
                let (end, vertex_from_end) = way.unwrap();
                prop_assert_eq!(end, reason.by);
                let by = map.volume(reason.by).unwrap();
                for t in SAMPLES {
                    let t = closed.span.from + t * closed.span.share();
                    let there = vertex_from_end.inverse_transform(&edge.at(t));
                    match reason.cause {
                        Cause::Inside => {
                            let is_in = inside(&by.volume.inner, &there);
                            prop_assert!(
                                is_in != Some(false),
                                "{} {:?} {:?}",
                                vertex,
                                edge,
                                closed
                            );
                        }
                        Cause::Wall => {
                            let apart_m = to_solid_m(&by.volume, &there);
                            prop_assert!(apart_m < map.params().wall_closing_m + SLACK_M);
                        }
                        Cause::Unreachable => {
                            let near = by.given_up.iter().any(|(place, radius_m)| {
                                (there - place).norm() < radius_m + SLACK_M
                            });
                            prop_assert!(near);
                        }
                    }
                }
            }
        }
    }
    Ok(())
}

/// All that lies inside a volume within the scope is closed, and nothing that lies in none within
/// twice the scope: what is closed is between the two comparisons of all pairs from scratch.
pub fn check_against_all_pairs(drive: &Drive, map: &RelativeMap) -> Result<(), TestCaseError> {
    let distance_m = distances_m(&drive.graph, map.params().place_weight);
    let radius_m = map.params().consolidation_radius_m;
    let at = |limit_m: f64, vertex: VertexId, point: &Point2| {
        expected_at(map, &drive.world_from_vertex, &distance_m, limit_m, (vertex, point))
    };
    for (vertex, state) in map.volumes() {
        for (i, edge) in state.volume.frontier.iter().enumerate() {
            for t in SAMPLES {
                let point = edge.at(t);
                let near = at(radius_m - SLACK_M, vertex, &point);
                let far = at(2.0 * radius_m + SLACK_M, vertex, &point);
                let cause = cause_at(map, vertex, i, t);
                let told = || format!("{vertex} {edge:?} at {t}: {cause:?} {near:?} {far:?}");
                if let Some((is_inside, along_wall)) = near {
                    prop_assert!(cause.is_some() || !(is_inside || along_wall), "{}", told());
                }
                if let Some((is_inside, along_wall)) = far {
                    prop_assert!(cause != Some(Cause::Inside) || is_inside, "{}", told());
                    prop_assert!(cause != Some(Cause::Wall) || along_wall, "{}", told());
                }
            }
        }
    }
    Ok(())
}

/// Reasons at sample points of every frontier edge of a volume, with the geometry they belong to.
type Picture = Vec<Option<(geometry::planar::StarPolygon, Vec<Vec<Option<VertexId>>>)>>;

fn picture(map: &RelativeMap, count: usize) -> Picture {
    (0..count)
        .map(|vertex| {
            let state = map.volume(VertexId(vertex as u32))?;
            let by = state
                .ledgers
                .iter()
                .map(|ledger| SAMPLES.map(|t| ledger.reason_at(t).map(|r| r.by)).to_vec())
                .collect();
            Some((state.volume.polygon.clone(), by))
        })
        .collect()
}

proptest! {
    #![proptest_config(config(250, SEEDS))]

    #[test]
    fn labels_partition_every_edge(story in stories(ALL, 1..16), params in params()) {
        tell(&story, params, |_, map, _| check_partition(map))?;
    }

    #[test]
    fn every_reason_holds(story in stories(ALL, 1..16), params in params()) {
        tell(&story, params, |drive, map, _| check_reasons(drive, map))?;
    }

    /// What was closed stays closed, but for what a volume closed that got new rays.
    #[test]
    fn consolidation_is_monotone(story in stories(TURNING, 1..20), params in params()) {
        let mut before: Picture = Vec::new();
        tell(&story, params, |drive, map, done| {
            let now = picture(map, drive.world_from_vertex.len());
            let changed = match done {
                Done::Rescanned(vertex) => Some(vertex),
                _ => None,
            };
            for (vertex, (old, new)) in before.iter().zip(&now).enumerate() {
                let (Some((old_polygon, old_by)), Some((polygon, by))) = (old, new) else {
                    prop_assert!(old.is_none(), "volume {} is gone", vertex);
                    continue;
                };
                if old_polygon != polygon {
                    prop_assert_eq!(changed, Some(VertexId(vertex as u32)));
                    continue;
                }
                for (was, is) in old_by.iter().flatten().zip(by.iter().flatten()) {
                    if was.is_some() && *was != changed {
                        prop_assert_eq!(is, was, "a closing at v{} went", vertex);
                    }
                }
            }
            before = now;
            Ok(())
        })?;
    }
}

proptest! {
    #![proptest_config(config(32, SEEDS))]

    #[test]
    fn steps_come_to_what_all_pairs_come_to(
        story in stories(PLAIN, 1..16),
        params in params().prop_map(|params| RelativeParams { retire: false, ..params }),
    ) {
        tell(&story, params, |drive, map, _| check_against_all_pairs(drive, map))?;
    }

    #[test]
    fn turning_comes_to_what_all_pairs_come_to(
        story in stories(TURNING, 1..14),
        params in params().prop_map(|params| RelativeParams { retire: false, ..params }),
    ) {
        tell(&story, params, |drive, map, _| check_against_all_pairs(drive, map))?;
    }
}
