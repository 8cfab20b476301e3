//! Union, intersection and difference of 10,000 pairs of views, most of them degenerate, against
//! areas by slabs and lengths along the boundary.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use common::slabs::{Areas, areas, segments};
use common::views::{self, Draw};
use geometry::Point2;
use geometry::planar::overlay::{
    EdgeLabel, LATTICE_M, Operation, Overlay, OverlayEvent, Region, Ring, RingEdge, overlay,
    overlay_with, union, union_all,
};
use geometry::planar::{PlanarError, point_segment_distance};

const OPERATIONS: [Operation; 3] =
    [Operation::Union, Operation::Intersection, Operation::Difference];

fn perimeter_m(region: &Region<u32>) -> f64 {
    region.edges().map(|edge| (edge.to - edge.from).norm()).sum()
}

/// What must hold of every result, whatever the input.
fn check(result: &Overlay<u32>, inputs: [&Region<u32>; 2], expected_m2: f64, what: &str) {
    let region = &result.region;
    let boundary_m = perimeter_m(inputs[0]) + perimeter_m(inputs[1]);
    let slack_m2 = 4.0 * LATTICE_M * boundary_m + 1e-9;
    let area_m2 = region.area_m2();
    assert!((area_m2 - expected_m2).abs() <= slack_m2, "{what}: {area_m2} for {expected_m2}");
    assert_eq!(region.rings.len(), result.sources.len());
    let mut lengths = std::collections::BTreeMap::new();
    for edge in region.edges() {
        let source = result.sources[edge.ring][edge.edge];
        let ring = &inputs[source.input as usize].rings[source.ring as usize];
        let i = source.edge as usize;
        let (from, to) = (&ring.points[i], &ring.points[ring.next(i)]);
        for point in [edge.from, edge.to] {
            let off_m = point_segment_distance(&point, from, to);
            assert!(off_m <= 6.0 * LATTICE_M, "{what}: {point} is {off_m} m off its source");
        }
        assert_eq!((edge.label, edge.data), (ring.edges[i].label, ring.edges[i].data), "{what}");
        *lengths.entry(source).or_insert(0.0) += (edge.to - edge.from).norm();
    }
    // Pieces of one edge do not overlap.
    for (source, length_m) in lengths {
        let ring = &inputs[source.input as usize].rings[source.ring as usize];
        let i = source.edge as usize;
        let whole_m = (ring.points[ring.next(i)] - ring.points[i]).norm();
        assert!(length_m <= whole_m + 20.0 * LATTICE_M, "{what}: {length_m} m of {whole_m} m");
    }
    // Outer rings first, each with its holes; no ring without an inside.
    if let Some(first) = region.rings.first() {
        assert!(!first.is_hole(), "{what}");
    }
    assert!(region.rings.iter().all(|ring| ring.points.len() >= 3), "{what}");
}

#[test]
fn ten_thousand_pairs() {
    let mut draw = Draw::new(7);
    let mut met = [0_u32; views::KINDS];
    for case in 0..10_000 {
        let (a, b, kind) = views::pair(&mut draw, case);
        met[kind] += 1;
        let Areas { union, intersection, difference } = areas(&segments(&a), &segments(&b));
        for (operation, expected) in OPERATIONS.into_iter().zip([union, intersection, difference]) {
            let result = overlay(&a, &b, operation).unwrap();
            check(&result, [&a, &b], expected, &format!("case {case}, kind {kind}, {operation:?}"));
        }
    }
    assert!(met.iter().all(|&count| count >= 1000), "{met:?}");
}

/// Where boundaries coincide, the greater label is there, whichever input brings it.
#[test]
fn obstacle_wins() {
    let square = |label, data| {
        let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
        Region::from_ring(corners.map(|(x, y)| (Point2::new(x, y), RingEdge { label, data })))
    };
    let labels = [EdgeLabel::Free, EdgeLabel::Frontier, EdgeLabel::Obstacle];
    for (i, &a) in labels.iter().enumerate() {
        for (j, &b) in labels.iter().enumerate() {
            for operation in [Operation::Union, Operation::Intersection] {
                let result = overlay(&square(a, 0), &square(b, 1), operation).unwrap();
                assert_eq!(result.region.edge_count(), 4);
                let winner = u32::from(j > i);
                for edge in result.region.edges() {
                    assert_eq!((edge.label, edge.data), (a.max(b), winner), "{a:?} {b:?}");
                }
            }
        }
    }
}

