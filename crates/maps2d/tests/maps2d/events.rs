//! What the maps tell, and that telling changes nothing.

use std::collections::BTreeSet;

use geometry::Point2;
use maps2d::ExplorationMap;
use maps2d::correction::CorrectionEvent;
use maps2d::grid::{GridEvent, GridMap, GridParams};
use maps2d::polygons::PolygonEvent;
use maps2d::relative::{ConsolidationEvent, RelativeMap, RelativeParams};
use maps2d::volume::VolumeEvent;
use pose::Se2;
use proptest::prelude::*;

use super::config;
use super::drive::{Drive, Mix, params, stories};
use super::room::{Room, Sensor};
use super::told::Told;

const SEEDS: &str = "proptest-regressions/events.txt";

proptest! {
    #![proptest_config(config(150, SEEDS))]

    /// A map that is watched is the map that is not, bit for bit.
    #[test]
    fn watching_changes_nothing(
        story in stories(Mix { turns: 2, links: 2, withdrawals: 1 }, 1..24),
        params in params(),
    ) {
        let mut drive = Drive::new(&story.room, &story.sensor);
        let mut twin = Drive::new(&story.room, &story.sensor);
        let (mut watched, mut unseen) = (RelativeMap::new(params), RelativeMap::new(params));
        let (mut watched_grid, mut unseen_grid) =
            (GridMap::new(GridParams::default()), GridMap::new(GridParams::default()));
        let mut told: Vec<Told> = Vec::new();
        for op in &story.ops {
            drive.act_with(op, &mut [&mut watched, &mut watched_grid], &mut told);
            twin.act(op, &mut [&mut unseen, &mut unseen_grid]);
            prop_assert_eq!(watched.frontier(), unseen.frontier());
        }
        prop_assert_eq!(format!("{:?}", watched), format!("{:?}", unseen));
        prop_assert_eq!(format!("{:?}", watched_grid), format!("{:?}", unseen_grid));
    }

    /// Parts that were told closed, less those told open again, are what the ledgers hold.
    #[test]
    fn what_is_told_adds_up(
        story in stories(Mix { turns: 0, links: 2, withdrawals: 2 }, 1..24),
        params in params(),
    ) {
        let mut drive = Drive::new(&story.room, &story.sensor);
        let mut map = RelativeMap::new(params);
        let mut told: Vec<ClosedShare> = Vec::new();
        for op in &story.ops {
            drive.act_with(op, &mut [&mut map], &mut told);
        }
        let told: f64 = told.iter().map(|share| share.0).sum();
        let held: f64 = map
            .volumes()
            .flat_map(|(_, state)| &state.ledgers)
            .map(|ledger| ledger.closed_share())
            .sum();
        prop_assert!((told - held).abs() < 1e-6, "told {} held {}", told, held);
    }
}

/// How much of an edge an event closes; less than 0 where it opens.
struct ClosedShare(f64);

impl From<ConsolidationEvent<'_>> for ClosedShare {
    fn from(event: ConsolidationEvent<'_>) -> Self {
        Self(match event {
            ConsolidationEvent::Closed { span, .. } => span.share(),
            ConsolidationEvent::Reopened { span, .. } => -span.share(),
            _ => 0.0,
        })
    }
}

impl From<VolumeEvent<'_>> for ClosedShare {
    fn from(_: VolumeEvent<'_>) -> Self {
        Self(0.0)
    }
}

impl From<CorrectionEvent<'_>> for ClosedShare {
    fn from(_: CorrectionEvent<'_>) -> Self {
        Self(0.0)
    }
}

impl From<PolygonEvent<'_>> for ClosedShare {
    fn from(_: PolygonEvent<'_>) -> Self {
        Self(0.0)
    }
}

impl From<GridEvent<'_>> for ClosedShare {
    fn from(_: GridEvent<'_>) -> Self {
        Self(0.0)
    }
}

/// A short run in which everything happens that can be told.
fn eventful_run() -> Vec<Told> {
    let room = Room { width_m: 8.0, height_m: 6.0, pillars: vec![[3.0, 2.0, 2.0, 2.0]] };
    let sensor = Sensor { fov_rad: 2.0, rays: 24, range_m: 5.0 };
    let mut drive = Drive::new(&room, &sensor);
    let mut map = RelativeMap::new(RelativeParams::default());
    let mut grid = GridMap::new(GridParams::default());
    let mut told: Vec<Told> = Vec::new();
    let stops = [(1.5, 1.0), (6.5, 1.0), (6.5, 5.0), (1.5, 5.0)];
    for i in 0..12_usize {
        let (x, y) = stops[i % 4];
        let known: Vec<usize> = if i >= 4 { vec![i % 4] } else { Vec::new() };
        let maps: &mut [&mut dyn ExplorationMap] = &mut [&mut map, &mut grid];
        drive.go(&Se2::new(x, y, 0.4 * i as f64), &known, maps, &mut told);
        for _ in 0..3 {
            drive.standing.vertex_from_body =
                drive.standing.vertex_from_body * Se2::from_angle(1.6);
            drive.look(maps, &mut told);
        }
    }
    // Back to a place whose volume was retired.
    let retired = map.volumes().find(|(_, state)| state.retired).map(|(vertex, _)| vertex);
    drive.standing.vertex = retired.expect("going round retires volumes");
    drive.look(&mut [&mut map], &mut told);
    for edge in std::mem::take(&mut drive.place_edges) {
        drive.graph.withdraw(edge).unwrap();
        map.edge_withdrawn(&drive.graph, edge, &mut told);
        grid.edge_withdrawn(&drive.graph, edge, &mut told);
    }
    let goal = Point2::new(1.0, 0.0);
    map.give_up(&drive.standing, &goal, 2.0, true, &mut told);
    let poses = drive.world_from_vertex.clone();
    map.poses_reestimated(&poses, &mut told);
    grid.poses_reestimated(&poses, &mut told);
    told
}

/// Every variant that an event has is told by somebody.
#[test]
fn every_variant_is_told() {
    let run = eventful_run();
    let told: BTreeSet<&str> = run.iter().map(|event| event.variant).collect();
    let variants = [VolumeEvent::VARIANTS, ConsolidationEvent::VARIANTS, GridEvent::VARIANTS];
    let missing: Vec<&&str> =
        variants.into_iter().flatten().filter(|variant| !told.contains(**variant)).collect();
    assert!(missing.is_empty(), "never told: {missing:?}");
}

/// The order in which one scan is told: what was measured, what it came to, what that closed.
#[test]
fn a_scan_is_told_in_order() {
    let room = Room { width_m: 8.0, height_m: 6.0, pillars: Vec::new() };
    let sensor = Sensor { fov_rad: 2.0, rays: 5, range_m: 3.0 };
    let mut drive = Drive::new(&room, &sensor);
    let mut map = RelativeMap::new(RelativeParams::default());
    let mut told: Vec<Told> = Vec::new();
    drive.go(&Se2::new(2.0, 3.0, 0.0), &[], &mut [&mut map], &mut told);
    drive.go(&Se2::new(3.0, 3.0, 0.0), &[], &mut [&mut map], &mut told);
    let lines: Vec<String> =
        told.iter().map(|event| format!("{} {}", event.variant, event.says)).collect();
    insta::assert_snapshot!(lines.join("\n"));
}
