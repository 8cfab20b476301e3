//! What a policy asks of the relative map.

use geometry::Point2;
use maps2d::relative::{Cause, RelativeMap, RelativeParams};
use maps2d::{Clearance, ExplorationMap, Route, Standing};
use pose::Se2;
use probe::{Off, VertexId};
use proptest::prelude::*;

use super::config;
use super::consolidation::check_partition;
use super::drive::{Done, Drive, Mix, params, stories};
use super::oracle::distances_m;
use super::room::{Room, Sensor};

const SEEDS: &str = "proptest-regressions/asked.txt";
const MIX: Mix = Mix { turns: 1, links: 1, withdrawals: 1 };

proptest! {
    #![proptest_config(config(150, SEEDS))]

    /// The way leads over links to a vertex with frontier that counts; the nearest, where nothing
    /// was retired.
    #[test]
    fn the_way_leads_to_frontier_that_counts(story in stories(MIX, 1..16), params in params()) {
        let mut drive = Drive::new(&story.room, &story.sensor);
        let mut map = RelativeMap::new(params);
        for op in &story.ops {
            if drive.act(op, &mut [&mut map]) == Done::Nothing {
                continue;
            }
            let here = drive.standing.vertex;
            let distance_m = distances_m(&drive.graph, 1.0);
            let away_m = |vertex: VertexId| distance_m[here.0 as usize][vertex.0 as usize];
            let counting = map.volumes().filter(|(_, state)| state.counts());
            let nearest_m = counting.map(|(vertex, _)| away_m(vertex)).reduce(f64::min);
            match map.route(&drive.standing, 0.3) {
                Some(Route::Repeat(legs)) => {
                    let end = legs.last().map_or(here, |leg| leg.0);
                    prop_assert!(map.frontier_at(end) > 0.0);
                    let length_m: f64 = legs.iter().map(|leg| leg.1).sum();
                    prop_assert!(length_m > nearest_m.unwrap() - 1e-9);
                    if map.skeleton().is_whole() {
                        prop_assert!(length_m < nearest_m.unwrap() + 1e-9);
                    }
                    let mut at = here;
                    for (to, length_m) in legs {
                        let links = map.skeleton().links(at).iter();
                        let shortest = links.filter(|link| link.to == to).map(|link| link.driven_m);
                        prop_assert_eq!(shortest.reduce(f64::min), Some(length_m));
                        at = to;
                    }
                }
                Some(other) => prop_assert!(false, "{:?}", other),
                None => prop_assert_eq!(nearest_m, None),
            }
        }
    }

    /// Candidates in view are the frontier of the volume that the robot stands on: goals lie on
    /// open frontier, normals are unit vectors, lengths add up to no more than what counts.
    #[test]
    fn candidates_lie_on_open_frontier(story in stories(MIX, 1..12), params in params()) {
        let mut drive = Drive::new(&story.room, &story.sensor);
        let mut map = RelativeMap::new(params);
        for op in &story.ops {
            if drive.act(op, &mut [&mut map]) == Done::Nothing {
                continue;
            }
            let mut seen = Vec::new();
            map.in_view(&drive.standing, &mut seen);
            let state = map.volume(drive.standing.vertex).unwrap();
            for candidate in &seen {
                for goal in &candidate.goals_in_body {
                    let goal = drive.standing.vertex_from_body.transform(goal);
                    let on_open = state.chains.iter().flat_map(|chain| &chain.parts).any(|part| {
                        let edge = &state.volume.frontier[part.edge];
                        let (a, b) = (edge.at(part.span.from), edge.at(part.span.to));
                        geometry::planar::point_segment_distance(&goal, &a, &b) < 1e-9
                    });
                    prop_assert!(on_open, "{:?} is not on frontier", goal);
                }
                let normal_m = candidate.normal_in_body.norm();
                prop_assert!((normal_m - 1.0).abs() < 1e-9 || candidate.length_m < 1e-9);
            }
            let sum_m: f64 = seen.iter().map(|candidate| candidate.length_m).sum();
            prop_assert!(sum_m <= state.open_m + 1e-9);
            let mut tags: Vec<u64> = seen.iter().map(|candidate| candidate.tag).collect();
            tags.sort_unstable();
            tags.dedup();
            prop_assert_eq!(tags.len(), seen.len(), "tags name candidates");
            if state.counts() && state.open_m > 2.0 * map.params().sliver_m {
                prop_assert!(!seen.is_empty());
            }
        }
    }
}

/// A hall, and a robot that looks ahead from one place and from another 2 m on.
fn hall() -> (Drive, RelativeMap) {
    let room = Room { width_m: 30.0, height_m: 30.0, pillars: Vec::new() };
    let sensor = Sensor { fov_rad: 2.0, rays: 9, range_m: 5.0 };
    let mut drive = Drive::new(&room, &sensor);
    let mut map = RelativeMap::new(RelativeParams::default());
    drive.go(&Se2::new(10.0, 15.0, 0.0), &[], &mut [&mut map], &mut Off);
    (drive, map)
}

