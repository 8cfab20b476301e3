//! United polygons: what is inside, what is open, and ways that stay inside.

use geometry::Point2;
use geometry::planar::Triangulation;
use geometry::planar::overlay::{EdgeLabel, Region};
use maps2d::grid::CellState;
use maps2d::polygons::{
    CorrectedPolygons, CorrectedPolygonsParams, DualGraph, OpenFrontier, OpenParams, Tag, cells_of,
};
use maps2d::volume::{LocalVolume, Samples, VolumeParams, build};
use maps2d::{Candidate, ExplorationMap, Route};
use probe::VertexId;
use proptest::prelude::*;
use search::Scratch;

use super::config;
use super::drive::{Done, Drive, Mix, Story, stories};
use super::told::Told;

const SEEDS: &str = "proptest-regressions/polygons.txt";
const MIX: Mix = Mix { turns: 2, links: 1, withdrawals: 1 };

/// Tells a story to a map, and keeps what was seen from each vertex.
fn tell(
    story: &Story,
    map: &mut CorrectedPolygons,
    mut each: impl FnMut(&Drive, &mut CorrectedPolygons, &[LocalVolume]) -> Result<(), TestCaseError>,
) -> Result<(), TestCaseError> {
    let mut drive = Drive::new(&story.room, &story.sensor);
    let mut seen: Vec<Samples> = Vec::new();
    for op in &story.ops {
        let done = drive.act(op, &mut [map]);
        if let Done::Founded(vertex) | Done::Rescanned(vertex) = done {
            seen.resize_with(drive.world_from_vertex.len(), Samples::new);
            let turned = drive.standing.vertex_from_body;
            let scan = story.room.scan(&(drive.world_from(vertex) * turned), &story.sensor);
            seen[vertex.0 as usize].add(&scan, &turned);
        }
        if done != Done::Nothing {
            let volumes: Vec<LocalVolume> = seen
                .iter()
                .map(|samples| build(samples, &VolumeParams::default()).unwrap())
                .collect();
            each(&drive, map, &volumes)?;
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(config(32, SEEDS))]

    /// Without noise the region is the union of the views, and every open part is on its boundary.
    #[test]
    fn the_region_is_the_union_of_the_views(story in stories(MIX, 1..18)) {
        let mut map = CorrectedPolygons::new(CorrectedPolygonsParams::default());
        tell(&story, &mut map, |drive, map, volumes| {
            let first = drive.world_from(VertexId(0));
            let mut judged = 0;
            for i in 0..400 {
                let share = |k: f64| (f64::from(i) * k).fract();
                let in_world = Point2::new(
                    share(0.618_034) * story.room.width_m,
                    share(0.414_214) * story.room.height_m,
                );
                let sides: Vec<(bool, bool)> = volumes
                    .iter()
                    .zip(&drive.world_from_vertex)
                    .map(|(volume, pose)| {
                        let p = pose.inverse_transform(&in_world);
                        let near = volume.polygon.boundary().any(|edge| {
                            geometry::planar::point_segment_distance(&p, &edge.from, &edge.to)
                                < 1e-3
                        });
                        (volume.polygon.contains(&p), near)
                    })
                    .collect();
                if sides.iter().any(|side| side.1) {
                    continue;
                }
                judged += 1;
                let inside = sides.iter().any(|side| side.0);
                let in_map = first.inverse_transform(&in_world);
                prop_assert_eq!(map.region().contains(&in_map), inside, "{}", in_world);
            }
            prop_assert!(judged > 100);
            for part in map.open().chains.iter().flat_map(|chain| &chain.parts) {
                let middle = Point2::from((part.from.coords + part.to.coords) * 0.5);
                let on = map.region().edges().any(|edge| {
                    edge.label == EdgeLabel::Frontier
                        && geometry::planar::point_segment_distance(&middle, &edge.from, &edge.to)
                            < 1e-6
                });
                prop_assert!(on);
            }
            Ok(())
        })?;
    }

    /// Whoever listens changes nothing, whatever is asked in between.
    #[test]
    fn heard_or_not(story in stories(MIX, 1..18)) {
        let mut quiet = CorrectedPolygons::new(CorrectedPolygonsParams::default());
        let mut heard = CorrectedPolygons::new(CorrectedPolygonsParams::default());
        let mut told: Vec<Told> = Vec::new();
        let mut one = Drive::new(&story.room, &story.sensor);
        let mut other = Drive::new(&story.room, &story.sensor);
        let (mut here, mut there): (Vec<Candidate>, Vec<Candidate>) = Default::default();
        for op in &story.ops {
            if one.act(op, &mut [&mut quiet]) == Done::Nothing {
                continue;
            }
            other.act_with(op, &mut [&mut heard], &mut told);
            prop_assert_eq!(quiet.region(), heard.region());
            quiet.in_view(&one.standing, &mut here);
            heard.in_view(&one.standing, &mut there);
            prop_assert_eq!(&here, &there);
            prop_assert_eq!(quiet.route(&one.standing, 0.3), heard.route(&one.standing, 0.3));
            if let Some(candidate) = here.first() {
                let goal = candidate.goals_in_body[0];
                quiet.give_up(&one.standing, &goal, 0.5, true, &mut probe::Off);
                heard.give_up(&one.standing, &goal, 0.5, true, &mut told);
            }
            prop_assert_eq!(quiet.frontier(), heard.frontier());
        }
        prop_assert!(told.is_empty() || told.iter().any(|event| event.variant == "Settled"));
    }

    /// Ways end at open frontier and stay inside.
    #[test]
    fn ways_stay_inside(story in stories(MIX, 1..14)) {
        let mut map = CorrectedPolygons::new(CorrectedPolygonsParams::default());
        tell(&story, &mut map, |drive, map, _| {
            let standing = drive.standing;
            let places = map.frontier().places;
            let map_from_body = map.correction().pose(standing.vertex) * standing.vertex_from_body;
            let region = map.region().clone();
            let open = map.open().clone();
            let Some(Route::Drive(way)) = map.route(&standing, 0.3) else {
                // What no way leads to does not count any more.
                prop_assert_eq!(map.frontier().places, 0);
                return Ok(());
            };
            prop_assert!(places > 0 && !way.is_empty());
            let way: Vec<Point2> = way.iter().map(|p| map_from_body.transform(p)).collect();
            let goal = way[way.len() - 1];
            let near = open.counting().any(|chain| (chain.at(0.5).0 - goal).norm() < 1e-6);
            prop_assert!(near);
            let start = Point2::from(map_from_body.translation);
            for pair in std::iter::once(start).chain(way).collect::<Vec<_>>().windows(2) {
                for k in 1..8 {
                    let p = pair[0] + (pair[1] - pair[0]) * (f64::from(k) / 8.0);
                    let inside = region.contains(&p) || region.edges().any(|edge| {
                        geometry::planar::point_segment_distance(&p, &edge.from, &edge.to) < 0.06
                    });
                    prop_assert!(inside, "{} is outside", p);
                }
            }
            Ok(())
        })?;
    }
}

fn square(half_m: f64, labels: [EdgeLabel; 4]) -> Region<Tag> {
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    Region::from_ring(corners.iter().zip(labels).enumerate().map(|(i, (&(x, y), label))| {
        let key = maps2d::volume::EdgeKey(2 * i as u32);
        let data = Tag { vertex: VertexId(i as u32), key, spoke: false };
        (Point2::new(half_m * x, half_m * y), geometry::planar::overlay::RingEdge { label, data })
    }))
}

#[test]
fn chains_go_round_corners_and_end_at_walls() {
    use EdgeLabel::{Frontier, Obstacle};
    let open = |labels, wall_closing_m, given_up: &[(Point2, f64)]| {
        let params = OpenParams { wall_closing_m, sliver_m: 0.4 };
        OpenFrontier::of(&square(1.0, labels), &params, given_up)
    };
    // Two sides that meet where the ring starts are one chain.
    let two = open([Frontier, Obstacle, Obstacle, Frontier], 0.0, &[]);
    assert_eq!((two.chains.len(), two.chains[0].length_m), (1, 4.0));
    assert_eq!(two.chains[0].at(0.5).0, Point2::new(-1.0, -1.0));
    // Near the walls of other views it does not count.
    let walls = open([Frontier, Obstacle, Frontier, Obstacle], 0.3, &[]);
    assert_eq!(walls.chains.len(), 2);
    assert!((walls.wall_m - 1.2).abs() < 1e-9, "{walls:?}");
    assert!((walls.summary().open_m - 2.8).abs() < 1e-9);
    // What was given up, neither.
    let gone =
        open([Frontier, Obstacle, Obstacle, Obstacle], 0.0, &[(Point2::new(0.0, -1.0), 0.8)]);
    assert!((gone.given_up_m - 1.6).abs() < 1e-9);
    assert_eq!(gone.summary().places, 0);
    let all = open([Frontier; 4], 0.3, &[]);
    assert_eq!((all.chains.len(), all.summary().open_m), (1, 8.0));
}

#[test]
fn a_region_as_cells() {
    use EdgeLabel::{Frontier, Obstacle};
    let cells = cells_of(&square(2.0, [Obstacle, Frontier, Frontier, Frontier]), 1.0);
    let state = |column, row| cells.state(maps2d::grid::Cell { column, row });
    assert_eq!(state(0, 0), CellState::Free);
    assert_eq!(state(-2, 1), CellState::Free);
    assert_eq!(state(0, -3), CellState::Occupied);
    assert_eq!(state(0, 2), CellState::Unknown);
    assert_eq!(cells_of(&Region::default(), 1.0).slots(), 0);
}

#[test]
fn the_dual_graph_leads_to_the_nearest_goal() {
    let region = square(3.0, [EdgeLabel::Frontier; 4]);
    let mesh = Triangulation::of(&region).unwrap();
    let goals = [Point2::new(3.0, 0.0), Point2::new(0.0, 3.0), Point2::new(50.0, 0.0)];
    let dual = DualGraph::new(&mesh, &goals, &Point2::new(2.0, 0.3));
    let way = dual.way(&mut Scratch::default()).unwrap();
    assert_eq!(way.last(), Some(&goals[0]));
    let lonely = DualGraph::new(&mesh, &goals[2..], &Point2::new(2.0, 0.3));
    assert_eq!(lonely.way(&mut Scratch::default()), None);
    assert_eq!(DualGraph::new(&mesh, &[], &Point2::origin()).way(&mut Scratch::default()), None);
    assert_eq!(DualGraph::default().way(&mut Scratch::default()), None);
}