/// Labels follow the pieces of a cut edge, and neighbours with different labels stay apart.
#[test]
fn labels_partition_a_shared_side() {
    use EdgeLabel::{Frontier, Obstacle};
    let bar = |x: f64, label| {
        let corners = [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0)];
        let ring = corners.map(|(dx, y)| (Point2::new(x + dx, y), RingEdge { label, data: 0_u32 }));
        Region::from_ring(ring)
    };
    let both = union(&bar(0.0, Frontier), &bar(1.0, Obstacle)).unwrap().region;
    let length_of = |label| -> f64 {
        let edges = both.edges().filter(|edge| edge.label == label);
        edges.map(|edge| (edge.to - edge.from).norm()).sum()
    };
    assert!((length_of(Frontier) - 3.0).abs() < 1e-9);
    assert!((length_of(Obstacle) - 5.0).abs() < 1e-9);
}

#[test]
fn holes_are_kept_and_filled() {
    let ring = |half: f64, turn: f64| {
        let corners = [(-1.0, -turn), (1.0, -turn), (1.0, turn), (-1.0, turn)];
        let points = corners.map(|(x, y)| Point2::new(half * x, half * y)).to_vec();
        Ring { points, edges: vec![RingEdge { label: EdgeLabel::Obstacle, data: 0_u32 }; 4] }
    };
    let frame = Region { rings: vec![ring(3.0, 1.0), ring(2.0, -1.0)] };
    assert_eq!(frame.area_m2(), 36.0 - 16.0);
    assert!(frame.contains(&Point2::new(2.5, 0.0)) && !frame.contains(&Point2::origin()));
    let plug = Region { rings: vec![ring(1.0, 1.0)] };
    let island = union(&frame, &plug).unwrap().region;
    assert_eq!(island.sheets(), [0..2, 2..3]);
    assert!((island.area_m2() - 24.0).abs() < 1e-9);
    let filled = union(&frame, &Region { rings: vec![ring(2.0, 1.0)] }).unwrap().region;
    assert_eq!(filled.rings.len(), 1);
    assert!((filled.area_m2() - 36.0).abs() < 1e-9);
}

/// One operation over many inputs is the same as one after the other.
#[test]
fn many_at_once_are_as_one_by_one() {
    let mut draw = Draw::new(3);
    for round in 0..40 {
        let regions: Vec<Region<u32>> =
            (0..7).map(|i| views::pair(&mut draw, round * 7 + i).0).collect();
        let all = union_all(&regions.iter().collect::<Vec<_>>()).unwrap().region;
        let mut one_by_one = Region::default();
        for region in &regions {
            one_by_one = union(&one_by_one, region).unwrap().region;
        }
        let slack_m2 = 1e-4;
        assert!((all.area_m2() - one_by_one.area_m2()).abs() < slack_m2, "round {round}");
        for x in -8..=8 {
            for y in -8..=8 {
                let point = Point2::new(f64::from(x) + 0.123_4, f64::from(y) + 0.432_1);
                let inside = regions.iter().any(|region| region.contains(&point));
                assert_eq!(all.contains(&point), inside, "round {round}, {point}");
            }
        }
    }
}

#[test]
fn the_same_input_gives_the_same_bits_heard_or_not() {
    let mut draw = Draw::new(11);
    for case in 0..200 {
        let (a, b, _) = views::pair(&mut draw, case);
        for operation in OPERATIONS {
            let unheard = overlay(&a, &b, operation).unwrap();
            let mut heard: Vec<OverlayEvent> = Vec::new();
            assert_eq!(overlay_with(&a, &b, operation, &mut heard).unwrap(), unheard);
            let loops = heard.iter().filter(|e| matches!(e, OverlayEvent::LoopClosed { .. }));
            assert_eq!(loops.count(), unheard.region.rings.len());
        }
    }
}