fn unreachable_in(map: &RelativeMap, vertex: VertexId) -> f64 {
    let state = map.volume(vertex).unwrap();
    let edges = state.volume.frontier.iter().zip(&state.ledgers);
    edges
        .flat_map(|(edge, ledger)| ledger.closed().iter().map(move |closed| (edge, closed)))
        .filter(|(_, closed)| closed.reason.cause == Cause::Unreachable)
        .map(|(edge, closed)| closed.span.share() * edge.length_m())
        .sum()
}

#[test]
fn what_is_given_up_everywhere_is_so_for_later_volumes() {
    let (mut drive, mut map) = hall();
    let before = map.frontier();
    // 5 m ahead is the middle of the horizon.
    map.give_up(&drive.standing, &Point2::new(5.0, 0.0), 1.5, true, &mut Off);
    let after = map.frontier();
    let gone_m = unreachable_in(&map, VertexId(0));
    assert!((2.9..3.1).contains(&gone_m), "{gone_m} m within 1.5 m");
    assert!((before.open_m - gone_m - after.open_m).abs() < 1e-9);
    assert!((after.ignored_m - before.ignored_m - gone_m).abs() < 1e-9);
    check_partition(&map).unwrap();
    // Another volume that sees the same place.
    drive.go(&Se2::new(10.0, 15.5, 0.0), &[], &mut [&mut map], &mut Off);
    assert!(unreachable_in(&map, VertexId(1)) > 0.1);
    let state = map.volume(VertexId(1)).unwrap();
    let place = Point2::new(5.0, -0.5);
    for part in state.chains.iter().flat_map(|chain| &chain.parts) {
        let edge = &state.volume.frontier[part.edge];
        for t in [part.span.from, part.span.middle(), part.span.to] {
            assert!((edge.at(t) - place).norm() > 1.5 - 1e-9, "{part:?} is within 1.5 m");
        }
    }
    check_partition(&map).unwrap();
}

#[test]
fn what_is_given_up_here_stays_for_others() {
    let (mut drive, mut map) = hall();
    map.give_up(&drive.standing, &Point2::new(5.0, 0.0), 1.5, false, &mut Off);
    assert!(unreachable_in(&map, VertexId(0)) > 2.9);
    drive.go(&Se2::new(10.0, 15.5, 0.0), &[], &mut [&mut map], &mut Off);
    assert_eq!(unreachable_in(&map, VertexId(1)), 0.0);
}

#[test]
fn a_map_of_nothing_has_no_answers() {
    let mut map = RelativeMap::new(RelativeParams::default());
    let standing = Standing { vertex: VertexId(3), vertex_from_body: Se2::identity() };
    let mut out = Vec::new();
    map.in_view(&standing, &mut out);
    map.around(&standing, &mut out);
    assert!(out.is_empty());
    let goal = Point2::new(1.0, 0.0);
    assert_eq!(map.clearance(&standing, &goal), Clearance::NONE);
    assert_eq!(map.route(&standing, 0.3), None);
    map.give_up(&standing, &goal, 1.0, true, &mut Off);
    assert_eq!(map.frontier_at(VertexId(3)), 0.0);
    assert_eq!((map.frontier().places, map.frontier().open_m), (0, 0.0));
}

#[test]
fn clearance_is_that_of_the_volume_stood_on() {
    let room = Room { width_m: 8.0, height_m: 6.0, pillars: Vec::new() };
    let sensor = Sensor { fov_rad: std::f64::consts::TAU, rays: 360, range_m: 9.0 };
    let mut drive = Drive::new(&room, &sensor);
    let mut map = RelativeMap::new(RelativeParams::default());
    drive.go(&Se2::new(2.0, 3.0, 0.0), &[], &mut [&mut map], &mut Off);
    // From 2 m to 1 m before the wall at x = 8; the walls at the sides are 3 m away.
    let along = map.clearance(&drive.standing, &Point2::new(5.0, 0.0));
    assert!((along.at_start_m - 2.0).abs() < 0.01 && (along.along_m - 1.0).abs() < 0.01);
    assert!((along.at_end_m - 1.0).abs() < 0.01);
    assert!(along.keeps(0.9) && !along.keeps(1.1));
    let through = map.clearance(&drive.standing, &Point2::new(7.0, 0.0));
    assert_eq!(through, Clearance::NONE, "out of what is known");
    // Nearer to the wall than asked for, but going away from it.
    let away = Clearance { at_start_m: 0.2, along_m: 0.2, after_m: 0.3, at_end_m: 1.0 };
    assert!(away.keeps(0.5));
    let along_it = Clearance { at_start_m: 0.2, along_m: 0.2, after_m: 0.2, at_end_m: 0.2 };
    assert!(!along_it.keeps(0.5));
}

#[test]
fn a_body_that_touches_something_does_not_move_into_it() {
    let touching = Clearance { at_start_m: 0.451, along_m: 0.447, after_m: 0.6, at_end_m: 0.8 };
    assert!(touching.keeps(0.5), "the middle of a point may");
    assert!(!touching.around_body(0.45).keeps(0.05));
    let leaving = Clearance { along_m: 0.451, ..touching };
    assert!(leaving.around_body(0.45).keeps(0.05));
    // Seen a little nearer than it can be: it may still leave.
    let pushed = Clearance { at_start_m: 0.449, along_m: 0.449, ..touching };
    assert!(pushed.around_body(0.45).keeps(0.05));
}
