//! The extended polygon: who belongs to it, and what becomes free.

use geometry::Point2;
use maps2d::extended::{CornerState, ExtendedMap, ExtendedParams};
use maps2d::{Candidate, ExplorationMap, Route};
use probe::{Off, VertexId};
use proptest::prelude::*;

use super::config;
use super::drive::{Done, Drive, Mix, stories};
use super::told::Told;

const MIX: Mix = Mix { turns: 2, links: 1, withdrawals: 1 };

proptest! {
    #![proptest_config(config(48, "proptest-regressions/extended.txt"))]

    /// Without noise: what is free lies in what another vertex saw; what is open lies in no member;
    /// and free stays free unless an edge is withdrawn.
    #[test]
    fn free_is_what_members_saw(story in stories(MIX, 1..18)) {
        let mut map = ExtendedMap::new(ExtendedParams::default());
        let mut drive = Drive::new(&story.room, &story.sensor);
        let mut free: Vec<(VertexId, Point2)> = Vec::new();
        for op in &story.ops {
            let done = drive.act(op, &mut [&mut map]);
            if done == Done::Nothing {
                continue;
            }
            if matches!(done, Done::Withdrew(_)) {
                free.clear();
            }
            if let Done::Rescanned(vertex) = done {
                free.retain(|corner| corner.0 != vertex);
            }
            for (vertex, at) in &free {
                let corner = map.corners(*vertex).iter().find(|corner| corner.at == *at);
                prop_assert_eq!(corner.map(|corner| corner.state), Some(CornerState::Free));
            }
            free.clear();
            let region = map.extended_polygon();
            let root = map.members().next();
            for (vertex, root_from_vertex) in map.members() {
                for corner in map.corners(vertex) {
                    if corner.state == CornerState::Free {
                        free.push((vertex, corner.at));
                        continue;
                    }
                    let at = root_from_vertex.transform(&corner.at);
                    let deep = region.contains(&at)
                        && region.edges().all(|edge| {
                            geometry::planar::point_segment_distance(&at, &edge.from, &edge.to)
                                > 0.05
                        });
                    let scanned = root.is_some_and(|root| root.0 == drive.standing.vertex);
                    prop_assert!(!(deep && scanned), "{} of {} is open but inside", corner.at, vertex);
                }
            }
        }
    }

    #[test]
    fn heard_or_not(story in stories(MIX, 1..18)) {
        let mut quiet = ExtendedMap::new(ExtendedParams::default());
        let mut heard = ExtendedMap::new(ExtendedParams::default());
        let mut told: Vec<Told> = Vec::new();
        let mut one = Drive::new(&story.room, &story.sensor);
        let mut other = Drive::new(&story.room, &story.sensor);
        let (mut here, mut there): (Vec<Candidate>, Vec<Candidate>) = Default::default();
        for op in &story.ops {
            if one.act(op, &mut [&mut quiet]) == Done::Nothing {
                continue;
            }
            other.act_with(op, &mut [&mut heard], &mut told);
            quiet.in_view(&one.standing, &mut here);
            heard.in_view(&one.standing, &mut there);
            prop_assert_eq!(&here, &there);
            quiet.around(&one.standing, &mut here);
            heard.around(&one.standing, &mut there);
            prop_assert_eq!(&here, &there);
            prop_assert_eq!(quiet.route(&one.standing, 0.3), heard.route(&one.standing, 0.3));
            prop_assert_eq!(quiet.frontier(), heard.frontier());
            prop_assert_eq!(quiet.frontier().places == 0, quiet.frontier().open_m == 0.0);
        }
    }

    /// A way leads along edges of the graph to a vertex that has something open.
    #[test]
    fn ways_lead_to_open_corners(story in stories(MIX, 1..18)) {
        let mut map = ExtendedMap::new(ExtendedParams::default());
        let mut drive = Drive::new(&story.room, &story.sensor);
        for op in &story.ops {
            if drive.act(op, &mut [&mut map]) == Done::Nothing {
                continue;
            }
            match map.route(&drive.standing, 0.3) {
                None => prop_assert_eq!(map.frontier().places, 0),
                Some(Route::Drive(_)) => prop_assert!(false, "not along the graph"),
                Some(Route::Repeat(legs)) => {
                    let mut at = drive.standing.vertex;
                    for (to, length_m) in &legs {
                        let linked = drive.graph.edges_of(at).any(|(_, edge)| {
                            edge.from_end(at).0 == *to && edge.length_m == *length_m
                        });
                        prop_assert!(linked);
                        at = *to;
                    }
                    prop_assert!(map.frontier_at(at) > 0.0);
                }
            }
        }
    }
}

/// Giving everything up that is in view leaves nothing there.
#[test]
fn what_is_given_up_does_not_count() {
    let room = super::room::Room { width_m: 12.0, height_m: 9.0, pillars: Vec::new() };
    let sensor = super::room::Sensor { fov_rad: 2.0, rays: 16, range_m: 4.0 };
    let mut drive = Drive::new(&room, &sensor);
    let mut map = ExtendedMap::new(ExtendedParams::default());
    drive.go(&pose::Se2::new(6.0, 4.0, 0.0), &[], &mut [&mut map], &mut Off);
    let mut out = Vec::new();
    map.in_view(&drive.standing, &mut out);
    assert!(!out.is_empty());
    let before = map.frontier();
    for candidate in out.clone() {
        map.give_up(&drive.standing, &candidate.goals_in_body[0], 0.1, false, &mut Off);
    }
    map.in_view(&drive.standing, &mut out);
    assert!(out.is_empty());
    assert_eq!(map.frontier().places, 0);
    assert!((map.frontier().ignored_m - before.open_m).abs() < 1e-9);
    assert_eq!(map.route(&drive.standing, 0.3), None);
}