/// Two squares that cross enter and leave each other once each.
#[test]
fn entries_and_exits_come_in_pairs() {
    let square = |x: f64, y: f64| {
        let corners = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)];
        let edge = RingEdge { label: EdgeLabel::Frontier, data: 0_u32 };
        Region::from_ring(corners.map(|(dx, dy)| (Point2::new(x + dx, y + dy), edge)))
    };
    let mut heard: Vec<OverlayEvent> = Vec::new();
    overlay_with(&square(0.0, 0.0), &square(1.0, 1.0), Operation::Union, &mut heard).unwrap();
    let met: Vec<(Point2, bool)> = heard
        .iter()
        .filter_map(|event| match event {
            OverlayEvent::Intersected { at, entry, .. } => Some((*at, *entry)),
            _ => None,
        })
        .collect();
    assert_eq!(met.len(), 2);
    // Counter-clockwise, the first one's right side runs up into the second, and its upper side
    // comes out of it on its way to the left.
    assert!(met.contains(&(Point2::new(2.0, 1.0), false)), "{met:?}");
    assert!(met.contains(&(Point2::new(1.0, 2.0), true)), "{met:?}");
    assert_eq!(heard.iter().filter(|e| matches!(e, OverlayEvent::Merged { .. })).count(), 2);
}

/// Thinning moves the boundary by no more than the slack, and only where edges are alike.
#[test]
fn thinned_boundaries_stay_where_they_are() {
    let mut draw = Draw::new(17);
    for round in 0..60 {
        let regions: Vec<Region<u32>> =
            (0..5).map(|i| views::pair(&mut draw, round * 7 + 7 * i + 1).0).collect();
        let region = union_all(&regions.iter().collect::<Vec<_>>()).unwrap().region;
        let thinned = region.thinned(1e-3, |a, b| a.label == b.label);
        assert!(thinned.edge_count() <= region.edge_count());
        assert_eq!(thinned.rings.len(), region.rings.len());
        for edge in region.edges() {
            let ring = &thinned.rings[edge.ring];
            let off_m = (0..ring.points.len())
                .map(|i| {
                    let to = &ring.points[ring.next(i)];
                    point_segment_distance(&edge.from, &ring.points[i], to)
                })
                .fold(f64::INFINITY, f64::min);
            assert!(off_m <= 1e-3, "round {round}: {off_m} m off");
        }
        assert_eq!(region.thinned(1e-3, |_, _| false), region);
    }
    let edge = RingEdge { label: EdgeLabel::Obstacle, data: 0_u32 };
    let corners = [(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (3.0, 0.0), (3.0, 1.0), (0.0, 1.0)];
    let bar = Region::from_ring(corners.map(|(x, y)| (Point2::new(x, y), edge)));
    assert_eq!(bar.thinned(1e-9, |_, _| true).edge_count(), 4);
}

#[test]
fn nothing_and_nonsense() {
    let nothing: Region<u32> = Region::default();
    assert!(union(&nothing, &nothing).unwrap().region.is_empty());
    assert!(union_all::<u32>(&[]).unwrap().region.is_empty());
    let edge = RingEdge { label: EdgeLabel::Free, data: 0_u32 };
    // Rings without an inside vanish.
    let flat = Region::from_ring([0.0, 1.0, 2.0].map(|x| (Point2::new(x, x), edge)));
    assert!(union(&flat, &nothing).unwrap().region.is_empty());
    let point = Region::from_ring([(Point2::new(1.0, 1.0), edge)]);
    assert!(union(&point, &flat).unwrap().region.is_empty());
    for bad in [Point2::new(f64::NAN, 0.0), Point2::new(5000.0, 0.0)] {
        let far = Region::from_ring([(Point2::origin(), edge), (bad, edge)]);
        let refused = union(&far, &nothing);
        assert!(matches!(refused, Err(PlanarError::Unsnappable { .. })));
    }
}
