//! Triangles fill a region, and nothing else.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use common::views::{self, Draw};
use geometry::Point2;
use geometry::planar::overlay::{EdgeLabel, Operation, Region, RingEdge, overlay, union_all};
use geometry::planar::{PlanarError, Triangulation};

/// Area, symmetry of neighbours, and corners in order.
fn check(region: &Region<u32>, what: &str) {
    let mesh = Triangulation::of(region).unwrap();
    let (area_m2, expected_m2) = (mesh.area_m2(), region.area_m2());
    assert!((area_m2 - expected_m2).abs() < 1e-6, "{what}: {area_m2} for {expected_m2}");
    for (index, triangle) in mesh.triangles.iter().enumerate() {
        let [a, b, c] = mesh.corners(index as u32);
        assert!((b - a).perp(&(c - a)) > 0.0, "{what}: triangle {index} is not counter-clockwise");
        for (side, neighbour) in triangle.neighbours.iter().enumerate() {
            let Some(neighbour) = neighbour else { continue };
            let (from, to) = (triangle.corners[side], triangle.corners[(side + 1) % 3]);
            let other = &mesh.triangles[*neighbour as usize];
            let back = (0..3).find(|&i| other.corners[i] == to).unwrap();
            assert_eq!(other.corners[(back + 1) % 3], from, "{what}");
            assert_eq!(other.neighbours[back], Some(index as u32), "{what}");
        }
        let centre = mesh.centroid(index as u32);
        assert_eq!(mesh.locate(&centre, 0.0), Some(index as u32), "{what}");
        assert!(region.contains(&centre), "{what}: {centre} is outside");
    }
}

#[test]
fn overlays_of_views_are_filled() {
    let mut draw = Draw::new(5);
    for case in 0..400 {
        let (a, b, kind) = views::pair(&mut draw, case);
        for operation in [Operation::Union, Operation::Intersection, Operation::Difference] {
            let region = overlay(&a, &b, operation).unwrap().region;
            check(&region, &format!("case {case}, kind {kind}, {operation:?}"));
        }
    }
}

#[test]
fn many_views_with_holes_are_filled() {
    let mut draw = Draw::new(9);
    for round in 0..20 {
        let views: Vec<Region<u32>> = (0..12)
            .map(|i| {
                let by = (draw.between(-8.0, 8.0), draw.between(-8.0, 8.0));
                let view = views::pair(&mut draw, 7 * i).0;
                let moved = |p: Point2| Point2::new(p.x + by.0, p.y + by.1);
                let mut region = view;
                for ring in &mut region.rings {
                    ring.points.iter_mut().for_each(|p| *p = moved(*p));
                }
                region
            })
            .collect();
        let region = union_all(&views.iter().collect::<Vec<_>>()).unwrap().region;
        check(&region, &format!("round {round}"));
    }
}

#[test]
fn a_frame_leaves_its_hole_out() {
    let edge = RingEdge { label: EdgeLabel::Obstacle, data: 0_u32 };
    let square = |half: f64, turn: f64| {
        let corners = [(-1.0, -turn), (1.0, -turn), (1.0, turn), (-1.0, turn)];
        Region::from_ring(corners.map(|(x, y)| (Point2::new(half * x, half * y), edge)))
    };
    let mut frame = square(3.0, 1.0);
    frame.rings.extend(square(2.0, -1.0).rings);
    let mesh = Triangulation::of(&frame).unwrap();
    assert_eq!(mesh.triangles.len(), 8);
    assert!((mesh.area_m2() - 20.0).abs() < 1e-12);
    assert_eq!(mesh.locate(&Point2::origin(), 0.5), None);
    assert!(mesh.locate(&Point2::new(1.9, 0.0), 0.2).is_some());
    assert!(mesh.locate(&Point2::new(2.5, 0.0), 0.0).is_some());
}

#[test]
fn nothing_and_nonsense() {
    assert!(Triangulation::of(&Region::<u32>::default()).unwrap().triangles.is_empty());
    let edge = RingEdge { label: EdgeLabel::Free, data: 0_u32 };
    let flat = Region::from_ring([0.0, 1.0, 2.0].map(|x| (Point2::new(x, x), edge)));
    assert!(Triangulation::of(&flat).unwrap().triangles.is_empty());
    // Edges that cross: what can be kept is kept, and nothing panics.
    let bow = [(0.0, 0.0), (2.0, 2.0), (2.0, 0.0), (0.0, 2.0)];
    let bow = Region::from_ring(bow.map(|(x, y)| (Point2::new(x, y), edge)));
    assert!(Triangulation::of(&bow).is_ok());
    let bad = Region::from_ring([0.0, f64::NAN, 1.0].map(|x| (Point2::new(x, 1.0), edge)));
    assert!(matches!(Triangulation::of(&bad), Err(PlanarError::Unsnappable { .. })));
}
