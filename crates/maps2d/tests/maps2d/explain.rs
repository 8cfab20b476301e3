//! The answers to: why is this frontier left, and who removed that one.

use maps2d::relative::{Fate, RelativeMap, RelativeParams, WhyLeft};
use pose::Se2;
use probe::{Off, VertexId};
use proptest::prelude::*;

use super::config;
use super::drive::{Drive, Mix, params, stories};
use super::oracle::{distances_m, inside, walk};
use super::room::{Room, Sensor};

const SEEDS: &str = "proptest-regressions/explain.txt";

proptest! {
    #![proptest_config(config(250, SEEDS))]

    /// The pieces of each edge tile it in order; what they tell is what the ledgers hold, and why
    /// something is left is true by brute force.
    #[test]
    fn every_piece_is_accounted_for(
        story in stories(Mix { turns: 1, links: 1, withdrawals: 1 }, 1..16),
        params in params(),
    ) {
        let mut drive = Drive::new(&story.room, &story.sensor);
        let mut map = RelativeMap::new(params);
        for op in &story.ops {
            drive.act(op, &mut [&mut map]);
        }
        let distance_m = distances_m(&drive.graph, params.place_weight);
        for (vertex, state) in map.volumes() {
            let pieces = map.explain(vertex);
            let mut next = 0;
            for (i, edge) in state.volume.frontier.iter().enumerate() {
                let mut reached = 0.0;
                while reached < 1.0 {
                    let piece = &pieces[next];
                    prop_assert_eq!(piece.edge, *edge);
                    prop_assert_eq!(piece.span.from, reached);
                    reached = piece.span.to;
                    next += 1;
                    let held = state.ledgers[i].reason_at(piece.span.from);
                    match &piece.fate {
                        Fate::Gone { cause, by, step, path } => {
                            let held = held.unwrap();
                            prop_assert_eq!((held.cause, held.by, held.step), (*cause, *by, *step));
                            let way = walk(&drive.graph, vertex, path);
                            prop_assert_eq!(way.map(|way| way.0), Some(*by));
                        }
                        Fate::Left(why) => {
                            prop_assert_eq!(held, None);
                            check_why(&drive, &map, &distance_m, (vertex, *why), piece)?;
                        }
                    }
                }
            }
            prop_assert_eq!(next, pieces.len());
        }
        prop_assert_eq!(map.explain(VertexId(1_000)), vec![]);
    }
}

fn check_why(
    drive: &Drive,
    map: &RelativeMap,
    distance_m: &[Vec<f64>],
    (vertex, why): (VertexId, WhyLeft),
    piece: &maps2d::relative::FrontierPiece,
) -> Result<(), TestCaseError> {
    let scope_m = map.params().consolidation_radius_m;
    let row = &distance_m[vertex.0 as usize];
    let in_world = drive.world_from(vertex).transform(&piece.edge.at(piece.span.middle()));
    let covers = |other: VertexId| {
        let state = map.volume(other)?;
        inside(&state.volume.inner, &drive.world_from(other).inverse_transform(&in_world))
    };
    match why {
        WhyLeft::Sliver { chain_m, least_m } => {
            prop_assert_eq!(least_m, map.params().sliver_m);
            prop_assert!(chain_m < least_m);
            let counts =
                map.volume(vertex).unwrap().counting_chains().flat_map(|chain| &chain.parts).any(
                    |part| part.span == piece.span && piece.edge == edge_of(map, vertex, part.edge),
                );
            prop_assert!(!counts);
        }
        WhyLeft::OutOfScope { by, distance_m: told_m, radius_m } => {
            prop_assert_eq!(radius_m, scope_m);
            prop_assert!((told_m - row[by.0 as usize]).abs() < 1e-9 && told_m > scope_m);
            prop_assert!(covers(by) != Some(false));
        }
        WhyLeft::Unseen => {
            for (other, _) in map.volumes().filter(|(other, _)| *other != vertex) {
                let far_m = row[other.0 as usize];
                if far_m > scope_m + 1e-9 && far_m < 2.0 * scope_m - 1e-9 {
                    prop_assert!(covers(other) != Some(true), "{} covers it", other);
                }
            }
        }
    }
    Ok(())
}

fn edge_of(map: &RelativeMap, vertex: VertexId, edge: usize) -> maps2d::volume::FrontierEdge {
    map.volume(vertex).unwrap().volume.frontier[edge]
}

/// An empty hall, a robot that looks ahead from three places in a row, and a scope that holds only
/// neighbours.
#[test]
fn a_hall_is_explained() {
    let room = Room { width_m: 30.0, height_m: 30.0, pillars: Vec::new() };
    let sensor = Sensor { fov_rad: 2.0, rays: 9, range_m: 5.0 };
    let mut drive = Drive::new(&room, &sensor);
    let params = RelativeParams { consolidation_radius_m: 2.5, ..RelativeParams::default() };
    let mut map = RelativeMap::new(params);
    for x in [10.0, 12.0, 14.0] {
        drive.go(&Se2::new(x, 15.0, 0.0), &[], &mut [&mut map], &mut Off);
    }
    let pieces = map.explain(VertexId(0));
    let by = |who: u32| {
        pieces
            .iter()
            .filter(|piece| matches!(&piece.fate, Fate::Gone { by, .. } if by.0 == who))
            .count()
    };
    assert!(by(1) > 0, "the second place sees past the first one's horizon");
    assert_eq!(by(2), 0, "the third is out of scope");
    // What only the third place sees of it.
    let out_of_scope = pieces.iter().filter_map(|piece| match &piece.fate {
        Fate::Left(WhyLeft::OutOfScope { by, distance_m, radius_m }) => {
            Some((by.0, *distance_m, *radius_m))
        }
        _ => None,
    });
    for told in out_of_scope {
        assert_eq!(told, (2, 4.0, 2.5));
    }
    let unseen = |piece: &&maps2d::relative::FrontierPiece| {
        piece.fate == Fate::Left(WhyLeft::Unseen) && piece.edge.spoke
    };
    assert_eq!(pieces.iter().filter(unseen).count(), 2, "nobody looked back");
}
