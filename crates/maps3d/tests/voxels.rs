//! The voxel map: what it holds after a look, its frontier, and what corrected poses do to it.

use maps3d::{FlightRoute, Hovering, Known, Look, Map3d, Maps3dError, VoxelMap, VoxelParams};
use nalgebra::{Point3, Vector3};
use pose::Se3;
use posegraph::{EdgeKind, PoseGraph};
use probe::{Off, VertexId};
use sensing::{Camera, DepthImage};

/// A flat wall, 2 m ahead of a camera with rays closer than cells.
fn wall() -> DepthImage {
    DepthImage::new(81, Camera::new(60.0, 60.0, 40.0, 30.0), vec![2.03; 81 * 61])
}

fn params() -> VoxelParams {
    VoxelParams { cell_m: 0.1, ..VoxelParams::default() }
}

fn hovering(vertex: u32) -> Hovering {
    Hovering { vertex: VertexId(vertex), vertex_from_body: Se3::identity() }
}

fn look(map: &mut VoxelMap, vertex: u32, image: &DepthImage) -> Result<(), Maps3dError> {
    let vertex_from_camera = Se3::identity();
    map.looked(&Look { vertex: VertexId(vertex), vertex_from_camera, image }, &mut Off)
}

fn ahead(by_m: f64) -> Se3 {
    Se3::new(Vector3::new(0.0, 0.0, by_m), Se3::identity().rotation)
}

#[test]
fn a_look_is_free_up_to_what_it_hits() {
    let mut map = VoxelMap::new(params()).expect("parameters");
    look(&mut map, 0, &wall()).expect("a look");
    for (z, expected) in
        [(0.5, Known::Free), (1.5, Known::Free), (2.05, Known::Solid), (2.3, Known::Unknown)]
    {
        let known = map.knows(&hovering(0), &Point3::new(0.03, 0.04, z));
        assert_eq!(known, expected, "at {z}");
    }
    assert_eq!(map.knows(&hovering(0), &Point3::new(0.0, 0.0, -0.5)), Known::Unknown);
    // Every free cell lies in the pyramid, and the wall is one cell thick.
    let (mut free, mut solid) = (0, 0);
    for (cell, odds) in map.cells() {
        if odds > 0 {
            solid += 1;
            assert_eq!(cell[2], 20);
        } else {
            free += 1;
            assert!(cell[2] <= 20 && cell[2] >= 0);
        }
    }
    let pyramid = (80.0 / 60.0) * (60.0 / 60.0) * 20.3_f64.powi(3) / 3.0;
    assert!((f64::from(free) / pyramid - 1.0).abs() < 0.25, "{free} of {pyramid}");
    let face = (80.0 / 60.0) * 20.3_f64.powi(2);
    assert!((f64::from(solid) / face - 1.0).abs() < 0.15, "{solid} of {face}");
    assert_eq!(map.tally().volumes, (free + solid) as usize);
}

#[test]
fn the_sides_of_a_look_are_frontier_until_they_are_given_up() {
    let mut map = VoxelMap::new(params()).expect("parameters");
    look(&mut map, 0, &wall()).expect("a look");
    let tally = map.tally();
    // The four sides of the pyramid, in squares along the axes.
    assert!(tally.patches >= 1 && tally.open_m2 > 5.0 && tally.open_m2 < 25.0, "{tally:?}");
    let mut patches = Vec::new();
    map.frontiers(&hovering(0), &mut patches);
    let told_m2: f64 = patches.iter().flat_map(|patch| &patch.points).map(|p| p.area_m2).sum();
    assert!((told_m2 - tally.open_m2).abs() < 1e-9);
    let way = map.route(&hovering(0), 0.0, &|_| true);
    assert!(matches!(way, Some(FlightRoute::Fly(_))), "{way:?}");
    map.give_up(&hovering(0), &[Point3::origin()], 10.0, true, &mut Off);
    assert_eq!((map.tally().patches, map.tally().open_m2), (0, 0.0));
    assert!((map.tally().given_up_m2 - tally.open_m2 - tally.sliver_m2).abs() < 1e-9);
    assert!(map.route(&hovering(0), 0.0, &|_| true).is_none());
}

#[test]
fn clearance_sees_the_wall_and_the_unknown() {
    let mut map = VoxelMap::new(params()).expect("parameters");
    look(&mut map, 0, &wall()).expect("a look");
    let near = map.clearance(&hovering(0), &Point3::new(0.0, 0.0, 1.6), 1.0);
    assert!((near.solid_at_end_m - 0.4).abs() < 0.1 && near.unseen_m > 0.3, "{near:?}");
    let through = map.clearance(&hovering(0), &Point3::new(0.0, 0.0, 2.6), 1.0);
    assert_eq!(through.solid_m, 0.0);
    let beside = map.clearance(&hovering(0), &Point3::new(1.5, 0.0, 0.5), 0.2);
    assert_eq!(beside.unseen_m, 0.0);
}

#[test]
fn poses_are_followed_only_where_looks_are_kept() {
    for reintegrate in [false, true] {
        let mut map = VoxelMap::new(VoxelParams { reintegrate, ..params() }).expect("parameters");
        let mut graph: PoseGraph<Se3> = PoseGraph::new();
        let [a, b] = [graph.add_vertex(), graph.add_vertex()];
        let edge = graph.add_edge(a, b, ahead(-1.0), EdgeKind::Odometry).expect("an edge");
        map.edges_added(&graph, &[edge], &mut Off);
        look(&mut map, b.0, &wall()).expect("a look");
        let at = Point3::new(0.0, 0.0, 1.07);
        assert_eq!(map.knows(&hovering(0), &at), Known::Solid);
        map.poses_reestimated(&[Se3::identity(), ahead(0.5)], &mut Off);
        let (before, after) = (at, Point3::new(0.0, 0.0, 2.57));
        let expected =
            if reintegrate { (Known::Free, Known::Solid) } else { (Known::Solid, Known::Unknown) };
        let known = (map.knows(&hovering(0), &before), map.knows(&hovering(0), &after));
        assert_eq!(known, expected);
        assert_eq!(map.work().corrections, u64::from(reintegrate));
    }
}

#[test]
fn bad_looks_are_refused() {
    let mut map = VoxelMap::new(params()).expect("parameters");
    let mut bad = wall();
    bad.depths_m.pop();
    assert!(look(&mut map, 0, &bad).is_err());
    bad = wall();
    bad.camera.fx = f64::NAN;
    assert!(look(&mut map, 0, &bad).is_err());
    look(&mut map, 0, &wall()).expect("a look");
    assert!(look(&mut map, 7, &wall()).is_err(), "a vertex that nothing is known of");
    assert!(VoxelMap::new(VoxelParams { cell_m: 0.0, ..params() }).is_err());
}
